# SPDX-License-Identifier: BSD-3-Clause
"""Static checks of whole experiments: samples that are lost, offsets by interval, and what cannot be checked."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.analysis import calibrate_sensor, check_sensor, samples_of
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError, SerialNumberError
from forcetorque.experiment import Experiment, load_experiment
from forcetorque.recording import Use
from tests.experiments import MOUNTED, OFFSET, PARQUET, TWO, YARP, edit
from tests.warm_experiments import (
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
    made = calibrate_sensor(experiment, experiment.sensors[0], code_version="test", created="test", **options)
    return "new", made


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
    checks = check_sensor(plain, plain.sensors[0])
    fit, judge = _rows(plain)
    assert min(fit, judge) > 400
    assert [(each.label, each.samples) for each in checks.intervals] == [("fit", fit), ("judge", judge)]
    assert [(each.saturated, each.missing, each.lost) for each in checks.intervals] == [(0, 0, None)] * 2
    damaged = _changed(plain, r30c2=32767.0, r31c5=-32700.0, r50c0=float("nan"), r5c0=32767.0, r710c1=float("nan"))
    first, second = check_sensor(damaged, damaged.sensors[0]).intervals
    assert (first.saturated, first.missing) == (2, 1)
    assert (second.saturated, second.missing) == (0, 0)
    assert (first.saturated_share, first.missing_share) == (2 / fit, 1 / fit)
    near = _changed(plain, r30c2=32600.0)  # 0.51 % below the limit
    assert check_sensor(near, near.sensors[0]).intervals[0].saturated == 0


def test_a_stretch_of_one_reading_is_saturated(arm: Path) -> None:
    """A board that says nothing repeats its last valid sample: 60 samples in 1.2 s count, 40 in 0.8 s do not."""
    plain = load_experiment(arm / PARQUET)
    raw = plain.recording.stream("arm_ft").signal("raw").values
    for length, counted in ((60, 60), (40, 0)):
        held = {f"r{row}c{k}": raw[100, k] for row in range(100, 100 + length) for k in range(6)}
        damaged = _changed(plain, **held)
        assert [each.saturated for each in check_sensor(damaged, damaged.sensors[0]).intervals] == [counted, 0]


def test_what_the_board_says_is_believed(arm: Path) -> None:
    """With a status only its samples count, whatever the counts are."""
    plain = load_experiment(arm / PARQUET)
    status = np.zeros(len(plain.recording.stream("arm_ft")))
    status[730:737] = 1.0
    damaged = _changed(plain, saturated=status, r30c2=32767.0)
    assert [each.saturated for each in check_sensor(damaged, damaged.sensors[0]).intervals] == [0, 7]


def test_lost_messages_are_counted_where_they_were_lost(arm: Path) -> None:
    """Three lost before row 100 and five before row 800; eight before row 10 are outside the intervals."""
    plain = load_experiment(arm / PARQUET)
    sequence = np.arange(len(plain.recording.stream("arm_ft")))
    for row, lost in ((10, 8), (100, 3), (800, 5)):
        sequence[row:] += lost
    first, second = check_sensor(_changed(plain, sequence=sequence), plain.sensors[0]).intervals
    assert (first.lost, second.lost) == (3, 5)
    assert first.lost_share == 3 / (3 + _rows(plain)[0])


def test_offsets_by_hand(arm: Path) -> None:
    """Per interval the mean of reference less matrix times counts; the prior's full scale has the fitted one."""
    experiment = load_experiment(arm / PARQUET)
    sensor = experiment.sensors[0]
    name, calibration = _fitted(experiment)
    prior, new = check_sensor(experiment, sensor), check_sensor(experiment, sensor, (name, calibration))
    assert sensor.prior is not None
    for checks, matrix in ((prior, sensor.prior), (new, calibration.matrix)):
        assert [each.label for each in checks.offsets] == ["fit", "judge"]
        for each, use in zip(checks.offsets, (Use.CALIBRATION, Use.VALIDATION), strict=True):
            (part,) = samples_of(experiment, sensor, use)
            by_hand = (part.samples.reference - part.raw @ matrix.T).mean(axis=0)
            np.testing.assert_allclose(each.offset, by_hand, atol=ROUNDING)
        assert checks.offset is not None
        apart = checks.offsets[0].offset - checks.offsets[1].offset
        np.testing.assert_allclose(checks.offset.change, np.abs(apart), atol=ROUNDING)
    assert prior.offset is not None
    assert new.offset is not None
    assert new.offset.force_change < 0.1 * prior.offset.force_change
    assert (prior.candidate, new.candidate) == ("prior matrix_SIM001.txt", "new")
    assert prior.matrix is not None
    assert prior.matrix.full_scale is not None
    unloaded = -np.linalg.solve(sensor.prior, prior.offsets[0].offset)
    at_limit = np.linalg.solve(sensor.prior, prior.matrix.full_scale.positive[2] * np.eye(6)[2]) + unloaded
    assert np.abs(at_limit).max() == pytest.approx(sensor.limit_counts, rel=1e-9)


def test_temperature_explains_the_change(warm: Path) -> None:
    """With the true matrix the slope is the true coefficient; a calibration that has the variable leaves nothing."""
    path = with_variables(warm / PARQUET, TEMPERATURE)
    experiment = load_experiment(path)
    sensor = experiment.sensors[0]
    true = check_sensor(experiment, replace(sensor, prior=MOUNTED))
    assert true.offset is not None
    assert true.offset.per_degree is not None
    np.testing.assert_allclose(true.offset.per_degree, PER_DEGREE, rtol=1e-6)
    (part,) = samples_of(experiment, sensor, Use.CALIBRATION)
    seconds = seconds_of(experiment.recording, part.samples.stamp_ns)
    assert true.offsets[0].temperature == pytest.approx(true_temperature(seconds).mean(), abs=1e-9)
    assert true.matrix is not None
    moved = OFFSET + (true.offsets[0].temperature - WARM_DEGC) * PER_DEGREE
    np.testing.assert_allclose(true.offsets[0].offset, moved, atol=1e-6)
    compensated = check_sensor(experiment, sensor, _fitted(experiment, regularisation=0.0))
    assert compensated.offset is not None
    assert compensated.offset.force_change < 1e-4 < 1e-2 * true.offset.force_change


def test_temperature_of_another_stream_is_used(warm: Path) -> None:
    """A slow board's temperature gives the same slope; without a variable there is none."""
    slow = load_experiment(with_variables(warm / PARQUET, SLOW_TEMPERATURE))
    found = check_sensor(slow, replace(slow.sensors[0], prior=MOUNTED)).offset
    assert found is not None
    assert found.per_degree is not None
    np.testing.assert_allclose(found.per_degree, PER_DEGREE, rtol=1e-6)


def test_without_a_variable_there_is_no_slope(warm: Path) -> None:
    """The stream holds a temperature, but the experiment does not say that it is the sensor's."""
    experiment = load_experiment(warm / PARQUET)
    found = check_sensor(experiment, experiment.sensors[0]).offset
    assert found is not None
    assert (found.temperature_span, found.per_degree) == (None, None)


def test_recovered_counts_give_the_same_checks(arm: Path) -> None:
    """A log of calibrated wrenches, with the matrix that they were made with, is checked like one of counts."""
    raw, wrenches = (load_experiment(arm / form) for form in (PARQUET, YARP))
    ours, theirs = check_sensor(raw, raw.sensors[0]), check_sensor(wrenches, wrenches.sensors[0])
    assert ours.matrix is not None
    assert theirs.matrix is not None
    assert ours.matrix.condition == theirs.matrix.condition
    assert ours.matrix.least_full_scale is not None
    np.testing.assert_allclose(theirs.matrix.least_full_scale, ours.matrix.least_full_scale, rtol=1e-3)


def test_what_cannot_be_measured_has_a_reason(arm: Path) -> None:
    """One interval, no population, and a log without counts; the rest is measured all the same."""
    text = (arm / PARQUET).read_text(encoding="utf-8")
    edit(arm / PARQUET, 'use = "validation"', 'use = "ignore"')
    experiment = load_experiment(arm / PARQUET)
    checks = check_sensor(experiment, experiment.sensors[0])
    assert set(checks.not_measured) == {"offset", "population"}
    assert "at least 2 recordings, got 1" in checks.not_measured["offset"]
    assert "--population" in checks.not_measured["population"]
    assert (checks.offset, len(checks.offsets), checks.population) == (None, 1, None)
    assert checks.matrix is not None
    (arm / PARQUET).write_text(text, encoding="utf-8")
    edit(arm / YARP, 'prior = "matrix_SIM001.txt"', 'prior = "identity"')
    unknown = load_experiment(arm / YARP)
    checks = check_sensor(unknown, unknown.sensors[0], population={str(k): MOUNTED for k in range(9)})
    assert set(checks.not_measured) == {"matrix", "population"}
    assert "not for counts" in checks.not_measured["matrix"]
    assert [each.saturated for each in checks.intervals] == [0, 0]
    assert checks.offset is not None


def test_the_sensor_itself_is_not_in_its_population(arm: Path) -> None:
    """Its own serial number is left out, also where that leaves too few."""
    experiment = load_experiment(arm / PARQUET)
    sensor = experiment.sensors[0]
    rng = np.random.default_rng(3)
    others = {f"SN{k}": MOUNTED * rng.uniform(0.9, 1.1, (6, 6)) for k in range(5)}
    found = check_sensor(experiment, sensor, population={**others, "SIM001": MOUNTED}).population
    assert found is not None
    assert found.count == 5
    del others["SN0"]
    reason = check_sensor(experiment, sensor, population={**others, "SIM001": MOUNTED}).not_measured["population"]
    assert "expected at least 5 other sensors, got 4" in reason


def test_calibrations_of_others_and_sensors_without_matrix_are_refused(arm: Path) -> None:
    """Another serial number; neither calibration nor prior; nothing but ignored intervals."""
    experiment = load_experiment(arm / TWO)
    foreign = calibrate_sensor(experiment, experiment.sensors[1], code_version="test", created="test")
    with pytest.raises(SerialNumberError, match="every sensor has its own matrix"):
        check_sensor(experiment, experiment.sensors[0], ("foreign", foreign))
    with pytest.raises(ExperimentError, match="expected a calibration, or a prior matrix"):
        check_sensor(experiment, replace(experiment.sensors[0], prior=None))
    ignored = [replace(interval, use=Use.IGNORE) for interval in experiment.recording.intervals]
    empty = replace(experiment, recording=replace(experiment.recording, intervals=tuple(ignored)))
    with pytest.raises(ExperimentError, match="an interval that is not ignored"):
        check_sensor(empty, empty.sensors[0])
