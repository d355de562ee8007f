# SPDX-License-Identifier: BSD-3-Clause
"""Figure of sensors by what a load uses of their range, and of what principles read of it over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from forcetorque.results.figures import (
    LIMIT_LINE,
    ROW_INCHES,
    headline,
    in_figure_style,
    look,
    new_figure,
    shown_name,
)
from forcetorque.sensor.choice.result import Holds

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.sensor.choice.result import SensorChoice

_ROW_INCHES = 0.19
_MOST_PERCENT = 150.0
"""Shares beyond it are drawn up to it."""
_LOOKS = {Holds.HELD: look(0), Holds.AXIS_BY_AXIS: look(1), Holds.EXCEEDED: look(5)}


@in_figure_style
def choice_figure(choice: SensorChoice) -> Figure:
    """Draw the share of every range that the loads use, and simulated readings of the principles.

    Args:
        choice: Sensors and principles.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    height = _ROW_INCHES * len(choice.sensors) + 0.8
    figure = new_figure(height + ROW_INCHES[1])
    ranges, readings = figure.subplots(2, 1, height_ratios=[height, ROW_INCHES[1]])
    places = np.arange(len(choice.sensors))
    for holds, style in _LOOKS.items():
        rows = [k for k, row in enumerate(choice.sensors) if row.holds is holds]
        used = [min(choice.sensors[k].combined_percent, _MOST_PERCENT) for k in rows]
        if rows:
            ranges.barh(places[rows], used, height=0.7, color=style.colour, label=str(holds))
    ranges.axvline(100.0 * (1.0 - choice.margin), **LIMIT_LINE)
    ranges.set_yticks(places, [shown_name(row.name) for row in choice.sensors])
    ranges.invert_yaxis()
    ranges.set(xlim=(0.0, _MOST_PERCENT), xlabel="shares of all axes together, % of the range")
    ranges.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    for k, curve in enumerate(choice.curves):
        style = look(k)
        readings.plot(
            curve.time_s, curve.share, **style.key, markevery=(30 * k, 240), linewidth=0.9, label=curve.principle
        )
    readings.set(
        ylim=(-0.2, 1.6),
        xlabel="time, s",
        ylabel="reading over load",
        title=f"{shown_name(choice.largest)} from 10 s on, 0.1 degC warmer from 60 to 120 s, simulated",
    )
    if choice.curves:
        readings.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    holding = sum(row.holds is Holds.HELD for row in choice.sensors)
    spare = f"{100.0 * choice.margin:.0f} % to spare"
    headline(figure, f"{holding} of {len(choice.sensors)} ranges hold the loads, all axes together, with {spare}")
    return figure
