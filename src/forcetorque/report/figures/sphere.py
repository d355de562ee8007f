# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the forces that a sensor read, the ellipsoid through them, and the sphere that the model has."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.analysis import SensorSphere
from forcetorque.arrays import FloatArray
from forcetorque.errors import ShapeError
from forcetorque.evaluation.sphere import Ellipsoid
from forcetorque.report.figures.canvas import (
    PLANES,
    REFERENCE_COLOUR,
    ROW_INCHES,
    TITLE_POINTS,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.report.figures.thinning import thinned_cloud
from forcetorque.result.names import short_names
from forcetorque.spatial.wrench import WRENCH_COMPONENTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_OUTLINE_POINTS = 181
_MAPPED, _FREE = look(1), look(2)
_FEW = 300
"""Points that can be told apart one by one."""
_FAR = 2.5
"""An outline that is so many times larger than the cloud would hide it and is not drawn."""


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
    names = short_names([sphere.candidate for sphere in spheres])
    figure = new_figure(ROW_INCHES[1] * len(spheres))
    rows = figure.subplots(len(spheres), 3, squeeze=False)
    for panels, sphere in zip(rows, spheres, strict=True):
        centre = _centre(sphere)
        for panel, plane in zip(panels, PLANES, strict=True):
            _draw_plane(panel, sphere, centre, plane)
        panels[0].set_title(
            shown_name(f"{sphere.sensor} ({sphere.serial}), {names[sphere.candidate]}"),
            loc="left",
            fontsize=TITLE_POINTS,
        )
    legend_below(figure, _keys(spheres))
    return figure


def _keys(spheres: Sequence[SensorSphere]) -> list[tuple[str, dict[str, Any]]]:
    keys: list[tuple[str, dict[str, Any]]] = [("forces read", {**look(0).key, "linestyle": "none"})]
    if any(sphere.analysis.mapped is not None for sphere in spheres):
        keys.append(("ellipsoid with the model", {"color": _MAPPED.colour, "linestyle": _MAPPED.dashes}))
    keys.append(("ellipsoid without the model", {"color": _FREE.colour, "linestyle": _FREE.dashes}))
    if any(not fit.tilt_identifiable for sphere in spheres for fit in _fits(sphere)):
        keys.append(("not identifiable", {"color": "0.5", "linestyle": ":"}))
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
        shift: FloatArray = (sphere.force - sphere.reference).mean(axis=0)
        return shift
    if analysis.radius.centre is not None:
        return analysis.radius.centre
    middle: FloatArray = sphere.force.mean(axis=0)
    return middle


def _draw_plane(panel: Axes, sphere: SensorSphere, centre: FloatArray, plane: tuple[int, int]) -> None:
    force = thinned_cloud(sphere.force - centre)[:, plane]
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
    panel.grid(visible=True, color="0.9", linewidth=0.6)
    panel.set_axisbelow(True)
    panel.set_xlabel(f"{WRENCH_COMPONENTS[plane[0]]}, N")
    panel.set_ylabel(f"{WRENCH_COMPONENTS[plane[1]]}, N")


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
    outline: FloatArray = ellipsoid.centre[list(plane)] + _circle() @ np.linalg.cholesky(shadow).T
    return outline


def _circle() -> FloatArray:
    angle = np.linspace(0.0, 2.0 * np.pi, _OUTLINE_POINTS)
    return np.column_stack([np.cos(angle), np.sin(angle)])
