# SPDX-License-Identifier: BSD-3-Clause
"""Figure of the errors of the net contact force by phase, candidate and offset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.analysis import Coherence, PhaseForce
from forcetorque.analysis.coherence.rows import policy_words
from forcetorque.report.figures.canvas import (
    ROW_INCHES,
    SMALL_POINTS,
    TITLE_POINTS,
    Look,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.result.names import short_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SPREAD = 0.5
"""Width that the candidates of one phase take, of that of the phase."""
_LONGEST_LABEL = 14
"""Characters of the name of a phase that stands level below its place; longer ones are turned."""


def coherence_figure(result: Coherence) -> Figure:
    """Draw what the net contact force of every phase is off the weight, with 95 % intervals.

    A row for each offset, a panel for each axis. Hollow is what is near zero by construction.

    Args:
        result: The answer.

    Returns:
        The figure, a row for each offset.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    offsets = list(dict.fromkeys((row.offset, row.offset_interval) for row in result.rows))
    names = short_names([row.candidate for row in result.rows])
    looks = {candidate: look(k) for k, candidate in enumerate(names)}
    figure = new_figure(ROW_INCHES[1] * len(offsets))
    for line, panels in zip(offsets, figure.subplots(len(offsets), 3, squeeze=False, sharey="row"), strict=True):
        rows = [row for row in result.rows if (row.offset, row.offset_interval) == line]
        for axis, panel in enumerate(panels):
            _draw(panel, rows, looks, axis)
            panel.set_title(f"E{'xyz'[axis]}", loc="left", fontsize=TITLE_POINTS)
        panels[0].set_ylabel(shown_name(f"{policy_words(*line)}; N"), fontsize=SMALL_POINTS)
    keys: list[tuple[str, dict[str, Any]]] = [
        (shown_name(names[candidate]), {"color": one.colour, "marker": one.marker, "linestyle": "none"})
        for candidate, one in looks.items()
    ]
    if not all(row.evidence for row in result.rows):
        hollow = {"color": "0.4", "marker": "o", "markerfacecolor": "white", "linestyle": "none"}
        keys.append(("not evidence: the phase gave offset or matrix", hollow))
    legend_below(figure, keys)
    return figure


def _draw(panel: Axes, rows: Sequence[PhaseForce], looks: dict[str, Look], axis: int) -> None:
    phases = list(dict.fromkeys(row.phase for row in rows))
    shift = dict(zip(looks, _SPREAD * (np.linspace(0.0, 1.0, len(looks) + 2)[1:-1] - 0.5), strict=True))
    for row in rows:
        one, x = looks[row.candidate], phases.index(row.phase) + shift[row.candidate]
        half = row.force_half_width_95_N[axis]
        panel.errorbar(
            [x],
            [row.force_error_N[axis]],
            yerr=None if half is None else [half],
            color=one.colour,
            marker=one.marker,
            markersize=5.0,
            markerfacecolor=one.colour if row.evidence else "white",
            linewidth=1.0,
            capsize=2.0,
        )
    panel.axhline(0.0, color="0.5", linewidth=0.8, zorder=0)
    turned = max(map(len, phases)) * len(phases) > 3 * _LONGEST_LABEL
    panel.set_xticks(
        range(len(phases)),
        [shown_name(phase) for phase in phases],
        fontsize=SMALL_POINTS,
        rotation=30.0 if turned else 0.0,
        ha="right" if turned else "center",
    )
    panel.set_xlim(-0.6, len(phases) - 0.4)
    panel.grid(visible=True, axis="y", color="0.9", linewidth=0.6)
    panel.set_axisbelow(True)
