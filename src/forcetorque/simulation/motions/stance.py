# SPDX-License-Identifier: BSD-3-Clause
"""A robot on both feet: where they are, how the legs follow the trunk, and steps on the spot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, read_only
from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.base.pose import invert_pose, make_pose, rotation_about_z
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.simulation.motions.foot_loads import FootLoads, internal_pushes
from forcetorque.simulation.motions.held_robot import Legs, Stand, legs_of, shortest_turn_down
from forcetorque.simulation.motions.inverse_kinematics import CARRIAGE_JOINTS, Carriage, carried_poses, joints_reaching
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.trajectories import Spline, minimum_jerk

_UNLOADED = (0.02, 0.12)
_LIFTED = (0.13, 0.37)
_LOADED = (0.38, 0.48)
"""When a foot hands its load over, is in the air, and takes its load again, as shares of a cycle; the other foot does
so half a cycle later. A foot leaves the ground only when it bears nothing."""
_HEIGHT_M = 0.03
_SWING = np.array([0.05, 0.015, 0.01, 0.1, 0.1, 0.1])
"""How far a foot in the air goes at most away from the middle of its way; m, rad."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Steps:
    """Feet that are lifted in turn and put down where they stood."""

    cycle_s: float
    """Time in which each foot is lifted once; s."""
    swing: tuple[Spline, Spline]
    """Where each foot would go in the air, in `CARRIAGE_JOINTS`; m, rad."""

    @classmethod
    def draw(cls, *, cycle_s: float, duration_s: float, rng: np.random.Generator) -> Steps:
        """Draw what the feet do in the air.

        Args:
            cycle_s: Time in which each foot is lifted once; s.
            duration_s: How long it goes on; s.
            rng: Source of the ways of the feet.

        Returns:
            The steps; none is like another.
        """
        first, second = (
            Spline.towards_targets(CARRIAGE_JOINTS, _SWING, duration_s=duration_s, period_s=cycle_s / 4.0, rng=rng)
            for _ in range(2)
        )
        return cls(cycle_s=cycle_s, swing=(first, second))

    def shares(self, seconds: FloatArray) -> FloatArray:
        """Compute the share of its load that each foot has taken.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            From 0, which it is in the air, to 1, which one of both always is; shape (n, 2).
        """
        phase = self._phase(seconds)
        return 1.0 - minimum_jerk(_progress(phase, _UNLOADED)) + minimum_jerk(_progress(phase, _LOADED))

    def lifts(self, seconds: FloatArray) -> FloatArray:
        """Compute the height of each foot.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            From 0 on the ground to 1 half-way through the air, with two derivatives that vanish at either end of
            that; shape (n, 2).
        """
        x = np.clip(_progress(self._phase(seconds), _LIFTED), 0.0, 1.0)
        return 64.0 * (x * (1.0 - x)) ** 3

    def displacements(self, seconds: FloatArray) -> FloatArray:
        """Compute the displacement of each foot from where it stands.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            In `CARRIAGE_JOINTS`, zero on the ground; shape (2, n, 6); m, rad.
        """
        middle = np.array([0.0, 0.0, _HEIGHT_M, 0.0, 0.0, 0.0])
        lifts = self.lifts(seconds)
        return np.stack([lifts[:, [k]] * (middle + swing(seconds)) for k, swing in enumerate(self.swing)])

    def lean(self, seconds: FloatArray) -> FloatArray:
        """Compute over which foot the trunk leans.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            From -1 over the first foot to 1 over the second; shape (n,).
        """
        return np.sin(2.0 * np.pi / self.cycle_s * seconds)

    def _phase(self, seconds: FloatArray) -> FloatArray:
        """Time since each foot's cycle began, as a share of it; shape (n, 2)."""
        return (seconds[:, None] / self.cycle_s + [0.0, 0.5]) % 1.0


def _progress(phase: FloatArray, span: tuple[float, float]) -> FloatArray:
    """Part of a span of the cycle that is over; below 0 before it, above 1 after it."""
    return (phase - span[0]) / (span[1] - span[0])


_LEG_JOINTS: Final = 6
"""Joints of a leg: as many as a pose has coordinates, so that the trunk and the feet settle them."""
_SAMPLES_HZ = 50.0
"""Rate at which the legs' positions are found; splines between them keep the feet in place within 1e-5 m."""
_SPARE_SAMPLES = 10
_BENT = 0.25
"""Where the search for a leg's positions starts, between straight and the middle of the joints' ranges: a knee bends
the way in which it has more range."""
_ANKLE, _RELAXED = slice(-2, None), 0.5
"""In the air the two joints next to the foot go this part of the way to the middle of their ranges: a lifted knee would
bend them beyond."""
_OVERSHOOT = 1.1
"""Room that joints of trunk and arms keep beside the part of their range that they use."""
_REPLACED = np.array([0.02, 0.015, 0.15])
"""How far a foot is shifted forwards and sideways, and turned, at most, either way; m, m, rad."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stance(ArrayRecord):
    """A robot on both feet; the functions of this package make its movements.

    Its trunk is carried, and legs of six joints follow it to feet whose poses are known.
    """

    stand: Stand
    """The robot on its first foot; its gravity direction holds for the other one too."""
    other: str
    """Link of the other foot."""
    trunk: str | None = None
    """Link that both legs hang on; the last link that both feet hang on in the URDF if None."""
    crouch_m: float = 0.025
    """How much lower than with straight legs the trunk is at rest; m."""
    placement: FloatArray = field(default_factory=lambda: np.zeros((2, 3)), metadata=array(2, 3))
    """Where each foot stands away from where straight legs put it: forwards and sideways along the axes of the first
    foot, in m, and turned about the vertical, in rad; shape (2, 3)."""
    legs: Legs = field(init=False)
    """Joints of both legs, that of the first foot as `support`, and the others."""
    tree: BodyTree = field(init=False)
    """The robot rooted at its trunk."""
    world_H_trunk: FloatArray = field(init=False)
    """Pose of the trunk at rest; z of the world points up from the ground; shape (4, 4); m."""
    world_H_feet: FloatArray = field(init=False)
    """Poses of both feet on the ground; shape (2, 4, 4); m."""

    def __post_init__(self) -> None:
        check_arrays(self)
        legs = legs_of(self.stand, self.other, trunk=self.trunk)
        for foot, joints in zip((self.stand.support, self.other), (legs.support, legs.swing), strict=True):
            if len(joints) != _LEG_JOINTS:
                raise RobotError(
                    f"leg from {legs.trunk!r} to {foot!r}: expected {_LEG_JOINTS} joints, which settle the pose of a "
                    f"foot, got {', '.join(joints)}"
                )
        if not 0.0 < self.crouch_m < np.inf:
            raise ShapeError(f"crouch_m: expected a positive way in m, straight legs are rigid; got {self.crouch_m:g}")
        object.__setattr__(self, "legs", legs)
        object.__setattr__(self, "tree", build_tree(self.stand.model, legs.trunk))
        straight = JointMotion.at_rest(self.stand.joints, self._straight()[None])
        world_H_first = self.stand.world_H_support
        first_H_trunk = link_pose(self.stand.tree, straight, legs.trunk)[0]
        first_H_other = link_pose(self.stand.tree, straight, self.other)[0]
        feet = [
            _placed(pose, self.stand.gravity_direction, shift)
            for pose, shift in zip((world_H_first, world_H_first @ first_H_other), self.placement, strict=True)
        ]
        world_H_trunk = world_H_first @ first_H_trunk
        world_H_trunk[2, 3] -= self.crouch_m
        object.__setattr__(self, "world_H_trunk", read_only(world_H_trunk, name="world_H_trunk", shape=(4, 4)))
        object.__setattr__(self, "world_H_feet", read_only(feet, name="world_H_feet", shape=(2, 4, 4)))

    @property
    def feet(self) -> tuple[str, str]:
        """Links of both feet."""
        return self.stand.support, self.other

    def resting(self) -> Stand:
        """Give the robot in the posture in which it rests on both feet.

        Returns:
            The robot on its first foot, level.

        Raises:
            RobotError: If a joint is beyond its range there.
        """
        others = self.stand.rest[self.stand.columns(self.legs.others)]
        (posture,) = self._postures(np.zeros((1, len(CARRIAGE_JOINTS))), others[None], at=np.zeros(1))
        return replace(
            self.stand,
            posture=dict(zip(self.stand.joints, posture, strict=True)),
            gravity_direction=-self.world_H_feet[0, 2, :3],
        )

    def others_moving(self, *, share: float, duration_s: float, period_s: float, rng: np.random.Generator) -> Spline:
        """Move all joints but those of the legs at random, around their rest or as near to it as their range allows.

        Args:
            share: Share of its range that a joint uses at most.
            duration_s: How long it goes on; s.
            period_s: Time from target to target; s.
            rng: Source of the targets.

        Returns:
            Positions of the joints that `legs.others` names; no faster than the stand allows.
        """
        names = self.legs.others
        columns = self.stand.columns(names)
        low, high = np.array([self.stand.range_of(name) for name in names]).reshape(-1, 2).T
        reach = 0.5 * share * (high - low)
        centre = np.clip(self.stand.rest[columns], low + _OVERSHOOT * reach, high - _OVERSHOOT * reach)
        ways = Spline.towards_targets(
            names, reach, duration_s=duration_s, period_s=period_s, rng=rng, speeds=self.stand.speeds[columns]
        )
        return Spline(names=names, seconds=ways.seconds, values=centre + ways.values)

    def movement(
        self,
        name: str,
        kind: MovementKind,
        duration_s: float,
        *,
        trunk: Callable[[FloatArray], FloatArray],
        others: Callable[[FloatArray], FloatArray],
        internal_force_N: float,
        rng: np.random.Generator,
        steps: Steps | None = None,
    ) -> Movement:
        """Let the legs follow the trunk, and the ground bear the robot.

        Args:
            name: What it is called.
            kind: What it is good for.
            duration_s: How long it takes; s.
            trunk: From instants (n,) in s to the trunk's way from its rest in `CARRIAGE_JOINTS`; (n, 6); m, rad.
            others: From instants (n,) in s to positions of all joints but those of the legs; (n, j); rad or m.
            internal_force_N: Force along each axis with which the feet push against each other, at most; N; moments
                go with it by a lever of 0.1 m.
            rng: Source of these pushes.
            steps: What the feet do; both stay where they stand if None.

        Returns:
            The movement; both feet are its touches, and the trunk, which is carried, bears nothing.

        Raises:
            RobotError: If a foot is out of reach, or a joint beyond its limits.
            ShapeError: If the force is negative.
        """
        pushes = internal_pushes(self.feet, internal_force_N, duration_s=duration_s, rng=rng)
        # some samples more at either end, where splines are poor
        at = np.arange(-_SPARE_SAMPLES, round(duration_s * _SAMPLES_HZ) + _SPARE_SAMPLES + 1) / _SAMPLES_HZ
        carried = Spline(names=CARRIAGE_JOINTS, seconds=at, values=trunk(at))
        postures = self._postures(carried(at), others(at), at=at, steps=steps)
        joints = Spline(names=self.stand.joints, seconds=at, values=postures)
        self._require_limits(name, joints)
        unloaded = Movement(
            name=name,
            kind=kind,
            model=self.stand.model,
            support=self.legs.trunk,
            world_H_support=self.world_H_trunk,
            duration_s=duration_s,
            trajectory=joints.motion,
            carriage=Carriage(displacement=carried.motion),
            gravity=self.stand.gravity,
        )
        shares = _both if steps is None else steps.shares
        return FootLoads(unloaded=unloaded, feet=self.feet, shares=shares, pushes=pushes).borne()

    def _straight(self) -> FloatArray:
        """Posture with straight legs, or what the stand's posture says of them; shape (j,)."""
        posture = self.stand.rest.copy()
        legs = (*self.legs.support, *self.legs.swing)
        posture[self.stand.columns(legs)] = [self.stand.posture.get(joint, 0.0) for joint in legs]
        return posture

    def _postures(
        self, trunk: FloatArray, others: FloatArray, *, at: FloatArray, steps: Steps | None = None
    ) -> FloatArray:
        """Positions of all free joints with which the feet are where the steps want them; shape (n, j)."""
        trunk_H_world = invert_pose(_carried(trunk, self.world_H_trunk))
        shifts = np.zeros((2, len(at), 6)) if steps is None else steps.displacements(at)
        lifts = np.zeros((len(at), 2)) if steps is None else steps.lifts(at)
        posture = np.empty((len(at), len(self.stand.joints)))
        posture[:, self.stand.columns(self.legs.others)] = others
        straight = self._straight()
        for foot, joints, world_H_foot, shift, lift in zip(
            self.feet, (self.legs.support, self.legs.swing), self.world_H_feet, shifts, lifts.T, strict=True
        ):
            columns = self.stand.columns(joints)
            middle = np.array([self.stand.range_of(joint) for joint in joints]).mean(axis=1)
            start = straight[columns] + _BENT * (middle - straight[columns])
            wanted = trunk_H_world @ _carried(shift, world_H_foot)
            leg = joints_reaching(self.tree, joints, foot, wanted, start=start)
            leg[:, _ANKLE] += _RELAXED * lift[:, None] * (middle - leg)[:, _ANKLE]
            posture[:, columns] = leg
        return posture

    def _require_limits(self, name: str, joints: Spline) -> None:
        for joint, position in zip(joints.names, joints.values.T, strict=True):
            limit = self.stand.model.joints[joint].limit
            low = -np.inf if limit is None or limit.lower is None else limit.lower
            high = np.inf if limit is None or limit.upper is None else limit.upper
            if position.min() < low or position.max() > high:
                raise RobotError(
                    f"movement {name!r}: joint {joint!r}: expected positions in its limits {low:.3f} to {high:.3f}, "
                    f"legs that follow the trunk go from {position.min():.3f} to {position.max():.3f}; move less far, "
                    "or change crouch_m"
                )


def random_placement(rng: np.random.Generator) -> FloatArray:
    """Draw places for both feet, as when they are put down anew.

    Args:
        rng: Source of the places.

    Returns:
        A `Stance.placement` of up to 2 cm forwards or back, 1.5 cm sideways and 9 degrees; shape (2, 3).
    """
    return rng.uniform(-1.0, 1.0, (2, 3)) * _REPLACED


def _placed(world_H_foot: FloatArray, gravity_direction: FloatArray, shift: FloatArray) -> FloatArray:
    """Put a foot level on the ground, and shift it there."""
    level = shortest_turn_down(world_H_foot[:3, :3] @ gravity_direction) @ world_H_foot[:3, :3]
    place = np.array([world_H_foot[0, 3] + shift[0], world_H_foot[1, 3] + shift[1], 0.0])
    return make_pose(rotation_about_z(shift[2]) @ level, place)


def _carried(displacement: FloatArray, world_H_rest: FloatArray) -> FloatArray:
    return carried_poses(JointMotion.at_rest(CARRIAGE_JOINTS, displacement), world_H_rest)


def _both(seconds: FloatArray) -> FloatArray:
    """Both feet bear all the time."""
    return np.ones((len(seconds), 2))
