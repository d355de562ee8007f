# SPDX-License-Identifier: BSD-3-Clause
"""Joints of the robot that the log lacks: where each stood all along is asked, or offered where nobody need know."""

from __future__ import annotations

from collections.abc import Sequence

from forcetorque.inspection.draft.gravity import felt_joints
from forcetorque.inspection.draft.sensors import DraftedSensor, sensor_joints
from forcetorque.inspection.draft.streams import DraftedLog
from forcetorque.inspection.draft.toml_lines import line, listed, question, remark
from forcetorque.robot.model import JointType, RobotModel

_MOST_JOINTS = 12


def unlogged_joints(log: DraftedLog, model: RobotModel) -> tuple[str, ...]:
    """Name the joints that no stream holds.

    Args:
        log: The log.
        model: The robot.

    Returns:
        Joints that move by themselves, in the order of the robot; none where the log names none, or streams hold joints
        that nobody has named yet.
    """
    holders = [stream for stream in log.streams if "position" in stream.quantities]
    if not holders or not all(stream.joints for stream in holders):
        return ()
    logged = {joint for stream in holders for joint in stream.joints}
    moving = (name for name, one in model.joints.items() if one.type is not JointType.FIXED and one.mimic is None)
    return tuple(name for name in moving if name not in logged)


def standing_lines(log: DraftedLog, sensors: Sequence[DraftedSensor], model: RobotModel, base: str | None) -> list[str]:
    """Ask where joints stood that were not logged.

    Args:
        log: The log.
        sensors: Sensors of the log.
        model: The robot.
        base: The link that an arm is bolted down by; None for a robot that may stand on several.

    Returns:
        A question for each joint that a sensor needs wherever it sits, and a comment for others; none where no joint is
        missing.
    """
    missing = unlogged_joints(log, model)
    needed = joints_felt(sensors, model, base)
    asked = [joint for joint in missing if joint in needed]
    others = [joint for joint in missing if joint not in needed]
    lines = ["", "[robot.fixed]"] if asked else []
    for joint in asked:
        words = f"where it stood all along, {model.joints[joint].type.unit}: no stream is known to hold it"
        lines.append(question(joint, f"{words}; if it moved, the log must"))
    if others:
        stood = line(others[0], 0.0) if asked else line("fixed", {others[0]: 0.0})
        words = (
            f"for joints that stood still all along, where a command asks; not logged: {listed(others, _MOST_JOINTS)}"
        )
        lines.append(f"# {stood}  {remark(words)}")
    return lines


def joints_felt(sensors: Sequence[DraftedSensor], model: RobotModel, base: str | None) -> set[str]:
    """Name the joints without which nobody knows what sensors must read, wherever each of them sits.

    Args:
        sensors: Sensors of the log.
        model: The robot.
        base: The link that an arm is bolted down by; None where it may stand on several.

    Returns:
        The joints; none where nobody knows what stands still.
    """
    if base is None:
        return set()
    felt: set[str] = set()
    for sensor in sensors:
        places = sensor_joints(sensor, model)
        needed = [set(felt_joints(model, joint, base)) for joint in places]
        felt |= set.intersection(*needed) if needed else set()
    return felt
