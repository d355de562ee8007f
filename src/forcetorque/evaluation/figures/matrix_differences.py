# SPDX-License-Identifier: BSD-3-Clause
"""Figure of how far calibration matrices are from each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.results.figures.canvas import ROW_INCHES, SMALL_POINTS, new_figure, shown_name, text_inches
from forcetorque.results.figures.curves import drawable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_CELL_INCHES, _LINE_INCHES = 0.42, 0.17
"""Height of a cell with a number, and of one that only has the name of its row beside it."""
_SLANT, _SLANTED_INCHES = 50.0, 0.2
"""Angle of names that do not fit level over their columns, and width that each then takes up; degrees, inch."""
_TABLE_INCHES = 0.75 * ROW_INCHES[0]
"""Width of the cells together, at most, beside the names and the scale."""
_LETTER_ASPECT = 0.62
"""Width of a digit over the size of its letters."""
_READABLE_POINTS = 6.0
"""Numbers that would have to be smaller than this are left to the colours."""
_NOT_A_NUMBER = "0.85"
_MIDDLE_LUMINANCE = 0.179
"""Where black and white letters have the same contrast: (L + 0.05)^2 = 1.05 x 0.05."""


def difference_figure(names: Sequence[str], differences: FloatArray, *, unit: str) -> Figure:
    """Draw a table of differences between matrices, numbers on colours [1].

    Args:
        names: Names of the k matrices.
        differences: Difference of each to each, not negative; shape (k, k); in `unit`. What is not a finite number is
            a grey cell with a dash.
        unit: Unit with its power of ten, such as `1e-4 N/count`.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no names, the array does not fit them, or a difference is negative.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 5.3 and table 5.3.
    """
    if not names:
        raise ShapeError("names: expected at least one matrix to compare, got none")
    matrix = drawable(differences, name="differences", shape=(len(names), len(names)))
    if (matrix < 0.0).any():
        raise ShapeError(f"differences: expected none below zero, got {np.nanmin(matrix):g}; give absolute values")
    largest = float(np.nanmax(matrix, initial=0.0))
    texts = [[_cell(value, largest) for value in row] for row in matrix]
    points = _letters_that_fit(texts)
    cell = _CELL_INCHES if points else _LINE_INCHES
    shown = [shown_name(name) for name in names]
    figure = new_figure(max(ROW_INCHES[1], 1.2 + cell * len(names)))
    widest, room = max(text_inches(shown)), _TABLE_INCHES / len(names)
    level = widest < 0.9 * room
    if not level and room > _SLANTED_INCHES:
        figure.set_figheight(figure.get_figheight() + widest * math.sin(math.radians(_SLANT)))
    panel = figure.add_subplot()
    # cividis: its lightness rises evenly, for the colour-blind and in grey too
    image = panel.imshow(matrix, cmap="cividis", vmin=0.0, vmax=largest or 1.0, aspect="auto")
    image.set_cmap(image.get_cmap().with_extremes(bad=_NOT_A_NUMBER))
    _name_cells(panel, shown, room, level=level)
    if points:
        _write_cells(panel, texts, _luminance(image.to_rgba(matrix)) < _MIDDLE_LUMINANCE, points)
    figure.colorbar(image, ax=panel, label=f"mean absolute difference, {shown_name(unit)}", pad=0.01)
    return figure


def _luminance(colours: FloatArray) -> FloatArray:
    """Relative luminance of colours of sRGB, 0 for black and 1 for white, with a plain power for their curve."""
    weights = np.array([0.2126, 0.7152, 0.0722])
    return colours[..., :3] ** 2.2 @ weights


def _name_cells(panel: Axes, names: list[str], room: float, *, level: bool) -> None:
    places = range(len(names))
    panel.tick_params(top=True, bottom=False, labeltop=True, labelbottom=False, length=0.0)
    panel.set_yticks(places, names, fontsize=SMALL_POINTS)
    # too many to be named twice: the columns are in the order of the rows
    named = level or room > _SLANTED_INCHES
    panel.set_xticks(places, names if named else [""] * len(names), fontsize=SMALL_POINTS)
    if named and not level:
        for label in panel.get_xticklabels():
            label.set(rotation=_SLANT, ha="left", va="bottom", rotation_mode="anchor")
    edges = [place + 0.5 for place in places[:-1]]
    for lines in (panel.hlines, panel.vlines):
        lines(edges, -0.5, len(names) - 0.5, color="white", linewidth=min(1.0, 2.0 * room))
    for edge in panel.spines.values():
        edge.set_visible(False)


def _letters_that_fit(texts: list[list[str]]) -> float:
    """Size of letters with which all numbers fit in their cells; 0 where that would be too small to read; points."""
    widest = max(len(text) for row in texts for text in row)
    points = min(SMALL_POINTS, 0.87 * _TABLE_INCHES * 72.0 / len(texts) / (widest * _LETTER_ASPECT))
    return points if points >= _READABLE_POINTS else 0.0


def _write_cells(panel: Axes, texts: list[list[str]], dark: BoolArray, points: float) -> None:
    for row, column in np.ndindex(dark.shape):
        colour = "white" if dark[row, column] else "black"
        panel.text(column, row, texts[row][column], ha="center", va="center", fontsize=points, color=colour)


def _cell(value: float, largest: float) -> str:
    """A number with as many decimals as four digits of the largest need; zero and what is missing at a glance."""
    if not math.isfinite(value):
        return "–"
    if value == 0.0:
        return "0"
    if not 1e-3 <= largest < 1e5:
        return f"{value:.3g}"
    return f"{value:.{max(0, 3 - math.floor(math.log10(largest)))}f}"
