# SPDX-License-Identifier: BSD-3-Clause
"""Curves over lambda: an axis of decades on which 0 has a place, and curves that coincide all seen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import ShapeError
from forcetorque.report.canvas import Look
from forcetorque.report.inputs import drawable

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LAMBDA_LABEL = "lambda, counts²"
"""Label of the axis."""
LAMBDA_MEANING = (
    "lambda as the tables of the thesis count it: 6 lambda weighs |C - C_prior|² beside mean |f - C r - o|²"
)
"""The number means nothing without its convention."""

_ZERO_DECADES = 0.7
"""Room between lambda 0 and the smallest positive lambda; decades."""
_SAME = 0.006
"""Curves no further apart than this are seen as one; part of what the panel's height spans."""
_DASH = 12.0
"""Length of the dashes of curves that take turns; points."""
_WIDTHS, _SIZES = (1.8, 3.0), (6.5, 9.0)
"""Widths of lines and sizes of points, of the last colour and of the first; points."""


def rising_lambdas(lambdas: Any) -> tuple[FloatArray, IntArray]:
    """Check lambdas and bring them in order.

    Args:
        lambdas: Weights of the prior; shape (l,); counts2.

    Returns:
        The same, rising, and where each stood; shapes (l,), (l,).

    Raises:
        ShapeError: If the shape differs, there are none, or one is negative or not finite.
    """
    given = drawable(lambdas, name="lambdas", shape=(None,))
    if not (given >= 0.0).all():
        # NaN is not at least 0 either
        at = int(np.argmin(given >= 0.0))
        raise ShapeError(
            f"lambdas: expected finite numbers of at least 0 counts2, got {np.asarray(lambdas)[at]} at index {at}"
        )
    order = np.argsort(given, kind="stable").astype(np.int64)
    return given[order], order


def set_lambda_axis(panel: Axes, lambdas: FloatArray) -> None:
    """Give a panel an axis of decades, with 0 at its left end if it is among the lambdas.

    Args:
        panel: The panel.
        lambdas: What is drawn over; rising; shape (l,); counts2.
    """
    positive = lambdas[lambdas > 0.0]
    if len(positive) == len(lambdas):
        panel.set_xscale("log")
    elif len(positive):
        least, most = math.log10(positive[0]), math.log10(positive[-1])
        step = max(1, math.ceil((most - least) / 10.0))
        decades = [10.0**k for k in range(math.ceil(least), math.floor(most) + 1, step)]
        panel.set_xscale("symlog", linthresh=positive[0], linscale=_ZERO_DECADES)
        panel.set_xticks([0.0, *(decades or [positive[0]])])
        panel.set_xlim(-0.15 * positive[0], 10.0 ** (most + 0.02 * (most - least) + 0.05))
        panel.xaxis.set_major_formatter(_lambda_text)
    else:
        panel.set_xticks([0.0])
    panel.set_xticks([], minor=True)
    panel.grid(visible=True, color="0.9", linewidth=0.6)
    panel.set_axisbelow(True)


def _lambda_text(value: float, _: float) -> str:
    power = math.log10(value) if value > 0.0 else 0.0
    return f"$10^{{{power:.0f}}}$" if power.is_integer() and value > 0.0 else f"{value:g}"


def draw_curves(panel: Axes, lambdas: FloatArray, curves: Sequence[FloatArray], looks: Sequence[Look]) -> None:
    """Draw curves so that none hides another.

    Those of the first colour are the widest and show beside the others. Of those that coincide from end to end, each
    colour draws every other dash, and their points take turns.

    Args:
        panel: The panel, which has its vertical scale already.
        lambdas: Where the points are; rising; shape (l,); counts2.
        curves: Heights of the points; shape (l,) each.
        looks: Look of each curve.
    """
    colours = list(dict.fromkeys(style.colour for style in looks))
    groups = _coinciding(panel.get_yscale() == "log", curves)
    for k, (values, style) in enumerate(zip(curves, looks, strict=True)):
        group = next(group for group in groups if k in group)
        rest = 1.0 - colours.index(style.colour) / max(1, len(colours) - 1)
        width = _WIDTHS[0] + rest * (_WIDTHS[1] - _WIDTHS[0])
        panel.plot(
            lambdas,
            values,
            color=style.colour,
            linestyle=_dashes(k, group, looks, width),
            linewidth=width,
            dash_capstyle="butt",
            marker=style.marker,
            markersize=_SIZES[0] + rest * (_SIZES[1] - _SIZES[0]),
            markeredgecolor="white",
            markeredgewidth=0.5,
            # with fewer points than curves, the last ones share a point
            markevery=(min(group.index(k), len(lambdas) - 1), len(group)),
        )


def _dashes(k: int, group: list[int], looks: Sequence[Look], width: float) -> Any:
    """Dashes of a curve: its own alone, turns of its colour among several; none where its colour has had its turn."""
    colours = list(dict.fromkeys(looks[j].colour for j in group))
    if any(looks[j].colour == looks[k].colour for j in group[: group.index(k)]):
        return "none"
    if len(colours) == 1:
        return looks[k].dashes
    # matplotlib counts dashes in widths of the line
    dash, turn = _DASH / width, colours.index(looks[k].colour)
    return (len(colours) - turn) * dash, (dash, (len(colours) - 1) * dash)


def _coinciding(logarithmic: bool, curves: Sequence[FloatArray]) -> list[list[int]]:
    """Groups of curves that are seen as one; most have one member."""
    heights = [np.log(values) if logarithmic else values for values in curves]
    every = np.concatenate(heights)
    near = _SAME * (np.nanmax(every) - np.nanmin(every)) if np.isfinite(every).any() else 0.0
    groups: list[list[int]] = []
    for k, values in enumerate(heights):
        found = next((group for group in groups if _is_near(values, heights[group[0]], near)), None)
        if found is None:
            groups.append([k])
        else:
            found.append(k)
    return groups


def _is_near(first: FloatArray, second: FloatArray, near: float) -> bool:
    return bool((np.isnan(first) == np.isnan(second)).all() and (np.nan_to_num(np.abs(first - second)) <= near).all())
