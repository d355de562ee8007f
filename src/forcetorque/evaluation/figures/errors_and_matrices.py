# SPDX-License-Identifier: BSD-3-Clause
"""Figures of calibrations: measured against expected wrenches, residuals, and differences between matrices."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.noise.autocorrelation import Autocorrelation, autocorrelation
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.results.figure_style import (
    GRID,
    GUIDE,
    PAPER,
    REFERENCE_COLOUR,
    REFERENCE_LINE,
    ROW_INCHES,
    SMALL_POINTS,
    Look,
    draw_over_time,
    drawable,
    drawable_each,
    headline,
    in_figure_style,
    instants,
    legend_below,
    looks,
    new_figure,
    rms_sizes,
    rms_words,
    shown_name,
    text_inches,
    thinned_line,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_COMPARISON_ROW_HEIGHT = 0.7 * ROW_INCHES[1]


@in_figure_style
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
    figure = new_figure(3 * _COMPARISON_ROW_HEIGHT)
    panels = figure.subplots(3, 2, sharex=True).T.ravel()
    at, lines = thinned_line(time, known)
    for panel, component, line in zip(panels, WRENCH_COMPONENTS, lines.T, strict=True):
        panel.plot(at, line, zorder=3.0, **REFERENCE_LINE)
        panel.set_ylabel(f"{component}, {'N' if component.startswith('f') else 'N m'}")
        panel.grid(visible=True, color=GRID, linewidth=0.6)
        panel.set_axisbelow(True)
        panel.margins(x=0.01)
    keys = [("reference", REFERENCE_LINE)]
    styles = looks(list(by_name))
    for k, (name, values) in enumerate(by_name.items()):
        at, lines = thinned_line(time, values)
        for panel, line in zip(panels, lines.T, strict=True):
            draw_over_time(panel, at, line, styles[name], turn=k, count=len(by_name))
        text = f"{shown_name(name)}: {_difference(values - known)}"
        keys.append((text, styles[name].key | {"linestyle": "-"}))
    for panel in panels[2::3]:
        panel.set_xlabel("time, s")
    figure.align_ylabels()
    headline(figure, _message({name: values - known for name, values in by_name.items()}))
    legend_below(figure, keys)
    return figure


def _message(errors: Mapping[str, FloatArray]) -> str:
    """What errs least in force, and what in moment."""
    known = {name: sizes for name, error in errors.items() if (sizes := rms_sizes(error)) is not None}
    if not known:
        return "No sample has all six components"
    texts = []
    for k, (quantity, unit) in enumerate((("force", "N"), ("moment", "N m"))):
        best = min(known, key=lambda name: known[name][k])
        source = f" ({shown_name(best)})" if len(errors) > 1 else ""
        texts.append(f"{quantity} {known[best][k]:.3g} {unit}{source}")
    return f"{'Least RMS error' if len(errors) > 1 else 'RMS error'}: {', '.join(texts)}"


def _difference(error: FloatArray) -> str:
    size = rms_words(error)
    return "no samples" if size is None else f"rms difference {size}"


_ROW_HEIGHT = 0.75 * ROW_INCHES[1]
_FENCE = 3.0
"""Interquartile ranges beyond the quartiles from where on a residual is an outlier (Tukey's outer fence)."""
_BINS = (8, 50)
"""Least and greatest number of bins."""
_LAG_STRETCHES = 300
"""Stretches of the axis of lags, of each of which the smallest and the largest value are drawn."""
_MARKS = 6
"""Points along a curve over lag."""
_BAND: dict[str, Any] = {"color": GUIDE, "linewidth": 7.0}
_ZERO: dict[str, Any] = {"color": REFERENCE_COLOUR, "linewidth": 0.8}
_MEANING = (
    "Residuals beyond the edges are counted in the bins at the edges. "
    "n_eff = n / (1 + 2 Σ ρ): how many independent samples they are worth"
)


@in_figure_style
def residual_figure(time_s: FloatArray, residuals: Mapping[str, FloatArray]) -> Figure:
    """Draw the distribution of residuals, and their autocorrelation, component by component.

    The bins are common to all candidates. They reach from the least to the greatest residual, but no further than three
    interquartile ranges beyond the quartiles of a candidate; what lies beyond is counted in the bins at the edges, and
    the title says how much it is. Right of each histogram is the autocorrelation over the logarithm of the lag, pooled
    over stretches without a pause. The legend states the root mean square and the effective number of independent
    samples, see `base.noise.autocorrelation`.

    Args:
        time_s: Instants, not falling; shape (n,); s.
        residuals: Measured less reference wrench by candidate, on data that was not fitted; shape (n, 6); N, N m. What
            is not a finite number is left out.

    Returns:
        The figure, a row of two pairs of panels for each axis: forces, then torques.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no candidates or no samples, the shapes differ, time falls or does not pass, or a
            component of a candidate has no finite residual.
    """
    time = instants(time_s)
    by_name = drawable_each(residuals, name="residuals", shape=(len(time), 6))
    correlations = {name: _correlations(name, values, time) for name, values in by_name.items()}
    figure = new_figure(3 * _ROW_HEIGHT)
    grid = _panels(figure)
    by_look = looks(list(by_name))
    styles = list(by_look.values())
    for k, component in enumerate(WRENCH_COMPONENTS):
        counted, correlated = grid[k % 3, 2 * (k // 3)], grid[k % 3, 2 * (k // 3) + 1]
        _draw_histogram(counted, [values[:, k] for values in by_name.values()], component, styles)
        _draw_correlation(correlated, [components[k] for components in correlations.values()], component, styles)
    _share_correlation_axes(grid[:, 1::2].ravel().tolist())
    keys = [
        (f"{shown_name(name)}: {_size(values)}, {_effective(correlations[name])}", by_look[name].key)
        for name, values in by_name.items()
    ]
    headline(figure, _message(by_name))
    legend_below(figure, [*keys, ("ρ of white noise: 95 % lie within", _BAND)], title=_MEANING)
    return figure


def _correlations(name: str, values: FloatArray, time: FloatArray) -> list[Autocorrelation]:
    for component, column in zip(WRENCH_COMPONENTS, values.T, strict=True):
        if not np.isfinite(column).any():
            raise ShapeError(f"residuals[{name!r}]: expected residuals of {component}, got no finite number")
    return [autocorrelation(column, time) for column in values.T]


def _panels(figure: Figure) -> np.ndarray[Any, np.dtype[np.object_]]:
    grid: np.ndarray[Any, np.dtype[np.object_]] = figure.subplots(3, 4, squeeze=False)
    for panel in grid.ravel():
        panel.grid(visible=True, color=GRID, linewidth=0.6)
        panel.set_axisbelow(True)
    for panel in grid[:, 0]:
        panel.set_ylabel("samples, %")
    for panel in grid[2, 1::2]:
        panel.set_xlabel("lag, s")
    return grid


def _draw_histogram(panel: Axes, columns: list[FloatArray], component: str, styles: Sequence[Look]) -> None:
    known = [column[np.isfinite(column)] for column in columns]
    edges = bin_edges(known)
    panel.axvline(0.0, **_ZERO)
    beyond = 0
    for j, values in enumerate(known):
        beyond += int(((values < edges[0]) | (values > edges[-1])).sum())
        counts, _ = np.histogram(np.clip(values, edges[0], edges[-1]), edges)
        share, style = 100.0 * counts / len(values), styles[j]
        panel.stairs(share, edges, color=style.colour, linestyle=style.dashes, linewidth=1.4, baseline=None)
        # a point at its highest bin: the second cue where dashes are short
        top = int(share.argmax())
        panel.plot(edges[top : top + 2].mean(), share[top], style.marker, color=style.colour, markersize=6.0)
    panel.set_ylim(bottom=0.0)
    panel.margins(y=0.1)
    panel.set_xlabel(f"{component}, {'N' if component.startswith('f') else 'N m'}", labelpad=1.0)
    title = f"{beyond} of {sum(map(len, known))} beyond the edges" if beyond else "none beyond the edges"
    panel.set_title(title)


def bin_edges(columns: list[FloatArray]) -> FloatArray:
    """Divide the range of residuals, without outliers, in bins.

    Args:
        columns: Finite residuals of each candidate, at least one each; shape (n,).

    Returns:
        Edges of bins of one width; shape (b + 1,).
    """
    low, high = math.inf, -math.inf
    for values in columns:
        first, third = np.quantile(values, (0.25, 0.75))
        # where most are alike there is no scale to call the others outliers by
        reach = _FENCE * (third - first) or math.inf
        low, high = min(low, max(values.min(), first - reach)), max(high, min(values.max(), third + reach))
    if not high > low:
        # all alike: one bin in the middle of some
        half = 0.5 * abs(low) or 0.5
        low, high = low - half, high + half
    # the rule of Rice, for the smallest candidate
    bins = int(np.clip(2.0 * min(map(len, columns)) ** (1.0 / 3.0), *_BINS))
    return np.linspace(low, high, bins + 1)


def _draw_correlation(panel: Axes, correlations: list[Autocorrelation], component: str, styles: Sequence[Look]) -> None:
    panel.set_xscale("log")
    longest = max(correlations, key=lambda correlation: len(correlation.lag_s))
    if len(longest.lag_s) > 1:
        lag, band = thinned_lags(longest.lag_s, longest.white_band)
        panel.fill_between(lag, -band, band, color=_BAND["color"], linewidth=0.0)
    panel.axhline(0.0, **_ZERO)
    for j, correlation in enumerate(correlations):
        if np.isfinite(correlation.integrated_time):
            style = styles[j]
            at, drawn = thinned_lags(correlation.lag_s, correlation.rho)
            turn = (j + 0.5) / len(correlations) / _MARKS
            panel.plot(
                at,
                drawn,
                color=style.colour,
                linestyle=style.dashes,
                linewidth=1.2,
                marker=style.marker,
                markersize=5.0,
                markeredgecolor=PAPER,
                markeredgewidth=0.5,
                markevery=[int(len(at) * (m / _MARKS + turn)) for m in range(_MARKS)],
            )
    panel.set_title(f"autocorrelation ρ of {component}")


def thinned_lags(lag_s: FloatArray, rho: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Take a curve over the logarithm of lag that keeps every peak.

    Args:
        lag_s: Lags from 0 on; shape (l,), l at least 2; s.
        rho: Values at them; shape (l,).

    Returns:
        Lags and values to draw, without lag 0; of each stretch the smallest and the largest value; shapes (m,), (m,).
    """
    starts = np.unique(np.geomspace(1.0, len(rho), _LAG_STRETCHES).astype(np.int64))[:-1]
    if len(rho) == 2:
        starts = np.array([1])
    ends = np.stack([np.minimum.reduceat(rho, starts), np.maximum.reduceat(rho, starts)], axis=1).ravel()
    return np.repeat(lag_s[starts], 2), ends


def _share_correlation_axes(panels: list[Axes]) -> None:
    low = min(panel.get_ylim()[0] for panel in panels)
    spans = [panel.get_xlim() for panel in panels if panel.lines[1:]]
    for panel in panels:
        panel.set_ylim(max(-1.05, low), 1.05)
        if spans:
            panel.set_xlim(min(span[0] for span in spans), max(span[1] for span in spans))


def _size(values: FloatArray) -> str:
    size = rms_words(values)
    return "no whole samples" if size is None else f"rms {size}"


def _effective(correlations: list[Autocorrelation]) -> str:
    count = max(correlation.count for correlation in correlations)
    numbers = [
        f"{name} {_rounded(correlation.effective_count)}"
        for name, correlation in zip(WRENCH_COMPONENTS, correlations, strict=True)
    ]
    return f"n {count}, n_eff {', '.join(numbers)}"


def _rounded(count: float) -> str:
    """A number that is known to a part of itself."""
    return "–" if math.isnan(count) else f"{count:.{int(count < 9.95)}f}"


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
_NOT_A_NUMBER = GUIDE
_MIDDLE_LUMINANCE = 0.179
"""Where black and white letters have the same contrast: (L + 0.05)^2 = 1.05 x 0.05."""


@in_figure_style
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
    if largest > 0.0:
        one, other = np.unravel_index(int(np.nanargmax(matrix)), matrix.shape)
        headline(figure, f"Largest difference: {largest:.3g} in {shown_name(unit)}, {shown[one]} to {shown[other]}")
    return figure


def _luminance(colours: FloatArray) -> FloatArray:
    """Relative luminance of colours of sRGB, 0 for black and 1 for white, with a plain power for their curve."""
    weights = np.array([0.2126, 0.7152, 0.0722])
    return colours[..., :3] ** 2.2 @ weights


def _name_cells(panel: Axes, names: list[str], room: float, *, level: bool) -> None:
    places = range(len(names))
    panel.tick_params(top=True, bottom=False, labeltop=True, labelbottom=False, length=0.0)
    panel.set_yticks(places, names)
    # too many to be named twice: the columns are in the order of the rows
    named = level or room > _SLANTED_INCHES
    panel.set_xticks(places, names if named else [""] * len(names))
    if named and not level:
        for label in panel.get_xticklabels():
            label.set(rotation=_SLANT, ha="left", va="bottom", rotation_mode="anchor")
    edges = [place + 0.5 for place in places[:-1]]
    for lines in (panel.hlines, panel.vlines):
        lines(edges, -0.5, len(names) - 0.5, color=PAPER, linewidth=min(1.0, 2.0 * room))
    for edge in panel.spines.values():
        edge.set_visible(False)


def _letters_that_fit(texts: list[list[str]]) -> float:
    """Size of letters with which all numbers fit in their cells; 0 where that would be too small to read; points."""
    widest = max(len(text) for row in texts for text in row)
    points = min(SMALL_POINTS, 0.87 * _TABLE_INCHES * 72.0 / len(texts) / (widest * _LETTER_ASPECT))
    return points if points >= _READABLE_POINTS else 0.0


def _write_cells(panel: Axes, texts: list[list[str]], dark: BoolArray, points: float) -> None:
    for row, column in np.ndindex(dark.shape):
        colour = PAPER if dark[row, column] else REFERENCE_COLOUR
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
