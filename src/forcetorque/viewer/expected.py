# SPDX-License-Identifier: BSD-3-Clause
"""What the model expects sensors to read, wherever an interval says what the robot stands on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval, MovingSupport, Support
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.question import Question, required_joints_of
from forcetorque.robot.mechanics.root_motion import joints_to_support
from forcetorque.robot.mechanics.samples import robot_motion_at
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.viewer.instants import Posture


def expected_readings(
    experiment: Experiment, sensors: Sequence[str], posture: Posture
) -> tuple[dict[str, FloatArray], list[str]]:
    """Evaluate the model at every instant that lies in an interval with a support.

    Where several intervals hold an instant, the first with a support rules. Nothing is expected of a
    sensor in an interval in which something touches a robot on the move beyond it.

    Args:
        experiment: The experiment, without intervals that hold no sample.
        sensors: Names of the sensors.
        posture: The instants.

    Returns:
        Expected readings by sensor, NaN where there is none, of shape (n, 6) in N, N m; and what is missing.
    """
    n = len(posture.stamp_ns)
    expected = {sensor: np.full((n, 6), np.nan) for sensor in sensors}
    notes: dict[str, None] = {}
    left = np.ones(n, dtype=bool)
    spans: dict[int, tuple[Support | MovingSupport, np.ndarray]] = {}
    shown: list[tuple[Interval, BoolArray]] = []
    for interval in experiment.recording.intervals:
        if interval.support is not None:
            inside = left & interval.holds(posture.stamp_ns)
            left &= ~inside
            shown.append((interval, inside))
            _, before = spans.get(id(interval.support), (None, np.zeros(n, dtype=bool)))
            spans[id(interval.support)] = (interval.support, before | inside)
    for support, inside in spans.values():
        chosen = np.flatnonzero(inside)
        if not len(chosen):
            continue
        answerable = []
        try:
            tree = build_tree(experiment.model_on(support), support.frame)
        except ForceTorqueError as error:
            notes[f"no expected wrenches on {support.frame!r}: {error}"] = None
            continue
        for sensor in sensors:
            try:
                lacking = _lacking(experiment, tree, sensor, support)
            except ForceTorqueError as error:
                notes[f"sensor {sensor!r}: no expected wrench on {support.frame!r}: {error}"] = None
                continue
            if lacking:
                joints = ", ".join(lacking)
                notes[f"sensor {sensor!r}: no expected wrench on {support.frame!r}: no stream holds {joints}"] = None
            else:
                answerable.append(sensor)
        if not answerable:
            continue
        try:
            readings = _evaluate(experiment, tree, answerable, support, posture, chosen)
        except ForceTorqueError as error:
            notes[f"no expected wrenches on {support.frame!r}: {error}"] = None
            continue
        for sensor, values in readings.items():
            expected[sensor][chosen] = values
    for sensor, values in expected.items():
        notes.update(dict.fromkeys(_without_touched(SensorRun(experiment, sensor), values, shown)))
    if not spans:
        notes["no expected wrenches: no interval states a support"] = None
    return expected, list(notes)


def _without_touched(run: SensorRun, values: FloatArray, shown: Sequence[tuple[Interval, BoolArray]]) -> Iterator[str]:
    """Take away what is expected where something touches beyond the sensor; in words, where that is."""
    touched: dict[tuple[str, ...], list[str]] = {}
    for interval, inside in shown:
        if (names := run.touched_beyond(interval)) and np.isfinite(values[inside]).any():
            values[inside] = np.nan
            touched.setdefault(names, []).append(interval.label)
    for names, labels in touched.items():
        yield (
            f"sensor {run.sensor.name!r}: no expected wrench in {', '.join(labels)}, where {', '.join(names)} touches "
            "the robot beyond it"
        )


def _lacking(experiment: Experiment, tree: BodyTree, sensor: str, support: Support | MovingSupport) -> list[str]:
    """Joints that the expected reading of a sensor needs and no stream holds."""
    needed = required_joints_of(Question(tree=tree, expected=(sensor,), equations=()))
    needed += joints_to_support(experiment.model, experiment.recording, support)
    logged = experiment.recording.joint_signals("position")
    return [joint for joint in dict.fromkeys(needed) if joint not in logged]


def _evaluate(
    experiment: Experiment,
    tree: BodyTree,
    sensors: Sequence[str],
    support: Support | MovingSupport,
    posture: Posture,
    chosen: np.ndarray,
) -> dict[str, FloatArray]:
    question = Question(tree=tree, expected=tuple(sensors), equations=())
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        support,
        required_joints_of(question),
        posture.stream,
        posture.stamp_ns[chosen],
        processing=experiment.processing,
    )
    estimates = estimate(question, joints, root)
    return {sensor: estimates.expected_of(sensor) for sensor in sensors}
