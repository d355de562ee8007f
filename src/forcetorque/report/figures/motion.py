# SPDX-License-Identifier: BSD-3-Clause
"""Figure of columns of a motion, with the swings that stand out of their noise and the steps that they settle after."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.analysis import Motion, MotionCurve
from forcetorque.report.figures.canvas import (
    REFERENCE_COLOUR,
    ROW_INCHES,
    SMALL_POINTS,
    TITLE_POINTS,
    legend_below,
    look,
    new_figure,
    shown_name,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_CURVES = 6
"""Columns that are drawn, the first ones."""
_MEASURED, _SWING = look(0), look(1)


def motion_figure(motion: Motion) -> Figure:
    """Draw columns over time.

    Args:
        motion: The motion.

    Returns:
        The figure, a row for each column.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    curves = motion.curves[:MOST_CURVES]
    figure = new_figure(0.7 * ROW_INCHES[1] * max(len(curves), 1))
    panels = figure.subplots(max(len(curves), 1), 1, squeeze=False)[:, 0]
    for panel, curve in zip(panels, curves, strict=False):
        _draw(panel, curve, motion)
    keys: list[tuple[str, Any]] = [("measured", {"color": _MEASURED.colour, "linestyle": _MEASURED.dashes})]
    if any(curve.swing is not None for curve in curves):
        keys.append(("mean, trend and swings", {"color": _SWING.colour, "linestyle": _SWING.dashes}))
    if motion.settling:
        keys.append(("step", {"color": REFERENCE_COLOUR, "linestyle": ":"}))
        keys.append(("settled", {"color": REFERENCE_COLOUR, "linestyle": "-"}))
    legend_below(figure, keys)
    return figure


def _draw(panel: Axes, curve: MotionCurve, motion: Motion) -> None:
    panel.plot(curve.time_s, curve.values, color=_MEASURED.colour, linestyle=_MEASURED.dashes, linewidth=1.0)
    if curve.swing is not None:
        panel.plot(curve.time_s, curve.swing, color=_SWING.colour, linestyle=_SWING.dashes, linewidth=1.2)
    for row in motion.settling:
        if curve.title == f"{row.interval}: {row.column}":
            panel.axvline(row.step_at_s, color=REFERENCE_COLOUR, linestyle=":", linewidth=1.0)
            if row.settling_s is not None:
                panel.axvline(row.step_at_s + row.settling_s, color=REFERENCE_COLOUR, linestyle="-", linewidth=1.0)
    swings = [row for row in motion.oscillations if row.oscillates and curve.title == f"{row.interval}: {row.column}"]
    words = ", ".join(f"{row.frequency_hz:.3g} Hz" for row in swings) or "no oscillation"
    panel.set_title(shown_name(f"{curve.title}: {words}"), fontsize=TITLE_POINTS, loc="left")
    panel.set_ylabel(shown_name(curve.unit), fontsize=SMALL_POINTS)
    panel.set_xlabel("time, s", fontsize=SMALL_POINTS)
    panel.set_xlim(*np.array([curve.time_s[0], curve.time_s[-1]]))
    panel.tick_params(labelsize=SMALL_POINTS)
