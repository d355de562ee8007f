# SPDX-License-Identifier: BSD-3-Clause
"""Contact-force validation of an experiment: the free part beyond a sensor, by the model or by the other sensors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError, ExperimentError, SerialNumberError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.validation.contact_force_errors import ContactForceErrors, contact_forces
from forcetorque.evaluation.validation.contact_wrenches import contact_wrenches
from forcetorque.evaluation.validation.validation import joint_torques
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import wrench_errors
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.free_sub_model import OtherSensors, SubModelChoice
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Use
from tests.scenes.experiments import PARQUET, TWO, add, edit, holed

EXACT = 1e-9
"""N, N m: wrenches of some 100 N through two evaluators of the same dynamics."""


def _fitted(experiment: Experiment, index: int = 0) -> Calibration:
    return calibrate_sensor(SensorRun(experiment, experiment.sensors[index]), code_version="test", created="test")


def _by_candidate(verdicts: Sequence[ContactForceErrors]) -> dict[tuple[str, Offset], ContactForceErrors]:
    return {(verdict.calibration, verdict.offset): verdict for verdict in verdicts}


def _bias(run: SensorRun, calibrations: dict[str, Calibration], offset: Offset, **how: str) -> FloatArray:
    """Mean contact wrench by the last candidate, which the rows do not have; shape (6,); N, N m."""
    contacts = contact_wrenches(SubModelChoice(**how).in_run(run), calibrations)  # type: ignore[arg-type]
    bias: FloatArray = contacts.wrenches[len(contacts.candidates) - 1, offset].mean(axis=0)
    return bias


def test_by_the_model_it_is_reading_less_expected(arm: Path) -> None:
    """In the mode `model` the wrench at the sensor is what `evaluate` calls the error, but for the first second."""
    experiment = load_experiment(arm / PARQUET)
    calibration = _fitted(experiment)
    found = _by_candidate(contact_forces(SensorRun(experiment, experiment.sensors[0]), {"new": calibration}).verdicts)
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.VALIDATION)
    stamps = part.samples.stamp_ns
    first = stamps < stamps[0] + 1_000_000_000
    reading = calibration.model.wrench(part.raw)
    by_hand = wrench_errors(
        reading[~first], part.samples.reference[~first], seconds_since(stamps[~first], int(stamps[0]))
    )
    errors = found["new", Offset.FITTED]
    assert errors.samples == by_hand.count
    assert errors.force_mean_N == pytest.approx(by_hand.force_mean, abs=EXACT)
    bias = _bias(SensorRun(experiment, experiment.sensors[0]), {"new": calibration}, Offset.FITTED)
    np.testing.assert_allclose(bias, by_hand.bias, atol=EXACT)
    moved = reading - (reading - part.samples.reference)[first].mean(axis=0)
    by_hand = wrench_errors(
        moved[~first], part.samples.reference[~first], seconds_since(stamps[~first], int(stamps[0]))
    )
    errors = found["new", Offset.FIRST_SECOND]
    np.testing.assert_allclose(errors.mean_absolute, by_hand.mean_absolute, atol=EXACT)


def test_the_new_calibration_is_best_and_the_prior_is_not(arm: Path) -> None:
    """Known truth: the fit reports a tenth of the force that the prior reports, with either offset."""
    experiment = load_experiment(arm / PARQUET)
    found = _by_candidate(
        contact_forces(SensorRun(experiment, experiment.sensors[0]), {"new": _fitted(experiment)}).verdicts
    )
    assert len(found) == 4
    for source in KNOWN_BEFORE:
        new, prior = found["new", source], found["prior", source]
        assert new.force_mean_N < 0.1 * prior.force_mean_N


@pytest.mark.long
def test_errors_of_other_sensors_count_only_as_measured(arm: Path) -> None:
    """A wrong matrix of the outer sensor is in the result of the mode `measured` only, a right one in neither."""
    experiment = load_experiment(arm / TWO)
    sensor, calibrations = experiment.sensors[0], {"new": _fitted(experiment)}
    right = {"tool": _fitted(experiment, 1)}

    def force(**how: object) -> float:
        choice = SubModelChoice(**how)  # type: ignore[arg-type]
        verdicts = _by_candidate(contact_forces(SensorRun(experiment, sensor), calibrations, choice).verdicts)
        return verdicts["new", Offset.FIRST_SECOND].force_mean_N

    model = force()
    with_right = force(others=right, other_sensors=OtherSensors.MEASURED)
    with_prior = force(other_sensors=OtherSensors.MEASURED)
    assert force(others=right) == model
    assert with_right < 2.0 * model
    assert with_prior > 1.3 * with_right


def test_the_outer_sensor_is_judged_by_either_side(arm: Path) -> None:
    """The parts beyond it and before it see the same error by the model; only the sign of the wrench differs."""
    experiment = load_experiment(arm / TWO)
    tool = experiment.sensors[1]
    beyond = _by_candidate(contact_forces(SensorRun(experiment, tool), {}).verdicts)
    before = _by_candidate(contact_forces(SensorRun(experiment, tool), {}, SubModelChoice(sub_model="arm_ft")).verdicts)
    key = ("prior", Offset.FITTED)
    assert beyond[key].sub_model == "tool_ft"
    assert before[key].sub_model == "arm_ft"
    run = SensorRun(experiment, tool)
    bias = _bias(run, {}, Offset.FITTED)
    np.testing.assert_allclose(bias, -_bias(run, {}, Offset.FITTED, sub_model="arm_ft"), atol=EXACT)
    assert np.linalg.norm(bias) > 100 * EXACT  # the sign is seen
    assert beyond[key].force_mean_N == pytest.approx(before[key].force_mean_N, abs=EXACT)


def test_what_cannot_be_judged_is_refused(arm: Path) -> None:
    """A part that the sensor does not bound or that bears the robot; a foreign calibration; counts without matrix."""
    experiment = load_experiment(arm / TWO)
    sensor = experiment.sensors[0]
    with pytest.raises(EstimationError, match=r"interval 'judge': sub_model: expected one of the two"):
        contact_forces(SensorRun(experiment, sensor), {}, SubModelChoice(sub_model="tool_ft"))
    with pytest.raises(EstimationError, match="bears the support 'base'"):
        contact_forces(SensorRun(experiment, sensor), {}, SubModelChoice(sub_model="base"))
    foreign = _fitted(experiment, 1)
    with pytest.raises(SerialNumberError, match="SIM/002"):
        contact_forces(SensorRun(experiment, sensor), {"new": foreign})
    bare = load_experiment(edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"\n', ""))
    with pytest.raises(ExperimentError, match="raw counts become wrenches"):
        contact_forces(SensorRun(bare, bare.sensors[0]), {})
    idle = replace(experiment, recording=replace(experiment.recording, intervals=()))
    with pytest.raises(ExperimentError, match='expected an interval with use = "validation"'):
        contact_forces(SensorRun(idle, idle.sensors[0]), {})


def _only_judged(experiment: Experiment) -> Experiment:
    """The same without an interval that could give a prior its offset."""
    recording = experiment.recording.with_intervals(experiment.intervals(Use.VALIDATION))
    return replace(experiment, recording=recording)


def test_the_prior_has_the_offset_that_the_calibration_carries_for_it(arm: Path) -> None:
    """As `evaluate` has it, also where the judged file has no interval to fit: the prior is not made worse than it is.

    Negative control: by the experiment's own prior alone, without an offset, errors are far larger, which is said.
    """
    whole = load_experiment(arm / PARQUET)
    calibration, experiment = _fitted(whole), _only_judged(whole)
    prior, sensor = calibration.prior, experiment.sensors[0]
    assert prior is not None
    found = _by_candidate(contact_forces(SensorRun(experiment, sensor), {"new": calibration}).verdicts)
    (part,) = SensorRun(experiment, sensor).samples(Use.VALIDATION)
    stamps = part.samples.stamp_ns
    later = stamps >= stamps[0] + 1_000_000_000
    by_hand = wrench_errors(
        part.raw[later] @ prior.matrix.T + prior.offset,
        part.samples.reference[later],
        seconds_since(stamps[later], int(stamps[0])),
    )
    verdict = found["prior", Offset.FITTED]
    assert verdict.force_mean_N == pytest.approx(by_hand.force_mean, abs=EXACT)
    assert verdict.offset_source.endswith("offset of the data that new was fitted on")
    assert (verdict.prior, found["new", Offset.FITTED].prior) == (None, "prior")
    alone = _by_candidate(contact_forces(SensorRun(experiment, sensor), {}).verdicts)["prior", Offset.NONE]
    assert alone.offset_source == "the prior matrix_SIM001.txt, no offset removed"
    assert alone.force_mean_N > 2.0 * verdict.force_mean_N
    torques = {
        (v.calibration, v.offset, v.joint): v
        for v in joint_torques(SensorRun(experiment, sensor), {"new": calibration})[0]
    }
    in_whole = {(v.calibration, v.offset, v.joint): v for v in joint_torques(SensorRun(whole, sensor), {})[0]}
    assert len(in_whole) == 6
    for key, torque in in_whole.items():  # that file's own intervals are those that were fitted
        assert torques[key].rmse == pytest.approx(torque.rmse, abs=EXACT)


@pytest.mark.long
def test_priors_are_called_as_evaluate_calls_them(arm: Path) -> None:
    """Two calibrations that share a prior, one with another, and one that is itself called `prior`."""
    experiment = load_experiment(arm / PARQUET)
    sensor, first = experiment.sensors[0], _fitted(experiment)
    assert first.prior is not None
    other = first.model_copy(update={"prior": first.prior.model_copy(update={"offset": first.prior.offset + 1.0})})
    for given in ({"a": first, "b": first, "c": other}, {"prior": first}):
        names = [(v.calibration, v.prior) for v in evaluate(SensorRun(experiment, sensor), given).verdicts]
        assert [
            (v.calibration, v.prior) for v in contact_forces(SensorRun(experiment, sensor), given).verdicts
        ] == names
        torques, _ = joint_torques(SensorRun(experiment, sensor), given)
        assert list(dict.fromkeys((v.calibration, v.prior) for v in torques)) == list(dict.fromkeys(names))


def test_an_interval_that_ends_within_its_first_second_is_named(arm: Path) -> None:
    """It changes no number, and alone it leaves nothing to judge."""
    experiment = load_experiment(edit(arm / PARQUET, "end_s = 23.5", "end_s = 20.0"))
    expected = contact_forces(SensorRun(experiment, experiment.sensors[0]), {})
    assert expected.left_out == ()
    short = '\n[[interval]]\nlabel = "blink"\nstart_s = 21.0\nend_s = 21.9\nuse = "validation"\nsupport = "base"\n'
    both = load_experiment(add(arm / PARQUET, short))
    found = contact_forces(SensorRun(both, both.sensors[0]), {})
    assert found.left_out == ("interval 'blink': it ends within its first 1 s, after which it would be evaluated",)
    assert joint_torques(SensorRun(both, both.sensors[0]), {})[1] == found.left_out
    assert len(found.verdicts) == 2
    for one, other in zip(found.verdicts, expected.verdicts, strict=True):
        assert one.samples == other.samples
        np.testing.assert_array_equal(one.mean_absolute, other.mean_absolute)
        assert one.force_mean_N == other.force_mean_N
    only = replace(both, recording=both.recording.with_intervals(both.recording.intervals[::2]))
    message = "nothing can be evaluated: interval 'blink': it ends within its first 1 s"
    with pytest.raises(ExperimentError, match=message):
        contact_forces(SensorRun(only, only.sensors[0]), {})


def test_an_interval_whose_first_second_is_a_gap_is_named(arm: Path) -> None:
    """No offset comes from it, so it counts with the fitted offset only; torques say the same."""
    edit(arm / PARQUET, "end_s = 23.5", "end_s = 17.0")
    rest = '\n[[interval]]\nlabel = "rest"\nstart_s = 17.0\nend_s = 23.5\nuse = "validation"\nsupport = "base"\n'
    experiment = load_experiment(add(arm / PARQUET, rest))
    gap = replace(experiment, recording=holed(experiment.recording, "arm_ft", 17.0, 18.1))
    found = contact_forces(SensorRun(gap, gap.sensors[0]), {})
    words = "{} by prior over 'rest', offset first-second: every sample of its first second has a gap"
    assert found.left_out == (words.format("contact force"),)
    count = {verdict.offset: verdict.samples for verdict in found.verdicts}
    assert count[Offset.FITTED] > count[Offset.FIRST_SECOND] + 200
    torques, not_estimated = joint_torques(SensorRun(gap, gap.sensors[0]), {})
    joints = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll")
    assert set(not_estimated) == {words.format(f"torque of {joint}") for joint in joints}
    assert {v.samples for v in torques if v.offset is Offset.FITTED} == {count[Offset.FITTED]}
    blind = replace(experiment, recording=holed(experiment.recording, "arm_ft", 17.1, 23.6))
    assert contact_forces(SensorRun(blind, blind.sensors[0]), {}).left_out == (
        "contact force by prior over 'rest': every evaluated sample has a gap",
    )
