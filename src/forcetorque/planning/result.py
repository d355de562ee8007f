# SPDX-License-Identifier: BSD-3-Clause
"""Records and text of a plan: recordings with the errors expected after them, postures, and assumptions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated

import numpy as np

from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.evaluation.load_cases.load_case import LoadCase
from forcetorque.evaluation.load_cases.predicted_error import PredictedError
from forcetorque.experiment.calibration.posterior import ModelPart, Posterior
from forcetorque.experiment.calibration.robot_model_error import EXACT, OF_CABLES, ModelTolerance, TermKind
from forcetorque.planning.information import ASSUMED_NOISE
from forcetorque.planning.posture_search import HELPS, Criterion
from forcetorque.planning.proposed_recordings import NOTHING, Proposal, Workplace
from forcetorque.results.number_text import number
from forcetorque.results.table import FloatOrNull, Row, Shown, Table, table_of
from forcetorque.robot.model import JointType
from forcetorque.robot.motion import JointMotion


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
    """What is allowed; infinite where it is not evaluated."""
    moment_before_Nm: Annotated[float, Shown("moment before", "N m", digits=3)]
    """Predicted moment error before it."""
    moment_before_at_most_Nm: float
    """With 95 % it is no more than that."""
    moment_after_Nm: Annotated[float, Shown("after", "N m", digits=3)]
    """Predicted moment error after it."""
    moment_after_at_most_Nm: Annotated[float, Shown("at most", "N m", digits=3)]
    """With 95 % it is no more than that."""
    moment_allowed_Nm: FloatOrNull
    """What is allowed; infinite where it is not evaluated."""
    force_by_model_N: float = 0.0
    """Part of the force error after it that comes of errors of the robot model, root mean square."""
    moment_by_model_Nm: float = 0.0
    """The same of the moment error."""
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
        force_by_model_N=after.force.sources["model"],
        moment_by_model_Nm=after.moment.sources["model"],
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


_STAYS = 0.7
"""Share of the prior's uncertainty of a load direction from which it counts as not taught."""
_MOST = 0.7
"""Share of an error from which errors of the robot model are named: half of its square."""
_MATTERS = 0.1
"""Part that such a direction makes of what is left, or of what is allowed where that is more, to be named."""
_SPAN = 1e-3
"""Share of the largest change of load below which a direction counts as not loaded."""
_SEED, _DRAWN = 3, 200


def recordings_table(rows: Sequence[PlannedRecording]) -> Table:
    """Lay out the recordings.

    Args:
        rows: The recordings, at least one.

    Returns:
        A line for each.
    """
    first = rows[0]
    allowed = " and ".join(
        f"{limit:.3g} {unit}"
        for limit, unit in ((first.force_allowed_N, "N"), (first.moment_allowed_Nm, "N m"))
        if np.isfinite(limit)
    )
    table = table_of(
        rows,
        "predicted root mean square error at the loads of use, typical, and at most with a probability of 95 %; "
        f"{allowed} allowed",
    )
    if all(row.temperature_start_degC is None for row in rows):
        return table
    cells = [_temperature(row) for row in rows]
    headings = (*table.headings[:3], "degC", *table.headings[3:])
    lines = tuple((*line[:3], cell, *line[3:]) for line, cell in zip(table.rows, cells, strict=True))
    return Table(caption=table.caption, headings=headings, rows=lines)


def posture_tables(rows: Sequence[PlannedPosture]) -> Iterator[Table]:
    """Lay out the postures.

    Args:
        rows: Postures of all recordings.

    Yields:
        A table for each recording.
    """
    for recording in dict.fromkeys(row.recording for row in rows):
        own = [row for row in rows if row.recording == recording]
        yield Table(
            caption=f"recording {recording}: positions of the joints that move, deg (m where they slide)",
            headings=("posture", "at, s", *own[0].positions),
            rows=tuple(
                (str(row.posture), number(row.arrival_s, 1), *(number(value, 1) for value in row.positions.values()))
                for row in own
            ),
        )


def helps(row: PlannedRecording) -> bool:
    """Tell whether a recording lowers an error that matters.

    Returns:
        Whether the force error or the moment error, where it is limited, falls by enough.
    """
    gained = max(
        1.0 - row.force_after_N / row.force_before_N if np.isfinite(row.force_allowed_N) else 0.0,
        1.0 - row.moment_after_Nm / row.moment_before_Nm if np.isfinite(row.moment_allowed_Nm) else 0.0,
    )
    return gained >= HELPS


def advice(
    rows: Sequence[PlannedRecording],
    before: Posterior,
    after: Posterior,
    criterion: Criterion,
    places: Sequence[Workplace],
) -> str:
    """Say what to record first and what it brings, or why nothing helps.

    Args:
        rows: The planned recordings.
        before: What is known before.
        after: What is known after all of them.
        criterion: What they lower.
        places: Where they could be made.

    Returns:
        A sentence or two.
    """
    first = rows[0]
    left = _left(before, after, criterion, places)
    if not helps(first):
        return (
            f"nothing within these limits helps: the best recording of {first.seconds:.0f} s leaves "
            f"{first.force_after_N:.3g} of {first.force_before_N:.3g} N and {first.moment_after_Nm:.3g} of "
            f"{first.moment_before_Nm:.3g} N m{of_model(first)}{left}"
        )
    attached = "nothing attached" if first.tool == NOTHING else f"{first.tool} attached"
    warm = "" if first.temperature_start_degC is None else f", {_temperature(first)} degC"
    return (
        f"record first {first.postures} postures in {first.seconds:.0f} s, held at {first.support}, {attached}{warm}: "
        f"the expected error falls from {first.force_before_N:.3g} N and {first.moment_before_Nm:.3g} N m to "
        f"{first.force_after_N:.3g} N (95 %: {first.force_after_at_most_N:.3g}) and {first.moment_after_Nm:.3g} N m "
        f"(95 %: {first.moment_after_at_most_Nm:.3g}){_in_the_end(rows)}{of_model(rows[-1])}{left}"
    )


def _in_the_end(rows: Sequence[PlannedRecording]) -> str:
    """What all recordings come to, where there are several."""
    last = rows[-1]
    if len(rows) == 1:
        return ""
    return f"; after all {len(rows)} to {last.force_after_N:.3g} N and {last.moment_after_Nm:.3g} N m"


def of_model(row: PlannedRecording) -> str:
    """Say what errors of the robot model make of the error after a recording.

    Returns:
        The end of a sentence; empty where it is little.
    """
    parts = [
        f"{by_model:.2g} {unit}"
        for by_model, error, allowed, unit in (
            (row.force_by_model_N, row.force_after_N, row.force_allowed_N, "N"),
            (row.moment_by_model_Nm, row.moment_after_Nm, row.moment_allowed_Nm, "N m"),
        )
        if by_model > _MOST * error and np.isfinite(allowed)
    ]
    if not parts:
        return ""
    return f"; tolerances of the robot model make {' and '.join(parts)} of it"


def limits_of(*, calibrated: bool, posterior: Posterior, tolerance: ModelTolerance) -> tuple[str, ...]:
    """List the assumptions, and what was not checked.

    Args:
        calibrated: Whether a calibration is known.
        posterior: What is known.
        tolerance: How far the robot model may be off.

    Returns:
        Sentences.
    """
    unchecked = (
        "not checked: whether the robot touches itself, the floor or anything else, and whether it keeps its balance; "
        "play every motion slowly, or in a simulator, first"
    )
    model = (
        "what a recording is expected to teach leaves room for quadratic terms, and none for what differentiation "
        "flattens",
        *_robot_model(tolerance, known=posterior.model, calibrated=calibrated),
    )
    if calibrated:
        return unchecked, *model
    drift = ASSUMED_NOISE * max(row.ratio for row in posterior.noise) ** 0.5
    assumed = (
        f"nothing was recorded: the prior matrix is taken to be off by some 6 % of each row, noise of a mean over a "
        f"second to be {ASSUMED_NOISE:g} of full scale and slow noise {drift:.2g}"
    )
    return assumed, unchecked, *model


def _robot_model(tolerance: ModelTolerance, *, known: ModelPart | None, calibrated: bool) -> Iterator[str]:
    """What is assumed of the robot model, and what of it a calibration did not take as unknown."""
    if tolerance == EXACT:
        yield "the robot model is taken as exact, as [robot] tolerance states"
        return
    cables = f", cables to pull by {tolerance.cable_N_rad:.2g} N/rad of joints" if tolerance.cable_N_rad else ""
    yield (
        f"the robot model is taken to be off by masses {100.0 * tolerance.mass:.2g} %, centres of mass "
        f"{1e3 * tolerance.centre_m:.2g} mm, joint zeros {np.degrees(tolerance.joint_zero_rad):.2g} deg{cables}, by "
        f"the same in all recordings, and by acceleration {tolerance.acceleration:.2g} m/s2 and delay "
        f"{1e3 * tolerance.delay_s:.2g} ms, anew in each; state others in [robot] tolerance"
    )
    if calibrated and known is None:
        yield (
            "the calibration took the robot model as exact, so that predicted errors do not have what errors of the "
            "model made of it; calibrate with [robot] tolerance"
        )
    kinds = {term.kind for term in known.terms} if calibrated and known is not None else set()
    if tolerance.cable_N_rad and TermKind.ZERO in kinds and kinds.isdisjoint(OF_CABLES):
        yield (
            "the calibration does not know pulls of cables, as a joint one or that of an earlier version, so that "
            "predicted errors do not have what these made of it; calibrate the sensor from its recordings anew"
        )


def _temperature(row: PlannedRecording) -> str:
    start, end = row.temperature_start_degC, row.temperature_end_degC
    if start is None or end is None:
        return "-"
    return f"{start:g}" if start == end else f"{start:g} to {end:g}"


def _left(before: Posterior, after: Posterior, criterion: Criterion, places: Sequence[Workplace]) -> str:
    """Load directions of the use that stay with the prior, and how many directions the loads span at all."""
    shares, known = criterion.shares(after), criterion.shares(before)
    total = max(float(shares.sum()), 1.0)
    stays = [
        name
        for name, share, prior in zip(WRENCH_COMPONENTS, shares, known, strict=True)
        if share > _MATTERS * total and np.sqrt(share / prior) > _STAYS
    ]
    if not stays:
        return ""
    verb, rank = "stays" if len(stays) == 1 else "stay", _rank(places)
    if rank < len(WRENCH_COMPONENTS):
        return (
            f"; {', '.join(stays)} {verb} with the prior: the loads within these limits span {rank} of 6 directions, a "
            "tool with its centre of mass elsewhere would load what is left"
        )
    return f"; {', '.join(stays)} {verb} with the prior: a heavier tool, or more recordings, would determine it"


def _rank(places: Sequence[Workplace]) -> int:
    """Number of load directions that change at all."""
    moved = []
    for place in places:
        drawn = place.postures(_DRAWN, np.random.default_rng(_SEED))
        loads = place.loads(JointMotion.at_rest(place.stand.joints, drawn))
        moved.append(loads - loads.mean(axis=0))
    changes = np.concatenate(moved)
    sizes = np.repeat([np.sqrt((changes[:, part] ** 2).mean()) for part in FORCE_AND_MOMENT], 3)
    strengths = np.linalg.svd(changes / sizes, compute_uv=False)
    return int((strengths > _SPAN * strengths[0]).sum())
