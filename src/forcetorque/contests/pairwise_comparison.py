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
from itertools import combinations
from typing import Annotated, Literal

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.noise.paired_comparison import (
    ALIKE,
    BLOCKS,
    CONFIDENCE,
    Conclusion,
    ErrorRatio,
    independent_segments,
    ratio_over,
)
from forcetorque.contests.phases import Trial
from forcetorque.results.table import Row, Shown

FAMILY_ERROR = 0.05
"""Share of contests in which any pair may be ranked, or called no different, wrongly: shared by all pairs."""

Quantity = Literal["wrench", "force", "moment"]
QUANTITIES: tuple[Quantity, ...] = ("wrench", "force", "moment")

_LEAST = 1e-12
"""Share of the largest square below which a square counts as this share: none may divide by nothing."""


class ContestPairRow(Row):
    """Two contestants."""

    contestant: Annotated[str, Shown("contestant")]
    """One."""
    other: Annotated[str, Shown("against")]
    """The other."""
    error_of: Annotated[str, Shown("error of")]
    """`wrench` (force and moment over the loads, together), `force` or `moment`."""
    ratio: Annotated[float, Shown("ratio", digits=2)]
    """Root mean square error of the one over that of the other."""
    ratio_low: Annotated[float | None, Shown("at least", digits=2)]
    """Lower end of an interval that holds for all pairs at once with 95 %."""
    ratio_high: Annotated[float | None, Shown("at most", digits=2)]
    """Upper end."""
    segments: Annotated[int, Shown("segments")]
    """Independent stretches of the motion that the interval comes from, of all loads."""
    conclusion: Annotated[Conclusion, Shown("conclusion")]
    """What the interval says of the one."""


def mean_squares(loads: Mapping[float, Sequence[Trial]], common: BoolArray) -> FloatArray:
    """Average the squared errors of the runs with each load.

    Args:
        loads: Runs of one contestant by load.
        common: Phases that all runs of all contestants have; shape (p,).

    Returns:
        Mean squares by load and phase, q phases in common; shape (loads, q, 6); N2, N2 m2.
    """
    return np.stack([np.mean([trial.error[common] ** 2 for trial in trials], axis=0) for trials in loads.values()])


def squared_norms(squares: FloatArray, quantity: Quantity, scale: tuple[float, float]) -> FloatArray:
    """Sum squared errors over the components of a quantity.

    Args:
        squares: Squared errors by `mean_squares`; shape (loads, q, 6); N2, N2 m2.
        quantity: Of the force, of the moment, or of both over the validation loads.
        scale: Root mean square force and moment of the validation loads; N, N m.

    Returns:
        By load and phase; shape (loads, q); N2, N2 m2, or 1.
    """
    force, moment = squares[..., :3].sum(axis=-1), squares[..., 3:].sum(axis=-1)
    wrench: FloatArray = force / scale[0] ** 2 + moment / scale[1] ** 2
    return {"wrench": wrench, "force": force, "moment": moment}[quantity]


def compared_pairs(contestants: Mapping[str, FloatArray], *, scale: tuple[float, float]) -> list[ContestPairRow]:
    """Compare every contestant with every other.

    The intervals of all pairs of one quantity hold together with 95 % (Bonferroni), so that of contests without a
    difference at most 5 % rank any pair, and of contests without equals at most 5 % call any pair equal.

    Args:
        contestants: Squared errors by `mean_squares` and by name, at least two, at the same phases and loads.
        scale: Root mean square force and moment of the validation loads; N, N m.

    Returns:
        Every pair for every quantity.
    """
    confidence = 1.0 - FAMILY_ERROR / math.comb(len(contestants), 2)
    pairs = []
    for quantity in QUANTITIES:
        for one, other in combinations(contestants, 2):
            ratio = _ratio(
                squared_norms(contestants[one], quantity, scale),
                squared_norms(contestants[other], quantity, scale),
                confidence,
            )
            known = math.isfinite(ratio.high)
            pairs.append(
                ContestPairRow(
                    contestant=one,
                    other=other,
                    error_of=quantity,
                    ratio=ratio.ratio,
                    ratio_low=ratio.low if known else None,
                    ratio_high=ratio.high if known else None,
                    segments=ratio.segments,
                    # a certain difference too small for any application ranks no pair
                    conclusion=(
                        "no difference" if ALIKE[0] <= ratio.low and ratio.high <= ALIKE[1] else ratio.conclusion
                    ),
                )
            )
    return pairs


def _ratio(first: FloatArray, second: FloatArray, confidence: float) -> ErrorRatio:
    least = _LEAST * max(float(first.max()), float(second.max()))
    if least == 0.0 or np.array_equal(first, second):
        return ErrorRatio(ratio=1.0, low=1.0, high=1.0, segments=len(first), conclusion="no difference")
    one, other = np.maximum(first, least), np.maximum(second, least)
    pooled = 0.5 * math.log(one.mean() / other.mean())
    # derivative of the log ratio of root mean squares by what a phase adds to either; its mean is zero
    return _over(pooled + 0.5 * (one / one.mean() - other / other.mean()), pooled, confidence)


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
        Root mean squares, lower and upper ends; shape (6,) each; infinite where there are too few segments.
    """
    rows = []
    for column in squares.T:
        mean = max(float(column.mean()), _LEAST)
        log = 0.5 * math.log(mean)
        ratio = _over(log + 0.5 * (column[None] / mean - 1.0), log, CONFIDENCE)
        rows.append((math.sqrt(mean), ratio.low, ratio.high))
    rms, low, high = np.array(rows).T
    return rms, low, high


def ranks_and_winner(
    names: Sequence[str], pairs: Sequence[ContestPairRow]
) -> tuple[dict[str, tuple[int, int, int]], str | None]:
    """Rank contestants.

    Args:
        names: The contestants.
        pairs: All pairs.

    Returns:
        Ranks from 1 by name, by wrench, force and moment: one more than the number of contestants with significantly
        smaller errors, so that several may share one; and the contestant whose wrench error is significantly smaller
        than that of every other, None without such a one.
    """
    ranked = [pair for pair in pairs if pair.conclusion in ("better", "worse")]
    lost = [(pair.error_of, pair.other if pair.conclusion == "better" else pair.contestant) for pair in ranked]
    won = [
        pair.contestant if pair.conclusion == "better" else pair.other for pair in ranked if pair.error_of == "wrench"
    ]
    wrench, force, moment = ({name: 1 + lost.count((quantity, name)) for name in names} for quantity in QUANTITIES)
    return (
        {name: (wrench[name], force[name], moment[name]) for name in names},
        next((name for name in names if won.count(name) == len(names) - 1), None),
    )
