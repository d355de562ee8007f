# SPDX-License-Identifier: BSD-3-Clause
"""Contact-force validation of an experiment: the free part beyond a sensor, by the model or by the other sensors."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.calibration import Calibration
from forcetorque.errors import EstimationError, ExperimentError, SerialNumberError
from forcetorque.evaluation import OtherSensors, wrench_errors
from forcetorque.experiment import (
    ContactForceVerdict,
    Experiment,
    calibrate_sensor,
    load_experiment,
    samples_of,
    validate_sensor,
)
from forcetorque.recording import Use
from forcetorque.study import OffsetSource
from tests.experiments import PARQUET, TWO, edit

EXACT = 1e-9
"""N, N m: wrenches of some 100 N through two evaluators of the same dynamics."""


def _fitted(experiment: Experiment, index: int = 0) -> Calibration:
    return calibrate_sensor(experiment, experiment.sensors[index], code_version="test", created="test")


def _by_candidate(verdicts: list[ContactForceVerdict]) -> dict[tuple[str, OffsetSource], ContactForceVerdict]:
    return {(verdict.candidate, verdict.offset): verdict for verdict in verdicts}


def test_by_the_model_it_is_reading_less_expected(arm: Path) -> None:
    """In the mode `model` the wrench at the sensor is what `evaluate` calls the error, but for the first second."""
    experiment = load_experiment(arm / PARQUET)
    calibration = _fitted(experiment)
    found = _by_candidate(validate_sensor(experiment, experiment.sensors[0], {"new": calibration}))
    (part,) = samples_of(experiment, experiment.sensors[0], Use.VALIDATION)
    stamps = part.samples.stamp_ns
    first = stamps < stamps[0] + 1_000_000_000
    reading = calibration.model.wrench(part.raw)
    by_hand = wrench_errors(reading[~first], part.samples.reference[~first])
    errors = found["new", OffsetSource.FITTED].errors
    assert errors.count == by_hand.count
    assert errors.force_mean == pytest.approx(by_hand.force_mean, abs=EXACT)
    np.testing.assert_allclose(errors.bias, by_hand.bias, atol=EXACT)
    moved = reading - (reading - part.samples.reference)[first].mean(axis=0)
    by_hand = wrench_errors(moved[~first], part.samples.reference[~first])
    errors = found["new", OffsetSource.RE_ESTIMATED].errors
    np.testing.assert_allclose(errors.mean_absolute, by_hand.mean_absolute, atol=EXACT)


def test_the_new_calibration_is_best_and_the_prior_is_not(arm: Path) -> None:
    """Known truth: the fit reports a tenth of the force that the prior reports, with either offset."""
    experiment = load_experiment(arm / PARQUET)
    found = _by_candidate(validate_sensor(experiment, experiment.sensors[0], {"new": _fitted(experiment)}))
    assert len(found) == 4
    for source in OffsetSource:
        new, prior = found["new", source].errors, found["prior", source].errors
        assert new.force_mean < 0.1 * prior.force_mean


def test_errors_of_other_sensors_count_only_as_measured(arm: Path) -> None:
    """A wrong matrix of the outer sensor is in the result of the mode `measured` only, a right one in neither."""
    experiment = load_experiment(arm / TWO)
    sensor, calibrations = experiment.sensors[0], {"new": _fitted(experiment)}
    right = {"tool": _fitted(experiment, 1)}

    def force(**how: object) -> float:
        verdicts = _by_candidate(validate_sensor(experiment, sensor, calibrations, **how))  # type: ignore[arg-type]
        return verdicts["new", OffsetSource.RE_ESTIMATED].errors.force_mean

    model = force()
    with_right = force(others=right, other_sensors=OtherSensors.MEASURED)
    with_prior = force(other_sensors=OtherSensors.MEASURED)
    assert force(others=right) == model
    assert with_right < 2.0 * model
    assert with_prior > 1.5 * with_right


def test_the_outer_sensor_is_judged_by_either_side(arm: Path) -> None:
    """The parts beyond it and before it see the same error by the model; only the sign of the wrench differs."""
    experiment = load_experiment(arm / TWO)
    tool = experiment.sensors[1]
    beyond = _by_candidate(validate_sensor(experiment, tool, {}))
    before = _by_candidate(validate_sensor(experiment, tool, {}, sub_model="arm_ft"))
    key = ("prior", OffsetSource.FITTED)
    assert beyond[key].sub_model == "tool_ft"
    assert before[key].sub_model == "arm_ft"
    np.testing.assert_allclose(beyond[key].errors.bias, -before[key].errors.bias, atol=EXACT)
    assert beyond[key].errors.force_mean == pytest.approx(before[key].errors.force_mean, abs=EXACT)


def test_what_cannot_be_judged_is_refused(arm: Path) -> None:
    """A part that the sensor does not bound or that bears the robot; a foreign calibration; counts without matrix."""
    experiment = load_experiment(arm / TWO)
    sensor = experiment.sensors[0]
    with pytest.raises(EstimationError, match=r"interval 'judge': sub_model: expected one of the two"):
        validate_sensor(experiment, sensor, {}, sub_model="tool_ft")
    with pytest.raises(EstimationError, match="bears the support 'base'"):
        validate_sensor(experiment, sensor, {}, sub_model="base")
    foreign = _fitted(experiment, 1)
    with pytest.raises(SerialNumberError, match="SIM/002"):
        validate_sensor(experiment, sensor, {"new": foreign})
    bare = load_experiment(edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"\n', ""))
    with pytest.raises(ExperimentError, match="raw counts become wrenches"):
        validate_sensor(bare, bare.sensors[0], {})
    idle = replace(experiment, recording=replace(experiment.recording, intervals=()))
    with pytest.raises(ExperimentError, match='expected an interval with use = "validation"'):
        validate_sensor(idle, idle.sensors[0], {})
