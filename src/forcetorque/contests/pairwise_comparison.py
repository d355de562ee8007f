# SPDX-License-Identifier: BSD-3-Clause
"""Which of several contestants err less than others, by the ratio of their errors over phases and loads.

The ratio is that of root mean squares over all phases and loads, the one that the tables show. What a phase contributes
to it says how sure it is: contributions of neighbouring phases repeat each other, so a motion is cut into no more
stretches than they are worth (`evaluation.paired`). Runs with one load are pooled phase by phase first, for a wrong
matrix errs alike in each.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.noise.paired_comparison import (
    ALIKE,
    BLOCKS,
    CONFIDENCE,
    ErrorRatio,
    independent_segments,
    ratio_over,
)
from forcetorque.contests.phases import Trial

FAMILY_ERROR = 0.05
"""Share of contests in which any pair may be ranked, or called no different, wrongly: shared by all pairs."""

Quantity = Literal["wrench", "force", "moment"]
QUANTITIES: tuple[Quantity, ...] = ("wrench", "force", "moment")

_LEAST = 1e-12
"""Share of the largest square below which a square counts as this share: none may divide by nothing."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Parts:
    """Squared errors of one contestant at q phases that all runs have, runs with one load pooled."""

    squares: FloatArray
    """By load and phase; shape (loads, q, 6); N2, N2 m2."""

    @classmethod
    def of(cls, loads: Mapping[float, Sequence[Trial]], common: BoolArray) -> Parts:
        """Pool runs.

        Args:
            loads: Runs by load.
            common: Phases that all runs of all contestants have; shape (p,).

        Returns:
            Mean squares of the runs with each load.
        """
        return cls(
            squares=np.stack(
                [np.mean([trial.error[common] ** 2 for trial in trials], axis=0) for trials in loads.values()]
            )
        )

    def norms(self, quantity: Quantity, scale: tuple[float, float]) -> FloatArray:
        """Give squared norms.

        Args:
            quantity: Of the force, of the moment, or of both over the loads that were judged.
            scale: Root mean square force and moment that were judged; N, N m.

        Returns:
            By load and phase; shape (loads, q); N2, N2 m2, or 1.
        """
        force, moment = self.squares[..., :3].sum(axis=-1), self.squares[..., 3:].sum(axis=-1)
        wrench: FloatArray = force / scale[0] ** 2 + moment / scale[1] ** 2
        return {"wrench": wrench, "force": force, "moment": moment}[quantity]


@dataclass(frozen=True, slots=True, kw_only=True)
class RatedPair:
    """Two contestants."""

    first: str
    """Name of one."""
    second: str
    """Name of the other."""
    quantity: Quantity
    """What the errors are of; `wrench` is force and moment over the judged loads, together."""
    ratio: ErrorRatio
    """Error of the first over that of the second, with an interval that holds for all pairs of a quantity at once."""


def rated_pairs(contestants: Mapping[str, Parts], *, scale: tuple[float, float]) -> list[RatedPair]:
    """Compare every contestant with every other.

    The intervals of all pairs of one quantity hold together with 95 % (Bonferroni), so that of contests without a
    difference at most 5 % rank anybody, and of contests without equals at most 5 % call anybody equal.

    Args:
        contestants: Squared errors by name, at least two, at the same phases and loads.
        scale: Root mean square force and moment that were judged; N, N m.

    Returns:
        Every pair for every quantity.
    """
    names = list(contestants)
    confidence = 1.0 - FAMILY_ERROR / math.comb(len(names), 2)
    return [
        RatedPair(
            first=one,
            second=other,
            quantity=quantity,
            ratio=_settled(
                _ratio(contestants[one].norms(quantity, scale), contestants[other].norms(quantity, scale), confidence)
            ),
        )
        for quantity in QUANTITIES
        for one, other in combinations(names, 2)
    ]


def _ratio(first: FloatArray, second: FloatArray, confidence: float) -> ErrorRatio:
    least = _LEAST * max(float(first.max()), float(second.max()))
    if least == 0.0 or np.array_equal(first, second):
        return ErrorRatio(ratio=1.0, low=1.0, high=1.0, stretches=len(first), judgement="no difference")
    one, other = np.maximum(first, least), np.maximum(second, least)
    pooled = 0.5 * math.log(one.mean() / other.mean())
    # derivative of the log ratio of root mean squares by what a phase adds to either; its mean is zero
    return _over(pooled + 0.5 * (one / one.mean() - other / other.mean()), pooled, confidence)


def _settled(ratio: ErrorRatio) -> ErrorRatio:
    """Call equal what differs surely, but by less than any use would see: nobody should be ranked by it."""
    alike = ALIKE[0] <= ratio.low and ratio.high <= ALIKE[1]
    return replace(ratio, judgement="no difference") if alike else ratio


def _over(contributions: FloatArray, pooled: float, confidence: float) -> ErrorRatio:
    """Ratio of what phases contribute; shape (loads, q)."""
    stretches, errors = [], []
    for row in contributions:
        count, error = independent_segments(_averaged(row, BLOCKS))
        stretches.append(_averaged(row, count))
        errors.append(error)
    return ratio_over(stretches, errors, pooled=pooled, confidence=confidence)


def _averaged(row: FloatArray, count: int) -> FloatArray:
    return np.array([piece.mean() for piece in np.array_split(row, min(count, len(row)))])


def rms_intervals(squares: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give root mean squares over phases with 95 % intervals.

    Args:
        squares: Squared errors at the phases of one load; shape (q, 6).

    Returns:
        Root mean squares, lower and upper ends; shape (6,) each; infinite where too few stretches tell none.
    """
    rows = []
    for column in squares.T:
        mean = max(float(column.mean()), _LEAST)
        log = 0.5 * math.log(mean)
        ratio = _over(log + 0.5 * (column[None] / mean - 1.0), log, CONFIDENCE)
        rows.append((math.sqrt(mean), ratio.low, ratio.high))
    rms, low, high = np.array(rows).T
    return rms, low, high


@dataclass(frozen=True, slots=True, kw_only=True)
class Standing:
    """Who stands before whom."""

    places: Mapping[str, tuple[int, int, int]]
    """Ranks from 1 by name, by wrench, force and moment: one more than those that err less beyond doubt."""
    winner: str | None
    """The one whose wrench errs less than that of every other; none where nobody's does."""

    @classmethod
    def of(cls, names: Sequence[str], pairs: Sequence[RatedPair]) -> Standing:
        """Rank contestants.

        Args:
            names: The contestants.
            pairs: All pairs.

        Returns:
            Their ranks; those that cannot be told apart may share one.
        """
        ranked = [pair for pair in pairs if pair.ratio.judgement in ("better", "worse")]
        lost = [(p.quantity, p.second if p.ratio.judgement == "better" else p.first) for p in ranked]
        won = [p.first if p.ratio.judgement == "better" else p.second for p in ranked if p.quantity == "wrench"]
        places = {name: tuple(1 + lost.count((quantity, name)) for quantity in QUANTITIES) for name in names}
        return cls(
            places={name: (wrench, force, moment) for name, (wrench, force, moment) in places.items()},
            winner=next((name for name in names if won.count(name) == len(names) - 1), None),
        )
