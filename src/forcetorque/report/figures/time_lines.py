# SPDX-License-Identifier: BSD-3-Clause
"""Lines over time: of many samples, and told apart by a few points where dashes would drown in noise."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.report.figures.canvas import Look

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_POINTS = 12
"""Points along a line."""


def draw_over_time(panel: Axes, time_s: FloatArray, values: FloatArray, style: Look, *, turn: int, count: int) -> None:
    """Draw a thinned line over time, with a point here and there.

    Args:
        panel: The panel.
        time_s: Instants, as `thinned_line` gives them; shape (m,); s.
        values: What is drawn, NaN where the line breaks; shape (m,).
        style: Colour of the line and shape of its points; the line is solid.
        turn: Place of the line among those of the panel, so that points of two lines do not meet.
        count: How many lines the panel has.
    """
    where = time_s[0] + (time_s[-1] - time_s[0]) * (np.arange(_POINTS) + (turn + 0.5) / count) / _POINTS
    points = np.minimum(np.searchsorted(time_s, where), len(time_s) - 1)
    panel.plot(
        time_s,
        values,
        color=style.colour,
        linewidth=1.0,
        marker=style.marker,
        markersize=6.5,
        markeredgecolor="white",
        markeredgewidth=0.6,
        markevery=[int(k) for k in points if np.isfinite(values[k])],
    )
