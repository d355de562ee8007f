# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of an experiment: those of the estimator, by every candidate, less those of the model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.evaluation.validation.joint_torque_errors import torque_error_samples
from forcetorque.evaluation.validation.validation import JointTorqueErrors, joint_torques
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.free_sub_model import OtherSensors, SubModelChoice
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.recording.recording import Use
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.mechanics.measured_and_expected_wrench import robot_motion_at
from forcetorque.robot.tree import build_tree
from tests.cases import some_cases
from tests.scenes.experiments import JOINTS, PARQUET, TWO, edit
from tests.scenes.robots import joint_xml, link_xml

EXACT = 1e-10
"""N m: torques of some 10 N m by two ways through the same dynamics."""

VISIBLE = 0.01
"""N m: what a negative control must exceed."""

INBOARD, BEYOND = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll"), ("elbow", "wrist")
"""Joints between the support and the arm's sensor, and between that and the tool's."""

Key = tuple[str, Offset, str]


def _with_branch(arm: Path, flap: str) -> Experiment:
    """The arm with its second sensor in a branch beside the shoulder's pitch; beyond it a joint that no log holds."""
    branch = (
        link_xml("counterweight", mass=1.0, xyz="0.1 0 0"),
        link_xml("flap", mass=0.3, xyz="0 0 0.1"),
        joint_xml("counterweight_joint", "shoulder_1", "counterweight"),
        joint_xml("flap_joint", "counterweight", "flap", type=flap),
    )
    edit(arm / "arm.urdf", "</robot>", "\n".join([*branch, "</robot>"]))
    return load_experiment(edit(arm / TWO, '"tool_joint"', '"counterweight_joint"'))


def _fitted(experiment: Experiment, index: int = 0) -> Calibration:
    return calibrate_sensor(SensorRun(experiment, experiment.sensors[index]), code_version="test", created="test")


def _by_key(found: tuple[Sequence[JointTorqueErrors], Sequence[str]]) -> dict[Key, JointTorqueErrors]:
    return {(verdict.calibration, verdict.offset, verdict.joint): verdict for verdict in found[0]}


def _model_torques(experiment: Experiment, at_ns: IntArray) -> dict[str, FloatArray]:
    """Torques of inverse dynamics in the validation interval."""
    (interval,) = experiment.intervals(Use.VALIDATION)
    assert interval.support is not None
    source = experiment.recording.stream(experiment.sensors[0].stream)
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        interval.support,
        JOINTS,
        source,
        at_ns,
        processing=experiment.processing,
    )
    tree = build_tree(experiment.model, interval.support.frame)
    found = estimate(Question(tree=tree, torques=JOINTS), joints, root)
    return {joint: found.torque(joint) for joint in JOINTS}


def _errors_of_the_estimator(experiment: Experiment, corrections: dict[str, Correction]) -> dict[str, FloatArray]:
    """Torques of `estimate` less those of the model, after the first second of the validation interval."""
    (interval,) = experiment.intervals(Use.VALIDATION)
    (over,) = (o for o in estimate_experiment(experiment, corrections) if o.interval.label == interval.label)
    later = over.stamp_ns >= over.stamp_ns[0] + 1_000_000_000
    model = _model_torques(experiment, over.stamp_ns)
    return {joint: (over.estimates.torque(joint) - model[joint])[later] for joint in JOINTS}


@some_cases("branch", [True, False], ids=["branch", "chain"])
def test_with_measured_others_it_is_what_the_estimator_gives(arm: Path, branch: bool) -> None:
    """Mean, root mean square and largest error of each joint are those of `estimate`, whatever the other sensor does.

    Only the joints inboard of the sensor depend on it; negative control: with the other candidate they are others.
    """
    experiment = _with_branch(arm, "fixed") if branch else load_experiment(arm / TWO)
    sensor, calibration = experiment.sensors[0], _fitted(experiment)
    found = _by_key(
        joint_torques(
            SensorRun(experiment, sensor), {"new": calibration}, SubModelChoice(other_sensors=OtherSensors.MEASURED)
        )
    )
    assert {joint for _, _, joint in found} == set(INBOARD)
    for candidate, calibrations in (("prior", {}), ("new", {"new": calibration})):
        wanted = _errors_of_the_estimator(experiment, corrections_of(experiment, calibrations))
        for joint in INBOARD:
            errors = found[candidate, Offset.FITTED, joint]
            assert errors.samples == len(wanted[joint])
            assert errors.rmse == pytest.approx(np.sqrt((wanted[joint] ** 2).mean()), abs=EXACT)
            assert errors.mean == pytest.approx(wanted[joint].mean(), abs=EXACT)
            assert errors.largest == pytest.approx(np.abs(wanted[joint]).max(), abs=EXACT)
            other = found["new" if candidate == "prior" else "prior", Offset.FITTED, joint]
            assert abs(other.rmse - errors.rmse) > VISIBLE
        for joint in BEYOND:  # a contact at the arm's sensor takes its error up
            alone = corrections_of(experiment, {})
            np.testing.assert_allclose(
                wanted[joint], _errors_of_the_estimator(experiment, alone)[joint], rtol=0, atol=EXACT
            )


def test_the_offset_is_that_of_the_first_second(arm: Path) -> None:
    """From the first second, the errors are those of the estimator with an offset right in the first second."""
    experiment = load_experiment(arm / PARQUET)
    calibration = _fitted(experiment)
    found = _by_key(joint_torques(SensorRun(experiment, experiment.sensors[0]), {"new": calibration}))
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.VALIDATION)
    stamps, reference = part.samples.stamp_ns, part.samples.reference
    wrong = (calibration.model.wrench(part.raw) - reference)[stamps < stamps[0] + 1_000_000_000].mean(axis=0)
    model = WrenchModel(matrix=calibration.model.matrix, offset=calibration.model.offset - wrong)
    wanted = _errors_of_the_estimator(
        experiment, {"arm_ft": Correction(model=model, source="test", matrix_source="test")}
    )
    for joint in INBOARD:
        rmse = np.sqrt((wanted[joint] ** 2).mean())
        assert found["new", Offset.FIRST_SECOND, joint].rmse == pytest.approx(rmse, abs=EXACT)


def test_the_new_calibration_makes_every_torque_better(arm: Path) -> None:
    """Known truth: with either offset a fifth of the prior's error is left, at most, at every joint."""
    experiment = load_experiment(arm / PARQUET)
    found = joint_torques(SensorRun(experiment, experiment.sensors[0]), {"new": _fitted(experiment)})
    verdicts = _by_key(found)
    assert len(verdicts) == 2 * 2 * len(INBOARD)
    assert found[1] == ()
    for source in KNOWN_BEFORE:
        for joint in INBOARD:
            new, prior = verdicts["new", source, joint], verdicts["prior", source, joint]
            assert new.rmse < 0.2 * prior.rmse
            assert new.unit == "N m"
            assert new.logged_rmse is None


def test_where_the_contact_is_decides_which_joints_bear_the_error(arm: Path) -> None:
    """With the contact of the free part at the hand, the joints between sensor and hand bear it too."""
    experiment = load_experiment(arm / TWO)
    sensor = experiment.sensors[0]
    at_hand = _by_key(joint_torques(SensorRun(experiment, sensor), {}, SubModelChoice(contact="hand")))
    at_sensor = _by_key(joint_torques(SensorRun(experiment, sensor), {}))
    assert {joint for _, _, joint in at_hand} == {*INBOARD, *BEYOND}
    for key, verdict in at_sensor.items():
        assert at_hand[key].rmse == verdict.rmse
    tool = _by_key(joint_torques(SensorRun(experiment, experiment.sensors[1]), {}))
    assert {joint for _, _, joint in tool} == set(BEYOND)


def test_errors_of_other_sensors_count_only_as_measured(arm: Path) -> None:
    """Of the joint before a branch, by the sensor there; of those that depend on the judged sensor alone, never."""
    experiment = _with_branch(arm, "fixed")
    by_model, as_measured = (
        _by_key(joint_torques(SensorRun(experiment, experiment.sensors[0]), {}, SubModelChoice(other_sensors=mode)))
        for mode in OtherSensors
    )
    for key, verdict in by_model.items():
        change = as_measured[key].rmse - verdict.rmse
        assert abs(change) > VISIBLE if key[2] == "shoulder_yaw" else abs(change) < EXACT
    assert {joint for _, _, joint in by_model} == set(INBOARD)


def test_torques_that_the_log_does_not_allow_are_named(arm: Path) -> None:
    """As measured, a joint before a branch needs what is expected of the branch's sensor, and its joints."""
    edit(arm / TWO, 'use = "calibration"', 'use = "ignore"')  # nor can the prior's offset be found
    experiment = _with_branch(arm, "revolute")
    sensor = experiment.sensors[0]
    by_model = joint_torques(SensorRun(experiment, sensor), {})
    assert by_model[1] == ()
    assert {verdict.joint for verdict in by_model[0]} == set(INBOARD)
    as_measured = joint_torques(SensorRun(experiment, sensor), {}, SubModelChoice(other_sensors=OtherSensors.MEASURED))
    (words,) = as_measured[1]
    assert words.startswith("torque of shoulder_yaw, from what is expected of arm_ft, tool_ft: ")
    assert "flap_joint" in words
    assert {verdict.joint for verdict in as_measured[0]} == set(INBOARD[1:])


def test_logged_torques_are_compared_too(arm: Path) -> None:
    """A log that is 0.25 N m less than the model at one joint: the error from it is 0.25 N m more."""
    experiment = load_experiment(arm / PARQUET)
    recording, sensor = experiment.recording, experiment.sensors[0]
    source = recording.stream(sensor.stream)
    logged = np.full((len(source.stamp_ns), 1), np.nan)
    (interval,) = experiment.intervals(Use.VALIDATION)
    inside = (source.stamp_ns >= interval.start_ns) & (source.stamp_ns < interval.end_ns)
    logged[inside, 0] = _model_torques(experiment, source.stamp_ns[inside])["shoulder_pitch"] - 0.25
    signal = Signal(quantity="torque", values=logged, columns=("shoulder_pitch",), units=("N m",))
    stream = Stream(name="torques", clock=source.clock, stamp_ns=source.stamp_ns, signals={"torque": signal})
    streams = {**recording.streams, "torques": stream}
    with_log = replace(experiment, recording=replace(recording, streams=streams))
    found = joint_torques(SensorRun(with_log, sensor), {})[0]
    without = joint_torques(SensorRun(experiment, sensor), {})[0]
    logged_fields = ("logged_samples", "logged_rmse", "logged_rmse_error", "logged_rmse_half_width_95")
    assert [v.model_copy(update=dict.fromkeys(logged_fields)) for v in found] == list(without)
    compared = [v for v in found if v.logged_rmse is not None]
    assert [v.joint for v in compared] == ["shoulder_pitch"] * 2
    assert all(v.logged_samples == v.samples for v in compared)
    torques = torque_error_samples(SubModelChoice().in_run(SensorRun(with_log, sensor)), {})
    samples = [errors for key, errors in torques.samples.items() if key.joint == "shoulder_pitch"]
    for errors, verdict in zip(samples, compared, strict=True):
        assert verdict.logged_rmse == pytest.approx(np.sqrt((errors.from_logged**2).mean()), abs=EXACT)
        assert errors.from_logged.mean() == pytest.approx(verdict.mean + 0.25, abs=EXACT)


def test_what_cannot_be_judged_is_refused(arm: Path) -> None:
    """Counts without a matrix; no interval to judge."""
    experiment = load_experiment(edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"\n', ""))
    with pytest.raises(ExperimentError, match="raw counts become wrenches"):
        joint_torques(SensorRun(experiment, experiment.sensors[0]), {})
    idle = replace(experiment, recording=replace(experiment.recording, intervals=()))
    with pytest.raises(ExperimentError, match="raw counts become wrenches"):
        joint_torques(SensorRun(idle, idle.sensors[0]), {})


def test_logged_torques_that_are_all_gaps_are_not_compared(arm: Path) -> None:
    """A stream of NaN is no reference, and takes nothing from the comparison with the model."""
    experiment = load_experiment(arm / PARQUET)
    recording, sensor = experiment.recording, experiment.sensors[0]
    source = recording.stream(sensor.stream)
    values = np.full((len(source.stamp_ns), 1), np.nan)
    signal = Signal(quantity="torque", values=values, columns=("shoulder_pitch",), units=("N m",))
    stream = Stream(name="torques", clock=source.clock, stamp_ns=source.stamp_ns, signals={"torque": signal})
    streams = {**recording.streams, "torques": stream}
    with_log = replace(experiment, recording=replace(recording, streams=streams))
    found, _ = joint_torques(SensorRun(with_log, sensor), {})
    assert len(found) == 2 * len(INBOARD)
    assert all(verdict.logged_rmse is None for verdict in found)


def test_a_sensor_without_a_judged_sample_is_named(arm: Path) -> None:
    """As measured, gaps of the branch's sensor leave out the joint that depends on it, and no other."""
    experiment = _with_branch(arm, "fixed")
    recording, other = experiment.recording, experiment.sensors[1]
    stream, (interval,) = recording.stream(other.stream), experiment.intervals(Use.VALIDATION)
    raw = np.array(stream.signal("raw").values)
    raw[(stream.stamp_ns > interval.start_ns) & (stream.stamp_ns < interval.end_ns)] = np.nan
    broken = replace(stream, signals={"raw": replace(stream.signal("raw"), values=raw)})
    gap = replace(experiment, recording=replace(recording, streams={**recording.streams, other.stream: broken}))
    found, left_out = joint_torques(
        SensorRun(gap, gap.sensors[0]), {}, SubModelChoice(other_sensors=OtherSensors.MEASURED)
    )
    assert left_out == ("torque of shoulder_yaw by prior over 'judge': every evaluated sample has a gap",)
    assert {verdict.joint for verdict in found} == set(INBOARD[1:])
