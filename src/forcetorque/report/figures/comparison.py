# SPDX-License-Identifier: BSD-3-Clause
"""Figure of measured wrenches against what mechanics demands."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from forcetorque.arrays import FloatArray
from forcetorque.report.figures.canvas import (
    REFERENCE_LINE,
    ROW_INCHES,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.report.figures.inputs import drawable, drawable_each, instants
from forcetorque.report.figures.thinning import thinned_line
from forcetorque.report.figures.time_lines import draw_over_time
from forcetorque.report.figures.wrench_size import rms_words
from forcetorque.spatial.wrench import WRENCH_COMPONENTS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_ROW_HEIGHT = 0.7 * ROW_INCHES[1]


def comparison_figure(time_s: FloatArray, reference: FloatArray, candidates: Mapping[str, FloatArray]) -> Figure:
    """Draw the wrench that sensors or calibrations measure against the reference, component by component [1].

    The reference is dashed in black above the others: noise does not hide it, and what agrees with it is seen between
    the dashes. The legend states the root mean square, over time, of the norm of the difference.

    Args:
        time_s: Instants, not falling; shape (n,); s.
        reference: Wrench that mechanics demands; shape (n, 6); N, N m.
        candidates: Measured wrenches by what measured them; shape (n, 6); N, N m. What is not a finite number breaks
            the line.

    Returns:
        The figure, a column for forces and one for torques.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no candidates or no samples, the shapes differ, or time falls.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 5.9.
    """
    time = instants(time_s)
    known = drawable(reference, name="reference", shape=(len(time), 6))
    by_name = drawable_each(candidates, name="candidates", shape=(len(time), 6))
    figure = new_figure(3 * _ROW_HEIGHT)
    panels = figure.subplots(3, 2, sharex=True).T.ravel()
    at, lines = thinned_line(time, known)
    for panel, component, line in zip(panels, WRENCH_COMPONENTS, lines.T, strict=True):
        panel.plot(at, line, zorder=3.0, **REFERENCE_LINE)
        panel.set_ylabel(f"{component}, {'N' if component.startswith('f') else 'N m'}")
        panel.grid(visible=True, color="0.9", linewidth=0.6)
        panel.set_axisbelow(True)
        panel.margins(x=0.01)
    keys = [("reference", REFERENCE_LINE)]
    for k, (name, values) in enumerate(by_name.items()):
        at, lines = thinned_line(time, values)
        for panel, line in zip(panels, lines.T, strict=True):
            draw_over_time(panel, at, line, look(k), turn=k, count=len(by_name))
        text = f"{shown_name(name)}: {_difference(values - known)}"
        keys.append((text, look(k).key | {"linestyle": "-"}))
    for panel in panels[2::3]:
        panel.set_xlabel("time, s")
    figure.align_ylabels()
    legend_below(figure, keys)
    return figure


def _difference(error: FloatArray) -> str:
    size = rms_words(error)
    return "no samples" if size is None else f"rms difference {size}"
