# SPDX-License-Identifier: BSD-3-Clause
"""Newton-Euler recursion over all samples at once: the readable reference.

Outwards: angular velocity, angular acceleration and proper acceleration of every body, in its axes
and at its origin. Net wrench of a body (thesis 2.2 with the corrected inertia): f = m a + ..., the
wrench that all its neighbours and contacts together must apply. Inwards: `S` of a sensor is the sum
of the net wrenches outboard of it, the wrench of the inboard on the outboard part. It holds where
nothing outboard touches the world.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError, known_names
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import cross, invert_pose
from forcetorque.base.wrench import transform_wrench
from forcetorque.robot.kinematics import BodyState, move_to, root_state, stacked_root
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, needed_bodies, required_joints

_BLOCK = 4096
"""Samples per pass: the working arrays of a block stay in the processor's cache."""


def expected_wrenches(
    tree: BodyTree, joints: JointMotion, root: RootMotion, sensors: Sequence[str] | None = None
) -> dict[str, FloatArray]:
    """Compute what the sensors should read where the only unknown contact is inboard of them.

    Args:
        tree: Robot rooted at the link whose motion is known.
        joints: Motion of at least the joints that the sensors need (`required_joints`).
        root: Motion of the root link's frame; a `RootMotion.fixed` for a support at rest.
        sensors: Names of the sensors; all of the tree if None.

    Returns:
        Expected reading of each sensor in its frame and direction; shape (n, 6); N, N m.

    Raises:
        RobotError: If a sensor is not in the tree, or a joint that it needs is not in `joints`.
        ShapeError: If `root` has neither one sample nor as many as `joints`.
    """
    wanted = tuple(tree.cuts) if sensors is None else tuple(sensors)
    for name in wanted:
        missing = [joint for joint in required_joints(tree, name) if joint not in joints.names]
        if missing:
            raise RobotError(
                f"sensor {name!r} seen from {tree.root_link!r} needs the joint(s) {', '.join(missing)}, "
                f"which the motion lacks; {known_names(missing[0], joints.names)}"
            )
    samples = len(joints)
    base = stacked_root(root, samples)
    expected = {name: np.empty((samples, 6)) for name in wanted}
    for start in range(0, samples, _BLOCK):
        block = slice(start, start + _BLOCK)
        for name, values in _evaluate_block(tree, joints, base[:, block], wanted, block).items():
            expected[name][block] = values
    return expected


def _evaluate_block(
    tree: BodyTree, joints: JointMotion, base: FloatArray, sensors: Sequence[str], block: slice
) -> dict[str, FloatArray]:
    moving, weighing = needed_bodies(tree, sensors)
    states: dict[int, BodyState] = {}
    wrenches: dict[int, FloatArray] = {}
    for index, body in enumerate(tree.bodies):
        if not moving[index]:
            continue
        states[index] = root_state(base) if body.parent < 0 else move_to(body, states[body.parent], joints, block)
        if weighing[index]:
            wrenches[index] = net_wrench(body.inertia, states[index])
    for index in reversed(range(len(tree.bodies))):
        parent = tree.bodies[index].parent
        if weighing[index] and parent >= 0 and weighing[parent]:
            wrenches[parent] += in_parent(states[index], wrenches[index])
    zero = np.zeros((base.shape[1], 6))
    readings = {}
    for name in sensors:
        cut = tree.cuts[name]
        outboard = wrenches.get(cut.body, zero)
        readings[name] = cut.sign * transform_wrench(invert_pose(cut.body_H_sensor), outboard)
    return readings


def net_wrench(inertia: Inertia, state: BodyState) -> FloatArray:
    """Compute the wrench that makes a body move as it does (thesis 2.3 with the corrected inertia).

    Args:
        inertia: Inertia in and about the body's frame.
        state: Motion of the body; n samples.

    Returns:
        Force and moment along the body's axes, about its origin; shape (n, 6); N, N m.
    """
    omega, alpha = state.angular_velocity, state.angular_acceleration
    moment, tensor = inertia.first_moment, inertia.second_moment
    force = inertia.mass * state.proper_acceleration + cross(alpha, moment) + cross(omega, cross(omega, moment))
    couple = alpha @ tensor + cross(omega, omega @ tensor) + cross(moment, state.proper_acceleration)
    return np.concatenate([force, couple], axis=1)


def in_parent(state: BodyState, wrench: FloatArray) -> FloatArray:
    """Express wrenches on a body in its parent's frame.

    Args:
        state: Where the body is in its parent; n samples.
        wrench: Wrenches along the body's axes, about its origin; shape (n, 6); N, N m.

    Returns:
        The same along the parent's axes, about its origin; shape (n, 6); N, N m.
    """
    force: FloatArray = np.einsum("...ij,...j->...i", state.parent_R_body, wrench[:, :3])
    couple = np.einsum("...ij,...j->...i", state.parent_R_body, wrench[:, 3:])
    return np.concatenate([force, couple + cross(state.parent_p_body, force)], axis=1)


def in_body(state: BodyState, wrench: FloatArray) -> FloatArray:
    """Express wrenches in a parent's frame in the frame of a body that hangs on it.

    Args:
        state: Where the body is in its parent; n samples.
        wrench: Wrenches along the parent's axes, about its origin; shape (n, 6); N, N m.

    Returns:
        The same along the body's axes, about its origin; shape (n, 6); N, N m.
    """
    about_body = wrench[:, 3:] - cross(state.parent_p_body, wrench[:, :3])
    force = np.einsum("...ji,...j->...i", state.parent_R_body, wrench[:, :3])
    return np.concatenate([force, np.einsum("...ji,...j->...i", state.parent_R_body, about_body)], axis=1)
