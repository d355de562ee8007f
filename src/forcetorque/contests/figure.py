# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a contest: the error of every contestant over the loads, component by component, with its intervals."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.contests.ranking import ContestLoadRow
from forcetorque.results.figures import (
    ROW_INCHES,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
    two_digits,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_BESIDE = 0.012
"""By how much marks of neighbouring contestants lie apart, over the width of a panel."""


@in_figure_style
def contest_figure(rows: Sequence[ContestLoadRow]) -> Figure:
    """Draw root mean square errors over the loads that judged, with 95 % intervals.

    Args:
        rows: Errors of every contestant under every load, at least one.

    Returns:
        The figure: forces above, moments below.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no row.
    """
    if not rows:
        raise ShapeError("contest: expected at least one row to draw, got none")
    figure = new_figure(1.9 * ROW_INCHES[1])
    panels = figure.subplots(2, 3, squeeze=False, sharex=True)
    names = list(dict.fromkeys(row.contestant for row in rows))
    width = max(max(row.load_kg for row in rows) - min(row.load_kg for row in rows), 1.0)
    for j, panel in enumerate(panels.ravel()):
        for k, name in enumerate(names):
            own = [row for row in rows if row.contestant == name]
            _draw(panel, own, j, k, shift=_BESIDE * width * (k - 0.5 * (len(names) - 1)))
        panel.set(ylabel=f"{WRENCH_COMPONENTS[j]} error, {WRENCH_UNITS[j]}", yscale="log")
    for panel in panels[1]:
        panel.set_xlabel("load, kg")
    heaviest = max(row.load_kg for row in rows)
    best = min((row for row in rows if row.load_kg == heaviest), key=lambda row: float(np.linalg.norm(row.rmse[:3])))
    size = two_digits(float(np.linalg.norm(best.rmse[:3])))
    headline(figure, f"Least force error under {heaviest:g} kg: {size} N, {shown_name(best.contestant)}")
    legend_below(
        figure,
        [(shown_name(name), look(k).key) for k, name in enumerate(names)],
        title="root mean square error over the motion; bars: 95 % intervals; no contestant was fitted on these loads",
    )
    return figure


def _draw(panel: Axes, rows: Sequence[ContestLoadRow], j: int, k: int, *, shift: float) -> None:
    style = look(k)
    loads = np.array([row.load_kg for row in rows]) + shift
    panel.plot(loads, [row.rmse[j] for row in rows], linewidth=1.0, markersize=5.0, **style.key)
    for load, row in zip(loads, rows, strict=True):
        if row.rmse_low is not None and row.rmse_high is not None:
            panel.plot([load, load], [row.rmse_low[j], row.rmse_high[j]], color=style.colour, linewidth=1.4)
