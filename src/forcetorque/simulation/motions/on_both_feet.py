# SPDX-License-Identifier: BSD-3-Clause
"""Movements on both feet: standing still, sway, squats, and steps on the spot."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.simulation.motions.inverse_kinematics import CARRIAGE_JOINTS
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.stance import Stance, Steps
from forcetorque.simulation.motions.trajectories import Spline

_REACH_M = 0.03
_TURN_RAD = 0.09
"""How far the trunk goes along, and turns about, each axis at most, either way, as a rule; 5 degrees."""
_VERTICAL = 0.5
"""Way up and down as a part of the ways along the ground: legs are nearly straight, and ankles near their limits."""
_DEPTH = 2.0 / 3.0
"""Way of a squat up and down from the middle, as a part of the reach; the other ways are a third of it."""
INTERNAL_FORCE_N = 15.0
"""How much the feet push against each other along each axis at most, as a rule."""
_PERIOD_S = 2.0
"""Time from target to target of trunk and arms."""
_OTHERS_SHARE = 0.4
"""Share of their range that joints of trunk and arms use at most."""
_LEAN = 0.6
"""How far the trunk goes towards the foot that bears, as a share of the way to it."""


def standing_movement(
    stance: Stance,
    *,
    rng: np.random.Generator,
    duration_s: float,
    internal_force_N: float = INTERNAL_FORCE_N,
    name: str = "standing",
) -> Movement:
    """Stand still on both feet, which push against each other.

    Args:
        stance: The robot on both feet.
        rng: Source of the pushes.
        duration_s: How long it takes; s.
        internal_force_N: How much the feet push against each other along each axis at most; N.
        name: Name of the movement.

    Returns:
        The movement; what touches the feet is in `external`.
    """
    still = _others(stance, duration_s, rng, share=0.0)

    def trunk(seconds: FloatArray) -> FloatArray:
        return np.zeros((len(seconds), len(CARRIAGE_JOINTS)))

    return stance.movement(
        name,
        MovementKind.STANDING,
        duration_s,
        trunk=trunk,
        others=still,
        internal_force_N=internal_force_N,
        rng=rng,
    )


def sway_movement(
    stance: Stance,
    *,
    rng: np.random.Generator,
    duration_s: float,
    reach_m: float = _REACH_M,
    internal_force_N: float = INTERNAL_FORCE_N,
    name: str = "sway",
) -> Movement:
    """Move and turn the trunk about all axes towards a new target every 2 s, and the arms with it.

    Args:
        stance: The robot on both feet.
        rng: Source of targets and pushes.
        duration_s: How long it takes; s.
        reach_m: How far the trunk goes along each axis at most; m.
        internal_force_N: How much the feet push against each other along each axis at most; N.
        name: Name of the movement.

    Returns:
        The movement; it neither starts nor ends at rest.
    """
    return stance.movement(
        name,
        MovementKind.SWAY,
        duration_s,
        trunk=_trunk(reach_m, _TURN_RAD, duration_s, rng),
        others=_others(stance, duration_s, rng),
        internal_force_N=internal_force_N,
        rng=rng,
    )


def squat_movement(
    stance: Stance,
    *,
    rng: np.random.Generator,
    duration_s: float,
    reach_m: float = _REACH_M,
    internal_force_N: float = INTERNAL_FORCE_N,
    period_s: float = 2.0 * _PERIOD_S,
    name: str = "squat",
) -> Movement:
    """Move the trunk down and up, a third of the turns and of the way in the other directions aside.

    Args:
        stance: The robot on both feet.
        rng: Source of targets and pushes.
        duration_s: How long it takes; s.
        reach_m: How far the trunk goes down and up from its rest; m.
        internal_force_N: How much the feet push against each other along each axis at most; N.
        period_s: Time of a squat; s.
        name: Name of the movement.

    Returns:
        The movement; it neither starts nor ends at rest.
    """
    aside = _trunk(reach_m / 3.0, _TURN_RAD / 3.0, duration_s, rng)

    def trunk(seconds: FloatArray) -> FloatArray:
        way = aside(seconds)
        way[:, 2] = _DEPTH * reach_m * np.cos(2.0 * np.pi / period_s * seconds)
        return way

    return stance.movement(
        name,
        MovementKind.SQUAT,
        duration_s,
        trunk=trunk,
        others=_others(stance, duration_s, rng),
        internal_force_N=internal_force_N,
        rng=rng,
    )


def stepping_movement(
    stance: Stance,
    *,
    rng: np.random.Generator,
    duration_s: float,
    reach_m: float = _REACH_M / 2.0,
    internal_force_N: float = INTERNAL_FORCE_N,
    cycle_s: float = 4.0,
    name: str = "stepping",
) -> Movement:
    """Lift the feet in turn, swing each freely and put it down where it stood; the trunk sways all the while.

    A foot hands its load over, smoothly, before it leaves the ground. Where one foot bears all, the pressure is
    below the robot's weight, be that under its sole or not: it may have to pull as if it were bolted to the ground.

    Args:
        stance: The robot on both feet.
        rng: Source of targets, steps and pushes.
        duration_s: How long it takes; s.
        reach_m: How far the trunk goes along each axis at most, beside its leaning over the foot that bears; m.
        internal_force_N: How much the feet push against each other along each axis at most; N.
        cycle_s: Time in which each foot is lifted once; s.
        name: Name of the movement.

    Returns:
        The movement; both feet are in `external`, with a wrench of zero in the air.
    """
    steps = Steps.draw(cycle_s=cycle_s, duration_s=duration_s, rng=rng)
    aside = _trunk(reach_m, _TURN_RAD, duration_s, rng)
    first, second = stance.world_H_feet[:, :2, 3]

    def trunk(seconds: FloatArray) -> FloatArray:
        way = aside(seconds)
        way[:, :2] += _LEAN * steps.lean(seconds)[:, None] * (0.5 * (second - first))
        return way

    return stance.movement(
        name,
        MovementKind.STEPPING,
        duration_s,
        trunk=trunk,
        others=_others(stance, duration_s, rng),
        internal_force_N=internal_force_N,
        rng=rng,
        steps=steps,
    )


def _trunk(reach_m: float, turn_rad: float, duration_s: float, rng: np.random.Generator) -> Spline:
    reach = [reach_m, reach_m, _VERTICAL * reach_m, turn_rad, turn_rad, turn_rad]
    return Spline.towards_targets(CARRIAGE_JOINTS, reach, duration_s=duration_s, period_s=_PERIOD_S, rng=rng)


def _others(stance: Stance, duration_s: float, rng: np.random.Generator, share: float = _OTHERS_SHARE) -> Spline:
    return stance.others_moving(share=share, duration_s=duration_s, period_s=_PERIOD_S, rng=rng)
