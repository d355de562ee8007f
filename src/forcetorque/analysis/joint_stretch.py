# SPDX-License-Identifier: BSD-3-Clause
"""From the intervals of an experiment to what a joint calibration is made from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from forcetorque.analysis.reading import Correction, wrench_at
from forcetorque.calibration.joint import Stretch
from forcetorque.errors import ExperimentError
from forcetorque.estimation.part_equations import joints_of_part, sensors_of, untouched_parts
from forcetorque.estimation.picked import padded_samples
from forcetorque.estimation.root_motion import imu_frame
from forcetorque.estimation.samples import robot_motion_at
from forcetorque.experiment import Experiment
from forcetorque.recording import Interval, MovingSupport
from forcetorque.recording.alignment import require_overlap
from forcetorque.robot import BodyTree, build_tree
from forcetorque.robot.sub_model import SubModel


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointInterval:
    """An interval as a joint calibration sees it."""

    stretch: Stretch
    """Readings and motion."""
    parts: tuple[SubModel, ...]
    """Parts that nothing touches and whose joints were logged."""
    left_out: tuple[str, ...]
    """Parts that nothing touches but whose joints were not logged, in words."""


def joint_interval(
    experiment: Experiment, interval: Interval, sensors: Sequence[str], *, recording: str, session: str
) -> JointInterval:
    """Take what an interval says of several sensors at once.

    Args:
        experiment: The experiment.
        interval: One of its intervals.
        sensors: Names of its sensors.
        recording: Name of the recording.
        session: Name of the session of the interval.

    Returns:
        Readings by the prior matrices, at the instants of the first sensor, and the motion of the robot.

    Raises:
        ExperimentError: If the interval has no support, or no part between these sensors is untouched and logged.
    """
    support = interval.support
    if support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a support frame or an IMU, got none")
    touched = (support.frame,)
    if isinstance(support, MovingSupport):
        # the motion is known where the IMU is: nothing needs to be carried to another link
        support = replace(support, frame=imu_frame(experiment.model, experiment.recording, support))
    tree = build_tree(experiment.model, support.frame)
    parts, left_out = _logged(experiment, untouched_parts(tree, sensors, touched), tree)
    if not parts:
        raise ExperimentError(
            f"interval {interval.label!r}: of no untouched part are all joints in the log: {'; '.join(left_out)}"
        )
    used = [experiment.sensor(name) for name in sensors if any(name in sensors_of(part) for part in parts)]
    source = experiment.recording.stream(used[0].stream)
    for sensor in used[1:]:
        require_overlap(source, experiment.recording.stream(sensor.stream))
    samples = padded_samples(experiment.recording, source, interval, None)
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        support,
        tuple(dict.fromkeys(joint for part in parts for joint in joints_of_part(tree, part))),
        source,
        samples.stamp_ns,
        processing=experiment.processing,
    )
    return JointInterval(
        stretch=Stretch(
            label=interval.label,
            recording=recording,
            session=session,
            time_s=(samples.stamp_ns - experiment.recording.start_ns) * 1e-9,
            tree=tree,
            joints=joints,
            root=root,
            readings={
                sensor.name: wrench_at(experiment, sensor, Correction.without_offset(sensor), samples.stamp_ns)
                for sensor in used
            },
            touched=touched,
        ),
        parts=parts,
        left_out=left_out,
    )


def _logged(
    experiment: Experiment, parts: Sequence[SubModel], tree: BodyTree
) -> tuple[tuple[SubModel, ...], tuple[str, ...]]:
    """Parts whose joints were logged, and of the others what they lack."""
    available = set(experiment.recording.joint_signals("position"))
    logged, lacking = [], []
    for part in parts:
        missing = [joint for joint in joints_of_part(tree, part) if joint not in available]
        if missing:
            lacking.append(f"part {part.name!r} needs the joint(s) {', '.join(missing)}, which the log lacks")
        else:
            logged.append(part)
    return tuple(logged), tuple(lacking)
