# SPDX-License-Identifier: BSD-3-Clause
"""Figure of contacts on skin: the field of pressure on the patch, and forces over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.analysis.skin.contact_rows import SkinWrenchPicture
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

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_REFERENCE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": "-"}


def skin_wrench_figure(picture: SkinWrenchPicture, reference: FloatArray | None = None) -> Figure:
    """Draw the pressures of a patch, laid flat, when the force was largest [1], and forces over time [2].

    Args:
        picture: Forces over time, and one field of pressure.
        reference: What the force truly is, where that is known; shape (k,); N.

    Returns:
        The figure, one row.

    Raises:
        MissingExtraError: If matplotlib is not installed.

    References:
        F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019): [1] figure 7.9; [2] figure 7.11.
    """
    figure = new_figure(ROW_INCHES[1])
    field, lines = figure.subplots(1, 2, width_ratios=(2.0, 3.0))
    _draw_field(figure, field, picture)
    _draw_forces(lines, picture, reference)
    keys = [(shown_name(name), _style(k)) for k, name in enumerate(picture.forces)]
    legend_below(figure, [*keys, *([] if reference is None else [("true force", _REFERENCE)])])
    return figure


def _draw_field(figure: Figure, panel: Axes, picture: SkinWrenchPicture) -> None:
    from matplotlib.tri import Triangulation

    across, along = 1e3 * picture.places.T
    facets = Triangulation(across, along, picture.triangles)
    drawn = panel.tripcolor(facets, picture.pressed_kPa, shading="gouraud", cmap="cividis")
    panel.plot(across, along, linestyle="none", marker=".", markersize=1.5, color="#FFFFFF")
    bar = figure.colorbar(drawn, ax=panel)
    bar.set_label("pressure, kPa", fontsize=TITLE_POINTS)
    bar.ax.tick_params(labelsize=SMALL_POINTS)
    panel.set_aspect("equal")
    panel.set_xlabel("around, mm", fontsize=TITLE_POINTS)
    panel.set_ylabel("along, mm", fontsize=TITLE_POINTS)
    panel.set_title(f"{shown_name(picture.patch)} at {picture.pressed_s:.1f} s", fontsize=TITLE_POINTS, loc="left")
    panel.tick_params(labelsize=SMALL_POINTS)


def _draw_forces(panel: Axes, picture: SkinWrenchPicture, reference: FloatArray | None) -> None:
    if reference is not None:
        time, drawn = thinned_line(picture.seconds, np.asarray(reference)[:, None])
        panel.plot(time, drawn[:, 0], linewidth=1.4, **_REFERENCE)
    for k, force in enumerate(picture.forces.values()):
        time, drawn = thinned_line(picture.seconds, force[:, None])
        panel.plot(time, drawn[:, 0], linewidth=1.4, **_style(k))
    panel.set_xlabel("time, s", fontsize=TITLE_POINTS)
    panel.set_ylabel("force, N", fontsize=TITLE_POINTS)
    panel.tick_params(labelsize=SMALL_POINTS)


def _style(k: int) -> dict[str, Any]:
    return {"color": look(k).colour, "linestyle": look(k).dashes}
