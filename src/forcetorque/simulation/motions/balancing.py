# SPDX-License-Identifier: BSD-3-Clause
"""Balancing: one foot stands, the other leg moves widely, the arms with it (thesis 5.1.3)."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import ShapeError
from forcetorque.simulation.motions.legs import legs_of
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.stand import Stand
from forcetorque.simulation.motions.weight import weight_at_support

_SUPPORT_SHARE, _OTHER_SHARE = 0.2, 0.4
"""How much of their range the standing leg, and trunk and arms, use around their rest."""


def balancing_movement(
    stand: Stand,
    swing: str,
    *,
    rng: np.random.Generator,
    trunk: str | None = None,
    postures: int = 12,
    candidates: int = 50,
    hold_s: float = 0.0,
    name: str | None = None,
) -> Movement:
    """Stand on one foot and move the other leg widely.

    The standing leg's sensors then carry most of the weight, those of the other leg only what hangs
    on them: one movement is a data set for both kinds, support leg and non-support leg.

    Args:
        stand: The robot on one foot.
        swing: A link of the other foot.
        rng: Source of the postures.
        trunk: Link that both legs hang on; the last link that both feet hang on in the URDF if None.
        postures: How many postures, the rest at either end not counted.
        candidates: How many random postures each is chosen from.
        hold_s: How long to rest at each; s.
        name: Name of the movement.

    Returns:
        The movement, from rest to rest.
    """
    chosen = balancing_postures(stand, swing, rng=rng, trunk=trunk, postures=postures, candidates=candidates)
    trajectory = stand.through(np.vstack([stand.rest, chosen, stand.rest]), hold_s=hold_s)
    title = f"balancing on {stand.support}" if name is None else name
    return stand.movement(title, MovementKind.BALANCING, trajectory, trajectory.duration_s)


def balancing_postures(
    stand: Stand, swing: str, *, rng: np.random.Generator, trunk: str | None, postures: int, candidates: int
) -> FloatArray:
    """Choose postures on one foot.

    A heuristic: the swing leg's posture is random over all of its range; of the random postures of
    the rest the one is taken whose weight is nearest to above the support. The foot may still have
    to pull on the ground, as if it were bolted to it.

    Args:
        stand: The robot on one foot.
        swing: A link of the other foot.
        rng: Source of the postures.
        trunk: Link that both legs hang on, as in `balancing_movement`.
        postures: How many postures.
        candidates: How many random postures each is chosen from.

    Returns:
        Postures of all free joints; shape (postures, j); rad or m.

    Raises:
        ShapeError: If there are no postures or no candidates.
    """
    if postures < 1 or candidates < 1:
        raise ShapeError(f"expected at least one posture and candidate, got {postures} and {candidates}")
    legs = legs_of(stand, swing, trunk=trunk)
    drawn = np.tile(stand.rest, (postures, candidates, 1))
    # the sine puts more of the postures near the ends of the range
    wide = 0.5 - 0.5 * np.cos(np.pi * rng.uniform(size=(postures, 1, len(legs.swing))))
    low, high = stand.around_rest(legs.swing, 1.0)
    drawn[:, :, stand.columns(legs.swing)] = low + (high - low) * wide
    for joints, share in ((legs.support, _SUPPORT_SHARE), (legs.others, _OTHER_SHARE)):
        low, high = stand.around_rest(joints, share)
        drawn[:, :, stand.columns(joints)] = rng.uniform(low, high, (postures, candidates, len(joints)))
    wrench = weight_at_support(stand, drawn.reshape(-1, len(stand.joints))).reshape(postures, candidates, 6)
    # the moment about the support's origin is the weight times the level way to the centre of mass
    lever = np.linalg.norm(wrench[:, :, 3:], axis=2)
    best: FloatArray = drawn[np.arange(postures), lever.argmin(axis=1)]
    return best
