# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a checked dataset: in which episodes what is wrong, and the weight along gravity in each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from forcetorque.base.errors import ShapeError
from forcetorque.base.units import NORMAL_95
from forcetorque.results.figure_style import (
    GRID,
    MUTED,
    headline,
    in_figure_style,
    legend_below,
    looks,
    new_figure,
    shown_name,
)
from forcetorque.results.number_text import counted
from forcetorque.results.visual_roles import FINDING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from forcetorque.dataset.result import DatasetCheck, DatasetFinding

_ROW_INCHES, _WEIGHT_INCHES, _FRAME_INCHES = 0.3, 2.0, 1.0
"""Height of a row of findings, of the weights, and of titles and the axis; inch."""
_MOST_ROWS: Final = 25
"""Rows that are drawn; the others are counted."""
_BAR_HEIGHT: Final = 0.8
"""Height of the mark of an episode, in rows."""
_HARM, _REMARK = FINDING.colour, MUTED


@in_figure_style
def episodes_figure(check: DatasetCheck) -> Figure:
    """Draw in which episodes something is wrong, and the weight of the tool along gravity.

    Args:
        check: What was found.

    Returns:
        The figure over episodes: a row per finding, those of harm first; below it the weights with their 95 %
        intervals, where they are separable from the bias.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no episode.
    """
    if not check.records_of_episodes:
        raise ShapeError(f"{check.source}: expected at least one episode to draw, got none")
    shown = check.findings[:_MOST_ROWS]
    weighed = [row for row in check.records_of_episodes if row.weight is not None and row.weight_error is not None]
    rows = max(len(shown), 1)
    heights = [_ROW_INCHES * rows + 0.2, *([_WEIGHT_INCHES] if weighed else [])]
    figure = new_figure(_FRAME_INCHES + sum(heights))
    panels = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
    _draw_findings(panels[0], shown)
    numbers = [row.episode for row in check.records_of_episodes]
    panels[-1].set_xlim(min(numbers) - 0.6, max(numbers) + 0.6)
    panels[-1].xaxis.get_major_locator().set_params(integer=True)
    panels[-1].set_xlabel("episode")
    keys: list[tuple[str, Any]] = [
        ("does harm", {"color": _HARM, "marker": "s", "linestyle": "none"}),
        ("remark", {"color": _REMARK, "marker": "s", "linestyle": "none"}),
    ]
    if weighed:
        panels[1].set_title("weight along gravity, in the unit of the field; line: 95 % interval", loc="left")
        panels[1].grid(color=GRID, linewidth=0.6)
        for name, style in looks(list(dict.fromkeys(row.field for row in weighed))).items():
            own = [row for row in weighed if row.field == name]
            at, weight, error = np.array([(row.episode, row.weight, row.weight_error) for row in own]).T
            panels[1].errorbar(at, weight, NORMAL_95 * error, color=style.colour, marker=style.marker, linestyle="none")
            keys.append((shown_name(name), style.key | {"linestyle": "-"}))
    legend_below(figure, keys)
    headline(figure, _message(check))
    return figure


def _draw_findings(panel: Axes, findings: tuple[DatasetFinding, ...]) -> None:
    for place, finding in enumerate(findings):
        left = np.array(finding.episodes) - 0.5
        colour = _HARM if finding.harm else _REMARK
        panel.barh([place] * len(left), 1.0, left=left, height=_BAR_HEIGHT, color=colour)
    names = [shown_name(f"{_of(one)}: {one.kind.replace('_', ' ')}") for one in findings]
    panel.set_yticks(range(len(names) or 1), names or ["nothing found"])
    panel.set_ylim(max(len(names), 1) - 0.4, -0.6)
    panel.grid(axis="x", color=GRID, linewidth=0.6)


def _of(finding: DatasetFinding) -> str:
    return finding.field if finding.component is None else f"{finding.field} {finding.component}"


def _message(check: DatasetCheck) -> str:
    harmed = {number for finding in check.findings if finding.harm for number in finding.episodes}
    rest = len(check.findings) - _MOST_ROWS
    more = f"; {counted(rest, 'more finding')} not drawn" if rest > 0 else ""
    kinds = len({finding.kind for finding in check.findings if finding.harm})
    found = f"{counted(kinds, 'kind')} of harm, in {len(harmed)} of {counted(check.episodes, 'episode')}"
    return f"{shown_name(check.source)}: {found if kinds else 'no harm found'}{more}"
