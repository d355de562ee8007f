# SPDX-License-Identifier: BSD-3-Clause
"""What all figures share: size, letters, palette, curves that are checked and thinned, and the way to a file."""

from __future__ import annotations

import io
import math
import textwrap
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cache, wraps
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import MissingExtraError, ShapeError, install_line
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.recording.alignment import GAP_PERIODS
from forcetorque.results.visual_roles import CALIBRATIONS, EXPECTED, HIGHLIGHT, LIMIT, PRIOR, SURFACES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.backend_bases import RendererBase
    from matplotlib.figure import Figure


DOTS_PER_INCH = 100
"""Resolution of every figure; dots per inch."""
ROW_INCHES = (12.0, 3.6)
"""Width of every figure and usual height of one of its rows; inch."""

COLOURS = (*(role.colour for role in CALIBRATIONS), EXPECTED.colour, HIGHLIGHT)
"""Colours that the colour-blind tell apart; the faint yellow comes last."""
REFERENCE_COLOUR = EXPECTED.colour
"""Colour of what the others are compared with; no `look` has it."""
PAPER, MUTED, GUIDE, GRID = (SURFACES[name][0] for name in ("panel", "muted", "guide", "grid"))
"""Colours of the ground, of what has less weight, of lines that guide the eye, and of a grid."""
REFERENCE_LINE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (4, 3)), "linewidth": 1.6}
"""Line of what the others are compared with, such as a limit."""
LIMIT_LINE: dict[str, Any] = {"color": LIMIT.colour, "linestyle": (0, LIMIT.dash), "linewidth": 1.6}
"""Line of what must not be exceeded."""
THIN_REFERENCE_LINE: dict[str, Any] = {**REFERENCE_LINE, "linewidth": 1.2}
"""The same in small panels."""

SMALL_POINTS = 9.0
"""Size of all letters but those of titles; points."""
FIGURE_STYLE: dict[Any, Any] = {
    "font.size": SMALL_POINTS,
    "axes.titlesize": 10.0,
    "axes.labelsize": SMALL_POINTS,
    "xtick.labelsize": SMALL_POINTS,
    "ytick.labelsize": SMALL_POINTS,
    "legend.fontsize": SMALL_POINTS,
    "legend.title_fontsize": SMALL_POINTS,
    "figure.titlesize": 10.0,
    "figure.labelsize": SMALL_POINTS,
}
"""Settings of matplotlib for every figure of the library."""

PLANES = ((0, 1), (1, 2), (0, 2))
"""Axes along and up a panel in the three views of what lies in space."""
SMALL_PANEL_POINTS = 8.0
"""Size of the numbers along axes of panels that share a row with others; points."""

LONGEST_NAME = 60
"""Characters of a name that are shown; of a longer one both ends."""

_LEGEND_ROW_INCHES, _KEY_INCHES = 0.22, 0.82
"""Height of a row of a legend, and width of what stands beside its text; inch."""

_HEADLINE_INCHES, _HEADLINE_POINTS, _HEADLINE_LETTERS = 0.3, 11.0, 100
"""Height of a line of a message, size of its letters, and how many of them a line holds; inch and points."""

_HUES = COLOURS[: len(CALIBRATIONS)]
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (6, 2, 1, 2)), (0, (2, 1.5)), (0, (6, 2, 1, 2, 1, 2)), (0, (1, 1)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Look:
    """How one of several curves or clouds differs from the others."""

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


def looks(names: Sequence[str]) -> dict[str, Look]:
    """Looks of curves by name: black for what is expected, grey for prior and logged, blue and on for others.

    Args:
        names: Names of curves.

    Returns:
        The look of each.
    """
    fixed = dict.fromkeys(_BEFORE, PRIOR) | {EXPECTED.word: EXPECTED}
    others = [name for name in names if name not in fixed]
    return {
        name: Look(colour=role.colour, marker=role.marker, dashes=(0, role.dash) if role.dash else "-")
        if (role := fixed.get(name)) is not None
        else look(others.index(name))
        for name in names
    }


_BEFORE = ("prior", "logged")
"""Names of curves before a calibration."""

_P = ParamSpec("_P")
_Drawn = TypeVar("_Drawn")


def in_figure_style(draw: Callable[_P, _Drawn]) -> Callable[_P, _Drawn]:
    """Draw with the settings of `FIGURE_STYLE`; those of the program are as before afterwards.

    Args:
        draw: Function that makes a figure, or a file of several.

    Returns:
        The function with these settings.
    """

    @wraps(draw)
    def drawn(*args: _P.args, **kwargs: _P.kwargs) -> _Drawn:
        with _figure_style():
            return draw(*args, **kwargs)

    return drawn


def _figure_style() -> AbstractContextManager[None]:
    try:
        from matplotlib import rc_context
    except ImportError as error:
        raise MissingExtraError(_NO_MATPLOTLIB) from error
    return rc_context(FIGURE_STYLE)


_NO_MATPLOTLIB = f"figures are drawn by matplotlib: {install_line('report')}"


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
        raise MissingExtraError(_NO_MATPLOTLIB) from error
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

        def draw(self, renderer: RendererBase) -> None:
            with _figure_style():  # matplotlib makes the numbers along axes when it draws them
                super().draw(renderer)

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


def number_log_axis(axis: Axis) -> None:
    """Number an axis that is logarithmic at 1, 2 and 5 of every decade, without powers of ten.

    Args:
        axis: Axis along or up a panel.
    """
    from matplotlib.ticker import LogLocator, NullLocator

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_locator(NullLocator())


def two_digits(value: float) -> str:
    """Write a size beside what is drawn: two digits that count, without a power of ten.

    Args:
        value: The size.

    Returns:
        Such as `0.043`, `1.6` or `324`.
    """
    return f"{value:.0f}" if value >= 100.0 else f"{value:#.2g}".rstrip(".")


def headline(figure: Figure, message: str) -> None:
    """Write what a figure shows above all panels, at the left, and make the figure higher by its lines.

    Args:
        figure: The figure.
        message: The message, with names as `shown_name` gives them.
    """
    lines = textwrap.wrap(message, _HEADLINE_LETTERS, break_long_words=False)
    figure.set_figheight(figure.get_figheight() + _HEADLINE_INCHES * len(lines))
    figure.suptitle("\n".join(lines), x=0.01, horizontalalignment="left", fontsize=_HEADLINE_POINTS, fontweight="bold")


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

    Returns:
        It as PNG at `DOTS_PER_INCH`.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    png = io.BytesIO()
    # `savefig` would go through everything twice, the first time for the layout alone
    FigureCanvasAgg(figure).print_png(png)  # type: ignore[no-untyped-call]
    return png.getvalue()


FIGURE_ENDINGS = (".png", ".svg", ".pdf")
"""How files of figures may end."""


def figure_bytes(figure: Figure, ending: str) -> bytes:
    """Draw a figure for a file.

    Args:
        figure: The figure.
        ending: One of `FIGURE_ENDINGS`.

    Returns:
        The same bytes of the same figure, whenever it is drawn; lines and letters of SVG and PDF can be enlarged.
    """
    if ending == ".png":
        return png_bytes(figure)
    from matplotlib import rc_context

    drawn, undated = io.BytesIO(), {".svg": "Date", ".pdf": "CreationDate"}[ending]
    with rc_context({"svg.hashsalt": "forcetorque"}):
        figure.savefig(drawn, format=ending[1:], metadata={undated: None})
    return drawn.getvalue()


def drawable(values: Any, *, name: str, shape: tuple[int | None, ...]) -> FloatArray:
    """Copy values to an array in which everything that is not a finite number is NaN, which no figure draws.

    Args:
        values: Anything NumPy can turn into numbers.
        name: Name of the argument, for the message.
        shape: Expected shape; `None` accepts any length of that axis but zero.

    Returns:
        A float64 array of that shape.

    Raises:
        ShapeError: If the shape differs, or the array is empty.
    """
    array = np.array(values, dtype=np.float64)
    require_shape(array, name=name, shape=shape)
    if not array.size:
        raise ShapeError(f"{name}: expected at least one sample to draw, got none, of shape {array.shape}")
    array[~np.isfinite(array)] = np.nan
    return array


def drawable_each(given: Mapping[str, Any], *, name: str, shape: tuple[int | None, ...]) -> dict[str, FloatArray]:
    """Do the same for every array of a mapping.

    Args:
        given: Arrays by their names.
        name: Name of the argument, for the message.
        shape: Expected shape of each.

    Returns:
        Arrays by their names, in the same order.

    Raises:
        ShapeError: If the mapping is empty, a shape differs, or an array is empty.
    """
    if not given:
        raise ShapeError(f"{name}: expected at least one name with its array to draw, got none")
    return {key: drawable(values, name=f"{name}[{key!r}]", shape=shape) for key, values in given.items()}


def instants(time_s: Any, *, name: str = "time_s") -> FloatArray:
    """Check that times can be an axis.

    Args:
        time_s: Instants of samples; shape (n,), n at least 1; s.
        name: Name of the argument, for the message.

    Returns:
        The same as an array.

    Raises:
        ShapeError: If the shape differs, there are none, one is not a finite number, or they fall.
    """
    time = drawable(time_s, name=name, shape=(None,))
    # a step from or to a NaN is no step forward
    forward = np.append(np.isfinite(time[0]), np.diff(time) >= 0.0)
    if not forward.all():
        at = int(np.argmin(forward))
        raise ShapeError(f"{name}: expected finite instants that do not fall, got {time[at]:g} s at index {at}")
    return time


DRAWN_SAMPLES = 2000
"""Samples of a line beyond which its smallest and largest values stand for stretches of them."""
DRAWN_POINTS = 3000
"""Points of a cloud beyond which some stand for all."""


def thinned_line(time_s: FloatArray, values: FloatArray, samples: int = DRAWN_SAMPLES) -> tuple[FloatArray, FloatArray]:
    """Take a line of bearable length that keeps every peak and is broken where the samples pause.

    Values that are not numbers break it too, where a whole stretch has none.

    Args:
        time_s: Instants, not falling, at least one; shape (n,); s.
        values: Columns to draw; shape (n, k).
        samples: Length beyond which it is thinned.

    Returns:
        Instants and values of the m points to draw, each unbroken part with a row of NaN after it; shapes (m,), (m, k).
    """
    steps = np.diff(time_s)
    pause = GAP_PERIODS * np.median(steps) if len(steps) else np.inf
    breaks = np.flatnonzero(steps > pause) + 1
    stride = -(-2 * len(time_s) // samples)
    times: list[FloatArray] = []
    drawn: list[FloatArray] = []
    for time, part in zip(np.split(time_s, breaks), np.split(values, breaks), strict=True):
        shown_time, shown = (time, part) if stride <= 2 else _envelope(time, part, stride)
        times += [shown_time, shown_time[-1:]]
        drawn += [shown, np.full((1, values.shape[1]), np.nan)]
    return np.concatenate(times), np.concatenate(drawn)


def thinned_cloud(points: FloatArray, limit: int = DRAWN_POINTS) -> FloatArray:
    """Take points of a cloud evenly in the order of time, first and last among them.

    Args:
        points: The cloud; shape (n, k).
        limit: Greatest number to take, at least 2.

    Returns:
        At most that many of the points; shape (m, k).
    """
    if len(points) <= limit:
        return points
    return points[np.linspace(0, len(points) - 1, limit).round().astype(np.int64)]


def _envelope(time_s: FloatArray, values: FloatArray, stride: int) -> tuple[FloatArray, FloatArray]:
    starts = np.arange(0, len(time_s), stride)
    # fmin, fmax: a missing value must not take the peak beside it along
    smallest, largest = np.fmin.reduceat(values, starts), np.fmax.reduceat(values, starts)
    ends = np.stack([smallest, largest], axis=1).reshape(-1, values.shape[1])
    return np.repeat(time_s[starts], 2), ends


_POINTS = 12
"""Points along a line."""


def draw_over_time(panel: Axes, time_s: FloatArray, values: FloatArray, style: Look, *, turn: int, count: int) -> None:
    """Draw a thinned line over time, with a point here and there.

    Args:
        panel: The panel.
        time_s: Instants, as `thinned_line` gives them; shape (m,); s.
        values: What is drawn, NaN where the line breaks; shape (m,).
        style: Colour of the line and shape of its points; the line is solid.
        turn: Place of the line among those of the panel, so that points of two lines do not meet.
        count: How many lines the panel has.
    """
    where = time_s[0] + (time_s[-1] - time_s[0]) * (np.arange(_POINTS) + (turn + 0.5) / count) / _POINTS
    points = np.minimum(np.searchsorted(time_s, where), len(time_s) - 1)
    panel.plot(
        time_s,
        values,
        color=style.colour,
        linewidth=1.0,
        marker=style.marker,
        markersize=6.5,
        markeredgecolor=PAPER,
        markeredgewidth=0.6,
        markevery=[int(k) for k in points if np.isfinite(values[k])],
    )


def rms_words(wrenches: FloatArray) -> str | None:
    """Give the root mean squares of the norms of force and moment.

    Args:
        wrenches: Wrenches; shape (n, 6); N, N m; NaN in gaps.

    Returns:
        Such as `1.2 N, 0.03 N m`; None where no wrench is whole.
    """
    sizes = rms_sizes(wrenches)
    return None if sizes is None else f"{sizes[0]:.3g} N, {sizes[1]:.3g} N m"


def rms_sizes(wrenches: FloatArray) -> tuple[float, float] | None:
    """Compute the root mean squares of the norms of force and moment.

    Args:
        wrenches: Wrenches; shape (n, 6); N, N m; NaN in gaps.

    Returns:
        That of forces, in N, and that of moments, in N m; None where no wrench is whole.
    """
    whole = wrenches[np.isfinite(wrenches).all(axis=1)]
    if not len(whole):
        return None
    force, moment = (float(np.sqrt((whole[:, part] ** 2).sum(axis=1).mean())) for part in FORCE_AND_MOMENT)
    return force, moment
