# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a torque loop: tracking, swings and falls over the size of the sensors' error."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from forcetorque.analysis import TorqueLoopRow, TorqueLoopStudy
from forcetorque.report.figures.canvas import (
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


def torque_loop_figure(loop: TorqueLoopStudy) -> Figure:
    """Draw what the error of the sensors does, a curve per soles, gains and kind of error.

    Args:
        loop: The result.

    Returns:
        The figure: tracking error, share that swings on after a push, share that falls; bars are 95 % intervals.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    figure = new_figure(1.25 * ROW_INCHES[1])
    panels = figure.subplots(1, 3)
    curves = _curves(loop.rows)
    for k, (_, rows) in enumerate(curves):
        _draw(panels, rows, k)
    names = ("tracking error, N m", "swings on after a push, %", "falls, %")
    for panel, name in zip(panels, names, strict=True):
        panel.set_xlabel("force error of the sensors under the weight, N", fontsize=TITLE_POINTS)
        panel.set_ylabel(name, fontsize=TITLE_POINTS)
        panel.tick_params(labelsize=SMALL_POINTS)
    for panel in panels[1:]:
        panel.set_ylim(-3.0, 103.0)
    legend_below(figure, [(shown_name(name), look(k).key) for k, (name, _) in enumerate(curves)])
    return figure


def _curves(rows: Sequence[TorqueLoopRow]) -> list[tuple[str, list[TorqueLoopRow]]]:
    """A curve per robot, gains and kind of error; each begins with the robot whose sensors have none."""
    curves = []
    for (tilt_deg, factor), group in groupby(rows, key=lambda row: (row.tilt_deg, row.gain_factor)):
        first, *others = group
        for errors, sized in groupby(others, key=lambda row: row.errors):
            name = f"{errors}, soles at {tilt_deg:g} deg" + (f", gains times {factor:g}" if factor != 1.0 else "")
            curves.append((name, [first, *sized]))
    return curves


def _draw(panels: Sequence[Axes], rows: Sequence[TorqueLoopRow], k: int) -> None:
    style = look(k)
    size = [row.force_error_N for row in rows]
    shares = [
        [(row.oscillating, row.oscillating_least_percent, row.oscillating_most_percent) for row in rows],
        [(row.falls, row.falls_least_percent, row.falls_most_percent) for row in rows],
    ]
    panels[0].plot(size, [row.tracking_rms_Nm for row in rows], linewidth=1.0, markersize=5.0, **style.key)
    for x, row in zip(size, rows, strict=True):
        half = row.tracking_half_width_95_Nm or 0.0
        panels[0].plot([x, x], [row.tracking_rms_Nm - half, row.tracking_rms_Nm + half], color=style.colour)
    for panel, counts in zip(panels[1:], shares, strict=True):
        values = [100.0 * count / row.runs for (count, _, _), row in zip(counts, rows, strict=True)]
        panel.plot(size, values, linewidth=1.0, markersize=5.0, **style.key)
        for x, (_, least, most) in zip(size, counts, strict=True):
            panel.plot([x, x], [least, most], color=style.colour, linewidth=1.0)
