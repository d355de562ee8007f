# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file adds to what was logged: clocks, frames of wrenches, joints that stand still."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import ExperimentError
from forcetorque.experiment import schema
from forcetorque.experiment.inputs import Inputs, stated_in
from forcetorque.experiment.recipes.clocks import aligned_clocks
from forcetorque.experiment.tables.recipes import PoseTable, TransformTable
from forcetorque.recording import Finding, Recording
from forcetorque.recording.wrench_frame import orientation_at, pose_at, wrench_in_frame
from forcetorque.robot import RobotModel, fix_joints, read_urdf
from forcetorque.spatial import make_pose, rotation_from_rpy


def read_robot(table: schema.Robot, file: Path, inputs: Inputs) -> RobotModel:
    """Read the robot of an experiment, with the joints fixed that stand still all along.

    Args:
        table: What the file says of it.
        file: The experiment file, for messages.
        inputs: Resolves and remembers the files.

    Returns:
        The robot.
    """
    model = read_urdf(inputs.file(table.urdf))
    with stated_in(f"{file}: robot: fixed"):
        return fix_joints(model, table.fixed)


def follow_recipes(
    parsed: schema.ExperimentFile,
    file: Path,
    logged: Recording,
    model: RobotModel | None,
    *,
    clocks_must_tell: bool = True,
) -> Recording:
    """Make of what was logged what it is taken for.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        logged: The streams as they were logged.
        model: The robot, with its joints that stand still; None for a wrist sensor.
        clocks_must_tell: Whether a delay that the recording does not tell is refused.

    Returns:
        The recording, with a finding for everything that was added.

    Raises:
        ExperimentError: If the file contradicts itself or the log.
    """
    fixed = {} if parsed.robot is None else parsed.robot.fixed
    _require_not_logged(fixed, file, logged)
    recording = aligned_clocks(parsed, file, logged, model, must_tell=clocks_must_tell)
    for index, entry in enumerate(parsed.transform):
        with stated_in(f"{file}: transform[{index}]"):
            recording = _transformed(recording, entry)
    findings = (*recording.findings, *_standing(fixed, parsed))
    return replace(recording, findings=findings)


def _require_not_logged(fixed: Mapping[str, float], file: Path, logged: Recording) -> None:
    with stated_in(str(file)):
        holders = logged.joint_signals("position") if fixed else {}
    for joint in fixed:
        if joint in holders:
            raise ExperimentError(
                f"{file}: robot: fixed: joint {joint!r} is logged, in the stream {holders[joint][0].name!r}; leave it "
                "out of one of them"
            )


def _standing(fixed: Mapping[str, float], parsed: schema.ExperimentFile) -> Sequence[Finding]:
    if not fixed:
        return ()
    values = ", ".join(f"{joint} at {value:g}" for joint, value in fixed.items())
    text = (
        f"not logged, taken to stand still all along (rad, m): {values}; what they weigh and do elsewhere is an error"
    )
    return (Finding(stream=parsed.name, kind="fixed_joint", message=text, count=len(fixed)),)


def _transformed(recording: Recording, entry: TransformTable) -> Recording:
    stream = recording.stream(entry.stream)
    own = stream.signal("wrench").frame
    by = "a pose that does not change" if entry.orientation is None else f"the orientation of {entry.orientation!r}"
    moved = wrench_in_frame(stream, entry.to, _pose_of_wrench(recording, entry))
    point = {
        "sensor": f"the origin of {entry.to!r}",
        "own_frame": f"the origin of {own!r}",
        "point": f"a point that moves with {entry.to!r}",
    }[entry.moment_about]
    text = f"the wrench is logged along the axes of {own!r}, its moment about {point}: moved into {entry.to!r} by {by}"
    finding = Finding(stream=entry.stream, kind="transformed", message=text, count=len(stream))
    return replace(
        recording, streams={**recording.streams, entry.stream: moved}, findings=(*recording.findings, finding)
    )


def _pose_of_wrench(recording: Recording, entry: TransformTable) -> FloatArray:
    """Axes of the wrench in the frame of the sensor, and there the point that its moment is about; ([n,] 4, 4); m."""
    if entry.orientation is not None:
        stream, source = recording.stream(entry.stream), recording.stream(entry.orientation)
        pose = (pose_at if entry.moment_about == "own_frame" else orientation_at)(stream, source, entry.to)
    else:
        pose = _pose(entry.pose)
    if entry.point_m is not None:
        pose[..., :3, 3] = entry.point_m
    return pose


def _pose(table: PoseTable | None) -> FloatArray:
    if table is None:
        raise ExperimentError("expected pose, or orientation")
    return make_pose(rotation_from_rpy(table.rpy_rad), np.zeros(3) if table.position_m is None else table.position_m)
