# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a joint calibration: what is left of the equation of every part over time, before and after."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.calibration.joint.robust_fit import PartResidual
from forcetorque.results.figures import (
    COLOURS,
    GRID,
    MUTED,
    in_figure_style,
    legend_below,
    new_figure,
    shown_name,
)
from forcetorque.results.visual_roles import PRIOR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_ROW_INCHES = 1.7
_BEFORE: dict[str, Any] = {"color": PRIOR.colour, "linestyle": (0, PRIOR.dash), "linewidth": 1.1}
_AFTER: dict[str, Any] = {"color": COLOURS[0], "linestyle": "-", "linewidth": 1.4}
_LEFT_OUT: dict[str, Any] = {"color": COLOURS[1], "linestyle": "none", "marker": "X", "markersize": 5.0}
_BORDER: dict[str, Any] = {"color": MUTED, "linestyle": ":", "linewidth": 1.0}
_QUANTITIES = (("force", "N", FORCE), ("moment", "N m", MOMENT))


@in_figure_style
def joint_figure(residuals: Sequence[PartResidual]) -> Figure:
    """Draw what is left of the equation of every part: magnitudes of force and moment, window by window.

    Intervals stand behind each other, with a dotted line between. The axes of magnitudes are logarithmic.

    Args:
        residuals: What is left, of every part in every interval, at least one.

    Returns:
        The figure, a row for each part: forces, moments.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are none.
    """
    if not residuals:
        raise ShapeError("residuals: expected those of at least one part, got none")
    parts = list(dict.fromkeys(one.part for one in residuals))
    starts = _starts(residuals)
    figure = new_figure(_ROW_INCHES * len(parts))
    grid = figure.subplots(len(parts), 2, squeeze=False, sharex=True)
    for row, part in zip(grid, parts, strict=True):
        own = [one for one in residuals if one.part == part]
        for panel, (quantity, unit, loads) in zip(row, _QUANTITIES, strict=True):
            _draw(panel, own, starts, loads)
            panel.set_ylabel(f"{quantity}, {unit}")
            for start in list(starts.values())[1:]:
                panel.axvline(start, **_BORDER)
        sensors = ", ".join(dict.fromkeys(name for one in own for name in one.sensors))
        row[0].set_title(shown_name(f"{part}: {sensors}"), loc="left")
    for panel in grid[-1]:
        panel.set_xlabel("time of all intervals, s")
    legend_below(
        figure,
        [
            ("by the prior matrices, best offsets", _BEFORE),
            ("by the calibrations", _AFTER),
            ("left out: disagrees with the others", _LEFT_OUT),
        ],
        title="sensors of a part less what moves its bodies: magnitudes over windows of a quarter of a second",
    )
    return figure


def _starts(residuals: Sequence[PartResidual]) -> dict[str, float]:
    """Where the time of every interval begins on the common axis; s."""
    starts: dict[str, float] = {}
    end = 0.0
    for label in dict.fromkeys(one.label for one in residuals):
        times = np.concatenate([one.time_s for one in residuals if one.label == label])
        starts[label] = end
        end += float(np.ptp(times)) + 1.0 if len(times) else 0.0
    return starts


def _draw(panel: Axes, residuals: Sequence[PartResidual], starts: dict[str, float], loads: slice) -> None:
    for one in residuals:
        if not len(one.time_s):
            continue
        time = starts[one.label] + one.time_s - one.time_s[0]
        before, after = _sizes(one.before[:, loads]), _sizes(one.after[:, loads])
        panel.plot(time, before, **_BEFORE)
        panel.plot(time, after, **_AFTER)
        panel.plot(time[~one.kept], after[~one.kept], **_LEFT_OUT)
    if any(np.nanmax(line.get_ydata(), initial=0.0) > 0.0 for line in panel.lines):  # Matplotlib warns of an empty one
        panel.set_yscale("log")
    panel.grid(visible=True, axis="y", color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


def _sizes(values: FloatArray) -> FloatArray:
    return np.sqrt((values**2).sum(axis=1))
