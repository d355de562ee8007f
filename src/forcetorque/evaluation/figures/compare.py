# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the indices of many sensors, conditions and trials, with the mean and the pooled fit of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.sphere.findings import EllipsoidFit
from forcetorque.evaluation.trials.trials import TrialGroup
from forcetorque.results.figures.canvas import SMALL_POINTS, TITLE_POINTS, legend_below, look, new_figure, shown_name
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_LINE_INCHES, _GAP_INCHES, _HEAD_INCHES = 0.135, 0.06, 1.1
"""Height of a line, of what separates two groups, and of all but the lines; inch."""
_LEAST_INCHES, _MOST_INCHES = 3.2, 400.0
"""Bounds of the height of the panels, so that few lines do not crowd and matplotlib can still write the file; inch."""
_SCREEN_INCHES = 8.0
"""Height beyond which one end of an axis is not seen from the other; inch."""
_UNKNOWN = "0.55"
"""Colour of what is not identifiable."""
_TRIAL, _MEAN, _POOLED = look(0), look(1), look(2)
_MARGIN = 1.08
"""Width of a panel, relative to the largest number that is known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Line:
    """A number with its interval, kg."""

    kind: str
    index: float
    low: float
    high: float
    known: bool


def index_figure(groups: Sequence[TrialGroup]) -> Figure:
    """Draw the performance indices of groups of trials, with their intervals, the smallest on top.

    Left by the fits with the model, right without; a panel that has nothing is left out. Each group has a line for
    every trial and, where there are several, one for their mean and one for the pooled fit. What is not identifiable is
    hollow and grey; groups of which nothing is identifiable come last, in the order that they were given in.

    Args:
        groups: The groups.

    Returns:
        The figure, as high as it has lines.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no group.
    """
    if not groups:
        raise ShapeError("indices: expected at least one group to draw, got none")
    ordered = sorted(groups, key=_place)
    modes = [mode for mode in (True, False) if any(_lines(group, with_reference=mode) for group in groups)]
    tops = np.cumsum([0.0, *(_height(group) for group in ordered)])
    inches = float(tops[-1])
    scale = min(max(1.0, _LEAST_INCHES / inches), _MOST_INCHES / inches)
    figure = new_figure(_HEAD_INCHES + inches * scale)
    panels = figure.subplots(1, len(modes), sharey=True, squeeze=False)[0]
    for panel, mode in zip(panels, modes, strict=True):
        words = "with the model" if mode else "without the model"
        panel.set_title(f"index {words}", loc="left", fontsize=TITLE_POINTS)
        panel.set_xlabel("index, kg")
        panel.set_xlim(0.0, _reach([line for group in groups for line in _lines(group, with_reference=mode)]))
        for k, (group, top) in enumerate(zip(ordered, tops[:-1], strict=True)):
            if k % 2:
                panel.axhspan(top, tops[k + 1], color="0.96", linewidth=0.0, zorder=0)
            _draw(panel, _lines(group, with_reference=mode), float(top))
        panel.grid(visible=True, axis="x", color="0.9", linewidth=0.6)
        panel.set_axisbelow(True)
        panel.tick_params(axis="y", length=0.0)
        panel.tick_params(axis="x", labeltop=inches > _SCREEN_INCHES)
    panels[0].set_ylim(inches, 0.0)
    panels[0].set_yticks(0.5 * (tops[:-1] + tops[1:]), _names(ordered), fontsize=SMALL_POINTS)
    legend_below(figure, _keys(groups))
    return figure


def _place(group: TrialGroup) -> tuple[float, float]:
    with_reference, without = (group.index(with_reference=mode) for mode in (True, False))
    return np.inf if with_reference is None else with_reference, np.inf if without is None else without


def _height(group: TrialGroup) -> float:
    count = len(group.trials)
    return _GAP_INCHES + _LINE_INCHES * (count + 2 if count > 1 else 1)


def _lines(group: TrialGroup, *, with_reference: bool) -> list[_Line]:
    fits = [(trial.gravity, trial.fit(with_reference=with_reference)) for trial in group.trials]
    lines = [_line("trial", fit, gravity) for gravity, fit in fits if fit is not None]
    mean, pooled = group.mean(with_reference=with_reference), group.pooled_fit(with_reference=with_reference)
    if len(group.trials) > 1 and mean is not None:
        lines.append(_Line(kind="mean", index=mean.mean, low=mean.low, high=mean.high, known=True))
    if pooled is not None:
        lines.append(_line("pooled", pooled, group.first.gravity))
    return lines


def _line(kind: str, fit: EllipsoidFit, gravity: float) -> _Line:
    return _Line(
        kind=kind,
        index=fit.index / gravity,
        low=fit.index_low / gravity,
        high=fit.index_high / gravity,
        known=fit.identifiable,
    )


def _reach(lines: Sequence[_Line]) -> float:
    """Right end of a panel: what is known decides, else what is there; intervals may go beyond it."""
    known = [line.index for line in lines if line.known]
    known += [line.high for line in lines if line.known and line.kind != "mean" and np.isfinite(line.high)]
    shown = known or [line.index for line in lines if np.isfinite(line.index)]
    return _MARGIN * max([*shown, 0.05])


def _draw(panel: Axes, lines: Sequence[_Line], top: float) -> None:
    right = panel.get_xlim()[1]
    for k, line in enumerate(lines):
        y = top + 0.5 * _GAP_INCHES + (k + 0.5) * _LINE_INCHES
        style = {"trial": _TRIAL, "mean": _MEAN, "pooled": _POOLED}[line.kind]
        colour = style.colour if line.known else _UNKNOWN
        dashes = "-" if line.known else ":"
        panel.plot([line.low, min(line.high, right)], [y, y], linestyle=dashes, color=colour, linewidth=1.1)
        if line.high > right:
            panel.plot([right], [y], ">", color=colour, markersize=4.0, markeredgewidth=0.0, clip_on=False)
        if np.isfinite(line.index) and line.index <= right:
            face = colour if line.known else "white"
            panel.plot(
                [line.index],
                [y],
                style.marker,
                color=colour,
                markerfacecolor=face,
                markersize=5.0,
                zorder=3,
                clip_on=False,
            )


def _names(groups: Sequence[TrialGroup]) -> list[str]:
    """Names of groups, by what tells them apart."""
    sensors = {group.first.sphere.sensor for group in groups}
    candidates = short_names([group.first.sphere.candidate for group in groups])
    names = []
    for group in groups:
        sphere = group.first.sphere
        words = [f"{sphere.sensor} ({sphere.serial})" if len(sensors) > 1 else sphere.serial]
        if group.first.condition is not None:
            words.append(group.first.condition)
        if len(candidates) > 1:
            words.append(candidates[sphere.candidate])
        names.append(shown_name(", ".join(words)))
    return names


def _keys(groups: Sequence[TrialGroup]) -> list[tuple[str, dict[str, Any]]]:
    keys: list[tuple[str, dict[str, Any]]] = [("trial, 95 % interval", _key(_TRIAL.colour, _TRIAL.marker))]
    if any(len(group.trials) > 1 for group in groups):
        keys.append(("mean of the trials, from their scatter", _key(_MEAN.colour, _MEAN.marker)))
        keys.append(("pooled fit, 95 % interval", _key(_POOLED.colour, _POOLED.marker)))
    lines = [line for group in groups for mode in (True, False) for line in _lines(group, with_reference=mode)]
    if any(not line.known for line in lines):
        unknown = {"color": _UNKNOWN, "linestyle": ":", "marker": "o", "markerfacecolor": "white"}
        keys.append(("not identifiable", unknown))
    return keys


def _key(colour: str, marker: str) -> dict[str, Any]:
    return {"color": colour, "linestyle": "-", "marker": marker, "markersize": 5.0}
