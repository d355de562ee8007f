# SPDX-License-Identifier: BSD-3-Clause
"""Figure of an acceptance: every criterion as a share of its limit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.acceptance.criteria import Criterion
from forcetorque.results.figures import (
    GRID,
    LIMIT_LINE,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
    two_digits,
)
from forcetorque.results.visual_roles import LIMIT

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.evaluation.acceptance.acceptance import Acceptance

_ROW_INCHES, _FRAME_INCHES = 0.24, 1.0
"""Height of a criterion, and of axis and margins; inch."""
_MOST = 35
"""Criteria that are drawn: those that fail or are nearest to their limits."""
_FARTHEST = 100.0
"""Times the limit, or below it, up to which shares are told apart."""
_HOLDS: dict[str, Any] = {"color": look(0).colour, "marker": look(0).marker, "linestyle": "none"}
_FAILS: dict[str, Any] = {"color": LIMIT.colour, "marker": "X", "linestyle": "none"}


@in_figure_style
def acceptance_figure(acceptance: Acceptance) -> Figure:
    """Draw how far criteria are from their limits.

    Returns:
        The figure: what was measured over its limit, and for a lower bound the limit over it, so that 1 is the limit
        and less holds; the worst on top, beside each its numbers.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no criterion.
    """
    if not acceptance.criteria:
        raise ShapeError("criteria: expected at least one to draw, got none")
    rows = sorted(acceptance.criteria, key=lambda row: row.share, reverse=True)[:_MOST]
    figure = new_figure(_FRAME_INCHES + _ROW_INCHES * max(len(rows), 6))
    panel = figure.subplots()
    low, high = (0.7 * min(0.5, *map(_drawn, rows)), 1.4 * max(2.0, *map(_drawn, rows)))
    for place, row in enumerate(rows):
        style = _HOLDS if row.passed else _FAILS
        panel.plot([low, _drawn(row)], [place, place], color=GRID, linewidth=1.2, zorder=1)
        panel.plot(_drawn(row), place, markersize=7.0, zorder=3, **style)
    panel.axvline(1.0, zorder=2, **LIMIT_LINE)
    panel.set(xscale="log", xlim=(low, high), ylim=(len(rows) - 0.5, -0.5))
    several = len({row.sensor for row in rows}) > 1
    panel.set_yticks(
        range(len(rows)), [shown_name(f"{row.sensor}: {row.criterion}" if several else row.criterion) for row in rows]
    )
    numbers = panel.secondary_yaxis("right")
    numbers.set_yticks(range(len(rows)), [_numbers(row) for row in rows])
    for axis in (panel, numbers):
        axis.tick_params(axis="y", length=0.0)
    panel.set_xlabel(f"share of the limit; what is below {1.0 / _FARTHEST:g} or above {_FARTHEST:g} is drawn there")
    failed = [row for row in rows if not row.passed]
    count = len(acceptance.criteria)
    headline(
        figure,
        f"{shown_name(acceptance.specification)}: {'accepted' if acceptance.accepted else 'NOT accepted'}, "
        f"{sum(row.passed for row in acceptance.criteria)} of {count} criteria hold"
        + (f"; farthest off: {shown_name(failed[0].criterion)}" if failed else "")
        + (f"; the {len(rows)} worst are drawn" if count > len(rows) else ""),
    )
    legend_below(figure, [("holds", _HOLDS), *([("fails", _FAILS)] if failed else []), ("limit", LIMIT_LINE)])
    return figure


def _drawn(row: Criterion) -> float:
    """Share of the limit within what the axis shows."""
    return float(np.clip(row.share, 1.0 / _FARTHEST, _FARTHEST))


def _numbers(row: Criterion) -> str:
    measured = two_digits(row.measured) if np.isfinite(row.measured) else "infinite"
    return f"{' '.join(filter(None, (measured, row.unit)))} ({row.bound} {row.limit:g})"
