# SPDX-License-Identifier: BSD-3-Clause
"""Figures of the directions of raw samples and wrenches that the loads of data sets excite."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE, MOMENT, WRENCH_COMPONENTS
from forcetorque.experiment.calibration.excitation import EXPLAINED_SHARE
from forcetorque.experiment.calibration.provenance import Validity
from forcetorque.results.figure_style import (
    GRID,
    PAPER,
    PLANES,
    REFERENCE_COLOUR,
    ROW_INCHES,
    SMALL_PANEL_POINTS,
    THIN_REFERENCE_LINE,
    Look,
    drawable_each,
    headline,
    in_figure_style,
    legend_below,
    look,
    looks,
    new_figure,
    shown_name,
    thinned_cloud,
    two_digits,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_DIRECTION_INCHES, _ROW_INCHES = 0.3, 1.25
"""Height of a direction, and of what a row has beside its directions: title, axis and room; inch."""
_MOST_WRITTEN = 10
"""Channels up to which the parts of a direction have room to be written as numbers; beyond, only minus signs have."""
_DARK = 0.72
"""Part of a direction from which on its cell is so dark, of a luminance below 0.18, that white letters have the higher
contrast."""
_SEEN = 0.1
"""Part of a direction from which on its cell is seen not to be white."""
_ROOM = 0.3
"""Part of the decades of an axis of counts, one at least, by which it goes on behind the strongest direction, for its
number."""
_EXCITED: dict[str, Any] = {"color": look(0).colour, "marker": look(0).marker}
_NOT_EXCITED: dict[str, Any] = {"color": look(1).colour, "marker": "X"}


@in_figure_style
def excitation_figure(sensors: Mapping[str, Validity]) -> Figure:
    """Draw what a data set has moved: raw directions, strongest first, and how far loads explain each.

    Of every direction there are the standard deviation of the readings along it, the share of their variance that the
    reference wrench explains, and the channels that it is made of. Along a direction that is not excited a matrix
    is its prior's, or fitted to noise. The sign of a direction means nothing; each is drawn with its largest part
    positive.

    Args:
        sensors: What supports the calibration of each sensor, by its name.

    Returns:
        The figure, a row for each sensor.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no sensors.
    """
    if not sensors:
        raise ShapeError("sensors: expected at least one sensor to draw, got none")
    heights = [_ROW_INCHES + _DIRECTION_INCHES * len(validity.excited) for validity in sensors.values()]
    figure = new_figure(sum(heights))
    grid = figure.subplots(
        len(sensors), 3, squeeze=False, gridspec_kw={"height_ratios": heights, "width_ratios": (1.0, 0.8, 1.2)}
    )
    for (strength, share, parts), (name, validity) in zip(grid, sensors.items(), strict=True):
        _draw_deviation(strength, validity)
        _draw_explained(share, validity)
        _draw_directions(parts, validity.directions)
        strength.set_title(shown_name(name), loc="left")
    keys = [("excited by the loads", {**_EXCITED, "markersize": 8.0, "linewidth": 1.2})]
    keys.append(("not excited", {**_NOT_EXCITED, "markersize": 9.0, "linewidth": 1.2, "linestyle": ":"}))
    keys.append((f"least share of an excited direction, {100 * EXPLAINED_SHARE:.0f} %", THIN_REFERENCE_LINE))
    legend_below(figure, keys)
    counts = [f"{sum(one.excited)} of {len(one.excited)} ({shown_name(name)})" for name, one in sensors.items()]
    headline(figure, f"Raw directions that the loads excite: {', '.join(counts)}")
    return figure


def _draw_deviation(panel: Axes, validity: Validity) -> None:
    """Standard deviations on a logarithmic axis, with their numbers; one that is 0 at the left edge."""
    deviation = np.sqrt(validity.variance_counts2)
    moved = deviation[deviation > 0.0]
    least, most = (float(moved.min()), float(moved.max())) if len(moved) else (1.0, 1.0)
    low, high = 0.5 * least, most * max(10.0, most / least) ** _ROOM
    panel.set(xscale="log", xlim=(low, high))
    _draw_values(panel, validity, np.maximum(deviation, low), low)
    for row, value in enumerate(deviation):
        text = f"{value:.3g}" if value < 1000.0 else f"{value:.0f}"
        panel.annotate(text, (max(value, low), row), (8.0, 0.0), textcoords="offset points", va="center")
    panel.set(ylabel="raw direction", xlabel="standard deviation, counts")


def _draw_explained(panel: Axes, validity: Validity) -> None:
    panel.axvline(100.0 * EXPLAINED_SHARE, **THIN_REFERENCE_LINE)
    panel.set_xlim(0.0, 105.0)
    _draw_values(panel, validity, 100.0 * validity.explained, 0.0)
    panel.set_xlabel("variance explained by loads, %")


def _draw_values(panel: Axes, validity: Validity, values: FloatArray, start: float) -> None:
    """A line and a point for each direction; of those that are not excited the line is dotted."""
    for row, (value, excited) in enumerate(zip(values, validity.excited, strict=True)):
        style = _EXCITED if excited else _NOT_EXCITED
        panel.plot([start, value], [row, row], "-" if excited else ":", color=style["color"], linewidth=1.6)
        panel.plot(
            value,
            row,
            style["marker"],
            color=style["color"],
            markersize=8.0 if excited else 9.0,
            clip_on=False,
            zorder=3,
        )
    _number_directions(panel, len(values))
    panel.grid(visible=True, axis="x", color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


def _number_directions(panel: Axes, count: int) -> None:
    panel.set_ylim(count - 0.5, -0.5)
    panel.set_yticks(range(count), [str(k + 1) for k in range(count)])


def _draw_directions(panel: Axes, directions: FloatArray) -> None:
    """Size of each part by darkness, which rises evenly in grey too; its sign, and with room its number, written."""
    largest = np.take_along_axis(directions, np.abs(directions).argmax(axis=1)[:, None], axis=1)
    rows = directions * np.where(largest < 0.0, -1.0, 1.0)
    panel.imshow(np.abs(rows), cmap="Blues", vmin=0.0, vmax=1.0, aspect="auto")
    written = len(rows) <= _MOST_WRITTEN
    for row, column in np.ndindex(rows.shape):
        part = rows[row, column]
        text = f"{part:.2f}" if written else "–" if part < -_SEEN else ""
        text = text.replace("-0.00", "0.00").replace("-", "−")
        colour = PAPER if abs(part) > _DARK else REFERENCE_COLOUR
        panel.text(column, row, text, ha="center", va="center", color=colour)
    _number_directions(panel, len(rows))
    step = 1 if written else 2
    panel.set_xticks(range(0, len(rows), step), [f"ch{k}" for k in range(0, len(rows), step)])
    meaning = "" if written else " (dark: large, –: negative)"
    panel.set_xlabel(f"part of each channel in the direction{meaning}")
    panel.tick_params(length=0.0)


_ROWS = (("force space", "N", FORCE), ("torque space", "N m", MOMENT))


@in_figure_style
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
    by_name = looks(list(wrenches_by_name))
    styles = list(by_name.values())
    # the narrow column keeps the label of the third axis clear of the next panel
    grid = figure.add_gridspec(2, 5, width_ratios=(1.5, 0.1, 1.0, 1.0, 1.0))
    for row, (title, unit, part) in enumerate(_ROWS):
        parts = [wrenches[_whole(wrenches), part] for wrenches in wrenches_by_name.values()]
        labels = [f"{name}, {unit}" for name in WRENCH_COMPONENTS[part]]
        _draw_space(figure.add_subplot(grid[row, 0], projection="3d"), parts, labels, styles, title=title)
        for column, plane in enumerate(PLANES):
            panel = figure.add_subplot(grid[row, column + 2])
            _draw_plane(panel, [points[:, plane] for points in parts], styles)
            panel.set_xlabel(labels[plane[0]])
            panel.set_ylabel(labels[plane[1]], labelpad=0.0)
    legend_below(figure, [(shown_name(name), style.key) for name, style in by_name.items()])
    headline(figure, f"Largest {' and '.join(_largest(wrenches_by_name, part, unit) for _, unit, part in _ROWS)}")
    return figure


def _largest(wrenches_by_name: Mapping[str, FloatArray], part: slice, unit: str) -> str:
    sizes = {
        name: float(np.max(np.linalg.norm(wrenches[:, part], axis=1), initial=0.0, where=_whole(wrenches)))
        for name, wrenches in wrenches_by_name.items()
    }
    name = max(sizes, key=sizes.__getitem__)
    return f"{'force' if part == FORCE else 'torque'}: {two_digits(sizes[name])} {unit} ({shown_name(name)})"


def _whole(wrenches: FloatArray) -> BoolArray:
    return np.asarray(np.isfinite(wrenches).all(axis=1))


def _draw_space(panel: Any, parts: list[FloatArray], labels: list[str], styles: Sequence[Look], *, title: str) -> None:
    for k in _widest_first(parts):
        style, points = styles[k], thinned_cloud(parts[k])
        panel.plot(*points.T, style.marker, color=style.colour, markersize=1.6, markeredgewidth=0.0)
    panel.set_title(title)
    panel.locator_params(nbins=5)
    for axis, label in zip("xyz", labels, strict=True):
        getattr(panel, f"set_{axis}label")(label)
        panel.tick_params(axis=axis, labelsize=SMALL_PANEL_POINTS)


def _draw_plane(panel: Axes, parts: list[FloatArray], styles: Sequence[Look]) -> None:
    for k in _widest_first(parts):
        style, points = styles[k], thinned_cloud(parts[k])
        panel.plot(*points.T, style.marker, color=style.colour, markersize=1.8, markeredgewidth=0.0, alpha=0.5)
    for k, points in enumerate(parts):
        # above all points
        panel.plot(*outline(points).T, color=styles[k].colour, linestyle=styles[k].dashes, linewidth=1.2, zorder=3.0)
    panel.set_aspect("equal", adjustable="datalim")
    panel.tick_params(labelsize=SMALL_PANEL_POINTS)
    panel.grid(visible=True, color=GRID, linewidth=0.6)
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
    return points[np.append(corners, corners[0])]
