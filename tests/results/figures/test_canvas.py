# SPDX-License-Identifier: BSD-3-Clause
"""Colours and shapes are told apart by everybody; names are shown as they are; a legend takes the room it needs."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from matplotlib.figure import Figure

from forcetorque.results.figure_style import (
    COLOURS,
    LONGEST_NAME,
    REFERENCE_COLOUR,
    legend_below,
    look,
    new_figure,
    png_bytes,
    shown_name,
)
from tests.report.drawing import legend_of, words


def test_the_colours_are_told_apart_without_colour_vision() -> None:
    """Seen with red- and green-blind eyes [1], no two of the first six channels look alike; red and green do.

    References:
        [1] F. Vienot, H. Brettel, J. Mollon, Digital video colourmaps for checking the legibility of
            displays by dichromats, 1999: linear RGB projected for protanopes and deuteranopes.
    """
    to_lms = np.array([[17.8824, 43.5161, 4.11935], [3.45565, 27.1554, 3.86714], [0.0299566, 0.184309, 1.46709]])
    blind = {
        "protanope": np.array([[0.0, 2.02344, -2.52581], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        "deuteranope": np.array([[1.0, 0.0, 0.0], [0.494207, 0.0, 1.24827], [0.0, 0.0, 1.0]]),
    }

    def seen(colour: str, eye: np.ndarray) -> np.ndarray:
        linear = (np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0) ** 2.2
        through = np.linalg.solve(to_lms, eye @ to_lms @ linear)
        return np.clip(through, 0.0, 1.0) ** (1 / 2.2)

    for eye in blind.values():
        looks = [seen(colour, eye) for colour in COLOURS[:6]]
        apart = [np.linalg.norm(a - b) for k, a in enumerate(looks) for b in looks[:k]]
        assert len(apart) == 15
        assert min(apart) > 0.1
    red, green = (seen(colour, blind["deuteranope"]) for colour in ("#a84d00", "#5f7a00"))
    assert np.linalg.norm(red - green) < 0.1


def test_looks_differ_in_colour_or_marker() -> None:
    """The first six in colour, marker and dashes; no two of the first 42 in all; none looks like the reference."""
    looks = [look(k) for k in range(42)]
    for part in ("colour", "marker", "dashes"):
        assert len({str(getattr(each, part)) for each in looks[:6]}) == 6
    assert len({(each.colour, each.marker) for each in looks}) == 42
    assert REFERENCE_COLOUR not in {each.colour for each in looks}


@pytest.mark.parametrize("name", ["grid", "$x$ and $y_", "_hidden", "two\nlines", r"back\slash", "100 %", "#1"])
def test_a_name_is_shown_as_it_is(name: str, drawn: list[Figure]) -> None:
    """Signs of formulas stay signs, an underscore hides nothing, a line break is written out."""
    figure = new_figure(3.0)
    figure.add_subplot()
    legend_below(figure, [(shown_name(name), look(0).key)])
    png_bytes(figure)
    (shown,) = legend_of(drawn[0])
    assert shown.strip().replace(r"\$", "$") == (name if name.isprintable() else repr(name))


def test_a_long_name_keeps_both_ends() -> None:
    """Names that differ at the end only are still told apart."""
    first, second = (shown_name("a" * 200 + end) for end in ("1", "2"))
    assert len(first) == LONGEST_NAME
    assert first != second


@pytest.mark.parametrize("count", [1, 4, 12, 40])
@pytest.mark.parametrize("letters", [3, LONGEST_NAME])
def test_a_legend_fits_and_leaves_the_panel_its_height(count: int, letters: int, drawn: list[Figure]) -> None:
    """The figure grows by the rows; every name is within it, in no more rows than there are names."""
    figure = new_figure(3.0)
    panel = figure.add_subplot()
    legend_below(figure, [("W" * (letters - 2) + f"{k:02}", look(k).key) for k in range(count)])
    png_bytes(figure)
    (legend,) = drawn[0].legends
    box = legend.get_window_extent()
    assert 0.0 <= box.x0 < box.x1 <= 1200.0
    assert box.y0 >= 0.0
    assert panel.get_window_extent().height > 240.0
    assert len(legend_of(drawn[0])) == count


def test_a_title_stands_above_the_legend(drawn: list[Figure]) -> None:
    """It is written, and takes a row."""
    heights = []
    for title in (None, "what it means"):
        figure = new_figure(3.0)
        legend_below(figure, [("a", look(0).key)], title=title)
        png_bytes(figure)
        heights.append(figure.get_figheight())
    assert "what it means" in words(drawn[1])
    assert all(first < second for first, second in pairwise(heights))
