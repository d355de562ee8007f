# SPDX-License-Identifier: BSD-3-Clause
"""Figure of how a fitted matrix approaches its prior as lambda rises."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from forcetorque.arrays import FloatArray
from forcetorque.report.figures.canvas import ROW_INCHES, legend_below, look, new_figure, shown_name
from forcetorque.report.figures.inputs import drawable_each
from forcetorque.report.figures.lambda_axis import (
    LAMBDA_LABEL,
    LAMBDA_MEANING,
    draw_curves,
    rising_lambdas,
    set_lambda_axis,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lambda_difference_figure(lambdas: FloatArray, curves: Mapping[str, FloatArray], *, unit: str) -> Figure:
    """Draw the difference to the Workbench matrix over lambda [1].

    Curves that coincide are dashed in turn, and their points take turns, so that each is seen.

    Args:
        lambdas: Those of equation (5.4) of [1], at least 0, in any order; shape (l,); counts2.
        curves: Difference to the Workbench matrix by estimation type; shape (l,); in `unit`. What is not a finite
            number breaks the curve.
        unit: Unit of the difference with its power of ten, such as `1e-4 N/count`.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no curves or no lambdas, the shapes differ, or a lambda is negative or not finite.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 5.4.
    """
    rising, order = rising_lambdas(lambdas)
    lines = drawable_each(curves, name="curves", shape=(len(rising),))
    figure = new_figure(1.4 * ROW_INCHES[1])
    panel = figure.add_subplot()
    looks = [look(k) for k in range(len(lines))]
    draw_curves(panel, rising, [values[order] for values in lines.values()], looks)
    set_lambda_axis(panel, rising)
    panel.set_xlabel(LAMBDA_LABEL)
    panel.set_ylabel(f"difference to the Workbench matrix, {shown_name(unit)}")
    panel.set_ylim(bottom=min(0.0, panel.get_ylim()[0]))
    legend_below(
        figure, [(shown_name(name), style.key) for name, style in zip(lines, looks, strict=True)], title=LAMBDA_MEANING
    )
    return figure
