# SPDX-License-Identifier: BSD-3-Clause
"""Which joint torques depend on a sensor while a robot stands on its support, and what the log allows to judge."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.analysis.runs.free_sub_model import FreeSubModel
from forcetorque.estimation import Question, required_joints_of
from forcetorque.evaluation import OtherSensors, joints_of_sensor
from forcetorque.recording import Interval
from forcetorque.robot import BodyTree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueScheme:
    """What is estimated over one interval, from which sensors."""

    tree: BodyTree
    """The robot, seen from the support."""
    cut_at: tuple[str, ...]
    """Sensors at which it is cut."""
    contact: str | None
    """Link of the free sub-model that takes up its contact wrench; None for that at its base."""
    joints: tuple[str, ...]
    """Joints that depend on the judged sensor and can be judged."""
    sensors: tuple[str, ...]
    """Sensors whose error is in their torques; the judged one first."""
    logged: tuple[str, ...]
    """Those of the joints whose torque was logged and can be computed by the model."""
    question: Question
    """What the model is asked: the expected readings of these sensors, and the torques to compare with logged ones."""
    motion: tuple[str, ...]
    """Joints whose motion is needed."""
    left_out: tuple[str, ...]
    """Torques that the log does not allow to estimate, in words."""


def torque_scheme(free: FreeSubModel, interval: Interval) -> TorqueScheme:
    """Decide which torques are judged in an interval.

    Args:
        free: The free sub-model of the judged sensor.
        interval: The interval.

    Returns:
        The joints, and what is needed for them.

    Raises:
        ExperimentError: If the interval has no support.
    """
    sub_model, recording = free.seen_from_support(interval), free.run.experiment.recording
    tree, cut_at, sensor = sub_model.tree, tuple(sub_model.cut_at or ()), sub_model.sensor
    available = set(recording.joint_signals("position"))
    names = cut_at if free.choice.other_sensors is OtherSensors.MEASURED else (sensor,)
    loaded = {name: joints_of_sensor(tree, name, cut_at=cut_at, contact=free.choice.contact) for name in names}
    joints, sensors, left_out = [], [sensor], []
    for joint in loaded[sensor]:
        readers = tuple(name for name in names if joint in loaded[name])
        missing = _missing(Question(tree=tree, expected=readers, equations=()), available)
        if missing:
            words = f"no stream holds the joint(s) {', '.join(missing)}"
            left_out.append(f"torque of {joint}, from what is expected of {', '.join(readers)}: {words}")
        else:
            joints.append(joint)
            sensors += [name for name in readers if name not in sensors]
    in_log = recording.joint_signals("torque")
    logged = tuple(
        joint
        for joint in joints
        if joint in in_log and not _missing(Question(tree=tree, torques=(joint,), equations=()), available)
    )
    question = Question(tree=tree, expected=tuple(sensors), torques=logged, equations=())
    return TorqueScheme(
        tree=tree,
        cut_at=cut_at,
        contact=free.choice.contact,
        joints=tuple(joints),
        sensors=tuple(sensors),
        logged=logged,
        question=question,
        motion=tuple(dict.fromkeys((*sub_model.required_joints, *required_joints_of(question)))),
        left_out=tuple(left_out),
    )


def _missing(question: Question, available: set[str]) -> list[str]:
    return [joint for joint in required_joints_of(question) if joint not in available]
