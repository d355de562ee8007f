# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the space that a calibration device sweeps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.exsitu.device import VIEWS, Silhouette
from forcetorque.report.figures.canvas import (
    REFERENCE_COLOUR,
    ROW_INCHES,
    SMALL_POINTS,
    TITLE_POINTS,
    legend_below,
    look,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_AXES = "xyz"


def envelope_figure(silhouettes: Sequence[Silhouette]) -> Figure:
    """Draw what is swept in each view, and the rectangle around it [1].

    Args:
        silhouettes: What is swept.

    Returns:
        The figure, a panel per view.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 6.13.
    """
    figure = new_figure(1.2 * ROW_INCHES[1])
    for panel, silhouette in zip(figure.subplots(1, len(silhouettes), squeeze=False)[0], silhouettes, strict=True):
        _draw(panel, silhouette)
    legend_below(
        figure,
        [
            ("convex hull of what is swept", {"color": look(0).colour, "linestyle": "-"}),
            ("rectangle around it", {"color": REFERENCE_COLOUR, "linestyle": "--"}),
        ],
    )
    return figure


def _draw(panel: Axes, silhouette: Silhouette) -> None:
    closed = np.concatenate([silhouette.outline, silhouette.outline[:1]])
    panel.fill(*closed.T, color=look(0).colour, alpha=0.2)
    panel.plot(*closed.T, color=look(0).colour, linewidth=1.4)
    low, high = silhouette.outline.min(axis=0), silhouette.outline.max(axis=0)
    corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]], low])
    panel.plot(*corners.T, color=REFERENCE_COLOUR, linestyle="--", linewidth=1.0)
    panel.set_aspect("equal", adjustable="datalim")
    panel.set_title(f"from {silhouette.view}, {silhouette.rectangle_m2:.2f} m2", fontsize=TITLE_POINTS)
    first, second = VIEWS[silhouette.view]
    panel.set_xlabel(f"{_AXES[first]}, m", fontsize=TITLE_POINTS)
    panel.set_ylabel(f"{_AXES[second]}, m", fontsize=TITLE_POINTS)
    panel.tick_params(labelsize=SMALL_POINTS)
