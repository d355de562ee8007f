# SPDX-License-Identifier: BSD-3-Clause
"""Figure of clouds of forces, or of moments, as seen along the three axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, Literal, get_args

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import ShapeError
from forcetorque.report.figures.canvas import (
    PLANES,
    ROW_INCHES,
    TITLE_POINTS,
    Look,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.report.figures.inputs import drawable
from forcetorque.report.figures.thinning import thinned_cloud
from forcetorque.report.figures.wrench_space import outline
from forcetorque.spatial.wrench import WRENCH_COMPONENTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Quantity = Literal["force", "moment"]
"""What the clouds are of."""

_LABELS: Final[dict[Quantity, list[str]]] = {
    "force": [f"{name}, N" for name in WRENCH_COMPONENTS[:3]],
    "moment": [f"{name}, N m" for name in WRENCH_COMPONENTS[3:]],
}


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
    looks = {name: look(k) for k, name in enumerate(names)}
    figure = new_figure(ROW_INCHES[1] * len(rows))
    grid = figure.subplots(len(rows), 3, squeeze=False)
    labels = _LABELS[quantity]
    for panels, (title, named) in zip(grid, rows.items(), strict=True):
        for panel, plane in zip(panels, PLANES, strict=True):
            _draw_plane(panel, [(looks[name], points[:, plane]) for name, points in named])
            panel.set_xlabel(labels[plane[0]])
            panel.set_ylabel(labels[plane[1]])
        panels[0].set_title(shown_name(title), fontsize=TITLE_POINTS, loc="left")
    legend_below(figure, [(shown_name(name), style.key) for name, style in looks.items()])
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


def _draw_plane(panel: Axes, clouds: list[tuple[Look, FloatArray]]) -> None:
    for style, points in clouds:
        panel.plot(
            *thinned_cloud(points).T, style.marker, color=style.colour, markersize=2.4, markeredgewidth=0.0, alpha=0.5
        )
    for style, points in clouds:
        panel.plot(*outline(points).T, color=style.colour, linestyle=style.dashes, linewidth=1.2, zorder=3.0)
    panel.set_aspect("equal", adjustable="datalim")
    panel.grid(visible=True, color="0.9", linewidth=0.6)
    panel.set_axisbelow(True)
