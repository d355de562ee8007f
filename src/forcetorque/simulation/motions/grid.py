# SPDX-License-Identifier: BSD-3-Clause
"""Grid: a stiff limb is carried over a grid of two joints, while the robot hangs on a pole (thesis 5.1.3)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import RobotError, ShapeError
from forcetorque.robot import JointMotion, JointType
from forcetorque.robot.kinematics import body_pose
from forcetorque.simulation.motions.limb import Limb, limb_of
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.stand import Stand

_ALONG = 0.9
"""Cosine above which two axes count as one: 26 degrees."""


def grid_movement(
    stand: Stand,
    sensor: str,
    *,
    joints: tuple[str, str] | None = None,
    steps: int = 7,
    hold_s: float = 0.0,
    name: str | None = None,
) -> Movement:
    """Carry the limb beyond a sensor over a grid of two joints between support and sensor.

    Everything beyond the sensor stays as it is, so the centre of mass stays where it is in the
    sensor's frame, and the force on the sensor goes over a part of a sphere. The second joint goes
    to and fro, the first one step by step.

    Args:
        stand: The robot on its support.
        sensor: Sensor of interest.
        joints: The two joints, slow one first; the first two of the limb that turn about axes of their own, neither
            along gravity at rest, if None.
        steps: Positions of each joint, spread over its range.
        hold_s: How long to rest at each; s.
        name: Name of the movement.

    Returns:
        The movement, from one corner of the grid to another.

    Raises:
        RobotError: If the limb has no two such joints, or those named do not carry the sensor.
        ShapeError: If there are fewer than two steps.
    """
    if steps < 2:
        raise ShapeError(f"steps: expected at least 2 positions of a joint, got {steps}")
    limb = limb_of(stand, sensor)
    slow, fast = _two_joints(stand, limb) if joints is None else _named(stand, limb, joints)
    rows, columns = (np.linspace(*stand.range_of(joint), steps) for joint in (slow, fast))
    postures = np.tile(stand.rest, (steps * steps, 1))
    postures[:, stand.joints.index(slow)] = np.repeat(rows, steps)
    there_and_back = [columns if row % 2 == 0 else columns[::-1] for row in range(steps)]
    postures[:, stand.joints.index(fast)] = np.concatenate(there_and_back)
    trajectory = stand.through(postures, hold_s=hold_s)
    title = f"grid {limb.sensor}" if name is None else name
    return stand.movement(title, MovementKind.GRID, trajectory, trajectory.duration_s)


def _two_joints(stand: Stand, limb: Limb) -> tuple[str, str]:
    pair: list[tuple[str, FloatArray]] = []
    for joint in limb.own:
        axis = _axis(stand, joint)
        others = [stand.gravity_direction, *(other for _, other in pair)]
        turns = stand.model.joints[joint].type is not JointType.PRISMATIC
        if turns and all(abs(axis @ other) < _ALONG for other in others):
            pair.append((joint, axis))
        if len(pair) == 2:
            return pair[0][0], pair[1][0]
    raise RobotError(
        f"grid of sensor {limb.sensor!r} from {stand.support!r}: expected two joints of its limb that turn about axes "
        f"of their own, away from gravity, got {_listed(joint for joint, _ in pair)} out of {_listed(limb.own)}; name "
        f"two of {_listed(limb.between)} as joints, or choose another support"
    )


def _named(stand: Stand, limb: Limb, joints: tuple[str, str]) -> tuple[str, str]:
    stand.columns(joints)
    for joint in joints:
        if joint not in limb.between:
            raise RobotError(
                f"grid of sensor {limb.sensor!r}: expected joints between {stand.support!r} and the sensor, got "
                f"{joint!r}; known: {_listed(limb.between)}"
            )
    slow, fast = joints
    if slow == fast:
        raise RobotError(f"grid of sensor {limb.sensor!r}: expected two joints, got {slow!r} twice")
    return slow, fast


def _axis(stand: Stand, joint: str) -> FloatArray:
    """Axis of a joint in the support, at rest; shape (3,)."""
    index = next(k for k, body in enumerate(stand.tree.bodies) if body.joint == joint)
    axis: FloatArray = body_pose(stand.tree, JointMotion.at_rest(stand.joints, stand.rest[None]), index)[0, :3, 2]
    return axis


def _listed(names: Iterable[str]) -> str:
    return ", ".join(map(repr, names)) or "none"
