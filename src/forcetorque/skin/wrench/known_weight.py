# SPDX-License-Identifier: BSD-3-Clause
"""A known weight on a patch, put on anew several times: what calibration under an even pressure cannot show.

A cover whose material keeps its volume is softer under an object than in a chamber, and reads too much; one that loses
load at its edge reads too little. Neither shows in counts, and a weight shows both. It does not show shear, which
changes the size of a force by a few percent and its moment by far more.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import SkinError
from forcetorque.base.noise.slow_noise import half_width
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.results.table import Row, Shown

TOLERANCE: Final = 0.1
"""Share of the weight by which a patch may err and pass (a heuristic): the methods err by 2 to 10 % on a patch whose
curves hold, hysteresis by as much."""
LEAST_PLACEMENTS: Final = 3
"""Placements of which an interval is computed."""
_LEAST_FRAMES: Final = 8
"""Frames of a placement, of which the middle half is taken: a weight that is put on or taken off is no known load."""
_APART_S: Final = 1.0
"""Time without a contact from which on the weight was put on anew; s: contacts are lost for a frame or two."""
_LEAST_SHARE: Final = 0.5
"""Part of the median force of all placements below which one is another touch, as of a hand (a heuristic)."""
_SETTLED: Final = 0.05
"""Share of its final force within which a placement has settled."""

Agreement = Literal["agrees", "too much", "too little", "inconclusive"]


class PlacementRow(Row):
    """The weight, put on once."""

    from_s: Annotated[float, Shown("from", "s", digits=2)]
    """First frame with a contact; s from the start of the recording."""
    to_s: Annotated[float, Shown("to", "s", digits=2)]
    """Last one."""
    force_N: Annotated[float, Shown("force", "N", digits=2)]
    """Median norm of the force of all contacts together, over the middle half of its frames."""
    share: Annotated[float, Shown("of the weight", digits=3)]
    """The same over the weight."""
    settled_s: Annotated[float, Shown("settled after", "s", digits=2)]
    """Time until it stays within 5 % of that force up to the end of the middle half: putting it on, lag of pads."""


class KnownWeight(Row):
    """A known weight against what the patch reads of it."""

    weight_N: float
    """The weight; N."""
    placements: tuple[PlacementRow, ...]
    """Each time that it was put on."""
    left_out: tuple[PlacementRow, ...] = ()
    """Touches of less than half of the median force of all, which are not taken for the weight."""
    share: float
    """Mean force over the weight."""
    share_half_width_95: float | None
    """Half of its 95 % interval, by the scatter between placements; null of fewer than three."""
    agreement: Agreement
    """`agrees` if the interval lies within 10 % of the weight, `too much` or `too little` if beyond it."""


def known_weight(mass_kg: float, seconds: FloatArray, force_N: FloatArray, touched: BoolArray) -> KnownWeight:
    """Compare a weight that was put on a level patch with what the patch reads.

    Args:
        mass_kg: Its mass; kg.
        seconds: Times of the frames; shape (k,); s.
        force_N: Norm of the force of all contacts together; shape (k,); N.
        touched: Whether a frame has a contact; shape (k,).

    Returns:
        The comparison.

    Raises:
        SkinError: If the mass is not above zero, or it was never on the patch for long enough.
    """
    if not 0.0 < mass_kg < np.inf:
        raise SkinError(f"known weight: expected a mass above 0 kg, got {mass_kg:g}")
    weight = mass_kg * STANDARD_GRAVITY
    edges = np.flatnonzero(np.diff(np.concatenate([[False], touched, [False]])))
    spans = [np.arange(first, end) for first, end in edges.reshape(-1, 2).tolist()]
    joined: list[IntArray] = []
    for span in spans:
        if joined and seconds[span[0]] - seconds[joined[-1][-1]] < _APART_S:
            joined[-1] = np.concatenate([joined[-1], span])
        else:
            joined.append(span)
    touches = [_placement(seconds[span], force_N[span], weight) for span in joined if len(span) >= _LEAST_FRAMES]
    if not touches:
        raise SkinError(
            f"known weight: expected it on the patch for {_LEAST_FRAMES} frames or more at a time, got "
            f"{int(touched.sum())} with a contact, never so many; leave it there for some seconds, or lower --average"
        )
    least = _LEAST_SHARE * float(np.median([row.force_N for row in touches]))
    placements = tuple(row for row in touches if row.force_N >= least)
    share, half, agreement = agreement_of(np.array([row.share for row in placements]))
    return KnownWeight(
        weight_N=weight,
        placements=placements,
        left_out=tuple(row for row in touches if row.force_N < least),
        share=share,
        share_half_width_95=half,
        agreement=agreement,
    )


def agreement_of(shares: FloatArray) -> tuple[float, float | None, Agreement]:
    """Decide by placements whether what is read agrees with the weight.

    Args:
        shares: Force over the weight of each placement; shape (n,).

    Returns:
        Their mean, half of its 95 % interval, and the decision.
    """
    count, mean = len(shares), float(shares.mean())
    if count < LEAST_PLACEMENTS:
        return mean, None, "inconclusive"
    error = shares.std(ddof=1) / np.sqrt(count)
    half = float(half_width(np.array([error]), np.array([count - 1.0]))[0])
    if mean - half > 1.0 + TOLERANCE:
        return mean, half, "too much"
    if mean + half < 1.0 - TOLERANCE:
        return mean, half, "too little"
    return mean, half, "agrees" if abs(mean - 1.0) + half <= TOLERANCE else "inconclusive"


def _placement(seconds: FloatArray, force_N: FloatArray, weight_N: float) -> PlacementRow:
    quarter = len(force_N) // 4
    end = len(force_N) - quarter
    force = float(np.median(force_N[quarter:end]))
    off = np.flatnonzero(np.abs(force_N[:end] - force) > _SETTLED * force)
    settled = 0 if not len(off) else min(int(off[-1]) + 1, end - 1)
    return PlacementRow(
        from_s=float(seconds[0]),
        to_s=float(seconds[-1]),
        force_N=force,
        share=force / weight_N,
        settled_s=float(seconds[settled] - seconds[0]),
    )
