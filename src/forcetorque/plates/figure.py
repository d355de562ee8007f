# SPDX-License-Identifier: BSD-3-Clause
"""Figures of force plates: forces and centres of pressure at rest, and errors of the centre before and after a fit."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.results.figures import (
    COLOURS,
    REFERENCE_COLOUR,
    REFERENCE_LINE,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
    two_digits,
)
from forcetorque.results.number_text import plus_minus

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from forcetorque.plates.calibration_result import PlatePicture, PlateRow, PlateWeight

_LONGEST = 0.24
"""Length of the longest line, as a share of the longer half-edge."""
_LOAD = {"color": REFERENCE_COLOUR, "linestyle": "none", "marker": "o", "markersize": 3.0}

_EDGES: dict[str, Any] = {"color": REFERENCE_COLOUR, "linewidth": 0.8}
_COLUMNS, _HEIGHT_INCHES = 4, 3.4
"""Panels in a row, and its height; inch."""
_AROUND_MM = 100.0
"""What is shown at least on each side of the centre of a plate; mm."""


@in_figure_style
def standing_figure(weight: PlateWeight) -> Figure:
    """Draw the force on every plate beside the weight, and where it acts.

    Args:
        weight: Who or what stands on the plates.

    Returns:
        The figure: a panel of forces, and one per loaded plate with its edges, its centre of pressure and the sway.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    loaded = [row for row in weight.plates if row.centre_mm is not None]
    rows = math.ceil((1 + len(loaded)) / _COLUMNS)
    figure = new_figure(_HEIGHT_INCHES * rows)
    grid = figure.subplots(rows, min(1 + len(loaded), _COLUMNS), squeeze=False).ravel()
    forces, *panels = grid
    style = look(0)
    forces.bar([str(row.plate) for row in weight.plates], [row.force_N for row in weight.plates], color=style.colour)
    forces.axhline(weight.mass_kg * weight.gravity, **REFERENCE_LINE)
    forces.margins(y=0.1)
    forces.set_title("force across the surface, N", loc="left")
    forces.set_xlabel("plate")
    for panel, row in zip(panels, loaded, strict=False):
        _draw_standing(panel, row)
    for panel in panels[len(loaded) :]:
        panel.set_visible(False)
    doubts = len(weight.contradictions)
    shares = ", ".join(f"plate {row.plate} {row.force_N:.0f} N" for row in loaded[:_COLUMNS])
    headline(
        figure,
        f"{plus_minus(weight.mass_kg, weight.half_width_95_kg, 'kg')}: {shares}; "
        + (f"{doubts} contradiction{'s' * (doubts > 1)}" if doubts else "no contradiction"),
    )
    keys = [
        ("weight", REFERENCE_LINE),
        ("centre of pressure", {"color": style.colour, "marker": style.marker, "linestyle": "none"}),
        ("its sway, root mean square", {"color": style.colour, "linewidth": 1.2}),
        ("edges of the plate; +: its centre", _EDGES),
    ]
    legend_below(figure, keys)
    return figure


def _draw_standing(panel: Axes, row: PlateRow) -> None:
    style, centre, turn = look(0), np.array(row.centre_mm), np.linspace(0.0, 2.0 * np.pi, 60)
    panel.plot(*centre, color=style.colour, marker=style.marker, linestyle="none", markersize=3.0)
    panel.plot(0.0, 0.0, color=REFERENCE_COLOUR, marker="+", linestyle="none")
    panel.update_datalim([(-_AROUND_MM, -_AROUND_MM), (_AROUND_MM, _AROUND_MM)])
    sway = centre + (row.sway_mm or 0.0) * np.column_stack([np.cos(turn), np.sin(turn)])
    panel.plot(*sway.T, color=style.colour, linewidth=1.2)
    if row.half_edges_mm is not None:
        _draw_edges(panel, row.half_edges_mm)
    panel.set_aspect("equal", adjustable="datalim")
    panel.set(
        title=f"plate {row.plate}: ({centre[0]:.0f}, {centre[1]:.0f}) mm, sway {row.sway_mm or 0.0:.1f} mm",
        xlabel="x of the plate, mm",
        ylabel="y of the plate, mm",
    )


def _draw_edges(panel: Axes, half_edges_mm: FloatArray) -> None:
    x, y = half_edges_mm
    panel.plot([-x, x, x, -x, -x], [-y, -y, y, y, -y], **_EDGES)


@in_figure_style
def centre_error_figure(picture: PlatePicture) -> Figure:
    """Draw the error of the centre of pressure at every load.

    Args:
        picture: Places of the loads, and errors.

    Returns:
        The figure: lines from where a load acts to the centre of pressure, enlarged as the title says, as measured and
        with the calibration by all other loads.
    """
    figure = new_figure(4.2)
    extent = np.abs(picture.place_mm).max(axis=0) if picture.half_edges_mm is None else picture.half_edges_mm
    kinds = {"as measured": picture.before_mm, "calibrated by the other loads": picture.after_mm}
    styles = [{"color": colour, "linewidth": 1.0} for colour in COLOURS[:2]]
    for panel, (name, errors), style in zip(figure.subplots(1, 2), kinds.items(), styles, strict=True):
        largest = max(float(np.linalg.norm(errors, axis=1).max()), 1e-9)
        scale = _LONGEST * float(extent.max()) / largest
        ends = picture.place_mm + scale * errors
        for axes in zip(picture.place_mm, ends, strict=True):
            panel.plot(*np.array(axes).T, **style)
        panel.plot(*picture.place_mm.T, **_LOAD)
        _draw_edges(panel, extent)
        panel.set_aspect("equal", adjustable="datalim")
        panel.set(
            title=f"{name}: up to {two_digits(largest)} mm, drawn {two_digits(scale)} times as long",
            xlabel="x of the plate, mm",
            ylabel="y of the plate, mm",
        )
    before, after = (
        two_digits(float(np.linalg.norm(errors, axis=1).max())) for errors in (picture.before_mm, picture.after_mm)
    )
    headline(figure, f"Error of the centre of pressure: up to {before} mm as measured, {after} mm calibrated")
    words = [f"centre of pressure {name}" for name in kinds]
    keys = [("load", _LOAD), *zip(words, styles, strict=True)]
    legend_below(figure, [(shown_name(name), style) for name, style in keys])
    return figure
