# SPDX-License-Identifier: BSD-3-Clause
"""The answer of the report on a fleet: how many sensors may be used, which are the worst, and what to do next."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Final

from forcetorque.evaluation.answers import CONCERN
from forcetorque.fleet.report import DECISIONS
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, counted

if TYPE_CHECKING:
    from forcetorque.fleet.report import FleetReport, RankedSensor

_MOST: Final = 3
"""Sensors that the answer lists."""


def report_answers(report: FleetReport) -> Iterator[Answer]:
    """Count the verdicts, and name the worst sensors.

    Args:
        report: The report.

    Yields:
        One answer, then one for each of the worst sensors, at most three.
    """
    decisions = Counter(row.decision for row in report.ranked)
    counts = [f"{decisions[one]} {one.upper()}" for one in DECISIONS if decisions[one]]
    if report.unranked:
        counts.append(f"{len(report.unranked)} NOT EVALUATED")
    rows = [row for row in report.sensors if row.step]
    worst = max((CONCERN[row.decision] for row in report.ranked), default=Concern.UNCERTAIN)
    yield Answer(
        subject=f"{report.dataset}: {counted(len(report.sensors), 'sensor')}",
        verdict=", ".join(counts),
        why=tuple(_why(report)),
        step=f"{rows[0].subject}: {rows[0].step}" if rows else "",
        # files below the working folder as they are typed there
        command=rows[0].command.replace(f"{Path.cwd()}/", "") if rows else "",
        written=(report.file,),
        concern=worst,
    )
    for row in report.ranked[:_MOST]:
        if row.step:
            yield Answer(subject=f"{row.rank}. {row.subject}", verdict=_error(row), concern=worst)


def _why(report: FleetReport) -> Iterator[str]:
    if report.unranked:
        yield f"not evaluated: {report.unranked[0].subject}: {report.unranked[0].reason}"
    if report.failures:
        first = report.failures[0]
        yield f"{counted(len(report.failures), 'recording')} failed, such as {first.file}: {first.error}"


def _error(row: RankedSensor) -> str:
    allowed = "" if row.allowed is None else f" ({amount(row.allowed, row.unit)} allowed)"
    return f"{row.decision.upper()}: {amount(row.error, row.unit)}{allowed}"
