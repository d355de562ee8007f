# SPDX-License-Identifier: BSD-3-Clause
"""Figure of a plan: the predicted error at the loads of use, before and after each recording."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from forcetorque.results.figures import (
    LIMIT_LINE,
    ROW_INCHES,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    shown_name,
)
from forcetorque.results.number_text import amount

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.planning.planning import Plan


@in_figure_style
def plan_figure(plan: Plan) -> Figure:
    """Draw what a plan expects.

    Returns:
        The figure: force errors beside moment errors, typical ones as points, up to what they are with 95 % at most.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    rows = plan.recordings
    first, last = rows[0], rows[-1]
    limits = (first.force_allowed_N, first.moment_allowed_Nm)
    typical = (
        [first.force_before_N, *(row.force_after_N for row in rows)],
        [first.moment_before_Nm, *(row.moment_after_Nm for row in rows)],
    )
    at_most = (
        [first.force_before_at_most_N, *(row.force_after_at_most_N for row in rows)],
        [first.moment_before_at_most_Nm, *(row.moment_after_at_most_Nm for row in rows)],
    )
    figure, style = new_figure(ROW_INCHES[1]), look(0)
    for k, (panel, unit) in enumerate(zip(figure.subplots(1, 2), ("force error, N", "moment error, N m"), strict=True)):
        panel.plot(typical[k], linewidth=1.2, markersize=6.0, **style.key)
        panel.vlines(range(len(typical[k])), typical[k], at_most[k], color=style.colour, linewidth=1.4)
        if np.isfinite(limits[k]):
            panel.axhline(limits[k], **LIMIT_LINE)
        panel.set_ylabel(unit)
        panel.set_ylim(bottom=0.0)
        places = [f"{row.recording}: {shown_name(row.support)},\n{shown_name(row.tool)}" for row in rows]
        panel.set_xticks(range(len(rows) + 1), ["now", *places])
    before, after = amount(first.force_before_N, "N"), amount(last.force_after_N, "N")
    headline(
        figure,
        f"{shown_name(plan.sensor)} ({shown_name(plan.serial)}), {shown_name(plan.load_case)}: "
        f"predicted force error {before} now, {after} after {len(rows)} recording{'s' if len(rows) > 1 else ''}",
    )
    limit = [("allowed", LIMIT_LINE)] if np.isfinite(limits).any() else []
    legend_below(figure, [("typical; line: at most, with 95 %; below: held at, tool", style.key), *limit])
    return figure
