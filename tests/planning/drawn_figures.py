# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a plan, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.planning.figure import plan_figure
from forcetorque.planning.planning import Plan
from forcetorque.planning.result import PlannedRecording


def draw_plan(rng: np.random.Generator) -> Figure:
    """Three recordings whose errors fall; only forces have a limit."""
    force, moment = (np.sort(rng.uniform(0.5, 4.0, 4))[::-1] * size for size in (1.0, 0.05))
    recordings = tuple(
        PlannedRecording(
            recording=k + 1,
            support="_base $link$",
            tool="none",
            temperature_start_degC=None,
            temperature_end_degC=None,
            postures=5,
            seconds=20.0,
            force_before_N=float(force[k]),
            force_before_at_most_N=float(1.5 * force[k]),
            force_after_N=float(force[k + 1]),
            force_after_at_most_N=float(1.5 * force[k + 1]),
            force_allowed_N=1.0,
            moment_before_Nm=float(moment[k]),
            moment_before_at_most_Nm=float(1.5 * moment[k]),
            moment_after_Nm=float(moment[k + 1]),
            moment_after_at_most_Nm=float(1.5 * moment[k + 1]),
            moment_allowed_Nm=float("inf"),
            within_allowed=0.5,
        )
        for k in range(3)
    )
    plan = Plan(
        sensor="_arm $ft$",
        serial="SIM001",
        load_case="pushes of 34 N",
        loads="pushes",
        start="prior",
        advice="record these",
        recordings=recordings,
        postures=(),
        limits=(),
        folder=None,
    )
    return plan_figure(plan)
