# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a plan: recordings with what is expected after them, and postures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from forcetorque.analysis.plan.proposal import Proposal
from forcetorque.evaluation.use import LoadCase, PredictedError
from forcetorque.result import FloatOrNull, Row, Shown
from forcetorque.robot import JointType


class PlannedRecording(Row):
    """One recording: a power-up, a motion, something attached or nothing; errors are those at the loads of use."""

    recording: Annotated[int, Shown("recording")]
    """Its number, from 1."""
    support: Annotated[str, Shown("held at")]
    """Link that holds the robot."""
    tool: Annotated[str, Shown("tool")]
    """What is attached; `none` for nothing."""
    temperature_start_degC: float | None
    """Temperature at the start; None where none was stated."""
    temperature_end_degC: float | None
    """Temperature at the end."""
    postures: Annotated[int, Shown("postures")]
    """Number of postures, rest at start and end included."""
    seconds: Annotated[float, Shown("time", "s", digits=0)]
    """How long it takes."""
    force_before_N: Annotated[float, Shown("force before", "N", digits=2)]
    """Predicted force error before it, typically: root mean square over the loads."""
    force_before_at_most_N: float
    """With 95 % it is no more than that."""
    force_after_N: Annotated[float, Shown("after", "N", digits=2)]
    """Predicted force error after it."""
    force_after_at_most_N: Annotated[float, Shown("at most", "N", digits=2)]
    """With 95 % it is no more than that."""
    force_allowed_N: FloatOrNull
    """What is allowed; infinite where it is not judged."""
    moment_before_Nm: Annotated[float, Shown("moment before", "N m", digits=3)]
    """Predicted moment error before it."""
    moment_before_at_most_Nm: float
    """With 95 % it is no more than that."""
    moment_after_Nm: Annotated[float, Shown("after", "N m", digits=3)]
    """Predicted moment error after it."""
    moment_after_at_most_Nm: Annotated[float, Shown("at most", "N m", digits=3)]
    """With 95 % it is no more than that."""
    moment_allowed_Nm: FloatOrNull
    """What is allowed; infinite where it is not judged."""
    within_allowed: float
    """Probability that both are within what is allowed after it."""


class PlannedPosture(Row):
    """Where the joints that move rest for a while."""

    recording: int
    """Number of the recording."""
    posture: int
    """Its number, from 1."""
    arrival_s: float
    """When it is reached."""
    positions: dict[str, float]
    """Positions by joint; deg, m for joints that slide."""


def recording_row(
    number: int, proposal: Proposal, before: PredictedError, after: PredictedError, case: LoadCase
) -> PlannedRecording:
    """Write a recording as a row.

    Args:
        number: Its number.
        proposal: The recording.
        before: Predicted error before it.
        after: Predicted error after it.
        case: The use.

    Returns:
        The row.
    """
    force, moment = case.requirement
    start, end = (None, None) if proposal.temperature is None else proposal.temperature
    return PlannedRecording(
        recording=number,
        support=proposal.place.stand.support,
        tool=proposal.place.tool,
        temperature_start_degC=start,
        temperature_end_degC=end,
        postures=len(proposal.trajectory.postures),
        seconds=proposal.trajectory.duration_s,
        force_before_N=before.force.typical,
        force_before_at_most_N=before.force.at_most,
        force_after_N=after.force.typical,
        force_after_at_most_N=after.force.at_most,
        force_allowed_N=force,
        moment_before_Nm=before.moment.typical,
        moment_before_at_most_Nm=before.moment.at_most,
        moment_after_Nm=after.moment.typical,
        moment_after_at_most_Nm=after.moment.at_most,
        moment_allowed_Nm=moment,
        within_allowed=after.within(force, moment),
    )


def posture_rows(number: int, proposal: Proposal) -> Iterator[PlannedPosture]:
    """Write the postures of a recording as rows.

    Args:
        number: Number of the recording.
        proposal: The recording.

    Yields:
        A row per posture.
    """
    stand, way = proposal.place.stand, proposal.trajectory
    arrivals = np.concatenate([[0.0], way.departures_s + way.durations_s])
    columns = stand.columns(proposal.place.moved)
    slides = [stand.model.joints[joint].type is JointType.PRISMATIC for joint in proposal.place.moved]
    for k, posture in enumerate(way.postures[:, columns]):
        shown = np.where(slides, posture, np.rad2deg(posture)).tolist()
        yield PlannedPosture(
            recording=number,
            posture=k + 1,
            arrival_s=float(arrivals[k]),
            positions=dict(zip(proposal.place.moved, shown, strict=True)),
        )
