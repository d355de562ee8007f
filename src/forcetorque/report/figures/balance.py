# SPDX-License-Identifier: BSD-3-Clause
"""Figure of how a robot stands: what each foot bears over time, and where pressure is centred on the ground."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.analysis import IntervalBalance
from forcetorque.arrays import FloatArray
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
from forcetorque.report.figures.thinning import thinned_line
from forcetorque.report.figures.time_lines import draw_over_time

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MM = 1e3
_MOST_POINTS = 1500
_WEIGHT: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (4, 1.5)), "linewidth": 1.2}
_OUTLINE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": "-", "linewidth": 1.0}


def balance_figure(interval: IntervalBalance) -> Figure:
    """Draw the load on each foot over time, shaded where it is down, and the points on soles and ground.

    Args:
        interval: How a robot stood over an interval; panels that it has nothing for are left out.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    planes = len(interval.feet) + (1 if interval.robot is not None else 0)
    figure = new_figure(ROW_INCHES[1] * (1.0 if not planes else 2.1))
    grid = figure.add_gridspec(2 if planes else 1, max(planes, 1))
    loads = figure.add_subplot(grid[0, :])
    _draw_loads(loads, interval)
    for k, foot in enumerate(interval.feet):
        panel = figure.add_subplot(grid[1, k])
        outline = foot.sole.outline
        if outline is not None:
            panel.plot(*(_MM * np.vstack([outline, outline[:1]])).T, **_OUTLINE)
        _draw_points(panel, foot.pressure.points, k)
        _plane(panel, foot.sole.frame)
    if interval.robot is not None:
        panel = figure.add_subplot(grid[1, planes - 1])
        if interval.robot.zero_moment_point is not None:
            _draw_points(panel, interval.robot.zero_moment_point, len(interval.feet) + 1)
        _draw_points(panel, interval.robot.pressure.points, len(interval.feet))
        _plane(panel, f"robot, in {interval.robot.frame}")
    legend_below(figure, _keys(interval))
    return figure


def _draw_loads(panel: Axes, interval: IntervalBalance) -> None:
    count = len(interval.forces)
    for k, (force, down) in enumerate(zip(interval.forces.values(), interval.phases.down.T, strict=True)):
        at, lines = thinned_line(interval.time_s, force[:, None])
        draw_over_time(panel, at, lines[:, 0], look(k), turn=k, count=count)
        # a bar for each foot above the curves, where it is down
        panel.fill_between(
            interval.time_s,
            1.01 + 0.04 * (count - 1 - k),
            1.04 + 0.04 * (count - 1 - k),
            where=down.tolist(),
            transform=panel.get_xaxis_transform(),
            color=look(k).colour,
            linewidth=0.0,
            clip_on=False,
        )
    if interval.weight_N is not None:
        panel.axhline(interval.weight_N, **_WEIGHT)
    panel.set_xlabel("time, s", fontsize=TITLE_POINTS)
    panel.set_ylabel("load, N", fontsize=TITLE_POINTS)
    panel.tick_params(labelsize=SMALL_POINTS)


def _draw_points(panel: Axes, points: FloatArray, k: int) -> None:
    known = points[np.all(np.isfinite(points), axis=1)]
    rows = _MM * known[:: max(1, -(-len(known) // _MOST_POINTS))]
    panel.plot(rows[:, 0], rows[:, 1], linestyle="", marker=look(k).marker, markersize=2.5, color=look(k).colour)


def _plane(panel: Axes, title: str) -> None:
    panel.set_title(shown_name(title), fontsize=TITLE_POINTS)
    panel.set_xlabel("x, mm", fontsize=TITLE_POINTS)
    panel.set_ylabel("y, mm", fontsize=TITLE_POINTS)
    panel.tick_params(labelsize=SMALL_POINTS)
    panel.set_aspect("equal", adjustable="datalim")


def _keys(interval: IntervalBalance) -> list[tuple[str, dict[str, Any]]]:
    keys: list[tuple[str, dict[str, Any]]] = [
        (f"{shown_name(frame)}, bar: down", look(k).key | {"linestyle": "-"}) for k, frame in enumerate(interval.forces)
    ]
    if interval.weight_N is not None:
        keys.append(("weight of the robot", _WEIGHT))
    dots = {"linestyle": ""}
    if interval.robot is not None:
        keys.append(("centre of pressure, robot", look(len(interval.feet)).key | dots))
        if interval.robot.zero_moment_point is not None:
            keys.append(("zero moment point of the motion", look(len(interval.feet) + 1).key | dots))
    if any(foot.sole.outline is not None for foot in interval.feet):
        keys.append(("outline of the sole", _OUTLINE))
    return keys
