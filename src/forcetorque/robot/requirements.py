# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor's expected wrench depends on: bodies and joints, nothing more."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import BoolArray
from forcetorque.errors import RobotError, known_names
from forcetorque.robot.tree import BodyTree


def needed_bodies(tree: BodyTree, sensors: Sequence[str]) -> tuple[BoolArray, BoolArray]:
    """Find the bodies that the expected wrenches of some sensors depend on.

    Outboard bodies without inertia that carry none further out are left out, so their joints may
    be absent from a log.

    Args:
        tree: The robot.
        sensors: Names of the sensors.

    Returns:
        Bodies whose motion is needed, and among them those whose net wrench is; each of shape (bodies,).

    Raises:
        RobotError: If a sensor is not in the tree.
    """
    count = len(tree.bodies)
    outboard = np.zeros(count, dtype=bool)
    for name in sensors:
        if name not in tree.cuts:
            raise RobotError(f"no force-torque sensor {name!r} at a fixed joint; {known_names(name, tree.cuts)}")
        outboard[tree.cuts[name].body] = True
    has_weight = np.array([not body.inertia.is_zero for body in tree.bodies])
    for index, body in enumerate(tree.bodies):
        outboard[index] |= body.parent >= 0 and outboard[body.parent]
    for index in reversed(range(1, count)):
        has_weight[tree.bodies[index].parent] |= has_weight[index]
    weighing = outboard & has_weight
    moving = weighing.copy()
    for index in reversed(range(1, count)):
        moving[tree.bodies[index].parent] |= moving[index]
    return moving, weighing


def required_joints(tree: BodyTree, sensor: str) -> tuple[str, ...]:
    """Name the joints whose motion a sensor's expected wrench depends on.

    Args:
        tree: The robot, rooted where the motion is known.
        sensor: Name of the sensor.

    Returns:
        Joints, each once, from the root outwards; leaders instead of joints that mimic.

    Raises:
        RobotError: If the sensor is not in the tree.
    """
    moving, _ = needed_bodies(tree, [sensor])
    needed = (body.coordinate for body, moves in zip(tree.bodies, moving, strict=True) if moves)
    return tuple(dict.fromkeys(coordinate.joint for coordinate in needed if coordinate is not None))
