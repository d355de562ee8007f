# SPDX-License-Identifier: BSD-3-Clause
"""The balancing controller above the torque loops, and the sequence of supports that the robot follows."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import cross, invert_pose, make_pose
from forcetorque.base.toml_file import NotNegative, Positive, Table
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import centre_of_mass
from forcetorque.locomotion.torque_control.biped_in_mujoco import JOINTS, LEGS, SOLE_CENTRE, SOLES, Biped, Posture
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.simulation.motions.inverse_kinematics import joints_reaching
from forcetorque.simulation.motions.trajectories import minimum_jerk

_CROUCH_M: Final = 0.03
"""How much lower the pelvis stands than with straight legs; m."""
_KNEE_RAD: Final = -0.4
"""Where the search for a leg's posture starts, so that knees bend forwards; rad."""
_ROUNDS: Final = 6
"""Corrections of the pelvis until the centre of mass is where it should be; each leaves a tenth."""


class Phase(StrEnum):
    """Which feet bear."""

    DOUBLE = "double"
    LEFT = "left"
    RIGHT = "right"


class Timing(Table):
    """How long the robot stands on both feet, the left, both, the right, both."""

    hold_s: Positive = 0.5
    """Standing on both feet, each time; s."""
    shift_s: Positive = 0.8
    """Moving the weight; s."""
    single_s: Positive = 1.0
    """Standing on one foot, while the other is lifted and put down; s."""
    lift_m: NotNegative = 0.03
    """How high; m."""

    @property
    def duration_s(self) -> float:
        """All phases together; s."""
        return 3.0 * self.hold_s + 4.0 * self.shift_s + 2.0 * self.single_s


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reference:
    """What is wanted at n instants, one per step of the controller."""

    phases: tuple[Phase, ...]
    """Which feet bear; n of them."""
    position: FloatArray
    """Pelvis position, quaternion wxyz, joints, on soles that touch the ground; shape (n, 19); m, rad."""
    velocity: FloatArray
    """Velocities of joints; shape (n, 12); rad/s."""
    centre_of_mass: FloatArray
    """Horizontal place of the centre of mass; shape (n, 2); m."""
    centre_velocity: FloatArray
    """Its velocity; shape (n, 2); m/s."""
    centre_acceleration: FloatArray
    """Its acceleration; shape (n, 2); m/s2."""
    share: FloatArray
    """Shares of the weight on the left and the right foot; shape (n, 2)."""

    def __len__(self) -> int:
        return len(self.phases)


def switching(biped: Biped, timing: Timing, period_s: float) -> Reference:
    """Plan the motion: the centre of mass goes from above the middle to above a sole before the other foot is lifted.

    Args:
        biped: The robot.
        timing: How long everything takes.
        period_s: Time between instants; s.

    Returns:
        The reference, from standing to standing.
    """
    spans = [timing.hold_s, *2 * [timing.shift_s, timing.single_s, timing.shift_s, timing.hold_s]]
    knots = [float(end) for end in np.cumsum([0.0, *spans])]
    seconds: FloatArray = np.arange(round(timing.duration_s / period_s), dtype=np.float64) * period_s

    def moved(k: int) -> FloatArray:
        return minimum_jerk((seconds - knots[k]) / (knots[k + 1] - knots[k]))

    # +1 above the left sole, -1 above the right one
    side = moved(1) - moved(3) - moved(5) + moved(7)
    lift = timing.lift_m * np.stack([_bump(seconds, knots[6], knots[7]), _bump(seconds, knots[2], knots[3])], axis=1)
    phases = np.full(len(seconds), Phase.DOUBLE, dtype=object)
    phases[(seconds >= knots[2]) & (seconds < knots[3])] = Phase.LEFT
    phases[(seconds >= knots[6]) & (seconds < knots[7])] = Phase.RIGHT
    share = np.stack([0.5 + 0.5 * side, 0.5 - 0.5 * side], axis=1)
    return posture_reference(biped, tuple(phases), share, lift, period_s)


def standing(biped: Biped, phase: Phase, steps: int, lift_m: float, period_s: float) -> Reference:
    """Stand still, the centre of mass above what bears.

    Args:
        biped: The robot.
        phase: Which feet bear.
        steps: Number of instants, n.
        lift_m: How high the free foot is lifted; m.
        period_s: Time between instants; s.

    Returns:
        The reference.
    """
    left = {Phase.DOUBLE: 0.5, Phase.LEFT: 1.0, Phase.RIGHT: 0.0}[phase]
    lift = lift_m * np.array([[phase is Phase.RIGHT, phase is Phase.LEFT]], dtype=np.float64)
    still = posture_reference(biped, (phase,), np.array([[left, 1.0 - left]]), lift, period_s)
    return Reference(
        phases=(phase,) * steps,
        position=np.tile(still.position, (steps, 1)),
        velocity=np.zeros((steps, len(JOINTS))),
        centre_of_mass=np.tile(still.centre_of_mass, (steps, 1)),
        centre_velocity=np.zeros((steps, 2)),
        centre_acceleration=np.zeros((steps, 2)),
        share=np.tile(still.share, (steps, 1)),
    )


def posture_reference(
    biped: Biped, phases: tuple[Phase, ...], share: FloatArray, lift: FloatArray, period_s: float
) -> Reference:
    """Find postures in which the centre of mass lies between the soles as the weight is shared.

    Args:
        biped: The robot.
        phases: Which feet bear; n of them.
        share: Shares of the weight on the left and the right foot; shape (n, 2).
        lift: How high each foot is lifted; shape (n, 2); m.
        period_s: Time between instants; s.

    Returns:
        The reference.
    """
    soles, pelvis = _standing(biped)
    centres = soles[:, :2, 3] + SOLE_CENTRE
    wanted = share @ centres
    place = np.tile(pelvis, (len(share), 1))
    for _ in range(_ROUNDS):
        joints = _legs(biped, soles, place, lift)
        place[:, :2] += wanted - (place[:, :2] + centre_of_mass(biped.tree, JointMotion.at_rest(JOINTS, joints))[:, :2])
    joints = _legs(biped, soles, place, lift)
    upright = np.tile([1.0, 0.0, 0.0, 0.0], (len(share), 1))
    return Reference(
        phases=phases,
        position=np.concatenate([place, upright, joints], axis=1),
        velocity=_rate(joints, period_s),
        centre_of_mass=wanted,
        centre_velocity=_rate(wanted, period_s),
        centre_acceleration=_rate(_rate(wanted, period_s), period_s),
        share=share,
    )


def _standing(biped: Biped) -> tuple[FloatArray, FloatArray]:
    """Poses of both soles (2, 4, 4) below straight legs, level on the ground, and the place of the pelvis (3,)."""
    straight = JointMotion.at_rest(JOINTS, np.zeros((1, len(JOINTS))))
    below = np.array([link_pose(biped.tree, straight, sole)[0][:3, 3] for sole in SOLES])
    pelvis = np.array([0.0, 0.0, -below[:, 2].max() - _CROUCH_M])
    return np.array([make_pose(np.eye(3), [x, y, 0.0]) for x, y, _ in below]), pelvis


def _legs(biped: Biped, soles: FloatArray, place: FloatArray, lift: FloatArray) -> FloatArray:
    """Positions of all joints (n, 12) with which the soles are where they should be below the pelvis."""
    world_H_pelvis = np.tile(np.eye(4), (len(place), 1, 1))
    world_H_pelvis[:, :3, 3] = place
    start = [0.2, 0.0, 0.0, _KNEE_RAD, 0.2, 0.0]
    legs = []
    for leg, sole, world_H_sole, height in zip(LEGS, SOLES, soles, lift.T, strict=True):
        lifted = np.tile(world_H_sole, (len(place), 1, 1))
        lifted[:, 2, 3] += height
        legs.append(joints_reaching(biped.tree, leg, sole, invert_pose(world_H_pelvis) @ lifted, start=start))
    return np.concatenate(legs, axis=1)


def _bump(seconds: FloatArray, start: float, end: float) -> FloatArray:
    """Up and down between two instants, 0 outside; it stays up for the middle third."""
    third = (end - start) / 3.0
    return minimum_jerk((seconds - start) / third) - minimum_jerk((seconds - end + third) / third)


def _rate(values: FloatArray, period_s: float) -> FloatArray:
    if len(values) < 2:
        return np.zeros_like(values)
    return np.gradient(values, period_s, axis=0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Balance:
    """Gains of the balancing controller."""

    mass: float
    """Mass of the robot; kg."""
    centre_stiffness: float
    """K_c; N/m."""
    centre_damping: float
    """D_c; N s/m."""
    posture_stiffness: float
    """K_q of every joint; N m/rad."""
    posture_damping: float
    """D_q of every joint; N m s/rad."""

    def desired(self, posture: Posture, reference: Reference, k: int) -> FloatArray:
        """Give the torques that are wanted.

        Args:
            posture: What the copies do.
            reference: What they should do.
            k: Instant of the reference.

        Returns:
            tau_d; shape (B, 12); N m.
        """
        wrench = self.sole_wrenches(posture, reference, k)
        borne = np.einsum("bscv,bsc->bv", posture.sole_jacobian, wrench)[:, 6:]
        pull = self.posture_stiffness * (reference.position[k, 7:] - posture.position[:, 7:])
        pull += self.posture_damping * (reference.velocity[k] - posture.velocity[:, 6:])
        return posture.bias[:, 6:] - borne + pull

    def sole_wrenches(self, posture: Posture, reference: Reference, k: int) -> FloatArray:
        """Give what the ground is to do to each sole.

        Args:
            posture: What the copies do.
            reference: What they should do.
            k: Instant of the reference.

        Returns:
            Wrenches along the axes of the world, about the origins of the soles; shape (B, 2, 6); N, N m.
        """
        force = self._force(posture, reference, k)
        middle = np.array([*SOLE_CENTRE, 0.0])
        share = reference.share[k]
        lever = posture.centre_of_mass - np.tensordot(posture.sole_position, share, axes=([1], [0])) - middle
        moment = cross(lever, force) + cross(np.broadcast_to(middle, force.shape), force)
        return share[:, None] * np.concatenate([force, moment], axis=1)[:, None]

    def _force(self, posture: Posture, reference: Reference, k: int) -> FloatArray:
        """What the ground is to do to the robot; shape (B, 3)."""
        centre_velocity = np.einsum("bcv,bv->bc", posture.centre_jacobian, posture.velocity)
        force = np.zeros_like(posture.centre_of_mass)
        force[:, :2] = self.centre_stiffness * (reference.centre_of_mass[k] - posture.centre_of_mass[:, :2])
        force[:, :2] += self.centre_damping * (reference.centre_velocity[k] - centre_velocity[:, :2])
        force[:, :2] += self.mass * reference.centre_acceleration[k]
        force[:, 2] = self.mass * STANDARD_GRAVITY
        return force
