# SPDX-License-Identifier: BSD-3-Clause
"""Figures of plans: the predicted error at the loads of use, before and after each recording."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from forcetorque.base.errors import ShapeError
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
from forcetorque.results.number_text import amount, counted

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.planning.joint_calibration_plan import JointPlan, SensorForecast
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
        panel.set(ylabel=unit, ylim=(0.0, None))
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


@in_figure_style
def joint_plan_figure(plan: JointPlan) -> Figure:
    """Draw what a plan for several sensors at once expects.

    Returns:
        The figure: force errors beside moment errors over what is allowed, of every sensor at its loads of use, by the
        prior matrices and after each recording.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If no step is planned.
    """
    if not plan.steps:
        raise ShapeError("steps: expected at least one recording to draw, got none")
    cases: dict[tuple[str, str], list[SensorForecast]] = {}
    for row in plan.sensors:
        cases.setdefault((row.sensor, row.load_case), []).append(row)
    figure, count = new_figure(ROW_INCHES[1]), len(plan.steps)
    forces, moments = figure.subplots(1, 2)
    keys = []
    for k, ((sensor, case), rows) in enumerate(cases.items()):
        style, steps = look(k), [0, *(row.step for row in rows)]
        first = rows[0]
        for panel, before, after, allowed in (
            (forces, first.force_before_N, [row.force_after_N for row in rows], first.force_allowed_N),
            (moments, first.moment_before_Nm, [row.moment_after_Nm for row in rows], first.moment_allowed_Nm),
        ):
            if np.isfinite(allowed):
                panel.plot(steps, np.array([before, *after]) / allowed, markersize=6.0, linewidth=1.2, **style.key)
        keys.append((shown_name(f"{sensor}: {case}"), style.key))
    for panel, quantity in ((forces, "force"), (moments, "moment")):
        panel.axhline(1.0, **LIMIT_LINE)
        panel.set(ylabel=f"predicted {quantity} error over what is allowed", ylim=(0.0, None))
        panel.set_xticks(range(count + 1), ["prior", *map(str, range(1, count + 1))])
        panel.set_xlabel("recordings fitted")
    headline(
        figure,
        f"errors over what is allowed, geometric mean of {counted(len(cases), 'load case')}: "
        f"{plan.steps[0].excess_before:.2g} by the priors, {plan.steps[-1].excess_after:.2g} after "
        f"{counted(count, 'recording')}: {', '.join(shown_name(row.recording) for row in plan.steps)}",
    )
    legend_below(figure, [*keys, ("allowed", LIMIT_LINE)])
    return figure
