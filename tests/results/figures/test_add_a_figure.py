# SPDX-License-Identifier: BSD-3-Clause
"""A figure is one file and a line that draws it in tests: it is held to what holds for all then.

This is the recipe of docs/architecture.md, followed with `tests/toys/figure.py`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.results.document.content import Document, Figure, Picture, Section, html_bytes
from tests.report import drawing
from tests.results.figures import test_every_figure as every_figure
from tests.toys.figure import toy_figure


def _toy(rng: np.random.Generator) -> Any:
    forces = {name: 10.0 * rng.normal(size=(400, 3)) for name in ("prior", "new")}
    return toy_figure(0.01 * np.arange(400), forces)


@pytest.fixture
def named(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its file beside the figures of the library."""
    monkeypatch.setattr(every_figure, "FILES", [*every_figure.FILES, Path(toy_figure.__code__.co_filename)])


@pytest.fixture
def drawn_in_tests(monkeypatch: pytest.MonkeyPatch) -> None:
    """The line that draws it of random data."""
    monkeypatch.setitem(drawing.FIGURES, "toy", _toy)


@pytest.mark.usefixtures("named", "drawn_in_tests")
def test_it_is_held_to_what_holds_for_every_figure(monkeypatch: pytest.MonkeyPatch) -> None:
    """Width, the same bytes of the same data, room for its texts and its legend, and a message without matplotlib."""
    every_figure.test_every_public_figure_is_tested_here()
    every_figure.test_a_whole_png_of_the_common_width("toy")
    every_figure.test_the_same_data_give_the_same_bytes("toy")
    every_figure.test_no_text_lies_over_another_or_beyond_the_edge("toy")
    every_figure.test_the_legend_is_beside_the_data("toy")
    every_figure.test_without_matplotlib_the_error_says_what_to_install("toy", monkeypatch)


def test_a_document_shows_it() -> None:
    """As a block of a section: the picture, its caption and the words for who cannot see it."""
    picture = Picture(lambda: _toy(np.random.default_rng(1)))
    block = Figure(picture=picture, caption="Norms of forces.", description="Two noisy curves.")
    sections = (Section(title="Toy", blocks=(block,)),)
    page = html_bytes(Document(title="t", subtitle="s", created="2026-01-01T00:00:00+00:00", sections=sections))
    assert b"Norms of forces." in page
    assert b"Two noisy curves." in page
    assert b"data:image/png;base64," in page


@pytest.mark.usefixtures("named")
def test_a_figure_that_no_test_draws_is_noticed() -> None:
    """Negative control: the name alone is not enough."""
    with pytest.raises(AssertionError):
        every_figure.test_every_public_figure_is_tested_here()
