# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the drift of sensors over temperature, while they are heated and while they cool."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.results.figures import (
    ROW_INCHES,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
    thinned_cloud,
)
from forcetorque.sensor.temperature.temperature_drift import SensorThermal

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_POINTS = 400
"""Points of a branch that are drawn."""
_BRANCHES = ((1.0, "heating", look(1)), (-1.0, "cooling", look(0)))


@in_figure_style
def thermal_figure(sensors: Sequence[SensorThermal]) -> Figure:
    """Draw readings without offset and drift in time over temperature, with the fitted line of either branch.

    Args:
        sensors: Sensors; two rows each, of forces and of moments.

    Returns:
        The figure, twice `ROW_INCHES` high for each sensor.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    figure = new_figure(1.6 * ROW_INCHES[1] * len(sensors))
    panels = figure.subplots(2 * len(sensors), 3, squeeze=False, sharex="row")
    for k, sensor in enumerate(sensors):
        for j, panel in enumerate(panels[2 * k : 2 * k + 2].ravel()):
            _draw(panel, sensor, j)
        panels[2 * k, 0].set_title(shown_name(f"{sensor.sensor} ({sensor.serial})"), loc="left")
        for panel in panels[2 * k + 1]:
            panel.set_xlabel("temperature, degC")
    dots = [(name, _dots(style) | {"linestyle": "none"}) for _, name, style in _BRANCHES]
    lines = [(f"{name}, fitted", {"color": style.colour, "linestyle": style.dashes}) for _, name, style in _BRANCHES]
    legend_below(figure, [*dots, *lines])
    return figure


def _draw(panel: Axes, sensor: SensorThermal, j: int) -> None:
    curve, row = sensor.curve, sensor.components[j]
    for sign, _, style in _BRANCHES:
        branch = curve.heating == sign
        if not branch.any():
            continue
        degrees, values = curve.temperature_degC[branch], curve.reading[branch, j]
        cloud = thinned_cloud(np.column_stack([degrees, values]), _POINTS)
        panel.plot(cloud[:, 0], cloud[:, 1], linestyle="none", **_dots(style))
        ends = np.array([degrees.min(), degrees.max()])
        line = row.drift_per_degC * (ends - curve.reference_degC) + 0.5 * sign * (row.hysteresis or 0.0)
        panel.plot(ends, line, color=style.colour, linestyle=style.dashes, linewidth=1.4)
    panel.set_ylabel(curve.signals[j])


def _dots(style: Any) -> dict[str, Any]:
    return {"color": style.colour, "marker": style.marker, "markersize": 2.5, "markerfacecolor": "none"}
