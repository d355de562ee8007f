# SPDX-License-Identifier: BSD-3-Clause
"""Differences between matrices: every number in its cell, readable on its colour."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.figures.errors_and_matrices import difference_figure
from forcetorque.results.figure_style import PAPER, REFERENCE_COLOUR, png_bytes
from tests.cases import some_cases
from tests.report.drawing import panels, size_of, words

NAMES = ("Workbench", "SnTdTO", "SwTdTO", "SwTrTO")
TABLE_5_3 = np.array(
    [
        [0.0, 33.0389, 28.1952, 20.3309],
        [33.0389, 0.0, 6.9890, 15.9404],
        [28.1952, 6.9890, 0.0, 10.2228],
        [20.3309, 15.9404, 10.2228, 0.0],
    ]
)
"""First rows and columns of table 5.3 of the thesis; 1e-4 N/count."""
UNIT = "1e-4 N/count"

READABLE_CONTRAST = 4.5
"""Least contrast of letters on their ground, Web Content Accessibility Guidelines 2.1, 1.4.3."""


def _cells(figure: Figure) -> dict[tuple[int, int], str]:
    return {
        (round(text.get_position()[1]), round(text.get_position()[0])): text.get_text() for text in figure.axes[0].texts
    }


def test_every_number_is_in_its_cell(drawn: list[Figure]) -> None:
    """Four digits of the largest, as many decimals for all; rows and columns are named, and the unit is written."""
    difference_figure(NAMES, TABLE_5_3, unit=UNIT)
    cells = _cells(drawn[0])
    assert len(cells) == 16
    assert [cells[0, k] for k in range(4)] == ["0", "33.04", "28.20", "20.33"]
    assert cells[2, 1] == "6.99"
    panel = panels(drawn[0])[0]
    for labels in (panel.get_xticklabels(), panel.get_yticklabels()):
        assert tuple(label.get_text() for label in labels) == NAMES
    assert f"mean absolute difference, {UNIT}" in words(drawn[0])


def test_rows_are_rows(drawn: list[Figure]) -> None:
    """Negative control of the symmetric table: a difference that is not symmetric is not turned over."""
    difference_figure(("a", "b"), [[0.0, 1.0], [2.0, 0.0]], unit=UNIT)
    cells = _cells(drawn[0])
    assert (cells[0, 1], cells[1, 0]) == ("1.000", "2.000")


@pytest.mark.parametrize(
    ("value", "text"), [(1e-9, "1e-09"), (0.00123456, "0.001235"), (0.5, "0.5000"), (12345.6, "12346"), (1e7, "1e+07")]
)
def test_numbers_of_any_size_are_short(value: float, text: str, drawn: list[Figure]) -> None:
    """Whatever unit the caller chose."""
    difference_figure(("a", "b"), [[0.0, value], [value, 0.0]], unit=UNIT)
    assert _cells(drawn[0])[0, 1] == text


def test_numbers_are_readable_on_their_colours(drawn: list[Figure]) -> None:
    """Contrast by the guidelines' formula over the whole range of colours; not all letters are of one colour."""
    difference_figure([f"m{k}" for k in range(12)], np.arange(144.0).reshape(12, 12), unit=UNIT)

    def light(colour: object) -> float:
        parts = np.asarray(to_rgb(colour))  # type: ignore[arg-type]
        linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
        return float(linear @ [0.2126, 0.7152, 0.0722])

    panel = panels(drawn[0])[0]
    (image,) = panel.images
    grounds = image.to_rgba(image.get_array())
    colours = set()
    for text in panel.texts:
        ground = grounds[round(text.get_position()[1]), round(text.get_position()[0]), :3]
        high, low = sorted((light(text.get_color()), light(ground)), reverse=True)
        assert (high + 0.05) / (low + 0.05) >= READABLE_CONTRAST
        colours.add(text.get_color())
    assert colours == {REFERENCE_COLOUR, PAPER}


def test_the_colours_grow_lighter_with_the_difference(drawn: list[Figure]) -> None:
    """Also without colour vision and in grey a larger difference looks larger."""
    difference_figure(("a", "b", "c"), np.arange(9.0).reshape(3, 3), unit=UNIT)
    (image,) = panels(drawn[0])[0].images
    light = image.to_rgba(image.get_array())[..., :3] @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(light.ravel()) > 0.0).all()


def test_what_is_missing_is_a_dash(drawn: list[Figure]) -> None:
    """One missing difference does not spoil the others; all missing is a table of dashes."""
    table = TABLE_5_3.copy()
    table[0, 1] = np.nan
    difference_figure(NAMES, table, unit=UNIT)
    assert _cells(drawn[0])[0, 1] == "–"
    assert _cells(drawn[0])[1, 0] == "33.04"
    difference_figure(NAMES, np.full((4, 4), np.nan), unit=UNIT)
    assert set(_cells(drawn[1]).values()) == {"–"}


@some_cases("count", [1, 22, 55])
def test_many_matrices_with_long_names_keep_apart(count: int, drawn: list[Figure]) -> None:
    """Numbers stay in their cells or are left out; names of rows do not touch."""
    names = [f"support leg, type {k}" for k in range(count)]
    png = png_bytes(difference_figure(names, np.ones((count, count)), unit=UNIT))
    assert size_of(png)[0] == 1200
    panel = panels(drawn[0])[0]
    room = panel.get_window_extent().width / count
    assert len(panel.texts) == (count * count if count < 40 else 0)
    assert all(text.get_window_extent().width < room for text in panel.texts)
    rows = [label.get_window_extent() for label in panel.get_yticklabels()]
    assert all(upper.y0 > lower.y0 + 0.7 * lower.height for upper, lower in zip(rows, rows[1:], strict=False))
    assert all(box.x0 >= 0.0 for box in rows)


def test_what_is_no_table_is_refused() -> None:
    """No names, names for another table, a signed difference."""
    with pytest.raises(ShapeError, match="names: expected at least one"):
        difference_figure([], np.zeros((0, 0)), unit=UNIT)
    with pytest.raises(ShapeError, match="differences: expected an array of shape"):
        difference_figure(["a"], np.zeros((2, 2)), unit=UNIT)
    with pytest.raises(ShapeError, match="differences: expected none below zero, got -1"):
        difference_figure(["a"], [[-1.0]], unit=UNIT)
