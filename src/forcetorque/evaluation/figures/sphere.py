# SPDX-License-Identifier: BSD-3-Clause
"""Figures of spheres: clouds with the ellipsoid through them, and the indices of many sensors and trials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Literal, get_args

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.figures.excitation import outline
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid, EllipsoidFit
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere
from forcetorque.evaluation.trials.trials import TrialGroup, mean_of_trials
from forcetorque.results.figures import (
    GRID,
    MUTED,
    PAPER,
    PLANES,
    REFERENCE_COLOUR,
    ROW_INCHES,
    Look,
    drawable,
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
from forcetorque.results.table import short_names
from forcetorque.results.visual_roles import SHADE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_OUTLINE_POINTS = 181
_MAPPED, _FREE = look(1), look(2)
_FEW = 300
"""Points that can be told apart one by one."""
CLOUD_POINTS = 1000
"""Points of a cloud of which some stand for all; more hide each other and the outlines."""
_FAR = 2.5
"""An outline that is so many times larger than the cloud would hide it and is not drawn."""


@in_figure_style
def sphere_figure(spheres: Sequence[SensorSphere]) -> Figure:
    """Draw the clouds, ellipsoids and spheres of sensors as seen along the axes [1].

    Everything is moved so that the offset of the sensor is zero, as well as it is known: the centre of the ellipsoid
    with the model if it is identifiable, else of the one without if that is; else the mean of measured minus reference
    forces; without a reference the centre of the sphere of one radius, or the middle of the cloud. Ellipsoids are
    outlined as they are seen, so the outline reaches to their half-widths, not to the axis intersections. An outline
    that is not identifiable is dotted, and left out where it is far larger than the cloud.

    Args:
        spheres: Analyses, a row each.

    Returns:
        The figure, three views per row.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no analysis.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figures 4.2 to 4.4.
    """
    if not spheres:
        raise ShapeError("spheres: expected at least one to draw, got none")
    names = short_names([sphere.calibration for sphere in spheres])
    figure = new_figure(ROW_INCHES[1] * len(spheres))
    rows = figure.subplots(len(spheres), 3, squeeze=False)
    for panels, sphere in zip(rows, spheres, strict=True):
        centre = _centre(sphere)
        for panel, plane in zip(panels, PLANES, strict=True):
            _draw_plane(panel, sphere, centre, plane)
        panels[0].set_title(
            shown_name(f"{sphere.sensor} ({sphere.serial}), {names[sphere.calibration]}"),
            loc="left",
        )
    legend_below(figure, _keys(spheres))
    headline(figure, _axes_differ(spheres, [names[sphere.calibration] for sphere in spheres]))
    return figure


def _axes_differ(spheres: Sequence[SensorSphere], names: Sequence[str]) -> str:
    """Least and largest index, and how many there are not."""
    indices = {}
    for sphere, name in zip(spheres, names, strict=True):
        fit = next((fit for fit in _fits(sphere) if fit.identifiable), None)
        if fit is not None:
            indices[f"{sphere.sensor}, {name}"] = fit.index / sphere.analysis.gravity
    open_ones = f"{len(spheres) - len(indices)} of {len(spheres)} not identifiable"
    if not indices:
        return f"Axes of the ellipsoids: {open_ones}"
    ends = dict.fromkeys([min(indices, key=indices.__getitem__), max(indices, key=indices.__getitem__)])
    words = " to ".join(f"{two_digits(indices[name])} kg ({shown_name(name)})" for name in ends)
    return f"Axes of the ellipsoids differ by {words}" + (f"; {open_ones}" if len(indices) < len(spheres) else "")


def _keys(spheres: Sequence[SensorSphere]) -> list[tuple[str, dict[str, Any]]]:
    keys: list[tuple[str, dict[str, Any]]] = [("forces read", {**look(0).key, "linestyle": "none"})]
    if any(sphere.analysis.mapped is not None for sphere in spheres):
        keys.append(("ellipsoid with the model", {"color": _MAPPED.colour, "linestyle": _MAPPED.dashes}))
    keys.append(("ellipsoid without the model", {"color": _FREE.colour, "linestyle": _FREE.dashes}))
    if any(not fit.tilt_identifiable for sphere in spheres for fit in _fits(sphere)):
        keys.append(("not identifiable", {"color": MUTED, "linestyle": ":"}))
    if any(sphere.analysis.mass is not None for sphere in spheres):
        keys.append(("weight by the model", {"color": REFERENCE_COLOUR, "linestyle": "-"}))
    return keys


def _fits(sphere: SensorSphere) -> list[Any]:
    mapped = sphere.analysis.mapped
    return [sphere.analysis.free] if mapped is None else [mapped.fit, sphere.analysis.free]


def _centre(sphere: SensorSphere) -> FloatArray:
    """What the sensor reads without force, as well as it is known; shape (3,)."""
    analysis = sphere.analysis
    if analysis.mapped is not None and analysis.mapped.fit.identifiable:
        return analysis.mapped.centre
    if analysis.free.identifiable and analysis.free.ellipsoid is not None:
        return analysis.free.ellipsoid.centre
    if sphere.reference is not None:
        return (sphere.force - sphere.reference).mean(axis=0)
    if analysis.radius.centre is not None:
        return analysis.radius.centre
    return sphere.force.mean(axis=0)


def _draw_plane(panel: Axes, sphere: SensorSphere, centre: FloatArray, plane: tuple[int, int]) -> None:
    force = thinned_cloud(sphere.force - centre, CLOUD_POINTS)[:, plane]
    cloud = look(0)
    size_points = 5.0 if len(force) < _FEW else 1.8
    panel.plot(*force.T, cloud.marker, color=cloud.colour, markersize=size_points, markeredgewidth=0.0, alpha=0.5)
    analysis = sphere.analysis
    if analysis.mass is not None:
        circle = analysis.mass * analysis.gravity * _circle()
        panel.plot(*circle.T, color=REFERENCE_COLOUR, linewidth=1.0)
    size = max(float(np.ptp(sphere.force, axis=0).max()), (analysis.mass or 0.0) * analysis.gravity)
    drawn = [(analysis.free, _FREE)]
    if analysis.mapped is not None:
        drawn.append((analysis.mapped.fit, _MAPPED))
    for fit, style in drawn:
        if fit.ellipsoid is not None and float(fit.ellipsoid.half_widths.max()) < _FAR * size:
            outline = ellipsoid_outline(fit.ellipsoid, plane) - centre[list(plane)]
            panel.plot(
                *outline.T, color=style.colour, linestyle=style.dashes if fit.tilt_identifiable else ":", linewidth=1.4
            )
    panel.set_aspect("equal", adjustable="datalim")
    panel.grid(visible=True, color=GRID, linewidth=0.6)
    panel.set(axisbelow=True, xlabel=f"{WRENCH_COMPONENTS[plane[0]]}, N", ylabel=f"{WRENCH_COMPONENTS[plane[1]]}, N")


def ellipsoid_outline(ellipsoid: Ellipsoid, plane: tuple[int, int]) -> FloatArray:
    """Outline an ellipsoid as it is seen along an axis.

    Args:
        ellipsoid: The ellipsoid.
        plane: Indices of the two axes that are seen.

    Returns:
        Points of the closed outline; shape (m, 2).
    """
    # the shadow of an ellipsoid: what its inverse shape has of the plane
    shadow = np.linalg.inv(ellipsoid.shape)[np.ix_(plane, plane)]
    return ellipsoid.centre[list(plane)] + _circle() @ np.linalg.cholesky(shadow).T


def _circle() -> FloatArray:
    angle = np.linspace(0.0, 2.0 * np.pi, _OUTLINE_POINTS)
    return np.column_stack([np.cos(angle), np.sin(angle)])


Quantity = Literal["force", "moment"]
"""What the clouds are of."""

_LABELS: Final[dict[Quantity, list[str]]] = {
    "force": [f"{name}, N" for name in WRENCH_COMPONENTS[:3]],
    "moment": [f"{name}, N m" for name in WRENCH_COMPONENTS[3:]],
}


@in_figure_style
def force_space_figure(
    clouds: Mapping[str, Sequence[tuple[str, FloatArray]]], *, quantity: Quantity = "force"
) -> Figure:
    """Draw clouds of forces, or of moments, as seen along the three axes.

    Clouds of one name look alike in all rows. Those of many samples are thinned evenly in time; dashes outline the
    convex hull of all samples, above all points, so that a cloud that lies under another is seen.

    Args:
        clouds: By the title of a row, names and forces or moments of its clouds, drawn in this order; shape (n, 3);
            N or N m. A sample with a component that is not a finite number is left out.
        quantity: What they are, `force` or `moment`; of wrenches (n, 6) the first or the last three columns.

    Returns:
        The figure, a row of three views per title.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no rows, one has no clouds, a cloud is empty or of another shape, or the quantity is
            another.
    """
    if quantity not in _LABELS:
        raise ShapeError(f"quantity: expected one of {list(get_args(Quantity))}, got {quantity!r}")
    rows = _checked(clouds)
    names = list(dict.fromkeys(name for named in rows.values() for name, _ in named))
    styles = looks(names)
    figure = new_figure(ROW_INCHES[1] * len(rows))
    grid = figure.subplots(len(rows), 3, squeeze=False)
    labels = _LABELS[quantity]
    for panels, (title, named) in zip(grid, rows.items(), strict=True):
        for panel, plane in zip(panels, PLANES, strict=True):
            _draw_force_plane(panel, [(styles[name], points[:, plane]) for name, points in named])
            panel.set(xlabel=labels[plane[0]], ylabel=labels[plane[1]])
        panels[0].set_title(shown_name(title), loc="left")
    legend_below(figure, [(shown_name(name), style.key) for name, style in styles.items()])
    largest = {
        (name, title): float(np.linalg.norm(points, axis=1).max(initial=0.0))
        for title, named in rows.items()
        for name, points in named
    }
    name, title = max(largest, key=largest.__getitem__)
    unit = labels[0].partition(", ")[2]
    headline(figure, f"Largest {quantity}: {largest[name, title]:.3g} {unit} ({shown_name(name)}, {shown_name(title)})")
    return figure


def _checked(clouds: Mapping[str, Sequence[tuple[str, Any]]]) -> dict[str, list[tuple[str, FloatArray]]]:
    """Clouds of every row without the samples that are not whole."""
    if not clouds:
        raise ShapeError("clouds: expected at least one row of clouds to draw, got none")
    rows = {}
    for title, named in clouds.items():
        if not named:
            raise ShapeError(f"clouds[{title!r}]: expected at least one cloud to draw, got none")
        drawables = [
            (name, drawable(points, name=f"clouds[{title!r}], {name!r}", shape=(None, 3))) for name, points in named
        ]
        rows[title] = [(name, points[np.isfinite(points).all(axis=1)]) for name, points in drawables]
    return rows


def _draw_force_plane(panel: Axes, clouds: list[tuple[Look, FloatArray]]) -> None:
    for style, points in clouds:
        panel.plot(
            *thinned_cloud(points, CLOUD_POINTS).T,
            style.marker,
            color=style.colour,
            markersize=2.4,
            markeredgewidth=0.0,
            alpha=0.5,
        )
    for style, points in clouds:
        panel.plot(*outline(points).T, color=style.colour, linestyle=style.dashes, linewidth=1.2, zorder=3.0)
    panel.set_aspect("equal", adjustable="datalim")
    panel.grid(visible=True, color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


_LINE_INCHES, _GAP_INCHES, _HEAD_INCHES = 0.135, 0.06, 1.1
"""Height of a line, of what separates two groups, and of all but the lines; inch."""
_LEAST_INCHES, _MOST_INCHES = 3.2, 400.0
"""Bounds of the height of the panels, so that few lines do not crowd and matplotlib can still write the file; inch."""
_SCREEN_INCHES = 8.0
"""Height beyond which one end of an axis is not seen from the other; inch."""
_UNKNOWN = "0.55"
"""Colour of what is not identifiable."""
_TRIAL, _MEAN, _POOLED = look(0), look(1), look(2)
_MARGIN = 1.08
"""Width of a panel, relative to the largest number that is known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Line:
    """A number with its interval, kg."""

    kind: str
    index: float
    low: float
    high: float
    known: bool


@in_figure_style
def index_figure(groups: Sequence[TrialGroup]) -> Figure:
    """Draw the performance indices of groups of trials, with their intervals, the smallest on top.

    Left by the fits with the model, right without; a panel that has nothing is left out. Each group has a line for
    every trial and, where there are several, one for their mean and one for the pooled fit. What is not identifiable is
    hollow and grey; groups of which nothing is identifiable come last, in the order that they were given in.

    Returns:
        The figure, as high as it has lines.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no group.
    """
    if not groups:
        raise ShapeError("indices: expected at least one group to draw, got none")
    ordered = sorted(groups, key=_place)
    modes = [mode for mode in (True, False) if any(_lines(group, with_model=mode) for group in groups)]
    tops = np.cumsum([0.0, *(_height(group) for group in ordered)])
    inches = float(tops[-1])
    scale = min(max(1.0, _LEAST_INCHES / inches), _MOST_INCHES / inches)
    figure = new_figure(_HEAD_INCHES + inches * scale)
    panels = figure.subplots(1, len(modes), sharey=True, squeeze=False)[0]
    for panel, mode in zip(panels, modes, strict=True):
        words = "with the model" if mode else "without the model"
        panel.set_title(f"index {words}", loc="left")
        panel.set(
            xlabel="index, kg",
            xlim=(0.0, _reach([line for group in groups for line in _lines(group, with_model=mode)])),
        )
        for k, (group, top) in enumerate(zip(ordered, tops[:-1], strict=True)):
            if k % 2:
                panel.axhspan(top, tops[k + 1], color=SHADE, linewidth=0.0, zorder=0)
            _draw(panel, _lines(group, with_model=mode), float(top))
        panel.grid(visible=True, axis="x", color=GRID, linewidth=0.6)
        panel.set_axisbelow(True)
        panel.tick_params(axis="y", length=0.0)
        panel.tick_params(axis="x", labeltop=inches > _SCREEN_INCHES)
    panels[0].set_ylim(inches, 0.0)
    panels[0].set_yticks(0.5 * (tops[:-1] + tops[1:]), _names(ordered))
    legend_below(figure, _index_keys(groups))
    headline(figure, _least_index(ordered))
    return figure


def _least_index(ordered: Sequence[TrialGroup]) -> str:
    """The first of the groups in order, by the fit that it has its place from."""
    for words, index in zip(("with the model", "without the model"), _place(ordered[0]), strict=True):
        if np.isfinite(index):
            return f"Least index {words}: {two_digits(index)} kg ({_names(ordered)[0]})"
    return "No index is identifiable"


def _place(group: TrialGroup) -> tuple[float, float]:
    with_model, without = (group.index(with_model=mode) for mode in (True, False))
    return np.inf if with_model is None else with_model, np.inf if without is None else without


def _height(group: TrialGroup) -> float:
    count = len(group.trials)
    return _GAP_INCHES + _LINE_INCHES * (count + 2 if count > 1 else 1)


def _lines(group: TrialGroup, *, with_model: bool) -> list[_Line]:
    fits = [(trial.gravity, trial.fit(with_model=with_model)) for trial in group.trials]
    lines = [_line("trial", fit, gravity) for gravity, fit in fits if fit is not None]
    indices = group.identifiable_indices(with_model=with_model)
    pooled = group.pooled_fit(with_model=with_model)
    if len(group.trials) > 1 and indices:
        mean, low, high = mean_of_trials(indices)
        lines.append(_Line(kind="mean", index=mean, low=low, high=high, known=True))
    if pooled is not None:
        lines.append(_line("pooled", pooled, group.first.gravity))
    return lines


def _line(kind: str, fit: EllipsoidFit, gravity: float) -> _Line:
    return _Line(
        kind=kind,
        index=fit.index / gravity,
        low=fit.index_low / gravity,
        high=fit.index_high / gravity,
        known=fit.identifiable,
    )


def _reach(lines: Sequence[_Line]) -> float:
    """Right end of a panel: what is known decides, else what is there; intervals may go beyond it."""
    known = [line.index for line in lines if line.known]
    known += [line.high for line in lines if line.known and line.kind != "mean" and np.isfinite(line.high)]
    shown = known or [line.index for line in lines if np.isfinite(line.index)]
    return _MARGIN * max([*shown, 0.05])


def _draw(panel: Axes, lines: Sequence[_Line], top: float) -> None:
    right = panel.get_xlim()[1]
    for k, line in enumerate(lines):
        y = top + 0.5 * _GAP_INCHES + (k + 0.5) * _LINE_INCHES
        style = {"trial": _TRIAL, "mean": _MEAN, "pooled": _POOLED}[line.kind]
        colour = style.colour if line.known else _UNKNOWN
        dashes = "-" if line.known else ":"
        panel.plot([line.low, min(line.high, right)], [y, y], linestyle=dashes, color=colour, linewidth=1.1)
        if line.high > right:
            panel.plot([right], [y], ">", color=colour, markersize=4.0, markeredgewidth=0.0, clip_on=False)
        if np.isfinite(line.index) and line.index <= right:
            face = colour if line.known else PAPER
            panel.plot(
                [line.index],
                [y],
                style.marker,
                color=colour,
                markerfacecolor=face,
                markersize=5.0,
                zorder=3,
                clip_on=False,
            )


def _names(groups: Sequence[TrialGroup]) -> list[str]:
    """Names of groups, by what tells them apart."""
    sensors = {group.first.sphere.sensor for group in groups}
    candidates = short_names([group.first.sphere.calibration for group in groups])
    names = []
    for group in groups:
        sphere = group.first.sphere
        words = [f"{sphere.sensor} ({sphere.serial})" if len(sensors) > 1 else sphere.serial]
        if group.first.condition is not None:
            words.append(group.first.condition)
        if len(candidates) > 1:
            words.append(candidates[sphere.calibration])
        names.append(shown_name(", ".join(words)))
    return names


def _index_keys(groups: Sequence[TrialGroup]) -> list[tuple[str, dict[str, Any]]]:
    keys: list[tuple[str, dict[str, Any]]] = [("trial, 95 % interval", _key(_TRIAL.colour, _TRIAL.marker))]
    if any(len(group.trials) > 1 for group in groups):
        keys.append(("mean of the trials, from their scatter", _key(_MEAN.colour, _MEAN.marker)))
        keys.append(("pooled fit, 95 % interval", _key(_POOLED.colour, _POOLED.marker)))
    lines = [line for group in groups for mode in (True, False) for line in _lines(group, with_model=mode)]
    if any(not line.known for line in lines):
        unknown = {"color": _UNKNOWN, "linestyle": ":", "marker": "o", "markerfacecolor": PAPER}
        keys.append(("not identifiable", unknown))
    return keys


def _key(colour: str, marker: str) -> dict[str, Any]:
    return {"color": colour, "linestyle": "-", "marker": marker, "markersize": 5.0}
