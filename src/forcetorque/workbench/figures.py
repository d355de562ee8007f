# SPDX-License-Identifier: BSD-3-Clause
"""Figure of forces on the spheres of their loads, and of their errors along each axis."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.results.figure_style import (
    REFERENCE_COLOUR,
    ROW_INCHES,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
    two_digits,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_PLANES = ((0, 1), (1, 2), (2, 0))
_AXES = ("x", "y", "z")
_BINS = 30


@in_figure_style
def bench_figure(picture: Mapping[str, tuple[FloatArray, FloatArray]] | None) -> Figure:
    """Draw positions of a workbench, grouped by load [1].

    Args:
        picture: Of every load forces over its weight, shape (k, 3), and errors, shape (k, 6), N, N m, of one sensor or
            of many; None where there are none.

    Returns:
        The figure: forces seen along each axis, against the circle on which they should lie, and below a histogram of
        the errors of each component of the force.

    Raises:
        ForceTorqueError: If there is nothing to draw.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figures 6.3 and 6.4.
    """
    if picture is None:
        raise ForceTorqueError(
            "figure: expected measurements that determine a matrix of six components, there are none to draw"
        )
    figure = new_figure(2.6 * ROW_INCHES[1])
    above, below = figure.subplots(2, 3)
    for panel, (first, second) in zip(above, _PLANES, strict=True):
        _project(panel, picture, first, second)
    for panel, axis in zip(below, range(3), strict=True):
        _histogram(panel, picture, axis)
    legend_below(figure, [(shown_name(name), look(k).key) for k, name in enumerate(picture)])
    largest = [np.linalg.norm(errors[:, :3], axis=1).max(initial=0.0) for _, errors in picture.values()]
    worst = int(np.argmax(largest))
    message = f"Largest error of the force at a position: {two_digits(largest[worst])} N"
    headline(figure, f"{message} ({shown_name(list(picture)[worst])})")
    return figure


def _project(panel: Axes, picture: Mapping[str, tuple[FloatArray, FloatArray]], first: int, second: int) -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 181)
    panel.plot(np.cos(angle), np.sin(angle), color=REFERENCE_COLOUR, linewidth=0.8)
    for k, (forces, _) in enumerate(picture.values()):
        kind = look(k)
        panel.plot(
            forces[:, first],
            forces[:, second],
            linestyle="none",
            marker=kind.marker,
            markersize=4.0,
            alpha=0.6,
            color=kind.colour,
        )
    panel.set_aspect("equal", adjustable="datalim")
    panel.set(title="force over the weight", xlabel=f"f{_AXES[first]}", ylabel=f"f{_AXES[second]}")


def _histogram(panel: Axes, picture: Mapping[str, tuple[FloatArray, FloatArray]], axis: int) -> None:
    all_errors = np.concatenate([errors[:, axis] for _, errors in picture.values()])
    largest = max(float(np.abs(all_errors).max()), 1e-9)
    edges = np.linspace(-largest, largest, _BINS + 1).tolist()
    for k, (_, errors) in enumerate(picture.values()):
        kind = look(k)
        panel.hist(errors[:, axis], bins=edges, histtype="step", color=kind.colour, linestyle=kind.dashes)
    panel.set(title=f"error of f{_AXES[axis]}", xlabel="measured less known, N", ylabel="positions")
