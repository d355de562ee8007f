# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the torques of a calibration device's motors over its motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.analysis.device_demand_rows import MotorRow
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

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LINES = (("torque", "-", 1.4), ("peak", ":", 1.0), ("average (6.1)", "--", 1.0))


def motor_figure(time_s: FloatArray, torques: FloatArray, motors: Sequence[MotorRow]) -> Figure:
    """Draw torques over time, with peak and average of each motor [1].

    Args:
        time_s: Instants; shape (n,); s.
        torques: Torques; shape (n, m); N m.
        motors: What the m motors bear.

    Returns:
        The figure, a row per motor.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 6.9.
    """
    figure = new_figure(0.7 * ROW_INCHES[1] * len(motors))
    panels = figure.subplots(len(motors), 1, squeeze=False, sharex=True)[:, 0]
    for k, (panel, motor) in enumerate(zip(panels, motors, strict=True)):
        panel.plot(time_s, torques[:, k], color=look(0).colour, linestyle=_LINES[0][1], linewidth=_LINES[0][2])
        for value, (_, dashes, width) in zip((motor.peak_Nm, motor.average_Nm), _LINES[1:], strict=True):
            for line in () if value is None else (-value, value):
                panel.axhline(line, color=REFERENCE_COLOUR, linestyle=dashes, linewidth=width)
        panel.set_ylabel(shown_name(f"{motor.joint}, N m"), fontsize=TITLE_POINTS)
        panel.set_ylim(*(1.15 * max(motor.peak_Nm, float(np.abs(torques[:, k]).max())) * np.array([-1.0, 1.0])))
        panel.tick_params(labelsize=SMALL_POINTS)
    panels[-1].set_xlabel("time, s", fontsize=TITLE_POINTS)
    colours = (look(0).colour, REFERENCE_COLOUR, REFERENCE_COLOUR)
    legend_below(
        figure,
        [
            (name, {"color": colour, "linestyle": dashes, "linewidth": width})
            for colour, (name, dashes, width) in zip(colours, _LINES, strict=True)
        ],
    )
    return figure
