# SPDX-License-Identifier: BSD-3-Clause
"""Figure of what a skinManager saw: its heuristic over time, which is not newtons."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from forcetorque.analysis.skin.event_rows import SkinEventPicture
from forcetorque.errors import ShapeError
from forcetorque.report.figures.canvas import ROW_INCHES, TITLE_POINTS, legend_below, look, new_figure, shown_name
from forcetorque.report.figures.inputs import drawable, instants
from forcetorque.report.figures.thinning import thinned_line
from forcetorque.report.figures.time_lines import draw_over_time

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def skin_event_figure(pictures: Sequence[SkinEventPicture]) -> Figure:
    """Draw the heuristic of every stream of contacts over time.

    Args:
        pictures: The streams, at least one.

    Returns:
        The figure, one panel.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no stream, or the shapes of one differ.
    """
    if not pictures:
        raise ShapeError("pictures: expected at least one stream of contacts, got none")
    figure = new_figure(0.8 * ROW_INCHES[1])
    panel = figure.subplots()
    for k, picture in enumerate(pictures):
        seconds = instants(picture.seconds, name=f"{picture.stream}: seconds")
        sizes = drawable(picture.heuristic, name=f"{picture.stream}: heuristic", shape=(len(seconds),))
        time, lines = thinned_line(seconds, sizes[:, None])
        draw_over_time(panel, time, lines[:, 0], look(k), turn=k, count=len(pictures))
    panel.set_xlabel("time, s", fontsize=TITLE_POINTS)
    panel.set_ylabel("heuristic, not newtons", fontsize=TITLE_POINTS)
    panel.set_ylim(bottom=0.0)
    legend_below(figure, [(shown_name(one.stream), look(k).key | {"linestyle": "-"}) for k, one in enumerate(pictures)])
    return figure
