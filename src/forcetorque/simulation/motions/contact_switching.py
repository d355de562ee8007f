# SPDX-License-Identifier: BSD-3-Clause
"""Contact switching: the weight goes from foot to foot, and the foot that is free moves."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import ShapeError
from forcetorque.estimation import Contact, ContactType
from forcetorque.robot import JointMotion, link_pose
from forcetorque.simulation.motions.balancing import balancing_postures
from forcetorque.simulation.motions.movement import Movement, MovementKind, Touch
from forcetorque.simulation.motions.stand import Stand
from forcetorque.simulation.motions.waypoints import minimum_jerk
from forcetorque.simulation.motions.weight import weight_at_support
from forcetorque.spatial import invert_pose, transform_wrench


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ShiftedWeight:
    """A wrench that goes from one share of a still wrench to another, by minimum jerk."""

    wrench: FloatArray
    """The whole; shape (6,); N, N m."""
    start: float
    """Share before."""
    end: float
    """Share after."""
    duration_s: float
    """How long the change takes; s."""

    def __call__(self, seconds: FloatArray) -> FloatArray:
        """Give the wrench.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            The wrench; shape (n, 6); N, N m.
        """
        share = self.start + (self.end - self.start) * minimum_jerk(seconds / self.duration_s)
        return share[:, None] * self.wrench


def contact_switching_movements(
    stand: Stand,
    other: str,
    *,
    rng: np.random.Generator,
    trunk: str | None = None,
    steps: int = 2,
    shift_s: float = 2.0,
    postures: int = 3,
    candidates: int = 50,
) -> tuple[Movement, ...]:
    """Stand on both feet, on one, on both, on the other, and so on, ending on both.

    While both feet stand all joints hold still, so that both feet do, and the other foot's share of
    the weight changes from what it was to nothing or all; it comes as a known touch. A simplification:
    each foot bears its share of the whole wrench of the weight, moment included, so the pressure of
    each stays below the centre of mass, be that under its sole or not. Joint motions and readings
    are continuous from each movement to the next.

    Args:
        stand: The robot on the foot that stands first; at rest it stands on both.
        other: Link of the other foot, whose frame the touch is in.
        rng: Source of the postures on one foot.
        trunk: Link that both legs hang on; the last link that both feet hang on in the URDF if None.
        steps: How often the robot stands on one foot.
        shift_s: How long a shift of the weight takes; s.
        postures: How many postures on one foot each time.
        candidates: How many random postures each is chosen from.

    Returns:
        The movements in turn, `2 * steps + 1` of them, in one common world; each counts its own seconds from 0.

    Raises:
        ShapeError: If there is no step, or a shift takes no time.
    """
    if steps < 1 or not 0.0 < shift_s < np.inf:
        raise ShapeError(f"expected at least one step and a positive shift_s, got {steps} and {shift_s}")
    feet = _both_feet(stand, other)
    movements = []
    share = 0.5  # of the foot that will be free
    for step in range(steps):
        (here, world_H_here), (there, _) = feet[step % 2], feet[(step + 1) % 2]
        movements.append(_shift(here, world_H_here, there, (share, 0.0), shift_s, number=step))
        chosen = balancing_postures(here, there.support, rng=rng, trunk=trunk, postures=postures, candidates=candidates)
        trajectory = here.through(np.vstack([here.rest, chosen, here.rest]))
        title = f"{step + 1} on {here.support}"
        movements.append(
            here.movement(
                title,
                MovementKind.CONTACT_SWITCHING,
                trajectory,
                trajectory.duration_s,
                world_H_support=world_H_here,
            )
        )
        share = 1.0
    (here, world_H_here), (there, _) = feet[(steps - 1) % 2], feet[steps % 2]
    movements.append(_shift(here, world_H_here, there, (0.0, 0.5), shift_s, number=steps))
    return tuple(movements)


def _both_feet(stand: Stand, other: str) -> tuple[tuple[Stand, FloatArray], tuple[Stand, FloatArray]]:
    """The robot on either foot, and the pose of that foot in one world."""
    at_rest = JointMotion.at_rest(stand.joints, stand.rest[None])
    support_H_other = link_pose(stand.tree, at_rest, other)[0]
    on_other = replace(stand, support=other, gravity_direction=support_H_other[:3, :3].T @ stand.gravity_direction)
    return (stand, stand.world_H_support), (on_other, stand.world_H_support @ support_H_other)


def _shift(
    here: Stand, world_H_here: FloatArray, there: Stand, shares: tuple[float, float], shift_s: float, *, number: int
) -> Movement:
    """Hold still on one foot while the other's share of the weight changes."""
    still = here.through(here.rest[None])
    whole = weight_at_support(here, here.rest[None])[0]
    at_rest = JointMotion.at_rest(here.joints, here.rest[None])
    there_H_here = invert_pose(link_pose(here.tree, at_rest, there.support)[0])
    weight = ShiftedWeight(
        wrench=transform_wrench(there_H_here, whole), start=shares[0], end=shares[1], duration_s=shift_s
    )
    touch = Touch(Contact(link=there.support, type=ContactType.KNOWN), weight)
    title = f"{number} on both, {here.support} and {there.support}"
    return here.movement(
        title,
        MovementKind.CONTACT_SWITCHING,
        still,
        shift_s,
        external=(touch,),
        world_H_support=world_H_here,
    )
