# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the errors of a calibration device's references, by what tells gravity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.analysis.device.demand_rows import GradeRow
from forcetorque.arrays import FloatArray
from forcetorque.exsitu.device import FORCE_LIMIT_N, MOMENT_LIMIT_NM
from forcetorque.report.figures.canvas import (
    REFERENCE_COLOUR,
    ROW_INCHES,
    SMALL_POINTS,
    TITLE_POINTS,
    legend_below,
    look,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIZES = ("root mean square", "largest, one off alone", "largest component, all off", "largest norm, all off")


def reference_error_figure(grades: Sequence[GradeRow]) -> Figure:
    """Draw root mean squares and largest errors of forces and moments against what requirement 6 allows.

    Args:
        grades: Errors by grade.

    Returns:
        The figure: forces, and below moments.
    """
    ordered = sorted(grades, key=lambda row: (row.gravity_by, row.full_width))
    figure = new_figure(1.5 * ROW_INCHES[1])
    above, below = figure.subplots(2, 1, sharex=True)
    forces = [[row.rms[:3].max(), row.one_force_N, row.largest_force_N, row.force_norm_N] for row in ordered]
    moments = [[row.rms[3:].max(), row.one_moment_Nm, row.largest_moment_Nm, row.moment_norm_Nm] for row in ordered]
    _draw(above, np.array(forces), FORCE_LIMIT_N, "error of the force, N")
    _draw(below, np.array(moments), MOMENT_LIMIT_NM, "error of the moment, N m")
    below.set_xticks(
        range(len(ordered)),
        [f"{row.gravity_by}\n±{row.plus_minus:g} {row.unit}" for row in ordered],
        fontsize=SMALL_POINTS,
    )
    legend_below(
        figure,
        [
            *(
                (name, {"color": look(k).colour, "marker": look(k).marker, "linestyle": "none"})
                for k, name in enumerate(_SIZES)
            ),
            ("requirement 6", {"color": REFERENCE_COLOUR, "linestyle": "--"}),
        ],
    )
    return figure


def _draw(panel: Axes, errors: FloatArray, limit: float, label: str) -> None:
    from matplotlib.ticker import LogLocator, NullLocator

    for k in range(errors.shape[1]):
        places = np.arange(len(errors)) + 0.12 * (k - 1.5)
        panel.plot(places, errors[:, k], linestyle="none", marker=look(k).marker, color=look(k).colour, markersize=6.0)
    panel.axhline(limit, color=REFERENCE_COLOUR, linestyle="--", linewidth=1.0)
    panel.set_yscale("log")
    panel.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    panel.yaxis.set_major_formatter("{x:g}")
    panel.yaxis.set_minor_locator(NullLocator())
    panel.set_ylabel(label, fontsize=TITLE_POINTS)
    panel.tick_params(labelsize=SMALL_POINTS)
