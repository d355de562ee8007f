# SPDX-License-Identifier: BSD-3-Clause
"""The study of thesis 5.3 on simulated sensors of an iCub's leg, whose true matrices are known."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.calibration.thesis.calibrate import calibrate
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.sensor_model import LinearVariable, WrenchModel
from forcetorque.experiment.validation_offset import Offset, ValidationSet
from forcetorque.recording.recording import Interval, Support, Use
from forcetorque.robot.mechanics.estimate import Evaluator
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, sensor_samples
from forcetorque.simulation.scenario.scenario import (
    INTERVAL_MARGIN_S,
    Scenario,
    SimulatedRecording,
    load_scenario,
    simulate,
    trace_recordings,
)
from forcetorque.simulation.scenario.scenario_file import LINEAR_ONLY, bundled_scenario
from forcetorque.study.candidate_fits import Study, run_study
from forcetorque.study.candidate_selection import evaluate_models

LEG = "l_leg_ft"
SEEDS = [range(1, 6), pytest.param(range(6, 26), marks=pytest.mark.long)]
"""Of the sensors: some at every change, other twenty in the long run."""
COMBINATIONS = {
    "noTz": ("grid", "grid_2", "bsl", "bsl_2", "bnsl", "bnsl_2"),
    "suppOnly": ("grid", "grid_2", "tz", "tz_2", "bsl", "bsl_2"),
    "AllGeneral": ("grid", "grid_2", "tz", "tz_2", "bsl", "bsl_2", "bnsl", "bnsl_2"),
}
TEMPERATURE = LinearVariable(name="temperature", unit="degC")
WORKBENCH_N = (12.5, 20.0)
"""Range of the mean contact force of the workbench matrix over the samples that no board held; N."""
THIRD = 1.0 / 3.0
"""The thesis came from 16.66 N to 5.50 N."""
NOISE_FLOOR = 1.1
"""What a choice may leave of linear effects, relative to the true sensor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensor:
    """One simulated sensor with its data and its truth."""

    calibration: list[DataSet]
    validation: list[ValidationSet]
    prior: FloatArray
    truth: WrenchModel


@cache
def scenario() -> Scenario:
    """The bundled scenario with the sensor of the left leg alone."""
    return load_scenario(bundled_scenario("icub-insitu")).with_sensors(names=(LEG,))


@cache
def references() -> dict[str, tuple[FloatArray, FloatArray]]:
    """Samples of every recording and their expected wrenches; they do not depend on the sensor."""
    found = {}
    for made in simulate(scenario(), _traces()):
        stream = made.recording.stream(LEG)
        start, end = made.recording.span_ns
        margin = round(INTERVAL_MARGIN_S * 1e9)
        interval = Interval(
            label=made.name,
            start_ns=start + margin,
            end_ns=end - margin,
            use=Use.CALIBRATION,
            support=Support(frame=made.movement.support, gravity_direction=made.movement.gravity_direction),
        )
        samples = sensor_samples(
            made.recording,
            scenario().model,
            sensor=LEG,
            stream=LEG,
            quantity="raw",
            interval=interval,
            processing=Processing(),
            evaluator=Evaluator.COMPILED,
        )
        inside = np.isin(stream.stamp_ns, samples.stamp_ns)
        found[made.name] = (np.flatnonzero(inside), samples.reference)
    return found


@cache
def _traces() -> dict[str, object]:
    return trace_recordings(scenario())


def sensors(seeds: range, **changes: object) -> Iterator[Sensor]:
    """Sensors under the same loads."""
    for seed in seeds:
        drawn = scenario().with_sensors(seed=seed, **changes)
        made = list(simulate(drawn, _traces()))
        specimen = drawn.specimens[LEG]
        drift = specimen.sensor.drift
        assert drift is not None
        matrix = specimen.sensor.matrix
        yield Sensor(
            calibration=[_data_set(one) for one in made if one.use is Use.CALIBRATION],
            validation=[_validation_set(one) for one in made if one.use is Use.VALIDATION],
            prior=specimen.workbench,
            truth=WrenchModel(
                matrix=matrix,
                offset=np.zeros(6),
                coefficients=-(matrix @ drift.slope)[:, None],
                reference_values=np.array([drift.reference_degC]),
            ),
        )


def _valid(made: SimulatedRecording) -> IntArray:
    """Samples with a reference that no saturated board held."""
    index, _ = references()[made.name]
    return np.flatnonzero(~made.recording.stream(LEG).held[index])


def _data_set(made: SimulatedRecording) -> DataSet:
    index, reference = references()[made.name]
    stream, valid = made.recording.stream(LEG), _valid(made)
    return DataSet(
        label=made.name,
        raw=stream.signal("raw").values[index[valid]],
        reference=reference[valid],
        variables=stream.signal("temperature").values[index[valid]],
    )


def _validation_set(made: SimulatedRecording) -> ValidationSet:
    data = _data_set(made)
    stamps = made.recording.stream(LEG).stamp_ns[references()[made.name][0][_valid(made)]]
    return ValidationSet(
        label=made.name,
        session=made.session,
        time_s=(stamps - stamps[0]) * 1e-9,
        raw=data.raw,
        reference=data.reference,
        variables=data.variables,
    )


def _study(sensor: Sensor, kinds: Sequence[str] = tuple(ESTIMATION_TYPES)) -> Study:
    return run_study(
        sensor.calibration,
        COMBINATIONS,
        sensor.validation,
        prior=sensor.prior,
        variables=[TEMPERATURE],
        kinds=[ESTIMATION_TYPES[kind] for kind in kinds],
        sphere=["grid"],
    )


def _shares(study: Study, source: Offset) -> list[float]:
    """Mean contact force of the choice made on the other day, over that of the workbench matrix, on each day."""
    scores = study.choices[source].across_sessions
    assert [score.session for score in scores] == ["day 1", "day 2"]
    return [score.force_mean / (score.workbench_force_mean or 0.0) for score in scores]


@pytest.mark.parametrize("seeds", SEEDS, ids=len)
@pytest.mark.long
def test_a_choice_on_one_day_leaves_a_third_of_the_force_on_the_other(seeds: range) -> None:
    """Over all sensors, median and worst: far less than a third of what the workbench matrix gives."""
    shares, workbench = [], []
    for sensor in sensors(seeds):
        study = _study(sensor)
        assert len(study.fits.candidates) == 351
        shares += _shares(study, Offset.FIRST_SECOND)
        workbench.append(study.errors[Offset.FIRST_SECOND].pooled().force_mean[-1])
    assert len(workbench) == len(seeds)
    # the error is set to 14 to 20 N on the true loads; other effects, and what boards hold, move it
    assert WORKBENCH_N[0] < min(workbench) < max(workbench) < WORKBENCH_N[1]
    assert len(shares) == 2 * len(seeds)
    assert np.median(shares) < 0.1
    assert max(shares) < THIRD


@pytest.mark.long
@pytest.mark.parametrize("seeds", SEEDS, ids=len)
def test_linear_effects_are_taken_out_to_the_noise(seeds: range) -> None:
    """With linear drift, mounting and offsets the choice comes within 10 % of the true sensor on the other day."""
    ratios, errors = [], []
    distinct = [kind for kind in ESTIMATION_TYPES if not kind.startswith("C")]  # the C types equal the O types
    for sensor in sensors(seeds, **LINEAR_ONLY):
        study = _study(sensor, distinct)
        floor = evaluate_models([sensor.truth], [Offset.FIRST_SECOND], sensor.validation)
        for score in study.choices[Offset.FIRST_SECOND].across_sessions:
            ratios.append(score.force_mean / floor.pooled([score.session]).force_mean[0])
        fit = calibrate(sensor.calibration, None, regularisation=0.0, variables=[TEMPERATURE])
        assert fit.standard_errors is not None
        errors.append((fit.fit.matrix - sensor.truth.matrix) / fit.standard_errors.matrix)
        errors.append((fit.fit.model.coefficients - sensor.truth.coefficients) / fit.standard_errors.coefficients)
    assert len(ratios) == 2 * len(seeds)
    assert max(ratios) < NOISE_FLOOR
    # eight blocks leave a factor of about two in the estimate of a variance
    pooled = float(np.sqrt((np.concatenate([error.ravel() for error in errors]) ** 2).mean()))
    assert 0.7 < pooled < 1.5


@pytest.mark.long
def test_the_true_error_of_a_workbench_matrix_is_no_noise() -> None:
    """Negative control of the floor: the workbench matrix is far above it, with linear effects only."""
    sensor = next(sensors(range(1, 2), **LINEAR_ONLY))
    prior = WrenchModel(matrix=sensor.prior, offset=np.zeros(6))
    judged = evaluate_models([sensor.truth, prior], [Offset.FIRST_SECOND] * 2, sensor.validation).pooled().force_mean
    assert judged[1] > 30.0 * judged[0]
