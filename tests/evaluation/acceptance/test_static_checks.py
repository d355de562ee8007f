# SPDX-License-Identifier: BSD-3-Clause
"""Static checks of whole experiments: samples that are lost, offsets by interval, and what cannot be checked."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, SerialNumberError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.acceptance.static_checks import StaticChecks, check
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.scenes.experiments import MOUNTED, OFFSET, PARQUET, TWO, YARP, edit
from tests.scenes.warm_experiments import (
    PER_DEGREE,
    SLOW_TEMPERATURE,
    TEMPERATURE,
    WARM_DEGC,
    fixed_signal,
    seconds_of,
    true_temperature,
    with_variables,
)

ROUNDING = 1e-9
"""N, N m: means of 1e3 sums of counts up to 2e4 and coefficients up to 0.03."""


def _rows(experiment: Experiment) -> list[int]:
    """How many samples of the sensor are in each interval."""
    stamps = experiment.recording.stream("arm_ft").stamp_ns
    return [int(((stamps >= i.start_ns) & (stamps < i.end_ns)).sum()) for i in experiment.recording.intervals]


def _fitted(experiment: Experiment, **options: Any) -> tuple[str, Calibration]:
    run = SensorRun(experiment, experiment.sensors[0])
    return "new", calibrate_sensor(run, code_version="test", created="test", **options)


def _checked(
    experiment: Experiment, calibration: Any = None, *, sensor: ExperimentSensor | None = None, population: Any = None
) -> StaticChecks:
    """Check the first sensor of an experiment, or a changed one."""
    return check(SensorRun(experiment, sensor or experiment.sensors[0]), calibration, population=population)


def _changed(experiment: Experiment, *, sequence: Any = None, saturated: Any = None, **values: float) -> Experiment:
    """The same experiment with a sequence, a status, or channels of some rows set, such as r30c2=32767."""
    stream = experiment.recording.stream("arm_ft")
    raw = np.array(stream.signal("raw").values)
    for place, value in values.items():
        row, channel = place.removeprefix("r").split("c")
        raw[int(row), int(channel)] = value
    signals = {"raw": replace(stream.signal("raw"), values=raw)}
    if saturated is not None:
        signals["saturated"] = fixed_signal("saturated", saturated[:, None])
    streams = {**experiment.recording.streams, "arm_ft": replace(stream, signals=signals, sequence=sequence)}
    return replace(experiment, recording=replace(experiment.recording, streams=streams))


def test_samples_are_counted_by_interval(arm: Path) -> None:
    """Two samples at a limit and one missing in the first, none in the second; those outside do not count."""
    plain = load_experiment(arm / PARQUET)
    checks = _checked(plain)
    fit, judge = _rows(plain)
    assert min(fit, judge) > 400
    assert [(row.label, row.samples) for row in checks.recording] == [("fit", fit), ("judge", judge)]
    shares = [(row.saturated_share, row.missing_share, row.lost_share) for row in checks.recording]
    assert shares == [(0.0, 0.0, None)] * 2
    damaged = _changed(plain, r30c2=32767.0, r31c5=-32700.0, r50c0=float("nan"), r5c0=32767.0, r710c1=float("nan"))
    first, second = _checked(damaged).recording
    assert (first.saturated_share, first.missing_share) == (2 / fit, 1 / fit)
    assert (second.saturated_share, second.missing_share) == (0.0, 0.0)
    near = _changed(plain, r30c2=32600.0)  # 0.51 % below the limit
    assert _checked(near).recording[0].saturated_share == 0.0


def test_a_stretch_of_one_reading_is_saturated(arm: Path) -> None:
    """A board that says nothing repeats its last valid sample: 40 samples in 0.8 s count, 20 in 0.4 s do not."""
    plain = load_experiment(arm / PARQUET)
    raw = plain.recording.stream("arm_ft").signal("raw").values
    for length, counted in ((40, 40), (20, 0)):
        held = {f"r{row}c{k}": raw[100, k] for row in range(100, 100 + length) for k in range(6)}
        damaged = _changed(plain, **held)
        shares = [row.saturated_share for row in _checked(damaged).recording]
        assert shares == [counted / _rows(plain)[0], 0.0]


def test_what_the_board_says_is_believed(arm: Path) -> None:
    """With a status only its samples count, whatever the counts are."""
    plain = load_experiment(arm / PARQUET)
    status = np.zeros(len(plain.recording.stream("arm_ft")))
    status[730:737] = 1.0
    damaged = _changed(plain, saturated=status, r30c2=32767.0)
    assert [row.saturated_share for row in _checked(damaged).recording] == [0.0, 7 / _rows(plain)[1]]


def test_lost_messages_are_counted_where_they_were_lost(arm: Path) -> None:
    """Three lost before row 100 and five before row 800; eight before row 10 are outside the intervals."""
    plain = load_experiment(arm / PARQUET)
    sequence = np.arange(len(plain.recording.stream("arm_ft")))
    for row, lost in ((10, 8), (100, 3), (800, 5)):
        sequence[row:] += lost
    fit, judge = _rows(plain)
    shares = [row.lost_share for row in _checked(_changed(plain, sequence=sequence)).recording]
    assert shares == [3 / (3 + fit), 5 / (5 + judge)]


def test_offsets_by_hand(arm: Path) -> None:
    """Per interval the mean of reference less matrix times counts; the prior's full scale has the fitted one."""
    experiment = load_experiment(arm / PARQUET)
    sensor = experiment.sensors[0]
    name, calibration = _fitted(experiment)
    prior, new = _checked(experiment), _checked(experiment, (name, calibration))
    assert sensor.prior is not None
    for checks, matrix in ((prior, sensor.prior), (new, calibration.matrix)):
        assert [each.label for each in checks.offsets] == ["fit", "judge"]
        for each, use in zip(checks.offsets, (Use.CALIBRATION, Use.VALIDATION), strict=True):
            (data,) = SensorRun(experiment, sensor).samples(use)
            by_hand = (data.samples.reference - data.raw @ matrix.T).mean(axis=0)
            np.testing.assert_allclose(each.offset, by_hand, atol=ROUNDING)
        assert checks.offset_change is not None
        apart = checks.offsets[0].offset - checks.offsets[1].offset
        np.testing.assert_allclose(checks.offset_change, np.abs(apart), atol=ROUNDING)
    assert prior.offset_force_change_N is not None
    assert new.offset_force_change_N is not None
    assert new.offset_force_change_N < 0.1 * prior.offset_force_change_N
    assert (prior.calibration, new.calibration) == ("prior matrix_SIM001.txt", "new")
    assert prior.full_scale_positive is not None
    unloaded = -np.linalg.solve(sensor.prior, prior.offsets[0].offset)
    at_limit = np.linalg.solve(sensor.prior, prior.full_scale_positive[2] * np.eye(6)[2]) + unloaded
    assert np.abs(at_limit).max() == pytest.approx(sensor.limit_counts, rel=1e-9)


def test_temperature_explains_the_change(warm_log: Path) -> None:
    """With the true matrix the slope is the true coefficient; a calibration that has the variable leaves nothing."""
    path = with_variables(warm_log / PARQUET, TEMPERATURE)
    experiment = load_experiment(path)
    sensor = experiment.sensors[0]
    true = _checked(experiment, sensor=replace(sensor, prior=MOUNTED))
    assert true.offset_per_degC is not None
    np.testing.assert_allclose(true.offset_per_degC, PER_DEGREE, rtol=1e-6)
    (data,) = SensorRun(experiment, sensor).samples(Use.CALIBRATION)
    seconds = seconds_of(experiment.recording, data.samples.stamp_ns)
    assert true.offsets[0].temperature_degC == pytest.approx(true_temperature(seconds).mean(), abs=1e-9)
    moved = OFFSET + (true.offsets[0].temperature_degC - WARM_DEGC) * PER_DEGREE
    np.testing.assert_allclose(true.offsets[0].offset, moved, atol=1e-6)
    compensated = _checked(experiment, _fitted(experiment, regularisation=0.0))
    assert compensated.offset_force_change_N is not None
    assert true.offset_force_change_N is not None
    assert compensated.offset_force_change_N < 1e-4 < 1e-2 * true.offset_force_change_N


def test_temperature_of_another_stream_is_used(warm_log: Path) -> None:
    """A slow board's temperature gives the same slope; without a variable there is none."""
    slow = load_experiment(with_variables(warm_log / PARQUET, SLOW_TEMPERATURE))
    slope = _checked(slow, sensor=replace(slow.sensors[0], prior=MOUNTED)).offset_per_degC
    assert slope is not None
    np.testing.assert_allclose(slope, PER_DEGREE, rtol=1e-6)


def test_without_a_variable_there_is_no_slope(warm_log: Path) -> None:
    """The stream holds a temperature, but the experiment does not say that it is the sensor's."""
    experiment = load_experiment(warm_log / PARQUET)
    checks = _checked(experiment)
    assert checks.offset_change is not None
    assert [row.temperature_degC for row in checks.offsets] == [None, None]
    assert checks.offset_per_degC is None


def test_recovered_counts_give_the_same_checks(arm: Path) -> None:
    """A log of calibrated wrenches, with the matrix that they were made with, is checked like one of counts."""
    raw, wrenches = (load_experiment(arm / form) for form in (PARQUET, YARP))
    ours, theirs = _checked(raw), _checked(wrenches)
    assert ours.condition is not None
    assert ours.condition == theirs.condition
    assert ours.full_scale_least is not None
    assert theirs.full_scale_least is not None
    np.testing.assert_allclose(theirs.full_scale_least, ours.full_scale_least, rtol=1e-3)


def test_what_cannot_be_measured_has_a_reason(arm: Path) -> None:
    """One interval, no population, and a log without counts; the rest is measured all the same."""
    text = (arm / PARQUET).read_text(encoding="utf-8")
    edit(arm / PARQUET, 'use = "validation"', 'use = "ignore"')
    experiment = load_experiment(arm / PARQUET)
    checks = _checked(experiment)
    assert set(checks.not_measured) == {"offset", "population"}
    assert "at least 2 recordings, got 1" in checks.not_measured["offset"]
    assert "--population" in checks.not_measured["population"]
    assert (checks.offset_change, len(checks.offsets)) == (None, 1)
    assert (checks.population_count, checks.population) == (None, ())
    assert checks.condition is not None
    (arm / PARQUET).write_text(text, encoding="utf-8")
    edit(arm / YARP, 'prior = "matrix_SIM001.txt"', 'prior = "identity"')
    unknown = load_experiment(arm / YARP)
    checks = _checked(unknown, population={str(k): MOUNTED for k in range(9)})
    assert set(checks.not_measured) == {"matrix", "population"}
    assert "not for counts" in checks.not_measured["matrix"]
    assert [row.saturated_share for row in checks.recording] == [0.0, 0.0]
    assert checks.offset_change is not None


def test_the_sensor_itself_is_not_in_its_population(arm: Path) -> None:
    """Its own serial number is left out, also where that leaves too few."""
    experiment = load_experiment(arm / PARQUET)
    rng = np.random.default_rng(3)
    others = {f"SN{k}": MOUNTED * rng.uniform(0.9, 1.1, (6, 6)) for k in range(5)}
    assert _checked(experiment, population={**others, "SIM001": MOUNTED}).population_count == 5
    del others["SN0"]
    reason = _checked(experiment, population={**others, "SIM001": MOUNTED}).not_measured["population"]
    assert "expected at least 5 other sensors, got 4" in reason


@pytest.mark.long
def test_the_checks_are_one_line_of_numbers_and_say_themselves_in_short(arm: Path) -> None:
    """Components have their units in the keys, and what JSON cannot hold is null there but not in Python."""
    experiment = load_experiment(arm / PARQUET)
    name, calibration = _fitted(experiment)
    equal = np.array(calibration.matrix)
    equal[4] = equal[3]
    checks = _checked(experiment, (name, calibration.model_copy(update={"matrix": equal})))
    assert checks.condition == np.inf
    line = checks.flat()
    assert (line["condition"], line["resolution_rms_fx_N"]) == (None, float(checks.resolution_rms[0]))  # type: ignore[index]
    assert (checks.full_scale_least, "singular" in checks.not_measured["full_scale"]) == (None, True)
    assert len(repr(checks)) < 1000


def test_calibrations_of_others_and_sensors_without_matrix_are_refused(arm: Path) -> None:
    """Another serial number; neither calibration nor prior; nothing but ignored intervals."""
    experiment = load_experiment(arm / TWO)
    foreign = calibrate_sensor(SensorRun(experiment, experiment.sensors[1]), code_version="test", created="test")
    with pytest.raises(SerialNumberError, match="every sensor has its own matrix"):
        _checked(experiment, ("foreign", foreign))
    with pytest.raises(ExperimentError, match="expected a calibration, or a prior matrix"):
        _checked(experiment, sensor=replace(experiment.sensors[0], prior=None))
    ignored = [replace(interval, use=Use.IGNORE) for interval in experiment.recording.intervals]
    empty = replace(experiment, recording=replace(experiment.recording, intervals=tuple(ignored)))
    with pytest.raises(ExperimentError, match="an interval that is not ignored"):
        _checked(empty)
