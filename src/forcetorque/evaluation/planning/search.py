# SPDX-License-Identifier: BSD-3-Clause
"""From picked postures to the best motion: postures changed one by one, by the exact worth of the whole motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, Protocol, TypeVar

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.posterior import Posterior
from forcetorque.evaluation.planning.criterion import Aim
from forcetorque.evaluation.planning.picking import Choices, pick

HASTES: Final = (1.0, 0.5, 0.0)
"""Powers of the time by which gains are divided, from the most per second to the most per posture: all are tried."""


class Motion(Protocol):
    """A motion through postures that was judged as a whole."""

    @property
    def postures(self) -> FloatArray:
        """Postures in turn; shape (k, j)."""
        ...

    @property
    def duration_s(self) -> float:
        """How long it takes; s."""
        ...

    @property
    def value(self) -> float:
        """What is to be lowered."""
        ...


M = TypeVar("M", bound=Motion)


def search(
    through: Callable[[FloatArray], M],
    drawn: FloatArray,
    orders: Sequence[FloatArray],
    *,
    seconds: float,
    swaps: int,
    rng: np.random.Generator,
) -> M:
    """Find a motion that is worth much.

    Args:
        through: From postures in turn to the motion through them.
        drawn: Postures that may be taken; shape (n, j).
        orders: Motions to begin from, as postures in turn.
        seconds: How long it may take; s. Only where no motion to begin from is as short may the answer be longer.
        swaps: Changes that are tried.
        rng: Source of the changes.

    Returns:
        The best of all that was tried.
    """
    best = min(map(through, orders), key=lambda motion: (motion.duration_s > seconds, motion.value))
    for _ in range(swaps):
        other = through(_changed(best.postures, drawn, rng))
        if other.duration_s <= seconds and other.value < best.value:
            best = other
    return best


def picked_orders(posterior: Posterior, aim: Aim, choices: Choices, drawn: FloatArray) -> list[FloatArray]:
    """Pick postures greedily, in haste and without.

    Args:
        posterior: What is known of the sensor.
        aim: What to lower.
        choices: The postures.
        drawn: The same as positions of joints; shape (n, j).

    Returns:
        Postures in turn, for each of `HASTES`.
    """
    return [drawn[pick(posterior, aim, choices, haste=haste)] for haste in HASTES]


def _changed(postures: FloatArray, drawn: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Another posture in place of one, between two, or two in another order; the ends stay."""
    last = len(postures) - 1
    new = drawn[rng.integers(1, len(drawn))]
    if last < 2 or rng.uniform() < 0.25:
        return np.insert(postures, rng.integers(1, last + 1), new, axis=0)
    changed = postures.copy()
    first, second = rng.integers(1, last, size=2)
    if first != second and rng.uniform() < 0.5:
        changed[[first, second]] = changed[[second, first]]
    else:
        changed[first] = new
    return changed
