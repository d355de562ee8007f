# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `plan` in a few lines: what to record next and what it brings, or that nothing helps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from forcetorque.planning.joint_calibration_plan import useful_steps
from forcetorque.planning.proposed_recordings import NOTHING
from forcetorque.planning.result import PlannedRecording, helps, of_model
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, bounded

if TYPE_CHECKING:
    from forcetorque.planning.joint_calibration_plan import JointPlan, SensorForecast
    from forcetorque.planning.planning import Plan


def plan_answer(plan: Plan) -> Answer:
    """Give the answer of a plan for one sensor."""
    first = plan.recordings[0]
    subject = f"{plan.sensor} ({plan.serial}), {plan.load_case}"
    if not helps(first):
        return Answer(
            subject=subject,
            verdict="NOTHING HELPS",
            why=(plan.advice,),
            written=(plan.figure_file,),
            concern=Concern.BAD,
        )
    last = plan.recordings[-1]
    count = len(plan.recordings)
    after = f"after {f'all {count} recordings' if count > 1 else 'it'}: {_after(last)}"
    beyond = _beyond(last)
    loads = "motion alone does not do it: hang a load on it, or let the robot stand on it"
    if any(row.tool != NOTHING for row in plan.recordings):
        loads = "these tools do not do it: hang a heavier load"
    return Answer(
        subject=subject,
        verdict=f"RECORD {first.postures} POSTURES IN {first.seconds:.0f} s{', NOT ENOUGH' if beyond else ''}",
        why=(
            f"{_errors(first)}; held at {first.support}, tool: {first.tool}",
            *([f"{after}; {loads}"] if beyond else [after]),
            *([words.removeprefix("; ")] if (words := of_model(last)) else []),
        ),
        step=(
            "write the trajectories by the same command with --output FOLDER"
            if plan.folder is None
            else "play every motion slowly, or in a simulator, before it is recorded; collisions were not checked"
        ),
        written=(plan.folder, plan.figure_file),
        concern=Concern.UNCERTAIN if beyond else Concern.NONE,
    )


def _errors(row: PlannedRecording) -> str:
    """Errors before and after a recording."""
    force = bounded(row.force_after_N, row.force_after_at_most_N, "N")
    moment = bounded(row.moment_after_Nm, row.moment_after_at_most_Nm, "N m")
    return (
        f"predicted force error falls from {amount(row.force_before_N, 'N')} to {force}, moment error from "
        f"{amount(row.moment_before_Nm, 'N m')} to {moment}"
    )


def _after(row: PlannedRecording | SensorForecast) -> str:
    """Errors after a recording, each with what is allowed."""
    return ", ".join(
        f"{bounded(error, at_most, unit)}{f' of {amount(allowed, unit)} allowed' if np.isfinite(allowed) else ''}"
        for error, at_most, allowed, unit in (
            (row.force_after_N, row.force_after_at_most_N, row.force_allowed_N, "N"),
            (row.moment_after_Nm, row.moment_after_at_most_Nm, row.moment_allowed_Nm, "N m"),
        )
    )


def _beyond(row: PlannedRecording) -> bool:
    """Whether an error after a recording is typically more than what is allowed."""
    return row.force_after_N > row.force_allowed_N or row.moment_after_Nm > row.moment_allowed_Nm


def joint_plan_answer(plan: JointPlan) -> Answer:
    """Give the answer of a plan for all sensors of a robot."""
    useful = useful_steps([plan.steps[0].excess_before, *(step.excess_after for step in plan.steps)])
    last = [row for row in plan.sensors if row.step == len(plan.steps)]
    sensors = len({row.sensor for row in last})
    subject = f"{sensors} sensor{'s' * (sensors != 1)} calibrated jointly"
    farthest = max(last, key=lambda row: row.excess)
    worst = f"farthest from what is allowed: {farthest.sensor}, {farthest.load_case}: {_after(farthest)}"
    if not useful:
        return Answer(subject=subject, verdict="NOTHING HELPS", why=(plan.advice, worst), concern=Concern.BAD)
    names = [step.recording for step in plan.steps[:useful]]
    return Answer(
        subject=subject,
        verdict=f"RECORD {', THEN '.join(names)}{', NOT ENOUGH' if farthest.excess > 1.0 else ''}",
        why=(
            f"errors over what is allowed fall from {plan.steps[0].excess_before:.2f} to "
            f"{plan.steps[useful - 1].excess_after:.2f}, geometric mean over sensors and load cases",
            worst,
        ),
        step="record them, and calibrate with --jointly",
        concern=Concern.UNCERTAIN if farthest.excess > 1.0 else Concern.NONE,
    )
