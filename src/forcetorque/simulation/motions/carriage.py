# SPDX-License-Identifier: BSD-3-Clause
"""A link that is carried through the world, as if it hung on six joints."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.robot import (
    BodyTree,
    Joint,
    JointMotion,
    JointType,
    RobotModel,
    RootMotion,
    build_tree,
    link_pose,
    motion_of_link,
)
from forcetorque.spatial import Inertia, make_pose

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
    pose: FloatArray = make_pose(moved[:, :3, :3] @ world_H_rest[:3, :3], moved[:, :3, 3] + world_H_rest[:3, 3])
    return pose


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
