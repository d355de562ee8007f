# SPDX-License-Identifier: BSD-3-Clause
"""Where the joints of a robot may go: their limits, those of joints that follow them, and a margin."""

from __future__ import annotations

import math

from forcetorque.errors import RobotError
from forcetorque.robot import BodyTree, JointType, RobotModel


def free_joints(model: RobotModel) -> tuple[str, ...]:
    """Name the joints that have a coordinate of their own.

    Args:
        model: The robot.

    Returns:
        Joints that move and mimic no other, in the order of the robot.
    """
    return tuple(joint.name for joint in model.joints.values() if joint.type.moves and joint.mimic is None)


def joint_range(model: RobotModel, tree: BodyTree, joint: str, *, margin: float) -> tuple[float, float]:
    """Give the range of a free joint inside its limits.

    A joint that turns further than half a turn from zero, or without end, is kept to half a turn: all
    orientations lie in it. Joints that mimic it stay in their limits too.

    Args:
        model: The robot.
        tree: The same robot, rooted anywhere.
        joint: The joint.
        margin: Share of the range that is left out at either end.

    Returns:
        Lowest and highest position; rad or m.

    Raises:
        RobotError: If the limits are missing, or no position is inside all of them.
    """
    low, high = _limits(model, joint)
    for body in tree.bodies:
        follows = body.coordinate is not None and body.coordinate.joint == joint and body.joint != joint
        if not follows or body.joint is None or body.coordinate is None or body.coordinate.multiplier == 0.0:
            continue
        bounds = ((bound - body.coordinate.offset) / body.coordinate.multiplier for bound in _limits(model, body.joint))
        lowest, highest = sorted(bounds)
        low, high = max(low, lowest), min(high, highest)
    if not low <= high:
        raise RobotError(
            f"joint {joint!r}: expected a lower limit below the upper one, also by the joints that mimic it, got "
            f"{low:g} to {high:g}; name the range: ranges={{{joint!r}: (low, high)}}"
        )
    left_out = margin * (high - low)
    return low + left_out, high - left_out


def _limits(model: RobotModel, name: str) -> tuple[float, float]:
    joint = model.joints[name]
    if joint.type is JointType.CONTINUOUS:
        return -math.pi, math.pi
    limit = joint.limit
    if limit is None or limit.lower is None or limit.upper is None:
        raise RobotError(
            f"joint {name!r}: expected limits of its position in the URDF, it has none; "
            f"name the range: ranges={{{name!r}: (low, high)}}"
        )
    if joint.type is JointType.REVOLUTE and limit.lower < math.pi and limit.upper > -math.pi:
        return max(limit.lower, -math.pi), min(limit.upper, math.pi)
    return limit.lower, limit.upper
