# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a decision: predicted errors at the loads of use, against what is allowed and measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.load_cases.verdict import LoadCaseError, LoadCaseVerdict
from forcetorque.results.figure_style import (
    GRID,
    LIMIT_LINE,
    PAPER,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
    two_digits,
)
from forcetorque.results.visual_roles import PRIOR, SHADE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_POINTS = 13.0
"""Size of the letters: the figure is read on paper, at half its width."""
_ROW_INCHES, _FRAME_INCHES = 1.75, 1.1
"""Height of a row with its two intervals and their words, and of the titles and the axis; inch."""
_BEFORE_AT, _AFTER_AT, _MEASURED_AT, _WORDS_AT, _LIMIT_AT = -0.16, 0.2, 0.3, 0.08, 0.46
"""Heights within a row: of the two intervals, of what was measured, of words above them, and of those at the limit."""
_MARGIN, _WORDS, _LIMIT_WORDS = 0.04, 0.33, 0.4
"""Parts of the width of a panel: beside what is drawn, half of the words above an interval, and those at a limit."""
_LEAST_DECADES = 0.9
"""Decades that a panel shows at least, so that its axis has numbers."""
_BEFORE: dict[str, Any] = {"color": PRIOR.colour, "marker": "s", "markerfacecolor": PAPER, "linestyle": "-"}
_AFTER: dict[str, Any] = {"color": look(0).colour, "marker": look(0).marker, "linestyle": "-"}
_AFTER_BEYOND: dict[str, Any] = {"color": look(1).colour, "marker": "X", "linestyle": (0, (2, 1))}
_MEASURED: dict[str, Any] = {"color": look(2).colour, "marker": "D", "linestyle": "none"}


@in_figure_style
def use_figure(verdicts: Sequence[LoadCaseVerdict], names: Mapping[str, str]) -> Figure:
    """Draw how large the errors at the loads of use will be, with the prior matrix and with the calibration.

    Beside them stands what the calibration errs by on data that were not fitted.

    Args:
        verdicts: Verdicts on a sensor, those with predicted errors.
        names: What to show by name of a calibration.

    Returns:
        The figure: a row per calibration and load case; force on the left, moment on the right, as far as measured.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no verdict, or one that predicts nothing.
    """
    if not verdicts or not all(verdict.errors for verdict in verdicts):
        raise ShapeError("uses: expected at least one verdict, each with predicted errors")
    figure = new_figure(_FRAME_INCHES + _ROW_INCHES * len(verdicts))
    quantities = [row.quantity for row in verdicts[0].errors]
    panels = figure.subplots(1, len(quantities), squeeze=False, sharey=True)[0]
    for k, (panel, quantity) in enumerate(zip(panels, quantities, strict=True)):
        rows = [verdict.errors[k] for verdict in verdicts]
        _set_axis(panel, rows)
        for place, row in enumerate(rows):
            _draw_row(panel, place, row)
        panel.set_title(f"{quantity} error, {rows[0].unit}", loc="left", fontsize=_POINTS, fontweight="bold")
    panels[0].set_ylim(len(verdicts) - 0.4, -0.5)
    labels = [f"{shown_name(names[verdict.calibration])}\n{shown_name(verdict.load_case)}" for verdict in verdicts]
    panels[0].set_yticks(range(len(verdicts)), labels, fontsize=_POINTS)
    legend_below(
        figure,
        _keys([row for verdict in verdicts for row in verdict.errors]),
        title="mark: half of such sensors err less; line: 95 % of them; in brackets: its upper end",
        points=_POINTS,
    )
    headline(figure, _title(verdicts))
    return figure


def _title(verdicts: Sequence[LoadCaseVerdict]) -> str:
    """Predictions come last: a verdict against a use, and measured errors beyond what is allowed, are said before."""
    refused = sum(verdict.decision == "do not use" for verdict in verdicts)
    beyond = sum(any(_measured_beyond(row) for row in verdict.errors) for verdict in verdicts)
    return ". ".join(
        [
            *([f"Do not use for {refused} of {len(verdicts)}"] if refused else []),
            *([f"Measured errors of {beyond} of {len(verdicts)} are beyond what is allowed"] if beyond else []),
            _predicted(verdicts),
        ]
    )


def _measured_beyond(row: LoadCaseError) -> bool:
    return row.measured is not None and row.allowed is not None and row.measured > row.allowed


def _predicted(verdicts: Sequence[LoadCaseVerdict]) -> str:
    limited = [verdict for verdict in verdicts if any(row.allowed is not None for row in verdict.errors)]
    if limited:
        kept = sum(all(_style(row) is _AFTER for row in verdict.errors) for verdict in limited)
        return f"{kept} of {len(limited)} predictions stay within what is allowed, with 95 %"
    largest = max((verdict.errors[0] for verdict in verdicts), key=lambda row: row.after_at_most)
    return f"Largest predicted {largest.quantity} error: at most {two_digits(largest.after_at_most)} {largest.unit}"


def _keys(rows: Sequence[LoadCaseError]) -> list[tuple[str, Mapping[str, Any]]]:
    """What the legend names: what is drawn."""
    styles = [_style(row) for row in rows]
    return [
        *([("before: prior matrix", _BEFORE)] if any(row.before is not None for row in rows) else []),
        *([("after: calibration", _AFTER)] if _AFTER in styles else []),
        *([("after, perhaps too much", _AFTER_BEYOND)] if _AFTER_BEYOND in styles else []),
        *([("measured on other data", _MEASURED)] if any(row.measured is not None for row in rows) else []),
        *([("allowed; grey: too much", LIMIT_LINE)] if any(row.allowed is not None for row in rows) else []),
    ]


def _style(row: LoadCaseError) -> dict[str, Any]:
    return _AFTER_BEYOND if row.allowed is not None and row.after_at_most > row.allowed else _AFTER


def _draw_row(panel: Axes, place: int, row: LoadCaseError) -> None:
    if row.before is not None and row.before_at_least is not None and row.before_at_most is not None:
        quantiles = row.before_at_least, row.before, row.before_at_most
        _draw_interval(panel, place + _BEFORE_AT, quantiles, f"before {_words(quantiles, row.unit)}", _BEFORE)
    quantiles = row.after_at_least, row.after, row.after_at_most
    _draw_interval(panel, place + _AFTER_AT, quantiles, f"after {_words(quantiles, row.unit)}", _style(row))
    if row.measured is not None:
        size = max(row.measured, panel.get_xlim()[0])
        panel.plot(size, place + _MEASURED_AT, markersize=9.0, zorder=3, **_MEASURED)
    if row.allowed is None:
        return
    top, bottom = place - 0.47, place + 0.47
    end = panel.get_xlim()[1]
    if row.allowed < end:
        left = max(row.allowed, panel.get_xlim()[0])
        panel.fill_between([left, end], top, bottom, color=SHADE, linewidth=0.0, zorder=0)
    panel.plot([row.allowed] * 2, [top, bottom], zorder=1, **LIMIT_LINE)
    panel.annotate(
        f"{two_digits(row.allowed)} {row.unit} allowed",
        (row.allowed, place + _LIMIT_AT),
        (-6.0, 0.0),
        textcoords="offset points",
        ha="right",
        va="bottom",
        fontsize=_POINTS,
    )


def _draw_interval(panel: Axes, height: float, quantiles: tuple[float, float, float], words: str, style: Any) -> None:
    from matplotlib.patheffects import withStroke

    least = panel.get_xlim()[0]
    low, middle, high = (max(value, least) for value in quantiles)
    panel.plot([low, high], [height] * 2, color=style["color"], linestyle=style["linestyle"], linewidth=3.0)
    mark = {key: value for key, value in style.items() if key != "linestyle"}
    panel.plot(middle, height, linestyle="none", markersize=11.0, markeredgewidth=1.6, zorder=3, **mark)
    panel.annotate(
        words,
        (_centre(low, high), height - _WORDS_AT),
        ha="center",
        va="bottom",
        fontsize=_POINTS,
        color=style["color"],
        path_effects=[withStroke(linewidth=5.0, foreground=PAPER)],  # the limit may pass behind them
    )


def _words(quantiles: tuple[float, float, float], unit: str) -> str:
    _, middle, high = quantiles
    return f"{two_digits(middle)} {unit} (95 %: {two_digits(high)})"


def _centre(low: float, high: float) -> float:
    return float(np.sqrt(low * high))


def _set_axis(panel: Axes, rows: Sequence[LoadCaseError]) -> None:
    """A logarithmic axis with room for the words above every interval, and for the limits."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    ends = np.log10(_ends(rows))
    limits = np.log10([row.allowed for row in rows if row.allowed is not None])
    centres = ends.mean(axis=1)
    # what stands at a place of the axis, and the part of the panel that it takes to either side
    places = [(ends.min(), _MARGIN), (ends.max(), _MARGIN), (centres.min(), _WORDS), (centres.max(), _WORDS)]
    places += [(np.log10(row.measured), _MARGIN) for row in rows if row.measured]
    left = [*places, *((limit, _LIMIT_WORDS) for limit in limits)]
    right = [*places, *((limit, _MARGIN) for limit in limits)]
    width = max(
        _LEAST_DECADES, *((far - near) / (1.0 - before - after) for near, before in left for far, after in right)
    )
    start, end = min(at - take * width for at, take in left), max(at + take * width for at, take in right)
    spare = 0.5 * max(width - (end - start), 0.0)
    start, end = start - spare, end + spare
    panel.set(xscale="log", xlim=(10.0**start, 10.0**end))
    panel.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if end - start < 2.0 else (1.0,)))
    panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    panel.xaxis.set_minor_formatter(NullFormatter())
    panel.tick_params(labelsize=_POINTS)
    panel.grid(visible=True, axis="x", color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


def _ends(rows: Sequence[LoadCaseError]) -> FloatArray:
    """Lower and upper ends of all intervals, above zero; shape (k, 2)."""
    pairs = [(row.after_at_least, row.after_at_most) for row in rows]
    pairs += [
        (row.before_at_least, row.before_at_most)
        for row in rows
        if row.before_at_least is not None and row.before_at_most is not None
    ]
    ends = np.array(pairs)
    above = ends[ends > 0.0]
    return np.maximum(ends, 0.1 * above.min() if above.size else 1.0)
