# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the forces and torques that types of data set reach."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from forcetorque.arrays import FloatArray
from forcetorque.report.figures.canvas import (
    PLANES,
    ROW_INCHES,
    SMALL_PANEL_POINTS,
    TITLE_POINTS,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.report.figures.inputs import drawable_each
from forcetorque.report.figures.thinning import thinned_cloud
from forcetorque.spatial.wrench import FORCE, MOMENT, WRENCH_COMPONENTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROWS = (("force space", "N", FORCE), ("torque space", "N m", MOMENT))


def space_figure(clouds: Mapping[str, FloatArray]) -> Figure:
    """Draw which forces and torques each type of data set reaches: in space, and as seen along the axes [1].

    Clouds of many samples are thinned evenly in time. The planar views outline the convex hull of all samples, and
    wider clouds lie below narrower ones, so that none is hidden and one inside another is seen to be so.

    Args:
        clouds: Wrenches by the name of their data set type, in the order of time; shape (n, 6), n its own for each;
            N, N m. A sample with a component that is not a finite number is left out.

    Returns:
        The figure, a row for forces and one for torques.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no clouds, or one is empty or of another shape.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 5.2.
    """
    wrenches_by_name = drawable_each(clouds, name="clouds", shape=(None, 6))
    figure = new_figure(2 * ROW_INCHES[1])
    # the narrow column keeps the label of the third axis clear of the next panel
    grid = figure.add_gridspec(2, 5, width_ratios=(1.5, 0.1, 1.0, 1.0, 1.0))
    for row, (title, unit, part) in enumerate(_ROWS):
        parts = [wrenches[np.isfinite(wrenches).all(axis=1), part] for wrenches in wrenches_by_name.values()]
        labels = [f"{name}, {unit}" for name in WRENCH_COMPONENTS[part]]
        _draw_space(figure.add_subplot(grid[row, 0], projection="3d"), parts, labels, title=title)
        for column, plane in enumerate(PLANES):
            panel = figure.add_subplot(grid[row, column + 2])
            _draw_plane(panel, [points[:, plane] for points in parts])
            panel.set_xlabel(labels[plane[0]])
            panel.set_ylabel(labels[plane[1]], labelpad=0.0)
    legend_below(figure, [(shown_name(name), look(k).key) for k, name in enumerate(wrenches_by_name)])
    return figure


def _draw_space(panel: Any, parts: list[FloatArray], labels: list[str], *, title: str) -> None:
    for k in _widest_first(parts):
        style, points = look(k), thinned_cloud(parts[k])
        panel.plot(*points.T, style.marker, color=style.colour, markersize=1.6, markeredgewidth=0.0)
    panel.set_title(title, fontsize=TITLE_POINTS)
    panel.locator_params(nbins=5)
    for axis, label in zip("xyz", labels, strict=True):
        getattr(panel, f"set_{axis}label")(label)
        panel.tick_params(axis=axis, labelsize=SMALL_PANEL_POINTS)


def _draw_plane(panel: Axes, parts: list[FloatArray]) -> None:
    for k in _widest_first(parts):
        style, points = look(k), thinned_cloud(parts[k])
        panel.plot(*points.T, style.marker, color=style.colour, markersize=1.8, markeredgewidth=0.0, alpha=0.5)
    for k, points in enumerate(parts):
        # above all points
        panel.plot(*outline(points).T, color=look(k).colour, linestyle=look(k).dashes, linewidth=1.2, zorder=3.0)
    panel.set_aspect("equal", adjustable="datalim")
    panel.tick_params(labelsize=SMALL_PANEL_POINTS)
    panel.grid(visible=True, color="0.9", linewidth=0.6)
    panel.set_axisbelow(True)


def _widest_first(parts: list[FloatArray]) -> list[int]:
    """Order of clouds by the area or volume over which they scatter, the widest first."""
    sizes = [np.linalg.det(np.cov(points.T)) if len(points) > 1 else 0.0 for points in parts]
    return sorted(range(len(parts)), key=lambda k: (-sizes[k], k))


def outline(points: FloatArray) -> FloatArray:
    """Outline the convex hull of points in a plane.

    Args:
        points: The points; shape (n, 2).

    Returns:
        Its corners, the first again at the end; none where the points have no area; shape (m, 2).
    """
    try:
        corners = ConvexHull(points).vertices
    except (QhullError, ValueError):
        # fewer than three points, or all on one line: the points themselves show all there is
        return points[:0]
    closed: FloatArray = points[np.append(corners, corners[0])]
    return closed
