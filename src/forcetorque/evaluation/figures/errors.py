# SPDX-License-Identifier: BSD-3-Clause
"""Figures of measured against expected wrenches, and of residuals on data that were not fitted."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.noise.autocorrelation import Autocorrelation, autocorrelation
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.results.figures.canvas import (
    REFERENCE_COLOUR,
    REFERENCE_LINE,
    ROW_INCHES,
    SMALL_POINTS,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.results.figures.curves import (
    draw_over_time,
    drawable,
    drawable_each,
    instants,
    rms_words,
    thinned_line,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_COMPARISON_ROW_HEIGHT = 0.7 * ROW_INCHES[1]


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
        panel.grid(visible=True, color="0.9", linewidth=0.6)
        panel.set_axisbelow(True)
        panel.margins(x=0.01)
    keys = [("reference", REFERENCE_LINE)]
    for k, (name, values) in enumerate(by_name.items()):
        at, lines = thinned_line(time, values)
        for panel, line in zip(panels, lines.T, strict=True):
            draw_over_time(panel, at, line, look(k), turn=k, count=len(by_name))
        text = f"{shown_name(name)}: {_difference(values - known)}"
        keys.append((text, look(k).key | {"linestyle": "-"}))
    for panel in panels[2::3]:
        panel.set_xlabel("time, s")
    figure.align_ylabels()
    legend_below(figure, keys)
    return figure


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
_BAND: dict[str, Any] = {"color": "0.82", "linewidth": 7.0}
_ZERO: dict[str, Any] = {"color": REFERENCE_COLOUR, "linewidth": 0.8}
_MEANING = (
    "Residuals beyond the edges are counted in the bins at the edges. "
    "n_eff = n / (1 + 2 Σ ρ): how many independent samples they are worth"
)


def residual_figure(time_s: FloatArray, residuals: Mapping[str, FloatArray]) -> Figure:
    """Draw the distribution of residuals, and their autocorrelation, component by component.

    The bins are common to all candidates. They reach from the least to the greatest residual, but no further than three
    interquartile ranges beyond the quartiles of a candidate; what lies beyond is counted in the bins at the edges, and
    the title says how much it is. Right of each histogram is the autocorrelation over the logarithm of the lag, pooled
    over stretches without a pause. The legend states the root mean square and the effective number of independent
    samples, see `evaluation.autocorrelation`.

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
    for k, component in enumerate(WRENCH_COMPONENTS):
        counted, correlated = grid[k % 3, 2 * (k // 3)], grid[k % 3, 2 * (k // 3) + 1]
        _draw_histogram(counted, [values[:, k] for values in by_name.values()], component)
        _draw_correlation(correlated, [components[k] for components in correlations.values()], component)
    _share_correlation_axes(grid[:, 1::2].ravel().tolist())
    keys = [
        (f"{shown_name(name)}: {_size(values)}, {_effective(correlations[name])}", look(j).key)
        for j, (name, values) in enumerate(by_name.items())
    ]
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
        panel.tick_params(labelsize=SMALL_POINTS)
        panel.grid(visible=True, color="0.9", linewidth=0.6)
        panel.set_axisbelow(True)
    for panel in grid[:, 0]:
        panel.set_ylabel("samples, %", fontsize=SMALL_POINTS)
    for panel in grid[2, 1::2]:
        panel.set_xlabel("lag, s", fontsize=SMALL_POINTS)
    return grid


def _draw_histogram(panel: Axes, columns: list[FloatArray], component: str) -> None:
    known = [column[np.isfinite(column)] for column in columns]
    edges = bin_edges(known)
    panel.axvline(0.0, **_ZERO)
    beyond = 0
    for j, values in enumerate(known):
        beyond += int(((values < edges[0]) | (values > edges[-1])).sum())
        counts, _ = np.histogram(np.clip(values, edges[0], edges[-1]), edges)
        share, style = 100.0 * counts / len(values), look(j)
        panel.stairs(share, edges, color=style.colour, linestyle=style.dashes, linewidth=1.4, baseline=None)
        # a point at its highest bin: the second cue where dashes are short
        top = int(share.argmax())
        panel.plot(edges[top : top + 2].mean(), share[top], style.marker, color=style.colour, markersize=6.0)
    panel.set_ylim(bottom=0.0)
    panel.margins(y=0.1)
    panel.set_xlabel(f"{component}, {'N' if component.startswith('f') else 'N m'}", fontsize=SMALL_POINTS, labelpad=1.0)
    title = f"{beyond} of {sum(map(len, known))} beyond the edges" if beyond else "none beyond the edges"
    panel.set_title(title, fontsize=SMALL_POINTS)


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


def _draw_correlation(panel: Axes, correlations: list[Autocorrelation], component: str) -> None:
    panel.set_xscale("log")
    longest = max(correlations, key=lambda correlation: len(correlation.lag_s))
    if len(longest.lag_s) > 1:
        lag, band = thinned_lags(longest.lag_s, longest.white_band)
        panel.fill_between(lag, -band, band, color=_BAND["color"], linewidth=0.0)
    panel.axhline(0.0, **_ZERO)
    for j, correlation in enumerate(correlations):
        if np.isfinite(correlation.integrated_time):
            style = look(j)
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
                markeredgecolor="white",
                markeredgewidth=0.5,
                markevery=[int(len(at) * (m / _MARKS + turn)) for m in range(_MARKS)],
            )
    panel.set_title(f"autocorrelation ρ of {component}", fontsize=SMALL_POINTS)


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
