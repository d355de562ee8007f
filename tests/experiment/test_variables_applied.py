# SPDX-License-Identifier: BSD-3-Clause
"""A calibration with temperature where it is used: verdicts, estimates and gains; refused where there is none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, RecordingError, SerialNumberError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.evaluation.commands import evaluate
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import is_invertible
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.recording.recording import Use
from forcetorque.recording.storage import read_recording
from forcetorque.sensor.gains.gains import select_gains
from forcetorque.simulation.simulated_sensor import calibrated_by_board
from tests.scenes.experiments import FACTORY, PARQUET, edit
from tests.scenes.warm_experiments import (
    PER_DEGREE,
    PERIOD_S,
    SLOW_TEMPERATURE,
    SUPPLY,
    TEMPERATURE,
    put,
    seconds_of,
    true_temperature,
    with_variables,
)

NOTHING = 1e-5
"""N, N m: what an exact model leaves of some 100 N, by the condition of the fit."""
PLACES = pytest.mark.parametrize("place", [TEMPERATURE, SLOW_TEMPERATURE], ids=["own stream", "slow stream"])


def _fitted(experiment: Experiment) -> Calibration:
    sensor = experiment.sensors[0]
    return calibrate_sensor(SensorRun(experiment, sensor), code_version="1", created="now", regularisation=0.0)


@pytest.fixture(scope="module")
def with_temperature(intact_warm_log: Path, tmp_path_factory: pytest.TempPathFactory) -> Calibration:
    """The exact calibration of the drifting sensor."""
    return _fitted(load_experiment(_stated(intact_warm_log, tmp_path_factory.mktemp("stated"), TEMPERATURE)))


@pytest.fixture(scope="module")
def without(intact_warm_log: Path) -> Calibration:
    """Its calibration that knows nothing of the temperature."""
    return _fitted(load_experiment(intact_warm_log / PARQUET))


def _stated(folder: Path, beside: Path, *variables: str) -> Path:
    """An experiment file elsewhere that states variables of a folder that nobody changes."""
    text = (folder / PARQUET).read_text(encoding="utf-8")
    for name in ("arm.urdf", "recording", "matrix_SIM001.txt"):
        text = text.replace(f'"{name}"', f'"{(folder / name).as_posix()}"')
    file = beside / PARQUET
    file.write_text(text, encoding="utf-8")
    prior = f'prior = "{(folder / "matrix_SIM001.txt").as_posix()}"\n'
    return edit(file, prior, prior + "".join(variables))


def _silence(folder: Path, start_s: float, end_s: float) -> None:
    """Take the slow stream's stamps inside a span out."""
    board = read_recording(folder / "recording").stream("board")
    seconds = PERIOD_S * np.arange(len(board))
    kept = (seconds <= start_s) | (seconds >= end_s)
    signals = {name: replace(signal, values=signal.values[kept]) for name, signal in board.signals.items()}
    put(folder, replace(board, stamp_ns=board.stamp_ns[kept], signals=signals))


@PLACES
def test_a_verdict_takes_the_temperature_of_the_judged_samples(
    warm_log: Path, with_temperature: Calibration, place: str
) -> None:
    """The exact calibration leaves nothing on data that was not fitted; prior and plain calibration leave newtons."""
    experiment = load_experiment(with_variables(warm_log / PARQUET, place))
    verdicts = evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": with_temperature}).verdicts
    errors = {(v.calibration, v.offset): v for v in verdicts}
    assert list(errors) == [(c, o) for c in ("prior", "new") for o in ("fitted", "judged-mean")]
    for offset in ("fitted", "judged-mean"):
        assert errors["new", offset].rmse.max() < NOTHING < 0.1 < errors["prior", offset].rmse.max()
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.VALIDATION)
    wrong = with_temperature.model.wrench(part.raw, np.full((len(part.raw), 1), 30.0))
    assert np.abs(wrong - part.samples.reference).max() > 1.0  # negative control: the temperature matters there


@pytest.mark.long
def test_a_verdict_does_not_depend_on_who_is_judged_beside(
    warm_log: Path, with_temperature: Calibration, without: Calibration
) -> None:
    """Each candidate has the errors that it has alone, in any order; all are judged on the same samples."""
    experiment = load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE))
    sensor = experiment.sensors[0]
    alone = {}
    for name, one in {"warm": with_temperature, "plain": without}.items():
        verdicts = evaluate(SensorRun(experiment, sensor), {name: one.model_copy(update={"prior": None})}).verdicts
        alone |= {(v.calibration, v.offset): v.rmse for v in verdicts}
    tried = 0
    for order in (("warm", "plain"), ("plain", "warm")):
        given = {name: {"warm": with_temperature, "plain": without}[name] for name in order}
        verdicts = evaluate(SensorRun(experiment, sensor), given).verdicts
        assert len({v.samples for v in verdicts}) == 1
        for verdict in verdicts:
            if not verdict.calibration.startswith("prior"):
                np.testing.assert_array_equal(verdict.rmse, alone[verdict.calibration, verdict.offset])
                tried += 1
    assert tried == 8


def test_samples_without_a_temperature_are_judged_for_nobody(
    warm_log: Path, with_temperature: Calibration, without: Calibration
) -> None:
    """A gap of the thermometer takes its samples from all candidates, if one of them needs the temperature."""
    _silence(warm_log, 15.0, 19.0)
    experiment = load_experiment(with_variables(warm_log / PARQUET, SLOW_TEMPERATURE, SUPPLY))
    sensor = experiment.sensors[0]
    both = evaluate(SensorRun(experiment, sensor), {"warm": with_temperature, "plain": without}).verdicts
    plain = evaluate(SensorRun(experiment, sensor), {"plain": without}).verdicts
    stream = experiment.recording.stream("arm_ft")
    (judge,) = experiment.intervals(Use.VALIDATION)
    inside = (stream.stamp_ns >= judge.start_ns) & (stream.stamp_ns < judge.end_ns)
    seconds = seconds_of(experiment.recording, stream.stamp_ns)
    assert {v.samples for v in plain} == {np.count_nonzero(inside)}
    assert {v.samples for v in both} == {np.count_nonzero(inside & ((seconds <= 15.0) | (seconds >= 19.0)))}
    assert max(v.rmse.max() for v in both if v.calibration == "warm") < NOTHING


@PLACES
def test_an_estimate_takes_the_temperature_of_its_instants(
    warm_log: Path, with_temperature: Calibration, place: str
) -> None:
    """Nothing touches the arm, so the exact calibration finds no contact; without the temperature there is one."""
    experiment = load_experiment(with_variables(warm_log / PARQUET, place))
    corrections = corrections_of(experiment, {"warm.json": with_temperature})
    assert corrections["arm_ft"].variables == ("temperature",)
    spans = estimate_experiment(experiment, corrections)
    assert [span.interval.label for span in spans] == ["fit", "judge"]
    for span in spans:
        assert np.abs(span.estimates.contact("arm_ft")).max() < NOTHING
        measured = span.measured.of_name("arm_ft")
        seconds = seconds_of(experiment.recording, span.stamp_ns)
        drift = np.outer(true_temperature(seconds) - with_temperature.variables[0].reference_value, PER_DEGREE)
        raw = _raw_at(experiment, span.stamp_ns)
        by_hand = raw @ with_temperature.matrix.T + with_temperature.offset + drift
        assert np.abs(measured - by_hand).max() < NOTHING
        assert np.abs(drift).max() > 1.0  # negative control: without it the reading would be another


def _raw_at(experiment: Experiment, stamp_ns: FloatArray) -> FloatArray:
    stream = experiment.recording.stream("arm_ft")
    return stream.signal("raw").values[np.isin(stream.stamp_ns, stamp_ns)]


def test_an_estimate_has_a_gap_where_the_thermometer_has_one(warm_log: Path, with_temperature: Calibration) -> None:
    """Its instants stay, without a measured wrench; where only the prior reads the sensor there is no gap."""
    _silence(warm_log, 16.0, 20.0)
    experiment = load_experiment(with_variables(warm_log / PARQUET, SLOW_TEMPERATURE))
    for given, gap in (({"warm": with_temperature}, True), ({}, False)):
        _, judge = estimate_experiment(experiment, corrections_of(experiment, given))
        seconds = seconds_of(experiment.recording, judge.stamp_ns)
        missing = np.isnan(judge.measured.of_name("arm_ft")).any(axis=1)
        silent = (seconds > 16.0) & (seconds < 20.0)
        np.testing.assert_array_equal(missing, silent & gap)
        assert np.count_nonzero(silent) > 150


def test_an_estimate_asks_whose_clock_stamped_the_temperature(warm_log: Path, with_temperature: Calibration) -> None:
    """Another clock is refused as it is for a fit, but only where the temperature is needed."""
    board = read_recording(warm_log / "recording").stream("board")
    put(warm_log, replace(board, clock="board"))
    experiment = load_experiment(with_variables(warm_log / PARQUET, SLOW_TEMPERATURE))
    with pytest.raises(
        RecordingError, match="'arm_ft' and 'board' were stamped by the clocks 'simulation' and 'board'"
    ):
        estimate_experiment(experiment, corrections_of(experiment, {"warm": with_temperature}))
    assert estimate_experiment(experiment, corrections_of(experiment, {}))


def test_a_calibrated_stream_is_corrected_with_its_temperature(warm_log: Path) -> None:
    """Counts recovered through the prior, with the temperature: a board's wrenches are fitted and estimated exactly."""
    prior = read_matrix_file(warm_log / "matrix_SIM001.txt").matrix
    assert is_invertible(prior)
    recording = calibrated_by_board(read_recording(warm_log / "recording"), "arm_ft", matrix=prior, frame="arm_ft")
    put(warm_log, recording.stream("arm_ft"))
    experiment = load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE))
    assert experiment.sensors[0].quantity == "wrench"
    made = _fitted(experiment)
    verdicts = evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": made}).verdicts
    assert max(v.rmse.max() for v in verdicts if v.calibration == "new") < NOTHING
    spans = estimate_experiment(experiment, corrections_of(experiment, {"new": made}))
    assert max(np.abs(span.estimates.contact("arm_ft")).max() for span in spans) < NOTHING


def test_gains_take_the_matrix_of_a_calibration_with_temperature(warm_log: Path, with_temperature: Calibration) -> None:
    """What a count is worth is the matrix's business alone."""
    experiment = load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE))
    run = SensorRun(experiment, experiment.sensors[0])
    (row,) = select_gains(run, {"warm.json": with_temperature}).sensors
    assert row.matrix == "warm.json"
    worst = [axis.worst for axis in row.resolution]
    np.testing.assert_allclose(worst, np.abs(with_temperature.matrix).sum(axis=1))
    assert not np.allclose(worst, np.abs(FACTORY).sum(axis=1), rtol=1e-3)


Use_ = Callable[[Experiment, Calibration], object]
USES: dict[str, Use_] = {
    "evaluate": lambda experiment, made: evaluate(SensorRun(experiment, experiment.sensors[0]), {"warm.json": made}),
    "estimate": lambda experiment, made: corrections_of(experiment, {"warm.json": made}),
    "gains": lambda experiment, made: select_gains(SensorRun(experiment, experiment.sensors[0]), {"warm.json": made}),
}
_VOLTS = SUPPLY.replace('name = "supply"', 'name = "temperature"')


@pytest.mark.parametrize("use", USES)
@pytest.mark.parametrize(
    ("variables", "message"),
    [
        (
            (),
            r"sensor 'arm_ft': expected the variable 'temperature', the experiment specifies none; add it as",
        ),
        ((SUPPLY,), "sensor 'arm_ft': expected the variable 'temperature', the experiment specifies supply; add it"),
        ((_VOLTS,), "calibration 'warm.json' has the variable 'temperature' in degC, the experiment in V; convert"),
    ],
)
def test_an_experiment_that_cannot_give_the_variable_is_refused(
    warm_log: Path, with_temperature: Calibration, use: str, variables: tuple[str, ...], message: str
) -> None:
    """The variable must be stated under its name and in its unit; a wrong one is never taken for it."""
    experiment = load_experiment(with_variables(warm_log / PARQUET, *variables))
    with pytest.raises(ExperimentError, match=message):
        USES[use](experiment, with_temperature)


@pytest.mark.parametrize("use", USES)
def test_another_serial_number_is_refused(warm_log: Path, with_temperature: Calibration, use: str) -> None:
    """As without variables; the file that states them changes nothing about it."""
    file = with_variables(warm_log / PARQUET, TEMPERATURE)
    experiment = load_experiment(edit(file, 'serial = "SIM001"', 'serial = "SIM009"'))
    with pytest.raises(SerialNumberError, match="^warm.json: calibration of sensor 'SIM001': .* got 'SIM009'"):
        USES[use](experiment, with_temperature)
