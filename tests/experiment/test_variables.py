# SPDX-License-Identifier: BSD-3-Clause
"""Linear variables of a sensor: where their values come from, which samples have them, and what a fit makes of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, FormatError, RecordingError
from forcetorque.calibration.calibrate import calibrate_sensor, fit_doubts
from forcetorque.experiment.additions import added_to
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.recording.smoothing import EvenGrid, SavitzkyGolay, smooth
from forcetorque.recording.storage import read_recording
from tests.scenes.experiments import MOUNTED, OFFSET, PARQUET, TWO, add, edit
from tests.scenes.warm_experiments import (
    EXACT,
    NOMINAL_V,
    PER_DEGREE,
    PER_VOLT,
    PERIOD_S,
    SLOW_TEMPERATURE,
    SUPPLY,
    TEMPERATURE,
    WARM_DEGC,
    put,
    seconds_of,
    true_supply,
    true_temperature,
    warm_up,
    with_variables,
)

INTERPOLATED = 1e-9
"""degC, V: rounding of stamps of 1e18 ns to seconds of the recording, times a few degrees per second."""


def _fitted(
    experiment: Experiment, *, sensor: int = 0, regularisation: float | Literal["held-out"] | None = 0.0
) -> Calibration:
    return calibrate_sensor(
        SensorRun(experiment, experiment.sensors[sensor]),
        code_version="1",
        created="now",
        regularisation=regularisation,
    )


def _close(found: FloatArray, truth: FloatArray) -> bool:
    return bool(np.abs(found - truth).max() < EXACT * np.abs(truth).max())


@pytest.mark.parametrize("place", [TEMPERATURE, SLOW_TEMPERATURE], ids=["own stream", "slow stream"])
def test_the_truth_is_found_with_the_temperature(warm_log: Path, place: str) -> None:
    """Matrix, offset and coefficients are exact; the reference value is the first fitted sample's."""
    experiment = load_experiment(with_variables(warm_log / PARQUET, place))
    made = _fitted(experiment)
    assert made.estimation_type == "OwTrTO"
    assert _close(made.matrix, MOUNTED)
    (variable,) = made.variables
    assert (variable.name, variable.unit, variable.prior) == ("temperature", "degC", None)
    assert _close(variable.coefficients, PER_DEGREE)
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(
        Use.CALIBRATION, variables=[v.linear.name for v in experiment.sensors[0].variables]
    )
    first = true_temperature(seconds_of(experiment.recording, part.samples.stamp_ns[:1]))[0]
    assert abs(variable.reference_value - first) < INTERPOLATED
    assert _close(made.offset, OFFSET + PER_DEGREE * (first - WARM_DEGC))
    assert made.provenance.dropped == 0


def test_without_the_temperature_the_drift_stays(warm_log: Path) -> None:
    """Negative control: the same data without the variable give another matrix and leave newtons."""
    with_variable = _fitted(load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE)))
    plain = _fitted(load_experiment(edit(warm_log / PARQUET, TEMPERATURE, "")))
    assert (plain.estimation_type, plain.variables) == ("OnTdTO", ())
    assert not np.abs(plain.matrix - MOUNTED).max() < 1e3 * EXACT * np.abs(MOUNTED).max()
    # N, N m; the mean square of a residual is a difference of moments of some 1e3 N2, so its root keeps half the digits
    assert with_variable.residual_rms.max() < 1e-5 < 0.1 < plain.residual_rms.max()


@pytest.mark.parametrize("place", [TEMPERATURE, SLOW_TEMPERATURE], ids=["own stream", "slow stream"])
def test_values_are_those_at_the_instants_of_the_sensor(warm_log: Path, place: str) -> None:
    """Interpolated over time: a temperature that comes back to a value has that value both times."""
    experiment = load_experiment(with_variables(warm_log / PARQUET, place))
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(
        Use.CALIBRATION, variables=[v.linear.name for v in experiment.sensors[0].variables]
    )
    seconds = seconds_of(experiment.recording, part.samples.stamp_ns)
    values = part.samples.variables[:, 0]
    assert np.abs(values - true_temperature(seconds)).max() < INTERPOLATED
    # negative control: unique values at the instants at which they came first
    logged = experiment.recording.stream("board").signal("temperature").values[:, 0]
    unique, first = np.unique(logged, return_index=True)
    assert len(unique) < len(logged)
    order = np.argsort(first)
    over_unique = np.interp(seconds, PERIOD_S * first[order], unique[order])
    assert np.abs(over_unique - values).max() > 1.0


def test_samples_in_a_gap_of_the_thermometer_are_left_out(warm_log: Path) -> None:
    """Four seconds of silence take out the samples inside, which are counted; the fit stays exact."""
    board = read_recording(warm_log / "recording").stream("board")
    kept = np.r_[:12, 20 : len(board)]  # silent between the stamps at 5.5 s and at 10 s
    signals = {name: replace(signal, values=signal.values[kept]) for name, signal in board.signals.items()}
    put(warm_log, replace(board, stamp_ns=board.stamp_ns[kept], signals=signals))
    experiment = load_experiment(with_variables(warm_log / PARQUET, SLOW_TEMPERATURE))
    (fit,) = experiment.intervals(Use.CALIBRATION)
    stamps = experiment.recording.stream("arm_ft").stamp_ns
    silent = (stamps > board.stamp_ns[11]) & (stamps < board.stamp_ns[20])
    inside = (stamps >= fit.start_ns) & (stamps < fit.end_ns)
    made = _fitted(experiment)
    assert made.provenance.dropped == np.count_nonzero(silent) > 200
    assert made.provenance.samples == np.count_nonzero(inside & ~silent)
    assert _close(made.matrix, MOUNTED)
    assert _close(made.variables[0].coefficients, PER_DEGREE)
    (without,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.CALIBRATION)
    assert without.samples.dropped == 0


@pytest.mark.parametrize("place", [TEMPERATURE, SLOW_TEMPERATURE], ids=["own stream", "slow stream"])
def test_a_glitch_of_the_thermometer_is_left_out_and_named(warm_log: Path, place: str) -> None:
    """One value of 1e4 degC would take the coefficients to nothing; the fit stays exact, and the result says so."""
    name = "arm_ft" if place == TEMPERATURE else "board"
    stream = read_recording(warm_log / "recording").stream(name)
    temperature = stream.signal("temperature")
    values = np.array(temperature.values)
    values[len(values) // 2] = 1e4
    put(warm_log, replace(stream, signals={**stream.signals, "temperature": replace(temperature, values=values)}))
    experiment = load_experiment(with_variables(warm_log / PARQUET, place))
    made = _fitted(experiment)
    assert _close(made.variables[0].coefficients, PER_DEGREE)
    assert made.variables[0].maximum < 40.0
    (said,) = added_to(experiment.recording)
    assert f"{name}: temperature (degC): left out 1 value of {len(values)} that is nowhere near" in said
    assert "1e+04; the others lie from 2" in said


def test_glitches_of_the_thermometer_that_are_too_many_are_named(warm_log: Path) -> None:
    """Every third value of the slow stream; they are used."""
    stream = read_recording(warm_log / "recording").stream("board")
    temperature = stream.signal("temperature")
    values = np.array(temperature.values)
    values[1::3] = 1e4
    put(warm_log, replace(stream, signals={**stream.signals, "temperature": replace(temperature, values=values)}))
    recording = load_experiment(with_variables(warm_log / PARQUET, SLOW_TEMPERATURE)).recording
    (said,) = added_to(recording)
    assert f"temperature (degC): {len(values[1::3])} of {len(values)} values are nowhere near the others" in said
    assert np.isfinite(recording.stream("board").signal("temperature").values).all()


def test_a_missing_temperature_leaves_its_sample_out(warm_log: Path) -> None:
    """In the sensor's own stream one NaN costs one sample, and none where the variable is not fitted."""
    stream = read_recording(warm_log / "recording").stream("arm_ft")
    temperature = stream.signal("temperature")
    values = np.array(temperature.values)
    values[[200, 300]] = np.nan
    put(warm_log, replace(stream, signals={**stream.signals, "temperature": replace(temperature, values=values)}))
    experiment = load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE))
    assert _fitted(experiment).provenance.dropped == 2
    without = replace(experiment, fit_options=replace(experiment.fit_options, with_variables=False))
    plain = calibrate_sensor(
        SensorRun(without, without.sensors[0]),
        code_version="1",
        created="now",
        regularisation=1.0,
    )
    assert (plain.provenance.dropped, plain.variables) == (0, ())


def test_two_variables_are_fitted_together(intact: Path, tmp_path: Path) -> None:
    """Temperature of the own stream and voltage of a slow one; each has a reference value of its own."""
    folder = warm_up(intact, tmp_path / "warm", per_volt=PER_VOLT)
    references = [f"reference_value = {value}\n" for value in (WARM_DEGC, NOMINAL_V)]
    file = with_variables(folder / PARQUET, TEMPERATURE, references[0], SUPPLY, references[1])
    made = _fitted(load_experiment(file))
    assert _close(made.matrix, MOUNTED)
    assert [(v.name, v.unit, v.reference_value) for v in made.variables] == [
        ("temperature", "degC", WARM_DEGC),
        ("supply", "V", NOMINAL_V),
    ]
    assert _close(made.variables[0].coefficients, PER_DEGREE)
    assert _close(made.variables[1].coefficients, PER_VOLT)
    assert _close(made.offset, OFFSET)
    for variable, truth in zip(made.variables, (true_temperature, true_supply), strict=True):
        fitted = truth(np.arange(0.5, 14.0, 0.02))
        assert variable.minimum == pytest.approx(fitted.min(), abs=0.02)
        assert variable.maximum == pytest.approx(fitted.max(), abs=0.02)


def test_a_missing_current_is_nothing_to_the_voltage(warm_log: Path) -> None:
    """A gap in one column of a stream takes no value from another."""
    board = read_recording(warm_log / "recording").stream("board")
    scalar = board.signal("scalar")
    values = np.array(scalar.values)
    values[:, 1] = np.nan
    put(warm_log, replace(board, signals={**board.signals, "scalar": replace(scalar, values=values)}))
    experiment = load_experiment(with_variables(warm_log / PARQUET, SUPPLY))
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(
        Use.CALIBRATION, variables=[v.linear.name for v in experiment.sensors[0].variables]
    )
    assert part.samples.dropped == 0
    seconds = seconds_of(experiment.recording, part.samples.stamp_ns)
    assert np.abs(part.samples.variables[:, 0] - true_supply(seconds)).max() < INTERPOLATED


def test_coefficients_that_are_known_pull_the_fit(warm_log: Path) -> None:
    """A strong lambda keeps matrix and coefficients of the file; without prior coefficients only the matrix."""
    known = PER_DEGREE + 0.5
    stated = f"prior_coefficients = {known.tolist()}\n"
    pulled = _fitted(load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE, stated)), regularisation=1e15)
    free = _fitted(load_experiment(edit(warm_log / PARQUET, stated, "")), regularisation=1e15)
    assert pulled.variables[0].prior is not None
    np.testing.assert_array_equal(pulled.variables[0].prior, known)
    np.testing.assert_allclose(pulled.variables[0].coefficients, known, rtol=1e-6)
    assert np.abs(free.variables[0].coefficients - known).min() > 1e-3


def test_smoothing_takes_the_temperature_along(warm_log: Path) -> None:
    """One filter on reading, reference and temperature keeps the model exact, where a fast temperature is smoothed."""
    recording = read_recording(warm_log / "recording")
    stream = recording.stream("arm_ft")
    jumps = 4.0 * np.sign(np.sin(2.0 * np.pi * seconds_of(recording, stream.stamp_ns) / 0.7))
    raw, temperature = stream.signal("raw"), stream.signal("temperature")
    drifted = replace(raw, values=raw.values - np.linalg.solve(MOUNTED, np.outer(jumps, PER_DEGREE).T).T)
    jumping = replace(temperature, values=temperature.values + jumps[:, None])
    put(warm_log, replace(stream, signals={"raw": drifted, "temperature": jumping}))
    file = with_variables(warm_log / PARQUET, TEMPERATURE)
    add(file, "\n[processing]\nsmoothing = { window_s = 0.5, order = 2 }\n")
    experiment = load_experiment(file)
    made = _fitted(experiment)
    assert _close(made.matrix, MOUNTED)
    assert _close(made.variables[0].coefficients, PER_DEGREE)
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(
        Use.CALIBRATION, variables=[v.linear.name for v in experiment.sensors[0].variables]
    )
    whole = np.isfinite(raw.values).all(axis=1)[:, None]
    window, grid = SavitzkyGolay(window_s=0.5, order=2), EvenGrid.of(stream.stamp_ns)
    alone = smooth(stream.stamp_ns, np.where(whole, jumping.values, np.nan), window, grid=grid)
    inside = np.isin(stream.stamp_ns, part.samples.stamp_ns)
    assert np.abs(part.samples.variables - alone[inside]).max() < 1e-6  # degC; stamps as floats
    assert (
        np.abs(part.samples.variables - jumping.values[inside]).max() > 1.0
    )  # negative control: it was no smooth temperature


def test_a_first_calibration_needs_no_prior(warm_log: Path) -> None:
    """A sensor that nobody calibrated gets matrix and coefficients from lambda 0; nothing else is possible."""
    file = edit(with_variables(warm_log / PARQUET, TEMPERATURE), 'prior = "matrix_SIM001.txt"\n', "")
    experiment = load_experiment(file)
    made = _fitted(experiment)
    assert made.prior is None
    assert _close(made.matrix, MOUNTED)
    assert _close(made.variables[0].coefficients, PER_DEGREE)
    with pytest.raises(FitError, match="lambda cannot be chosen without a prior matrix; give a prior, or lambda 0"):
        _fitted(experiment, regularisation="held-out")


def test_lambda_is_chosen_with_the_temperature(warm_log: Path) -> None:
    """Data without noise trust no prior: the held-out choice keeps the matrix exact to a thousandth of its error."""
    made = _fitted(load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE)), regularisation="held-out")
    assert made.prior is not None
    assert "held-out" in made.selection.rule
    assert np.abs(made.matrix - MOUNTED).max() < 1e-3 * np.abs(made.prior.matrix - MOUNTED).max()
    np.testing.assert_allclose(made.variables[0].coefficients, PER_DEGREE, rtol=1e-3)


def test_a_constant_is_refused(warm_log: Path) -> None:
    """A temperature that does not change is named with its value, its unit and the way out."""
    stream = read_recording(warm_log / "recording").stream("arm_ft")
    temperature = stream.signal("temperature")
    still = replace(temperature, values=np.full_like(temperature.values, 31.5))
    put(warm_log, replace(stream, signals={**stream.signals, "temperature": still}))
    experiment = load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE))
    for regularisation in (0.0, 100.0, "held-out"):
        with pytest.raises(FitError, match="'temperature': its value is 31.5 degC throughout .* or a type without var"):
            _fitted(experiment, regularisation=regularisation)
    made = _fitted(experiment, regularisation=None)  # the default keeps what was expected of it, and says so
    assert np.abs(made.variables[0].coefficients).max() < 1e-9
    assert made.variables[0].standard_error is not None
    assert made.variables[0].standard_error.min() > 0.0
    assert any("temperature is 31.5 degC throughout" in doubt for doubt in fit_doubts(made))


def test_a_sensor_without_variables_stands_beside_one_with(warm_log: Path) -> None:
    """By default each sensor gets the type that its variables allow; a type that needs one is refused by name."""
    file = with_variables(warm_log / TWO, TEMPERATURE)
    experiment = load_experiment(file)
    assert [len(sensor.variables) for sensor in experiment.sensors] == [1, 0]
    kinds = [_fitted(experiment, sensor=k, regularisation=1.0).estimation_type for k in (0, 1)]
    assert kinds == ["OwTrTO", "OnTdTO"]
    asked = load_experiment(add(file, '\n[calibration]\ntype = "OwTrTO"\n'))
    assert _fitted(asked, sensor=0, regularisation=1.0).estimation_type == "OwTrTO"
    with pytest.raises(FitError, match="type OwTrTO: expected a linear variable such as temperature, the data have no"):
        _fitted(asked, sensor=1, regularisation=1.0)


def test_another_clock_is_refused(warm_log: Path) -> None:
    """Values of a stream that another clock stamped have no place among the samples."""
    board = read_recording(warm_log / "recording").stream("board")
    put(warm_log, replace(board, clock="board"))
    experiment = load_experiment(with_variables(warm_log / PARQUET, SLOW_TEMPERATURE))
    with pytest.raises(
        RecordingError, match="'arm_ft' and 'board' were stamped by the clocks 'simulation' and 'board'"
    ):
        _fitted(experiment)


def test_no_value_over_an_interval_is_refused(warm_log: Path) -> None:
    """A thermometer that was silent all along is named with its stream and column."""
    board = read_recording(warm_log / "recording").stream("board")
    temperature = board.signal("temperature")
    silent = replace(temperature, values=np.full_like(temperature.values, np.nan))
    put(warm_log, replace(board, signals={**board.signals, "temperature": silent}))
    experiment = load_experiment(with_variables(warm_log / PARQUET, SLOW_TEMPERATURE))
    with pytest.raises(RecordingError, match=r"interval 'fit': none of \d+ samples of 'arm_ft'.* board temperature"):
        _fitted(experiment)


REFUSED: dict[str, tuple[tuple[str, ...], type[ForceTorqueError], str]] = {
    "unknown stream": (
        (TEMPERATURE, 'stream = "bord"\n'),
        RecordingError,
        r"sensor\[0\]: variable\[0\]: the recording has no stream 'bord'; did you mean \"board\"\? known: arm_ft",
    ),
    "unknown quantity": (
        (TEMPERATURE, 'quantity = "temprature"\n'),
        RecordingError,
        r"sensor\[0\]: variable\[0\]: stream 'arm_ft' has no temprature; did you mean \"temperature\"",
    ),
    "quantity that the stream lacks": (
        (TEMPERATURE, SUPPLY.replace('stream = "board"\n', "")),
        RecordingError,
        r"sensor\[0\]: variable\[1\]: stream 'arm_ft' has no scalar; known: raw, temperature",
    ),
    "unknown column": (
        (SUPPLY.replace('column = "supply"', 'column = "suply"'),),
        RecordingError,
        r"sensor\[0\]: variable\[0\]: scalar: no column 'suply'; did you mean \"supply\"\? known: current, supply",
    ),
    "column not said": (
        (SUPPLY.replace('column = "supply"\n', ""),),
        ExperimentError,
        r"sensor\[0\]: variable\[0\]: expected column, one of supply, current",
    ),
    "name twice": (
        (TEMPERATURE, SLOW_TEMPERATURE),
        ExperimentError,
        r"sensor\[0\]: variable\[0\]: the name 'temperature' comes twice; name the variables apart",
    ),
    "five coefficients": (
        (TEMPERATURE, "prior_coefficients = [1.0, 1.0, 1.0, 1.0, 1.0]\n"),
        FormatError,
        r"sensor\[0\]\.variable\[0\]\.prior_coefficients: .*expected an array of shape \(6\)",
    ),
    "no finite reference": ((TEMPERATURE, "reference_value = nan\n"), FormatError, r"reference_value: .*finite"),
    "unknown key": ((TEMPERATURE, 'colum = "x"\n'), FormatError, r"unknown key 'colum'; did you mean \"column\""),
    "no name": (
        (TEMPERATURE.replace('name = "temperature"', 'quantity = "raw"'),),
        FormatError,
        "name: expected this key, there is none",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_does_not_fit_is_refused(warm_log: Path, name: str) -> None:
    """The error names the file, the sensor, the variable and what is known; nothing is guessed."""
    variables, error, message = REFUSED[name]
    with pytest.raises(error, match=message) as caught:
        load_experiment(with_variables(warm_log / PARQUET, *variables))
    assert str(warm_log / PARQUET) in str(caught.value)


def test_intervals_have_a_kind_and_a_session(warm_log: Path) -> None:
    """What an interval is to a study stands in the file; else its kind is its label, and its session the recording."""
    edit(warm_log / PARQUET, 'label = "fit"\n', 'label = "fit"\nkind = "grid"\nsession = "day 3"\n')
    roles = load_experiment(warm_log / PARQUET).roles
    assert {label: (role.kind, role.session) for label, role in roles.items()} == {
        "fit": ("grid", "day 3"),
        "judge": ("judge", None),
    }
