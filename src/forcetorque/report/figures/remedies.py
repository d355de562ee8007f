# SPDX-License-Identifier: BSD-3-Clause
"""Figure of what a sensor would read wrongly under a load along each axis, by how it was calibrated."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.analysis.device.span_rows import DirectionRow
from forcetorque.errors import ShapeError
from forcetorque.report.figures.canvas import (
    ROW_INCHES,
    SMALL_POINTS,
    TITLE_POINTS,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.spatial import WRENCH_COMPONENTS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def remedies_figure(rows: Sequence[DirectionRow]) -> Figure:
    """Draw predicted errors by the axis that is loaded; what is not known at all is left out.

    Args:
        rows: Errors of force and moment, by what the sensor was calibrated by.

    Returns:
        The figure, a panel for each error.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is nothing to draw.
    """
    if not rows:
        raise ShapeError("remedies: expected at least one row, got none")
    figure = new_figure(1.4 * ROW_INCHES[1])
    errors = tuple(dict.fromkeys(row.error for row in rows))
    names = tuple(dict.fromkeys(row.motion for row in rows))
    panels = figure.subplots(len(errors), 1, sharex=True, squeeze=False)[:, 0]
    for panel, error in zip(panels, errors, strict=True):
        for row in (row for row in rows if row.error == error):
            number = names.index(row.motion)
            values = np.array([getattr(row, component) for component in WRENCH_COMPONENTS])
            at = np.arange(6) + 0.7 * ((number + 0.5) / len(names) - 0.5)
            known = np.isfinite(values)
            style = look(number)
            panel.plot(at[known], values[known], linestyle="none", marker=style.marker, color=style.colour)
        panel.set_yscale("log")
        panel.set_ylabel(f"error of {error}", fontsize=TITLE_POINTS)
        panel.tick_params(labelsize=SMALL_POINTS)
    panels[-1].set_xticks(range(6), WRENCH_COMPONENTS)
    panels[-1].set_xlabel("axis that is loaded, by 100 N or 5 N m", fontsize=TITLE_POINTS)
    figure.align_ylabels()
    legend_below(figure, [(shown_name(name), look(k).key | {"linestyle": "none"}) for k, name in enumerate(names)])
    return figure
