# SPDX-License-Identifier: BSD-3-Clause
"""What a robot stands on, one link after the other, and how that carries another link."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only
from forcetorque.robot import BodyTree, JointMotion, RootMotion, link_pose, motion_of_link


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Foothold:
    """A link that stands still in the world from some instant on."""

    tree: BodyTree
    """The robot rooted at this link."""
    world_H_link: FloatArray
    """Where it stands; z of the world points up; shape (4, 4); m."""
    start_s: float
    """Since when; s."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "world_H_link", read_only(self.world_H_link, name="world_H_link", shape=(4, 4)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Footing:
    """How a link moves because others, one after the other, stand still.

    Where one follows the other, the joints between them have to be at rest, so that both stand still.
    """

    link: str
    """Link that is carried."""
    joints: Callable[[FloatArray], JointMotion]
    """From instants (n,) in s to the motion of all free joints."""
    footholds: tuple[Foothold, ...]
    """What stands still, in turn; the first one before its start too."""

    def poses(self, seconds: FloatArray, world_H_rest: FloatArray) -> FloatArray:
        """Find where the link is.

        Args:
            seconds: Instants; shape (n,); s.
            world_H_rest: Pose of the link at rest, which footholds tell already; shape (4, 4); m.

        Returns:
            `world_H_link`; shape (n, 4, 4); m.
        """
        poses = np.tile(world_H_rest, (len(seconds), 1, 1))
        for hold, rows in self._in_turn(seconds):
            poses[rows] = hold.world_H_link @ link_pose(hold.tree, self.joints(seconds[rows]), self.link)
        return poses

    def motion(self, seconds: FloatArray, world_H_rest: FloatArray, *, gravity: float) -> RootMotion:
        """Give the motion of the link's frame.

        Args:
            seconds: Instants; shape (n,); s.
            world_H_rest: Pose of the link at rest, which footholds tell already; shape (4, 4); m.
            gravity: Magnitude of gravity; m/s2.

        Returns:
            The motion in the link's axes; n samples.
        """
        vectors = np.zeros((3, len(seconds), 3))
        for hold, rows in self._in_turn(seconds):
            still = RootMotion.fixed(-hold.world_H_link[2, :3], gravity=gravity)
            carried = motion_of_link(hold.tree, self.joints(seconds[rows]), still, self.link)
            vectors[:, rows] = carried.proper_acceleration, carried.angular_velocity, carried.angular_acceleration
        proper, velocity, rate = vectors
        return RootMotion(proper_acceleration=proper, angular_velocity=velocity, angular_acceleration=rate)

    def _in_turn(self, seconds: FloatArray) -> list[tuple[Foothold, IntArray]]:
        """What stands still at which instants."""
        starts = [hold.start_s for hold in self.footholds[1:]]
        turn = np.searchsorted(starts, seconds, side="right")
        rows = ((hold, np.flatnonzero(turn == k)) for k, hold in enumerate(self.footholds))
        return [(hold, own) for hold, own in rows if len(own)]
