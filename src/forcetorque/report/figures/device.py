# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the motion of a calibration device, and of what its axes bear."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.report.figures.canvas import (
    ROW_INCHES,
    SMALL_POINTS,
    TITLE_POINTS,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.report.figures.inputs import drawable_each, instants
from forcetorque.report.figures.thinning import thinned_line
from forcetorque.report.figures.time_lines import draw_over_time
from forcetorque.robot import JointMotion

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def device_figure(time_s: FloatArray, motion: JointMotion, torques: Mapping[str, FloatArray]) -> Figure:
    """Draw positions of joints, and torques on their axes, over time [1].

    Args:
        time_s: Instants that do not fall; shape (n,); s.
        motion: Motion of the joints at them; rad.
        torques: Torques by joint; shape (n,) each; N m.

    Returns:
        The figure, a panel for positions and one for torques.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is nothing to draw, or the shapes differ.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figures 6.5 and 6.9.
    """
    time = instants(time_s)
    positions = dict(zip(motion.names, np.rad2deg(motion.position).T, strict=True))
    rows = {"position, deg": positions, "torque, N m": torques}
    figure = new_figure(1.4 * ROW_INCHES[1])
    panels = figure.subplots(len(rows), 1, sharex=True)
    for panel, (label, lines) in zip(panels, rows.items(), strict=True):
        drawable_lines = drawable_each(lines, name=label, shape=(len(time),))
        for number, values in enumerate(drawable_lines.values()):
            at, drawn = thinned_line(time, values[:, None])
            draw_over_time(panel, at, drawn[:, 0], look(number), turn=number, count=len(drawable_lines))
        panel.set_ylabel(label, fontsize=TITLE_POINTS)
        panel.tick_params(labelsize=SMALL_POINTS)
    panels[-1].set_xlabel("time, s", fontsize=TITLE_POINTS)
    figure.align_ylabels()
    keys = [(shown_name(name), look(number).key | {"linestyle": "-"}) for number, name in enumerate(positions)]
    legend_below(figure, keys)
    return figure
