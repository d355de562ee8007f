# SPDX-License-Identifier: BSD-3-Clause
"""What a plan says: its tables, what to do first, and what was taken for granted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.analysis.plan.rows import PlannedPosture, PlannedRecording
from forcetorque.analysis.plan.workplace import NOTHING, Workplace
from forcetorque.calibration.posterior import Posterior
from forcetorque.evaluation.planning import ASSUMED_NOISE, HELPS, Criterion
from forcetorque.result import Table, number, table_of
from forcetorque.robot import JointMotion
from forcetorque.spatial import FORCE_AND_MOMENT, WRENCH_COMPONENTS

_STAYS = 0.7
"""Share of the prior's uncertainty of a load direction from which it counts as not taught."""
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
    helped = max(
        1.0 - first.force_after_N / first.force_before_N if np.isfinite(first.force_allowed_N) else 0.0,
        1.0 - first.moment_after_Nm / first.moment_before_Nm if np.isfinite(first.moment_allowed_Nm) else 0.0,
    )
    if helped < HELPS:
        return (
            f"nothing within these limits helps: the best recording of {first.seconds:.0f} s leaves "
            f"{first.force_after_N:.3g} of {first.force_before_N:.3g} N and {first.moment_after_Nm:.3g} of "
            f"{first.moment_before_Nm:.3g} N m{left}"
        )
    attached = "nothing attached" if first.tool == NOTHING else f"{first.tool} attached"
    warm = "" if first.temperature_start_degC is None else f", {_temperature(first)} degC"
    return (
        f"record first {first.postures} postures in {first.seconds:.0f} s, held at {first.support}, {attached}{warm}: "
        f"the expected error falls from {first.force_before_N:.3g} N and {first.moment_before_Nm:.3g} N m to "
        f"{first.force_after_N:.3g} N (at most {first.force_after_at_most_N:.3g}) and {first.moment_after_Nm:.3g} N m "
        f"(at most {first.moment_after_at_most_Nm:.3g}){_in_the_end(rows)}{left}"
    )


def _in_the_end(rows: Sequence[PlannedRecording]) -> str:
    """What all recordings come to, where there are several."""
    last = rows[-1]
    if len(rows) == 1:
        return ""
    return f"; after all {len(rows)} to {last.force_after_N:.3g} N and {last.moment_after_Nm:.3g} N m"


def limits_of(*, calibrated: bool, posterior: Posterior) -> tuple[str, ...]:
    """Say what was taken for granted, and what was not checked.

    Args:
        calibrated: Whether a calibration is known.
        posterior: What is known.

    Returns:
        Sentences.
    """
    unchecked = (
        "not checked: whether the robot touches itself, the floor or anything else, and whether it keeps its balance; "
        "play every motion slowly, or in a simulator, first"
    )
    model = (
        "what a recording is expected to teach leaves room for quadratic terms, and none for what differentiation "
        "flattens"
    )
    if calibrated:
        return unchecked, model
    drift = ASSUMED_NOISE * max(row.ratio for row in posterior.noise) ** 0.5
    assumed = (
        f"nothing was recorded: the prior matrix is taken to be off by some 6 % of each row, noise of a mean over a "
        f"second to be {ASSUMED_NOISE:g} of full scale and slow noise {drift:.2g}"
    )
    return assumed, unchecked, model


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
    return f"; {', '.join(stays)} {verb} with the prior: a heavier tool, or more recordings, would tell"


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
