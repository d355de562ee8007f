# SPDX-License-Identifier: BSD-3-Clause
"""What holds for every figure: a whole PNG of the common width, the same again from the same data, and readable."""

from __future__ import annotations

import ast
import subprocess
import sys
from functools import cache
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox

import forcetorque
from forcetorque.base.errors import MissingExtraError
from forcetorque.results.figure_style import png_bytes
from tests.cases import some_cases
from tests.report.drawing import FIGURES, panels, shown_texts, size_of

every_figure = pytest.mark.parametrize("name", list(FIGURES))
FEW = ("comparison", "contact", "device")
"""Of several capabilities."""
some_figures = some_cases("name", [*FEW, *(name for name in FIGURES if name not in FEW)], quick=len(FEW))
"""A few, and in the long run all: what they have in common is written once, in the canvas."""

ROOT = Path(forcetorque.__file__).parent
FILES = sorted(
    path for pattern in ("figures.py", "figures/*.py") for path in ROOT.rglob(pattern) if "results" not in path.parts
)
"""Files of figures, by their names."""
TOUCHING_PIXELS = 2.0
"""Boxes of texts include room for letters that reach below the line: this much of it may be shared."""


def test_every_public_figure_is_tested_here() -> None:
    """A new figure must be added to the list; that of gains takes an experiment and has a test of its own."""
    names = {f"{name.replace(' ', '_')}_figure" for name in FIGURES}
    assert names | {"gain_figure"} == _public_figures()


def _public_figures() -> set[str]:
    """Functions of the files of figures that give a figure and are no detail of another one."""
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in FILES]
    functions = [node for tree in trees for node in tree.body if isinstance(node, ast.FunctionDef)]
    return {
        node.name
        for node in functions
        if node.returns is not None and ast.unparse(node.returns) == "Figure" and not node.name.startswith("_")
    }


@cache
def _drawn(name: str) -> tuple[bytes, Figure]:
    figure = FIGURES[name](np.random.default_rng(1))
    return png_bytes(figure), figure


@some_figures
def test_a_whole_png_of_the_common_width(name: str) -> None:
    """Signature, width and end as the format has them."""
    png, _ = _drawn(name)
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert png[-8:-4] == b"IEND"
    width, height = size_of(png)
    assert width == 1200
    assert 300 <= height <= 1200


@some_figures
def test_the_same_data_give_the_same_bytes(name: str) -> None:
    """Nothing of the moment or of the run is in the file."""
    first, _ = _drawn(name)
    assert png_bytes(FIGURES[name](np.random.default_rng(1))) == first


@pytest.mark.long
@every_figure
def test_other_data_give_another_file(name: str) -> None:
    """Negative control of the test above."""
    first, _ = _drawn(name)
    assert png_bytes(FIGURES[name](np.random.default_rng(2))) != first


@every_figure
def test_without_matplotlib_the_error_says_what_to_install(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One line with the command."""
    for module in ("matplotlib", "matplotlib.figure", "matplotlib.backends.backend_agg"):
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingExtraError, match=r"pip install 'forcetorque\[report\]'$"):
        FIGURES[name](np.random.default_rng(1))


def _overlaps(figure: Figure) -> list[tuple[str, str]]:
    """Pairs of texts that lie over each other; of slanted ones the boxes say nothing."""
    boxes = [
        (text.get_text(), text.get_window_extent()) for text in shown_texts(figure) if text.get_rotation() % 90.0 == 0.0
    ]
    assert len(boxes) > 5
    return [
        (first, second)
        for (first, a), (second, b) in combinations(boxes, 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > TOUCHING_PIXELS and min(a.y1, b.y1) - max(a.y0, b.y0) > TOUCHING_PIXELS
    ]


def _outside(figure: Figure) -> list[str]:
    page = figure.bbox.padded(1.0)
    boxes = [(text.get_text(), text.get_window_extent()) for text in shown_texts(figure)]
    return [text for text, box in boxes if not (page.contains(box.x0, box.y0) and page.contains(box.x1, box.y1))]


@some_figures
def test_no_text_lies_over_another_or_beyond_the_edge(name: str) -> None:
    """Labels, numbers along axes, titles and legend each have their place."""
    _, figure = _drawn(name)
    assert _overlaps(figure) == []
    assert _outside(figure) == []


@some_figures
def test_the_legend_is_beside_the_data(name: str) -> None:
    """Legends of figures, and of panels, lie outside all panels."""
    _, figure = _drawn(name)
    legends = figure.legends + [panel.get_legend() for panel in panels(figure) if panel.get_legend() is not None]
    assert len(legends) == {"difference": 0, "choice": 2}.get(name, 1)
    for legend in legends:
        box = legend.get_window_extent()
        assert not any(Bbox.intersection(box, panel.get_window_extent()) for panel in panels(figure))


def test_an_overlap_is_noticed() -> None:
    """Negative control: a title moved onto an axis' numbers, and one pushed over the edge."""
    figure = FIGURES["comparison"](np.random.default_rng(1))
    figure.draw_without_rendering()
    panel = panels(figure)[0]
    panel.text(0.0, 0.5, panel.get_ylabel(), transform=panel.yaxis.label.get_transform())
    moved = panel.annotate("moved", (0.5, 0.5), xycoords="figure fraction", fontsize=40.0)
    assert any("moved" in pair for pair in _overlaps(figure))
    moved.set_position((0.99, 0.5))
    assert _outside(figure) == ["moved"]


@pytest.mark.long
def test_figures_leave_the_program_as_it_is() -> None:
    """Matplotlib comes with the first figure and not before; pyplot, its windows and settings stay out of it."""
    code = """
import sys
import numpy as np
from forcetorque.calibration.figures.excitation import space_figure
from forcetorque.calibration.figures.lambda_curves import lambda_difference_figure
from forcetorque.estimation.figures import contact_figure
from forcetorque.evaluation.figures.errors_and_matrices import difference_figure
from forcetorque.results.figure_style import png_bytes
from forcetorque.study.figures import lambda_force_figure
assert "matplotlib" not in sys.modules
curves = {"a": np.ones(3)}
lambda_difference_figure(np.arange(3.0), curves, unit="N/count")
import matplotlib
settings = matplotlib.rcParams.copy()
lambda_force_figure(np.arange(3.0), {"set": curves}, workbench=20.0)
space_figure({"a": np.random.default_rng(1).normal(size=(9, 6))})
contact_figure(np.arange(9.0), {"a": np.ones((9, 3))}, unit="N")
difference_figure(["a"], np.zeros((1, 1)), unit="N/count")
assert matplotlib.rcParams.copy() == settings
assert "matplotlib.pyplot" not in sys.modules
"""
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)
