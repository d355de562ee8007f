# SPDX-License-Identifier: BSD-3-Clause
"""The robot that a log itself describes, fixed frames of its sensors, and the load at the wrist of an arm."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError, FormatError
from forcetorque.base.pose import split_pose
from forcetorque.formats.arm_log import DeclaredLoad, LoggedWrist
from forcetorque.formats.log_format import FixedFrame, LoggedRobot, RobotLoggingFormat
from forcetorque.formats.registry import format_named, recognised_format
from forcetorque.inspection.draft.drafted_streams import DraftedStream
from forcetorque.inspection.draft.sensors_and_supports import DraftedMount, DraftedSensor
from forcetorque.inspection.draft.toml_lines import line, listed
from forcetorque.recording.recording import Finding, Recording
from forcetorque.robot.model import JointType, RobotModel
from forcetorque.robot.mount_estimate import rotation_vector
from forcetorque.robot.urdf import read_urdf_text

_SAME_MASS_KG, _SAME_POSE = 1e-6, 1e-6
"""Masses, and entries of poses in m and 1, that differ by less are the same: files are rounded."""
_MOST_NAMED = 6
_REMEDY = "name the URDF of the robot by --urdf, which is then taken in its place"


def logged_robot(paths: Sequence[Path], log_format: str | None) -> LoggedRobot:
    """Read what a log has of its robot.

    Args:
        paths: One log of any format, or several tables.
        log_format: Name of the format; it is recognised by what is there if None.

    Returns:
        Description and frames; nothing where the format has none.
    """
    (path, *others) = paths
    if others or not path.exists():
        return LoggedRobot()
    known = recognised_format(path) if log_format is None else format_named(log_format)
    return known.robot(path) if isinstance(known, RobotLoggingFormat) else LoggedRobot()


def model_of(logged: LoggedRobot) -> RobotModel | None:
    """Read the robot that a log describes.

    Args:
        logged: What the log has of its robot.

    Returns:
        The robot; None where it has none.

    Raises:
        FormatError: If the description is no URDF, or there are several.
    """
    if logged.conflict:
        raise FormatError(f"{logged.conflict}; {_REMEDY}")
    if logged.urdf is None:
        return None
    try:
        return read_urdf_text(logged.urdf, where=logged.source)
    except ForceTorqueError as error:
        raise FormatError(f"{error}; {_REMEDY}") from error


def robot_findings(logged: LoggedRobot, recording: Recording) -> tuple[Finding, ...]:
    """Compare a log with the robot that it describes.

    Args:
        logged: What the log has of its robot.
        recording: Its streams.

    Returns:
        One finding about the robot, its joints in the log, and the frames of wrenches; none where it has no robot.
    """
    try:
        model = model_of(logged)
    except FormatError as error:
        return (Finding(stream=logged.topic, kind="robot", message=str(error), count=0),)
    if model is None:
        return ()
    moving = [name for name, joint in model.joints.items() if joint.type.moves and joint.mimic is None]
    positions = recording.joint_signals("position")
    missing, unknown = [name for name in moving if name not in positions], [n for n in positions if n not in moving]
    words = [f"robot {model.name!r}: {sum(link.mass for link in model.links.values()):.4g} kg"]
    words.append(f"{len(moving) - len(missing)} of {len(moving)} moving joints are logged")
    if missing:
        words.append(f"not logged: {listed(missing, _MOST_NAMED)}")
    if unknown:
        words.append(f"logged and not in the robot: {listed(unknown, _MOST_NAMED)}")
    for stream in recording.streams.values():
        frame = None if "wrench" not in stream.signals else stream.signals["wrench"].frame
        if frame is not None and frame not in model.links:
            frames, unclear = logged.frames_around(stream.name)
            words.append(_frame_text(stream.name, frame, _link_of(frame, frames, model), unclear))
    return (Finding(stream=logged.topic, kind="robot", message="; ".join(words), count=0),)


def _frame_text(stream: str, frame: str, found: tuple[str, FloatArray, str] | None, unclear: Sequence[str]) -> str:
    if found is None and unclear:
        return (
            f"frame {frame!r} of {stream!r} is no link of it, and of {listed(unclear, _MOST_NAMED)} topics outside the "
            f"namespace of {stream!r} have different poses"
        )
    if found is None:
        return f"frame {frame!r} of {stream!r} is no link of it, and no fixed frame of the log leads to one"
    return f"frame {frame!r} of {stream!r} is fixed to its link {found[0]!r} by {found[2]}"


def difference(logged: LoggedRobot, model: RobotModel, file: Path) -> str | None:
    """Compare the robot that a log describes with that of a file.

    Args:
        logged: What the log has of its robot.
        model: The robot of the file.
        file: The file, for the message.

    Returns:
        What differs; None where nothing does, or the log has no description.
    """
    try:
        own = model_of(logged)
    except FormatError as error:
        return f"{file} is not compared with the log: {str(error).removesuffix(f'; {_REMEDY}')}"
    words = [] if own is None else list(_differences(own, model))
    return f"{logged.source} differs from {file}, which is taken: {'; '.join(words)}" if words else None


def _differences(own: RobotModel, model: RobotModel) -> Iterator[str]:
    for what, ours, others in (("links", own.links, model.links), ("joints", own.joints, model.joints)):
        for which, names in (("log", set(ours) - set(others)), ("file", set(others) - set(ours))):
            if names:
                yield f"{what} of the {which} alone: {listed(sorted(names), _MOST_NAMED)}"
    links = [name for name in own.links if name in model.links]
    heavier = [name for name in links if abs(own.links[name].mass - model.links[name].mass) > _SAME_MASS_KG]
    if heavier:
        masses = [sum(one.links[name].mass for name in links) for one in (own, model)]
        yield f"masses of {listed(heavier, _MOST_NAMED)}: {masses[0]:.4g} kg and {masses[1]:.4g} kg in all"
    joints = [name for name in own.joints if name in model.joints]
    moved = [
        name
        for name in joints
        if np.abs(own.joints[name].parent_H_child - model.joints[name].parent_H_child).max() > _SAME_POSE
        or own.joints[name].type is not model.joints[name].type
    ]
    if moved:
        yield f"types or origins of {listed(moved, _MOST_NAMED)}"


def with_fixed_frame(
    sensor: DraftedSensor, streams: Sequence[DraftedStream], logged: LoggedRobot, model: RobotModel | None
) -> DraftedSensor:
    """Find the joint and the mount of a sensor by the fixed frames of its log.

    Args:
        sensor: The sensor, whose joint is open.
        streams: Streams of the log.
        logged: What the log has of its robot.
        model: The robot; None for a wrist sensor without one.

    Returns:
        The sensor with the fixed joint that leads to the link that its frame is fixed to, and its pose there; the same
        where a name gives the joint, or no such frame leads to the child of a fixed joint.
    """
    frame = next((stream.frame for stream in streams if stream.name == sensor.stream), None)
    if model is None or sensor.tags or sensor.joint is not None or frame is None:
        return sensor
    frames, _ = logged.frames_around(sensor.stream)
    found = _link_of(frame, frames, model)
    if found is None:
        return sensor
    link, link_H_frame, source = found
    joints = [joint for joint in model.joints.values() if joint.child == link and joint.type is JointType.FIXED]
    if not joints or joints[0].name not in sensor.joints:
        return sensor
    link_R_frame, origin = split_pose(link_H_frame)
    mount = DraftedMount(
        rotation_deg=np.rad2deg(rotation_vector(link_R_frame)),
        shift_mm=1e3 * origin,
        source=f"{frame!r} of its messages in {link!r}, by {source}",
    )
    return replace(sensor, joint=joints[0].name, mount=mount)


def _link_of(frame: str, frames: Mapping[str, FixedFrame], model: RobotModel) -> tuple[str, FloatArray, str] | None:
    """Link that a frame beyond the URDF is fixed to, its pose there, and what says so."""
    pose, here, passed = np.eye(4), frame, set[str]()
    while here not in model.links:
        if here not in frames or here in passed:
            return None
        passed.add(here)
        pose = frames[here].parent_H_child @ pose
        here = frames[here].parent
    return (here, pose, frames[frame].source) if passed else None


_BY_FORMAT = "by the format of the log"


def wrist_load_lines(wrist: LoggedWrist) -> list[str]:
    """Write the `[load]` table.

    Args:
        wrist: The wrench at the flange.

    Returns:
        Its lines.
    """
    return [
        "",
        "[load]",
        line("frame", wrist.frame, "the flange, about whose origin moments are"),
        line("motion", [wrist.stream]),
        line("measure_direction", wrist.measure_direction.value, _BY_FORMAT),
    ]


def wrist_interval_lines(wrist: LoggedWrist) -> list[str]:
    """Write the `[[interval]]` tables: one for each load that the controller knew, and motions, which are ignored.

    Args:
        wrist: The wrench at the flange.

    Returns:
        Their lines. A controller zeroes its measurement when the declared load is set, so that each is a session.
    """
    start, several = wrist.declared[0].start_ns, len(wrist.declared) > 1
    lines: list[str] = []
    for number, declared in enumerate(wrist.declared, start=1):
        label = f"payload {number}" if several else "all"
        known = _declared_text(declared) if declared.mass else ""
        lines += ["", "[[interval]]", line("label", label, known)]
        lines += [line("start_s", 1e-9 * (declared.start_ns - start))]
        if number < len(wrist.declared):
            lines.append(line("end_s", 1e-9 * (declared.end_ns - start)))
        lines.append(line("use", "calibration"))
        if several:
            lines.append(line("session", label))
    return [*lines, *_motion_lines(wrist, start)]


def _motion_lines(wrist: LoggedWrist, start: int) -> Iterator[str]:
    for number, (first, last) in enumerate(wrist.moving, start=1):
        yield from ("", "[[interval]]", line("label", f"motion {number}"))
        yield line("start_s", max(1e-9 * (first - start), 0.0))
        yield line("end_s", 1e-9 * (last - start))
        yield line("use", "ignore")


def _declared_text(declared: DeclaredLoad) -> str:
    return f"with the payload of {declared.mass:g} kg that the controller subtracts, and the reader adds"
