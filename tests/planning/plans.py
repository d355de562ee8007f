# SPDX-License-Identifier: BSD-3-Clause
"""Plans with stated errors."""

from __future__ import annotations

from forcetorque.planning.planning import Plan
from forcetorque.planning.result import PlannedRecording


def planned_recording(number: int, force_after: float, moment_after: float, **allowed: float) -> PlannedRecording:
    """A recording after which errors are these, of 4 N and .2 N m before."""
    return PlannedRecording(
        recording=number,
        support="base",
        tool="none",
        temperature_start_degC=None,
        temperature_end_degC=None,
        postures=5,
        seconds=20.0,
        force_before_N=4.0,
        force_before_at_most_N=6.0,
        force_after_N=force_after,
        force_after_at_most_N=1.5 * force_after,
        force_allowed_N=allowed.get("force", 1.0),
        moment_before_Nm=0.2,
        moment_before_at_most_Nm=0.3,
        moment_after_Nm=moment_after,
        moment_after_at_most_Nm=1.5 * moment_after,
        moment_allowed_Nm=allowed.get("moment", 0.1),
        within_allowed=0.5,
    )


def plan_of(*recordings: PlannedRecording, folder: str | None = None) -> Plan:
    """A plan of an arm."""
    return Plan(
        sensor="arm_ft",
        serial="SIM001",
        load_case="push",
        loads="pushes",
        start="prior",
        advice="nothing within these limits helps",
        recordings=recordings,
        postures=(),
        limits=(),
        folder=folder,
    )
