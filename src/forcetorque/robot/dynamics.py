# SPDX-License-Identifier: BSD-3-Clause
"""Motion of bodies from the root outwards, and the Newton-Euler recursion over all samples at once."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError, ShapeError, known_names
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import cross, invert_pose, make_pose, split_pose
from forcetorque.base.wrench import transform_wrench
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import (
    Body,
    BodyTree,
    Connection,
    joints_between,
    needed_bodies,
    path_from_root,
    path_to_root,
    required_joints,
)


@dataclass(slots=True)
class BodyState:
    """Where one body is in its parent, and its motion in its own axes at its origin."""

    parent_R_body: FloatArray
    """Rotation in the parent; shape (3, 3) or (n, 3, 3)."""
    parent_p_body: FloatArray
    """Origin in the parent; shape (3,) or (n, 3); m."""
    angular_velocity: FloatArray
    """Angular velocity; shape (n, 3); rad/s."""
    angular_acceleration: FloatArray
    """Angular acceleration; shape (n, 3); rad/s2."""
    proper_acceleration: FloatArray
    """Proper acceleration of the origin; shape (n, 3); m/s2."""


def root_vectors(root: RootMotion, samples: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give the root's motion in the order of the recursion.

    Args:
        root: Motion of one sample or of all.
        samples: Number of samples, n.

    Returns:
        Angular velocity, angular acceleration and proper acceleration; shape (1, 3) or (n, 3) each.

    Raises:
        ShapeError: If the motion has neither one sample nor n.
    """
    vectors = (root.angular_velocity, root.angular_acceleration, root.proper_acceleration)
    for values in vectors:
        if values.ndim == 2 and len(values) not in {1, samples}:
            raise ShapeError(f"root motion: expected 1 or {samples} samples, got {len(values)}")
    omega, alpha, proper = (values.reshape(-1, 3) for values in vectors)
    return omega, alpha, proper


def stacked_root(root: RootMotion, samples: int) -> FloatArray:
    """Give the root's motion for every sample.

    Args:
        root: Motion of one sample or of all.
        samples: Number of samples, n.

    Returns:
        Angular velocity, angular acceleration and proper acceleration; shape (3, n, 3).
    """
    return np.stack([np.broadcast_to(values, (samples, 3)) for values in root_vectors(root, samples)])


def motion_of_link(tree: BodyTree, joints: JointMotion, root: RootMotion, link: str) -> RootMotion:
    """Carry the motion of the root link, such as that of an IMU, to another link.

    Args:
        tree: Robot rooted at the link whose motion is known.
        joints: Motion of at least the joints between the two links (`joints_between`).
        root: Motion of the root link's frame.
        link: Link whose motion is wanted.

    Returns:
        Motion of that link's frame, in its own axes; n samples.

    Raises:
        RobotError: If a joint between the two links is not in `joints`.
    """
    for joint in joints_between(tree, link):
        if joint not in joints.names:
            raise RobotError(
                f"carrying the motion of {tree.root_link!r} to {link!r} needs joint {joint!r}; "
                f"{known_names(joint, joints.names)}"
            )
    state = root_state(stacked_root(root, len(joints)))
    for index in path_from_root(tree, link)[1:]:
        state = move_to(tree.bodies[index], state, joints, slice(None))
    body_R_link, body_p_link = split_pose(tree.frames[link][1])
    omega, alpha = state.angular_velocity, state.angular_acceleration
    at_link = state.proper_acceleration + cross(alpha, body_p_link) + cross(omega, cross(omega, body_p_link))
    return RootMotion(
        proper_acceleration=_into(body_R_link, at_link),
        angular_velocity=_into(body_R_link, omega),
        angular_acceleration=_into(body_R_link, alpha),
    )


def body_pose(tree: BodyTree, joints: JointMotion, index: int) -> FloatArray:
    """Find where a body is; z of a body on a joint is the joint's axis.

    Args:
        tree: The robot.
        joints: Motion of at least the joints between the root and the body.
        index: Index of the body.

    Returns:
        `root_H_body`; shape (n, 4, 4); m.
    """
    return body_poses(tree, joints, (index,))[index]


def body_poses(tree: BodyTree, joints: JointMotion, indices: Collection[int]) -> dict[int, FloatArray]:
    """Find where several bodies are, each body on the way to them once.

    Args:
        tree: The robot.
        joints: Motion of at least the joints between the root and the bodies.
        indices: Indices of the bodies.

    Returns:
        `root_H_body` of these bodies and of all between them and the root; shape (n, 4, 4); m.

    Raises:
        RobotError: If a joint between the root link and a body is not in `joints`.
    """
    poses: dict[int, FloatArray] = {}
    for k in sorted({k for index in indices for k in path_to_root(tree, index)}):
        body = tree.bodies[k]
        if body.coordinate is None:  # the root, or a cut: the same rigid body
            poses[k] = poses[body.parent] if body.parent >= 0 else np.tile(np.eye(4), (len(joints), 1, 1))
            continue
        if body.coordinate.joint not in joints.names:
            raise RobotError(
                f"placing {body.links[0]!r} seen from {tree.root_link!r} needs joint {body.coordinate.joint!r}; "
                f"{known_names(body.coordinate.joint, joints.names)}"
            )
        position = joints.position[:, joints.names.index(body.coordinate.joint)]
        here = make_pose(*_across(body, body.coordinate.multiplier * position + body.coordinate.offset))
        poses[k] = poses[body.parent] @ here
    return poses


def link_pose(tree: BodyTree, joints: JointMotion, link: str) -> FloatArray:
    """Find where a link is in the root link.

    Args:
        tree: Robot rooted at the link in which poses are wanted.
        joints: Motion of at least the joints between the two links (`joints_between`).
        link: The other link.

    Returns:
        `root_H_link`; shape (n, 4, 4); m.

    Raises:
        RobotError: If the robot has no such link, or a joint between the two links is not in `joints`.
    """
    index = path_from_root(tree, link)[-1]
    return body_pose(tree, joints, index) @ tree.frames[link][1]


def root_state(base: FloatArray) -> BodyState:
    """Start the recursion at the root body.

    Args:
        base: Result of `stacked_root`; shape (3, n, 3).

    Returns:
        State of the root body.
    """
    angular_velocity, angular_acceleration, proper_acceleration = base
    return BodyState(np.eye(3), np.zeros(3), angular_velocity, angular_acceleration, proper_acceleration)


def move_to(body: Body, parent: BodyState, joints: JointMotion, block: slice) -> BodyState:
    """Carry the parent's motion across a body's joint.

    Args:
        body: The body.
        parent: State of its parent.
        joints: Motion of its joint, by name.
        block: Samples of `joints` that the parent's state is of.

    Returns:
        State of the body.
    """
    if body.coordinate is None:  # a cut: the same rigid body
        return BodyState(
            np.eye(3), np.zeros(3), parent.angular_velocity, parent.angular_acceleration, parent.proper_acceleration
        )
    column = joints.names.index(body.coordinate.joint)
    q = body.coordinate.multiplier * joints.position[block, column] + body.coordinate.offset
    dq = body.coordinate.multiplier * joints.velocity[block, column]
    ddq = body.coordinate.multiplier * joints.acceleration[block, column]
    z = np.array([0.0, 0.0, 1.0])
    rotation, position = _across(body, q)
    omega_parent, alpha_parent = parent.angular_velocity, parent.angular_acceleration
    at_joint = (
        parent.proper_acceleration + cross(alpha_parent, position) + cross(omega_parent, cross(omega_parent, position))
    )
    omega, alpha, acceleration = (_into(rotation, v) for v in (omega_parent, alpha_parent, at_joint))
    along, along_rate = dq[:, None] * z, ddq[:, None] * z
    if body.connection is Connection.ROTARY:
        alpha = alpha + cross(omega, along) + along_rate
        omega = omega + along
    else:
        acceleration = acceleration + 2.0 * cross(omega, along) + along_rate
    return BodyState(rotation, position, omega, alpha, acceleration)


def _across(body: Body, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rotation (n, 3, 3) or (3, 3), and origin (3,) or (n, 3), of a body in its parent at joint coordinates (n,)."""
    rotation, position = body.parent_R_joint, body.parent_p_joint
    if body.connection is Connection.ROTARY:
        return _turned_about_z(rotation, q), position
    return rotation, position + q[:, None] * rotation[:, 2]


def _turned_about_z(rotation: FloatArray, angle: FloatArray) -> FloatArray:
    """`rotation @ rotation_about_z(angle)`, in half the time; shape (n, 3, 3)."""
    cosine, sine = np.cos(angle), np.sin(angle)
    turned = np.empty((len(angle), 3, 3))
    for row, (x, y, z) in enumerate(rotation):
        turned[:, row, 0] = x * cosine + y * sine
        turned[:, row, 1] = y * cosine - x * sine
        turned[:, row, 2] = z
    return turned


def _into(parent_R_body: FloatArray, parent_vector: FloatArray) -> FloatArray:
    return np.einsum("...ji,...j->...i", parent_R_body, parent_vector)


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
    """Express wrenches in a parent's frame in the frame of its child body.

    Args:
        state: Where the body is in its parent; n samples.
        wrench: Wrenches along the parent's axes, about its origin; shape (n, 6); N, N m.

    Returns:
        The same along the body's axes, about its origin; shape (n, 6); N, N m.
    """
    about_body = wrench[:, 3:] - cross(state.parent_p_body, wrench[:, :3])
    force = np.einsum("...ji,...j->...i", state.parent_R_body, wrench[:, :3])
    return np.concatenate([force, np.einsum("...ji,...j->...i", state.parent_R_body, about_body)], axis=1)
