# SPDX-License-Identifier: BSD-3-Clause
"""A robot held at one link: where its joints may go, how fast, and its limbs and legs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, check_arrays, mapping, read_only
from forcetorque.base.errors import RobotError, ShapeError, require_known
from forcetorque.base.pose import make_pose, skew
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.robot.mechanics.sub_model_equations import joints_of_bodies
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import (
    BodyTree,
    build_tree,
    cut_of,
    joint_range,
    joints_between,
    outboard_bodies,
    path_to_root,
)
from forcetorque.simulation.motions.movement import Movement, MovementKind, Touch
from forcetorque.simulation.motions.trajectories import Waypoints


def free_joints(model: RobotModel) -> tuple[str, ...]:
    """Name the joints that have a coordinate of their own.

    Returns:
        Joints that move and mimic no other, in the order of the robot.
    """
    return tuple(joint.name for joint in model.joints.values() if joint.type.moves and joint.mimic is None)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stand(ArrayRecord):
    """A robot on a pole or on a foot; the functions of this package make its movements."""

    model: RobotModel
    """The robot."""
    support: str
    """Link that stands still in the world."""
    gravity_direction: FloatArray
    """Unit vector along which things fall, in the axes of the support; shape (3,)."""
    speed: float = 0.5
    """Largest speed of any joint; its own limit holds where that is lower; rad/s or m/s."""
    margin: float = 0.05
    """Share of every joint's range that is left out at either end."""
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict, metadata=mapping())
    """Lowest and highest position of joints, instead of those from limits and margin; rad or m."""
    posture: Mapping[str, float] = field(default_factory=dict, metadata=mapping())
    """Where joints rest; the others rest at zero, or as near to it as their range allows; rad or m."""
    gravity: float = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""
    tree: BodyTree = field(init=False)
    """The robot rooted at the support."""
    joints: tuple[str, ...] = field(init=False)
    """Joints with a coordinate of their own; postures have a column for each."""
    rest: FloatArray = field(init=False)
    """Posture at rest; shape (j,); rad or m."""

    def __post_init__(self) -> None:
        check_arrays(self)
        object.__setattr__(self, "gravity_direction", _unit(self.gravity_direction))
        object.__setattr__(self, "tree", build_tree(self.model, self.support))
        object.__setattr__(self, "joints", free_joints(self.model))
        if not 0.0 < self.speed < np.inf:
            raise ShapeError(f"speed: expected a positive one in rad/s or m/s, got {self.speed:g}")
        if not 0.0 <= self.margin < 0.5:
            raise ShapeError(f"margin: expected a share of at least 0 and below 0.5, got {self.margin:g}")
        self.columns((*self.ranges, *self.posture))
        for name, (low, high) in self.ranges.items():
            if not -np.inf < low <= high < np.inf:
                raise RobotError(f"ranges: joint {name!r}: expected (lowest, highest), got ({low:g}, {high:g})")
        object.__setattr__(
            self, "rest", read_only([self._rest_of(name) for name in self.joints], name="rest", shape=(None,))
        )

    @property
    def world_H_support(self) -> FloatArray:
        """Pose of the support in a world of its own: at its origin, turned until gravity points down; shape (4, 4)."""
        flip = np.diag([1.0, -1.0, -1.0]) if self.gravity_direction[2] > 0.0 else np.eye(3)
        # the half turn keeps the shortest one away from where it is singular
        return make_pose(shortest_turn_down(flip @ self.gravity_direction) @ flip, np.zeros(3))

    @property
    def speeds(self) -> FloatArray:
        """Largest speed of every joint; a limit of 0 is taken to be unknown; shape (j,); rad/s or m/s."""
        limits = (self.model.joints[name].limit for name in self.joints)
        own = (None if limit is None else limit.velocity for limit in limits)
        return np.array([min(self.speed, speed) if speed else self.speed for speed in own])

    def range_of(self, joint: str) -> tuple[float, float]:
        """Give the positions that a joint may take.

        Args:
            joint: A free joint.

        Returns:
            Lowest and highest position; rad or m.

        Raises:
            RobotError: If there is no such joint, or its limits are missing or in the wrong order.
        """
        self.columns([joint])
        if joint in self.ranges:
            low, high = self.ranges[joint]
            return float(low), float(high)
        return joint_range(self.model, self.tree, joint, margin=self.margin)

    def around_rest(self, joints: Sequence[str], share: float) -> FloatArray:
        """Give a part of the joints' ranges around their rest.

        Args:
            joints: Free joints.
            share: Share of the way from rest to either end of the range.

        Returns:
            Lowest and highest positions; shape (2, joints); rad or m.
        """
        rest = self.rest[self.columns(joints)]
        limits = np.array([self.range_of(joint) for joint in joints]).reshape(-1, 2).T
        return rest + share * (limits - rest)

    def columns(self, joints: Iterable[str]) -> list[int]:
        """Find the columns of joints in postures.

        Args:
            joints: Free joints.

        Returns:
            Their columns.

        Raises:
            RobotError: If one is not a free joint of the robot.
        """
        for joint in joints:
            require_known(joint, self.joints, RobotError, f"robot {self.model.name!r} has no free joint {joint!r}")
        return [self.joints.index(joint) for joint in joints]

    def through(self, postures: FloatArray, *, hold_s: float = 0.0) -> Waypoints:
        """Go from posture to posture.

        Args:
            postures: Postures of all free joints; shape (k, j); rad or m.
            hold_s: How long to rest at each; s.

        Returns:
            The trajectory.
        """
        return Waypoints.at_speed(self.joints, postures, self.speeds, hold_s=hold_s)

    def movement(
        self,
        name: str,
        kind: MovementKind,
        trajectory: Callable[[FloatArray], JointMotion],
        duration_s: float,
        *,
        external: tuple[Touch, ...] = (),
        world_H_support: FloatArray | None = None,
    ) -> Movement:
        """Make a movement of a trajectory.

        Args:
            name: What it is called.
            kind: What it is good for.
            trajectory: From instants (n,) to the motion of all free joints.
            duration_s: How long it takes; s.
            external: Touches beside the support.
            world_H_support: Pose of the support in the world; `world_H_support` of the stand if None.

        Returns:
            The movement.
        """
        return Movement(
            name=name,
            kind=kind,
            model=self.model,
            support=self.support,
            world_H_support=self.world_H_support if world_H_support is None else world_H_support,
            duration_s=duration_s,
            trajectory=trajectory,
            external=external,
            gravity=self.gravity,
        )

    def _rest_of(self, joint: str) -> float:
        try:
            low, high = self.range_of(joint)
        except RobotError:  # limits that are missing or wrong matter only to those who move the joint
            low, high = -np.inf, np.inf
        wanted = self.posture.get(joint)
        if wanted is not None and not low <= wanted <= high:
            raise RobotError(
                f"posture: joint {joint!r}: expected a position in its range {low:g} to {high:g} (margin "
                f"{self.margin:g}), got {wanted:g}"
            )
        return float(np.clip(0.0 if wanted is None else wanted, low, high))


def shortest_turn_down(direction: FloatArray) -> FloatArray:
    """Give the shortest turn after which a direction points straight down.

    Args:
        direction: Unit vector that does not point straight up; shape (3,).

    Returns:
        Rotation matrix; shape (3, 3).
    """
    hat = skew(np.cross(direction, [0.0, 0.0, -1.0]))
    return np.eye(3) + hat + hat @ hat / (1.0 - direction[2])


def _unit(direction: object) -> FloatArray:
    vector = read_only(direction, name="gravity_direction", shape=(3,))
    length = float(np.linalg.norm(vector))
    if not 0.0 < length < np.inf:
        raise ShapeError(f"gravity_direction: expected a direction other than zero, got {vector.tolist()}")
    return read_only(vector / length, name="gravity_direction", shape=(3,))


@dataclass(frozen=True, slots=True, kw_only=True)
class Limb:
    """Free joints around a sensor, from the support outwards."""

    sensor: str
    """Name of the sensor."""
    between: tuple[str, ...]
    """All joints between the support and the sensor."""
    own: tuple[str, ...]
    """Those of them that carry this limb alone: after the last place where other joints branch off."""
    outboard: tuple[str, ...]
    """Joints beyond the sensor."""


def limb_of(stand: Stand, sensor: str) -> Limb:
    """Find the limb that a sensor sits in.

    Args:
        stand: The robot on its support.
        sensor: Name of the sensor, or an alias.

    Returns:
        Its joints.

    Raises:
        RobotError: If the robot has no such sensor at a fixed joint.
    """
    tree = stand.tree
    name = stand.model.sensor(sensor).name
    cut = cut_of(tree, name)
    path = tuple(reversed(path_to_root(tree, cut)))
    between = joints_of_bodies(tree, path)
    branching = [k for k, body in enumerate(path[:-1]) if _branches_off(tree, body, path[k + 1], between)]
    own = joints_of_bodies(tree, path[branching[-1] + 1 :]) if branching else between
    beyond = outboard_bodies(tree, cut)
    outboard = joints_of_bodies(
        tree, tuple(index for index in range(len(tree.bodies)) if beyond[index] and index != cut)
    )
    return Limb(
        sensor=name,
        between=between,
        own=own,
        outboard=tuple(joint for joint in outboard if joint not in between),
    )


def _branches_off(tree: BodyTree, body: int, onwards: int, path_joints: tuple[str, ...]) -> bool:
    """Whether joints hang on a body beside the path; those that follow joints of the path do not count."""
    away = outboard_bodies(tree, body) & ~outboard_bodies(tree, onwards)
    away[body] = False
    beside = joints_of_bodies(tree, (index for index in range(len(tree.bodies)) if away[index]))
    return any(joint not in path_joints for joint in beside)


@dataclass(frozen=True, slots=True, kw_only=True)
class Legs:
    """Free joints of a robot that stands on one foot."""

    trunk: str
    """Link that both legs hang on."""
    support: tuple[str, ...]
    """Joints between the trunk and the foot that stands."""
    swing: tuple[str, ...]
    """Joints between the trunk and the other foot."""
    others: tuple[str, ...]
    """All other free joints: of the trunk, arms and head."""


def legs_of(stand: Stand, swing: str, *, trunk: str | None = None) -> Legs:
    """Find the legs.

    Args:
        stand: The robot on one foot.
        swing: A link of the other foot.
        trunk: Link that both legs hang on; the last link that both feet hang on in the URDF if None.

    Returns:
        The joints of both legs, and the others.

    Raises:
        RobotError: If there is no such link, or a leg has no joints of its own.
    """
    for link in (swing, *(() if trunk is None else (trunk,))):
        require_known(link, stand.model.links, RobotError, f"robot {stand.model.name!r} has no link {link!r}")
    middle = _common_ancestor(stand, swing) if trunk is None else trunk
    tree = build_tree(stand.model, middle)
    standing, swinging = (joints_between(tree, foot) for foot in (stand.support, swing))
    shared = set(standing) & set(swinging)
    for foot, joints in ((stand.support, standing), (swing, swinging)):
        if not joints or shared:
            raise RobotError(
                f"legs from {middle!r} to {stand.support!r} and {swing!r}: expected joints of their own, {foot!r} has "
                f"{', '.join(joints) or 'none'}; name the trunk between the legs"
            )
    legs = {*standing, *swinging}
    return Legs(trunk=middle, support=standing, swing=swinging, others=tuple(j for j in stand.joints if j not in legs))


def _common_ancestor(stand: Stand, swing: str) -> str:
    parents = {joint.child: joint.parent for joint in stand.model.joints.values()}
    above = [stand.support]
    while above[-1] in parents:
        above.append(parents[above[-1]])
    link = swing
    while link not in above:
        link = parents[link]
    return link
