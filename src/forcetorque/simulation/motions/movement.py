# SPDX-License-Identifier: BSD-3-Clause
"""A movement of every joint while links stand, in phases in which the same links touch the world."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, check_arrays, names, require_shape
from forcetorque.base.errors import RobotError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.dynamics import link_pose, motion_of_link
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.simulation.motions.inverse_kinematics import Carriage


class PhaseKind(StrEnum):
    """How a robot is borne."""

    HANGING = "hanging"
    """By a link of its trunk, feet in the air."""
    LANDING = "landing"
    """By that link and both feet, while the first hands the weight over."""
    DOUBLE_SUPPORT = "double_support"
    """By both feet."""
    SINGLE_SUPPORT = "single_support"
    """By one foot."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Phase:
    """A span of a movement in which the same links touch the world."""

    label: str
    """Its name, unique in the movement."""
    kind: PhaseKind
    """How the robot is borne."""
    start_s: float
    """Start; s since the start of the movement."""
    end_s: float
    """End; s since the start of the movement."""
    touched: tuple[str, ...]
    """Links that touch the world; each stands still."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Foothold(ArrayRecord):
    """A link that stands still in the world from some instant on."""

    tree: BodyTree
    """The robot rooted at this link."""
    world_H_link: FloatArray = field(metadata=array(4, 4))
    """Where it stands; z of the world points up; shape (4, 4); m."""
    start_s: float
    """Since when; s."""


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
            world_H_rest: Pose of the link at rest, which footholds give already; shape (4, 4); m.

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
            world_H_rest: Pose of the link at rest, which footholds give already; shape (4, 4); m.
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


class MovementKind(StrEnum):
    """Kinds of data sets (thesis 5.1.3), and others beside them."""

    GRID = "grid"
    """A stiff limb is carried over a grid of two joints."""
    Z_TORQUE = "z_torque"
    """A limb goes between postures with much moment about z of a sensor."""
    BALANCING = "balancing"
    """One foot stands, the other leg moves widely."""
    RANDOM = "random"
    """Every joint moves by itself, smoothly."""
    CONTACT_SWITCHING = "contact_switching"
    """The weight goes from one foot to the other."""
    STANDING = "standing"
    """Both feet stand, and nothing moves."""
    SWAY = "sway"
    """Both feet stand, trunk and arms move."""
    SQUAT = "squat"
    """Both feet stand, the trunk goes down and up."""
    STEPPING = "stepping"
    """The feet leave the ground in turn."""


class Touch(NamedTuple):
    """A touch beside the support, whose wrench is known."""

    contact: Contact
    """Where; its type is `known`."""
    wrench: Callable[[FloatArray], FloatArray]
    """From instants (n,) in s to what the environment does to the robot, in the contact frame; (n, 6); N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Movement(ArrayRecord):
    """What all free joints do over some seconds while the support stands still, or is carried as known."""

    name: str
    """What it is called, such as the name of a data set."""
    kind: MovementKind
    """What it is good for."""
    model: RobotModel
    """The robot."""
    support: str
    """Link that stands still in the world, or is carried, and bears what the touches do not."""
    world_H_support: FloatArray = field(metadata=array(4, 4))
    """Pose of the support in the world, whose z points up; at rest if it is carried; shape (4, 4); m."""
    duration_s: float
    """How long it takes; before and after, it is as its trajectory says; s."""
    trajectory: Callable[[FloatArray], JointMotion]
    """From instants (n,) in s to the motion of all joints that are free, with exact derivatives."""
    external: tuple[Touch, ...] = field(default=(), metadata=names())
    """Touches beside the support."""
    carriage: Carriage | Footing | None = None
    """How the support is carried; None if it stands still."""
    gravity: float = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""
    phases: tuple[Phase, ...] = ()
    """Spans in which other links touch, in turn and without gaps; none if the same may touch all the time."""
    tree: BodyTree = field(init=False)
    """The robot rooted at the support."""

    def __post_init__(self) -> None:
        check_arrays(self)
        object.__setattr__(self, "kind", MovementKind(self.kind))
        object.__setattr__(self, "tree", build_tree(self.model, self.support))
        for touch in self.external:
            if touch.contact.type is not ContactType.KNOWN:
                raise RobotError(
                    f"movement {self.name!r}, touch {touch.contact.name!r}: expected the contact type known, got "
                    f"{touch.contact.type}; the support alone bears what is unknown"
                )

    @property
    def gravity_direction(self) -> FloatArray:
        """Unit vector along which things fall, in the axes of the support at rest; shape (3,)."""
        return -self.world_H_support[2, :3]

    @property
    def touched(self) -> tuple[str, ...]:
        """Links that touch the world, some of them at times: the support unless it is carried, and the touches'."""
        standing = () if self.carriage is not None else (self.support,)
        return (*standing, *(touch.contact.link for touch in self.external))

    def joints(self, seconds: Any) -> JointMotion:
        """Give the motion of the joints.

        Args:
            seconds: Instants since the start; shape (n,); s.

        Returns:
            Positions, velocities and accelerations of all joints that are free; those that mimic follow them.
        """
        return self.trajectory(_instants(seconds))

    def root(self, seconds: Any) -> RootMotion:
        """Give the motion of the support.

        Args:
            seconds: Instants since the start; shape (n,); s.

        Returns:
            Its motion; n samples, or the one of a frame at rest.
        """
        if self.carriage is None:
            return RootMotion.fixed(self.gravity_direction, gravity=self.gravity)
        return self.carriage.motion(_instants(seconds), self.world_H_support, gravity=self.gravity)

    def link_motion(self, seconds: Any, link: str) -> RootMotion:
        """Give the motion of a link, as a perfect IMU in its frame would read it.

        Args:
            seconds: Instants since the start; shape (n,); s.
            link: The link.

        Returns:
            Its motion, in its own axes; n samples.

        Raises:
            RobotError: If the robot has no such link.
        """
        return motion_of_link(self.tree, self.joints(seconds), self.root(seconds), link)

    def base_pose(self, seconds: Any, link: str) -> FloatArray:
        """Find where a link, such as the base of a floating-base model, is in the world.

        Args:
            seconds: Instants since the start; shape (n,); s.
            link: The link.

        Returns:
            `world_H_link`; shape (n, 4, 4); m.

        Raises:
            RobotError: If the robot has no such link.
        """
        at = _instants(seconds)
        world_H_support = self.world_H_support
        if self.carriage is not None:
            world_H_support = self.carriage.poses(at, self.world_H_support)
        return world_H_support @ link_pose(self.tree, self.joints(at), link)

    def external_wrenches(self, seconds: Any) -> Wrenches:
        """Give what the touches beside the support do to the robot.

        Args:
            seconds: Instants since the start; shape (n,); s.

        Returns:
            Wrenches by the names of the contacts, in their frames; none where nothing touches.
        """
        at = _instants(seconds)
        values = np.empty((len(at), len(self.external), 6))
        for k, touch in enumerate(self.external):
            values[:, k] = touch.wrench(at)
        return Wrenches(names=tuple(touch.contact.name for touch in self.external), values=values)

    def readings(self, seconds: Any, sensors: Sequence[str] | None = None) -> Wrenches:
        """Compute what perfect sensors read, touches included.

        Args:
            seconds: Instants since the start; shape (n,); s.
            sensors: Names of the sensors; all in fixed joints if None.

        Returns:
            The true readings, each in the sensor's frame and direction.

        Raises:
            RobotError: If the robot has no such sensor.
        """
        wanted = tuple(self.tree.cuts) if sensors is None else tuple(sensors)
        question = Question(
            tree=self.tree, contacts=tuple(touch.contact for touch in self.external), expected=wanted, equations=()
        )
        estimates = estimate(question, self.joints(seconds), self.root(seconds), known=self.external_wrenches(seconds))
        return Wrenches(names=wanted, values=estimates.expected)

    def support_wrench(self, seconds: Any) -> FloatArray:
        """Compute what the ground does to the robot at the support.

        Args:
            seconds: Instants since the start; shape (n,); s.

        Returns:
            The wrench in the support's frame; shape (n, 6); N, N m.
        """
        bearing = Contact(link=self.support, name=f"{self.support} (support)")  # a name that no touch has
        touches = tuple(touch.contact for touch in self.external)
        question = Question(tree=self.tree, contacts=(bearing, *touches))
        known = self.external_wrenches(seconds)
        return estimate(question, self.joints(seconds), self.root(seconds), known=known).contact_wrenches[:, 0]


def _instants(seconds: Any) -> FloatArray:
    at = np.asarray(seconds, dtype=np.float64)
    require_shape(at, name="seconds", shape=(None,))
    return at
