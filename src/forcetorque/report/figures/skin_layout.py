# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the taxels of a patch and their normals."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.errors import ShapeError
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

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_TAXEL, _NORMAL = look(1), look(0)
_ARROW_MM = 10.0


def skin_layout_figure(positions: FloatArray, normals: Mapping[str, FloatArray]) -> Figure:
    """Draw where taxels are and which way they look: in space, and as seen along the axes of the link [1].

    Args:
        positions: Taxels in the link frame; shape (n, 3); m.
        normals: Normals by what they are, such as `as written` and `rebuilt`; shape (n, 3) each. Those that are not of
            length 1 are drawn as long as they are.

    Returns:
        The figure, a row for each.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no normals, or of another shape.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 7.8.
    """
    if not normals:
        raise ShapeError("normals: expected at least one set to draw, got none")
    require_shape(positions, name="positions", shape=(None, 3))
    figure = new_figure(1.1 * ROW_INCHES[1] * len(normals))
    # the narrow column keeps the label of the third axis clear of the next panel
    grid = figure.add_gridspec(len(normals), 5, width_ratios=(1.5, 0.1, 1.0, 1.0, 1.0))
    places = 1e3 * positions
    for row, (name, vectors) in enumerate(normals.items()):
        require_shape(vectors, name=f"normals {name}", shape=(len(positions), 3))
        arrows = _ARROW_MM * vectors
        _draw_space(figure.add_subplot(grid[row, 0], projection="3d"), places, arrows, title=name)
        for column, plane in enumerate(PLANES):
            _draw_plane(figure.add_subplot(grid[row, column + 2]), places[:, plane], arrows[:, plane], plane)
    normal_key = {"color": _NORMAL.colour, "linestyle": "-"}
    taxel_key = {"color": _TAXEL.colour, "linestyle": "none", "marker": "o", "markerfacecolor": "none"}
    legend_below(figure, [("taxels", taxel_key), (f"normals, {_ARROW_MM:g} mm long", normal_key)])
    return figure


def _draw_space(panel: Any, places: FloatArray, arrows: FloatArray, *, title: str) -> None:
    panel.plot(*places.T, "o", color=_TAXEL.colour, markersize=2.2, markeredgewidth=0.6, markerfacecolor="none")
    if arrows.any():
        panel.quiver(*places.T, *arrows.T, color=_NORMAL.colour, linewidth=0.6, arrow_length_ratio=0.3)
    panel.set_title(shown_name(title), fontsize=TITLE_POINTS)
    panel.set_box_aspect(np.maximum(np.ptp(places, axis=0), 2.0 * _ARROW_MM), zoom=0.9)
    panel.locator_params(nbins=4)
    for axis in "xyz":
        getattr(panel, f"set_{axis}label")(f"{axis}, mm")
        panel.tick_params(axis=axis, labelsize=SMALL_PANEL_POINTS)


def _draw_plane(panel: Axes, places: FloatArray, arrows: FloatArray, plane: tuple[int, int]) -> None:
    panel.plot(*places.T, "o", color=_TAXEL.colour, markersize=2.5, markeredgewidth=0.6, markerfacecolor="none")
    panel.quiver(
        *places.T, *arrows.T, color=_NORMAL.colour, angles="xy", scale_units="xy", scale=1.0, width=0.003, zorder=3.0
    )
    # an arrow is no data: without the margin those at the rim would be cut
    panel.update_datalim(np.concatenate([places - _ARROW_MM, places + _ARROW_MM]))
    panel.autoscale_view()
    panel.set_xlabel(f"{'xyz'[plane[0]]}, mm")
    panel.set_ylabel(f"{'xyz'[plane[1]]}, mm", labelpad=0.0)
    panel.set_aspect("equal", adjustable="datalim")
    panel.tick_params(labelsize=SMALL_PANEL_POINTS)
    panel.grid(visible=True, color="0.9", linewidth=0.6)
    panel.set_axisbelow(True)
