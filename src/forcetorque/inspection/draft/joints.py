# SPDX-License-Identifier: BSD-3-Clause
"""Joints of a drafted experiment: joints without names in the log, and joints that the log lacks."""

from __future__ import annotations

import re
from collections.abc import Sequence

from forcetorque.formats.yarp.joint_and_sensor_ports import NO_JOINT
from forcetorque.inspection.draft.drafted_streams import DraftedLog
from forcetorque.inspection.draft.gravity_fit import required_joints_of_sensor
from forcetorque.inspection.draft.sensors_and_supports import DraftedSensor, sensor_joints
from forcetorque.inspection.draft.toml_lines import line, listed, question, remark, toml_value
from forcetorque.robot.model import JointType, RobotModel

_MOST_ROWS = 2
_SIDES = {"left", "right"}
"""Words that joints abbreviate by their first letter."""
_LIMBS = {
    "head": {"head", "neck", "eye", "eyes", "eyelids"},
    "torso": {"torso", "waist"},
    "arm": {"arm", "shoulder", "elbow", "wrist"},
    "leg": {"leg", "hip", "knee", "ankle"},
}
"""Words in the names of streams and joints of a limb."""
_TORSO = {"torso", "yaw", "roll", "pitch"}
"""Words in the names of the joints of the torso of an iCub."""
_TORSO_INWARD = "; a torso of iCub sends yaw, roll, pitch, from the outer one inwards"


def joints_question(count: int, where: str, model: RobotModel | None, *, key: str = "joints") -> str:
    """Write the question for the names of joints.

    Args:
        count: Number of joints.
        where: Name of the stream, which may contain a limb.
        model: The robot; None for none.
        key: Key of the experiment file.

    Returns:
        The line.
    """
    words = f"names of the {count} joints in the order of the log, as the URDF has them"
    if key == "joints":
        words += f', "{NO_JOINT}" for one that it lacks'
    if model is None:
        return question(key, words)
    rows = joint_rows(model, count, where)
    if rows:
        choices = " or ".join(toml_value(row) for row in rows[:_MOST_ROWS])
        inward = (
            _TORSO_INWARD if any({word for joint in row for word in _words(joint)} >= _TORSO for row in rows) else ""
        )
        return question(key, f"{words}; the robot has {choices}, from the inner one outwards{inward}")
    limbs = _limbs_called(_words(where))
    names = [name for name, joint in model.joints.items() if joint.type.moves]
    likely = [name for name in names if not (limbs and _is_of_another([name], limbs))]
    return question(key, f"{words}: of {listed(likely or names, 40)}")


def joint_rows(model: RobotModel, count: int, where: str = "") -> list[list[str]]:
    """Find serial chains with a number of joints.

    Args:
        model: The robot.
        count: Number of joints.
        where: Name that may contain a limb, as `left_leg`; chains of other limbs are left out, and chains with another
            prefix where one has this prefix.

    Returns:
        Chains of joints, each from the inner to the outer one.
    """
    words = _words(where)
    limbs = _limbs_called(words)
    rows = [row for row in _limbs(model) if len(row) == count and not (limbs and _is_of_another(row, limbs))]
    initials = {side[0] for side in _SIDES & words}
    named = [row for row in rows if all(_begins(joint, words, initials) for joint in row)]
    return named or rows


def _begins(joint: str, words: set[str], initials: set[str]) -> bool:
    first = re.split(r"[_\W]+", joint.lower())[0]
    return first in words or first in initials


def _is_of_another(row: list[str], limbs: set[str]) -> bool:
    called = _limbs_called({word for joint in row for word in _words(joint)})
    return bool(called) and not called & limbs


def _words(name: str) -> set[str]:
    return set(re.findall("[a-z]+", name.lower()))


def _limbs_called(words: set[str]) -> set[str]:
    return {limb for limb, known in _LIMBS.items() if words & known}


def _limbs(model: RobotModel) -> list[list[str]]:
    """Chains of moving joints from branch to branch, or to an end."""
    outward: dict[str, list[str]] = {}
    for name, joint in model.joints.items():
        outward.setdefault(joint.parent, []).append(name)
    inward = {joint.child: joint.parent for joint in model.joints.values()}
    moved: set[str] = set()
    for joint in model.joints.values():
        link: str | None = joint.parent if joint.type.moves else None
        while link is not None and link not in moved:
            moved.add(link)
            link = inward.get(link)
    limbs: list[list[str]] = []
    waiting: list[tuple[str, list[str]]] = [(model.root_link, [])]
    while waiting:
        here, row = waiting.pop()
        ways = [
            name for name in outward.get(here, ()) if model.joints[name].type.moves or model.joints[name].child in moved
        ]
        if len(ways) != 1 and row:
            limbs.append(row)
            row = []
        for name in ways:
            joint = model.joints[name]
            waiting.append((joint.child, [*row, name] if joint.type.moves else row))
    return limbs


_MOST_JOINTS = 12


def unlogged_joints(log: DraftedLog, model: RobotModel) -> tuple[str, ...]:
    """Find the joints without a stream.

    Returns:
        Independent joints, in the order of the robot; none where the log has no names of joints, or streams hold joints
        without names.
    """
    holders = [stream for stream in log.streams if "position" in stream.quantities]
    if not holders or not all(stream.joints for stream in holders):
        return ()
    logged = {joint for stream in holders for joint in stream.joints}
    moving = (name for name, one in model.joints.items() if one.type is not JointType.FIXED and one.mimic is None)
    return tuple(name for name in moving if name not in logged)


def standing_lines(log: DraftedLog, sensors: Sequence[DraftedSensor], model: RobotModel, base: str | None) -> list[str]:
    """Write questions for the positions of joints that were not logged.

    Args:
        log: The log.
        sensors: Sensors of the log.
        model: The robot.
        base: The link that an arm is bolted down by; None for a robot that may stand on several.

    Returns:
        A question for each joint that a sensor needs at any of its possible positions, and a comment for others; none
        where no joint is missing.
    """
    missing = unlogged_joints(log, model)
    needed = joints_of_sensors(sensors, model, base)
    required = [joint for joint in missing if joint in needed]
    others = [joint for joint in missing if joint not in needed]
    lines = ["", "[robot.fixed]"] if required else []
    for joint in required:
        words = f"where it stood all along, {model.joints[joint].type.unit}: no stream is known to hold it"
        lines.append(question(joint, f"{words}; if it moved, the log must"))
    if others:
        stood = line(others[0], 0.0) if required else line("fixed", {others[0]: 0.0})
        words = (
            f"for joints that stood still all along, where a command asks; not logged: {listed(others, _MOST_JOINTS)}"
        )
        lines.append(f"# {stood}  {remark(words)}")
    return lines


def joints_of_sensors(sensors: Sequence[DraftedSensor], model: RobotModel, base: str | None) -> set[str]:
    """Find the joints that the expected wrenches of sensors depend on, at any of their possible positions.

    Args:
        sensors: Sensors of the log.
        model: The robot.
        base: The link that an arm is bolted down by; None where it may stand on several.

    Returns:
        The joints; none where the support is unknown.
    """
    if base is None:
        return set()
    joints: set[str] = set()
    for sensor in sensors:
        candidates = sensor_joints(sensor, model)
        needed = [set(required_joints_of_sensor(model, joint, base)) for joint in candidates]
        joints |= set.intersection(*needed) if needed else set()
    return joints
