# SPDX-License-Identifier: BSD-3-Clause
"""What all figures share: size, palette, second cue beside the colour, and the way to PNG.

Matplotlib is needed for figures and nothing else; it comes with the extra `report` and is imported when a figure is
drawn.
"""

from __future__ import annotations

import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.errors import MissingExtraError

if TYPE_CHECKING:
    from matplotlib.figure import Figure


DOTS_PER_INCH = 100
"""Resolution of every figure; dots per inch."""
ROW_INCHES = (12.0, 3.6)
"""Width of every figure and usual height of one of its rows; inch."""

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#F0E442")
"""The palette of Okabe and Ito, which the colour-blind tell apart; the faint yellow comes last."""
REFERENCE_COLOUR = "#000000"
"""Colour of what the others are compared with; no `look` has it."""
REFERENCE_LINE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (4, 3)), "linewidth": 1.6}
"""Line of what the others are compared with, such as a limit."""
THIN_REFERENCE_LINE: dict[str, Any] = {**REFERENCE_LINE, "linewidth": 1.2}
"""The same in small panels."""

TITLE_POINTS = 10.0
"""Size of titles and of the labels of axes; points."""
SMALL_POINTS = 9.0
"""Size of legends and of the numbers along axes; points."""

PLANES = ((0, 1), (1, 2), (0, 2))
"""Axes along and up a panel in the three views of what lies in space."""
SMALL_PANEL_POINTS = 8.0
"""Size of the numbers along axes of panels that share a row with others; points."""

LONGEST_NAME = 60
"""Characters of a name that are shown; of a longer one both ends."""

_LEGEND_ROW_INCHES, _KEY_INCHES = 0.22, 0.82
"""Height of a row of a legend, and width of what stands beside its text; inch."""

_HUES = COLOURS[:6]
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (6, 2, 1, 2)), (0, (2, 1.5)), (0, (6, 2, 1, 2, 1, 2)), (0, (1, 1)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Look:
    """How one of several curves or clouds is told from the others."""

    colour: str
    """Colour that the colour-blind tell from the neighbours'."""
    marker: str
    """Shape of its points."""
    dashes: Any
    """Style of its line, as matplotlib takes it."""

    @property
    def key(self) -> dict[str, Any]:
        """How a legend shows it: its points on its line."""
        return {"color": self.colour, "linestyle": self.dashes, "marker": self.marker}


def look(k: int) -> Look:
    """Look of the k-th curve: the first six differ in all, the first 42 in colour or marker.

    Args:
        k: Index of the curve, from 0.

    Returns:
        Its look.
    """
    return Look(colour=_HUES[k % len(_HUES)], marker=_MARKERS[k % len(_MARKERS)], dashes=_DASHES[k % len(_DASHES)])


def new_figure(height: float) -> Figure:
    """Make an empty figure of the common width, which a notebook shows by itself.

    Args:
        height: Height; inch.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
    except ImportError as error:
        raise MissingExtraError("figures are drawn by matplotlib: pip install forcetorque[report]") from error
    # a Figure with its own canvas, not pyplot: no window, no state that others share
    figure = _figure_class()(figsize=(ROW_INCHES[0], height), dpi=DOTS_PER_INCH, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


@cache
def _figure_class() -> type[Figure]:
    """Figures that show themselves as a picture, also where no one has set up pyplot; made when one is first drawn."""
    from matplotlib.figure import Figure

    class ShownFigure(Figure):
        def _repr_png_(self) -> bytes:
            return png_bytes(self)

    return ShownFigure


def shown_name(name: str) -> str:
    """Write a name of the user's as matplotlib must be given it to show it as it is.

    Args:
        name: Any text.

    Returns:
        One line without formulas, not taken for a hidden label, of `LONGEST_NAME` characters at most before escapes.
    """
    line = name if name.isprintable() else repr(name)
    if len(line) > LONGEST_NAME:
        line = f"{line[: LONGEST_NAME // 2]}…{line[-(LONGEST_NAME // 2 - 1) :]}"
    return (" " if line.startswith("_") else "") + line.replace("$", r"\$")


def two_digits(value: float) -> str:
    """Write a size beside what is drawn: two digits that count, without a power of ten.

    Args:
        value: The size.

    Returns:
        Such as `0.043`, `1.6` or `324`.
    """
    return f"{value:.0f}" if value >= 100.0 else f"{value:#.2g}".rstrip(".")


def legend_below(
    figure: Figure,
    keys: Sequence[tuple[str, Mapping[str, Any]]],
    *,
    title: str | None = None,
    points: float = SMALL_POINTS,
) -> None:
    """Name what is drawn in rows below all panels, and make the figure higher by these rows.

    Args:
        figure: The figure.
        keys: Names, as `shown_name` gives them, and the line that stands for each, as matplotlib takes it.
        title: A line above them.
        points: Size of the letters; points.
    """
    from matplotlib.lines import Line2D

    names = [name for name, _ in keys]
    widths = [_KEY_INCHES * points / SMALL_POINTS + width for width in text_inches(names, points)]
    columns = next((k for k in range(len(names), 1, -1) if _width_in_columns(widths, k) < ROW_INCHES[0]), 1)
    rows = math.ceil(len(names) / columns) + (title is not None)
    figure.set_figheight(figure.get_figheight() + _LEGEND_ROW_INCHES * rows * points / SMALL_POINTS)
    figure.legend(
        [Line2D([], [], **style) for _, style in keys],
        names,
        loc="outside lower center",
        ncols=columns,
        frameon=False,
        fontsize=points,
        handlelength=3.6,
        title=title,
        title_fontsize=points,
    )


def text_inches(texts: Sequence[str], points: float = SMALL_POINTS) -> list[float]:
    """Measure how wide texts will be.

    Args:
        texts: Lines of text.
        points: Size of the letters; points.

    Returns:
        Width of each; inch.
    """
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    font = FontProperties(size=points)
    return [text_to_path.get_text_width_height_descent(text, font, ismath=False)[0] / 72.0 for text in texts]


def _width_in_columns(widths: Sequence[float], columns: int) -> float:
    """Width of a legend, which fills one column after the other; inch."""
    return sum(float(filled.max()) for filled in np.array_split(widths, columns))


def png_bytes(figure: Figure) -> bytes:
    """Draw a figure.

    Args:
        figure: The figure.

    Returns:
        It as PNG at `DOTS_PER_INCH`.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    png = io.BytesIO()
    # `savefig` would go through everything twice, the first time for the layout alone
    FigureCanvasAgg(figure).print_png(png)  # type: ignore[no-untyped-call]
    return png.getvalue()
