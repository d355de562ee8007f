# SPDX-License-Identifier: BSD-3-Clause
"""Joint positions that bring a link to a pose, and a link that is carried through the world."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import RobotError
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import cross, make_pose
from forcetorque.robot.dynamics import body_poses, link_pose, motion_of_link
from forcetorque.robot.model import Joint, JointType, RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, Connection, build_tree, path_to_root

_STEPS = 60
_LARGEST_STEP = 0.3
"""Joints go no farther in a step, so that a knee does not bend the other way; rad or m."""
_DAMPING = 1e-6
"""Beside the squares of singular values of the Jacobian, which are 1e-3 for a knee that is bent by 0.2 rad."""
_REACHED = 1e-9
"""What is left of the way; m, rad."""


def joints_reaching(tree: BodyTree, joints: Sequence[str], link: str, root_H_link: Any, *, start: Any) -> FloatArray:
    """Find positions of joints that bring a link to given poses, by damped Newton steps for all poses at once.

    Args:
        tree: Robot rooted at the link that the poses are seen from.
        joints: All joints between the two links.
        link: Link to bring there.
        root_H_link: Wanted poses of it in the root link; shape (n, 4, 4); m.
        start: Positions to start from, which choose among several solutions; shape (joints,); rad or m.

    Returns:
        Positions; shape (n, joints); rad or m.

    Raises:
        RobotError: If a pose is out of reach.
    """
    names = tuple(joints)
    wanted = read_only(root_H_link, name="root_H_link", shape=(None, 4, 4))
    position = np.tile(read_only(start, name="start", shape=(len(names),)), (len(wanted), 1))
    identity = _DAMPING * np.eye(6)
    left = np.full((len(wanted), 6), np.inf)
    for _ in range(_STEPS):
        pose, jacobian = _pose_and_jacobian(tree, names, link, position)
        left = _way(pose, wanted)
        if np.abs(left).max() < _REACHED:
            return position
        transposed = jacobian.transpose(0, 2, 1)
        step = transposed @ np.linalg.solve(jacobian @ transposed + identity, left[..., None])
        position = position + np.clip(step[..., 0], -_LARGEST_STEP, _LARGEST_STEP)
    worst = int(np.abs(left).max(axis=1).argmax())
    raise RobotError(
        f"link {link!r} seen from {tree.root_link!r}: expected poses within the reach of {', '.join(names)}, pose "
        f"{worst} of {len(wanted)}, {wanted[worst, :3, 3].round(3).tolist()} m away, is missed by "
        f"{np.linalg.norm(left[worst, :3]):.2g} m and {np.linalg.norm(left[worst, 3:]):.2g} rad; move less far"
    )


def _way(pose: FloatArray, wanted: FloatArray) -> FloatArray:
    """From poses to wanted ones, in the root's axes: a shift, and sines about the axis of the turn; shape (n, 6)."""
    turn = wanted[:, :3, :3] @ pose[:, :3, :3].transpose(0, 2, 1)
    sines = 0.5 * (turn - turn.transpose(0, 2, 1))
    return np.concatenate(
        [wanted[:, :3, 3] - pose[:, :3, 3], np.stack([sines[:, 2, 1], sines[:, 0, 2], sines[:, 1, 0]], axis=1)], axis=1
    )


def _pose_and_jacobian(
    tree: BodyTree, names: tuple[str, ...], link: str, position: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Pose of a link (n, 4, 4), and what its velocity (linear, angular) is per velocity of joints (n, 6, joints)."""
    index, body_H_link = tree.frames[link]
    poses = body_poses(tree, JointMotion.at_rest(names, position), (index,))
    pose = poses[index] @ body_H_link
    jacobian = np.zeros((len(position), 6, len(names)))
    for k in path_to_root(tree, index):
        body = tree.bodies[k]
        if body.coordinate is None:
            continue
        axis = body.coordinate.multiplier * poses[k][:, :3, 2]
        column = names.index(body.coordinate.joint)
        if body.connection is Connection.PRISMATIC:
            jacobian[:, :3, column] += axis
            continue
        jacobian[:, :3, column] += cross(axis, pose[:, :3, 3] - poses[k][:, :3, 3])
        jacobian[:, 3:, column] += axis
    return pose, jacobian


CARRIAGE_JOINTS: Final = ("x", "y", "z", "yaw", "pitch", "roll")
"""Along x, y and z of the world, then about z, y and x, each turned by those before it; m, rad."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Carriage:
    """How a link moves away from where it rests: along the axes of the world, and about its own origin."""

    displacement: Callable[[FloatArray], JointMotion]
    """From instants (n,) in s to the motion of `CARRIAGE_JOINTS`, with exact derivatives."""

    def poses(self, seconds: FloatArray, world_H_rest: FloatArray) -> FloatArray:
        """Find where the link is.

        Args:
            seconds: Instants; shape (n,); s.
            world_H_rest: Pose of the link where it rests; shape (4, 4); m.

        Returns:
            `world_H_link`; shape (n, 4, 4); m.
        """
        return carried_poses(self.displacement(seconds), world_H_rest)

    def motion(self, seconds: FloatArray, world_H_rest: FloatArray, *, gravity: float) -> RootMotion:
        """Give the motion of the link's frame.

        Args:
            seconds: Instants; shape (n,); s.
            world_H_rest: Pose of the link where it rests; shape (4, 4); m.
            gravity: Magnitude of gravity; m/s2.

        Returns:
            The motion in the link's axes; n samples.
        """
        world = RootMotion.fixed([0.0, 0.0, -1.0], gravity=gravity)
        turned = motion_of_link(_world(), self.displacement(seconds), world, "carried")
        rotation = world_H_rest[:3, :3]  # vectors are rows, so that this turns them into the link's axes
        return RootMotion(
            proper_acceleration=turned.proper_acceleration @ rotation,
            angular_velocity=turned.angular_velocity @ rotation,
            angular_acceleration=turned.angular_acceleration @ rotation,
        )


def carried_poses(displacement: JointMotion, world_H_rest: FloatArray) -> FloatArray:
    """Find where a carried link is.

    Args:
        displacement: Positions of `CARRIAGE_JOINTS`; n samples; m, rad.
        world_H_rest: Pose of the link where they are zero; shape (4, 4); m.

    Returns:
        `world_H_link`; shape (n, 4, 4); m.
    """
    moved = link_pose(_world(), displacement, "carried")
    return make_pose(moved[:, :3, :3] @ world_H_rest[:3, :3], moved[:, :3, 3] + world_H_rest[:3, 3])


@cache
def _world() -> BodyTree:
    """The six joints, one after the other, between the world and a frame that is carried."""
    links = ("world", *CARRIAGE_JOINTS[:-1], "carried")
    axes = np.vstack([np.eye(3), np.eye(3)[::-1]])
    joints = {
        name: Joint(
            name=name,
            type=JointType.PRISMATIC if index < 3 else JointType.CONTINUOUS,
            parent=links[index],
            child=links[index + 1],
            parent_H_child=np.eye(4),
            axis=axes[index],
        )
        for index, name in enumerate(CARRIAGE_JOINTS)
    }
    massless = {link: Inertia.zero() for link in links}
    return build_tree(RobotModel(name="carriage", links=massless, joints=joints, sensors={}), "world")
