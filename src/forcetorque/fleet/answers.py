# SPDX-License-Identifier: BSD-3-Clause
"""Answers of evaluations by a dataset and of the report on a fleet: what may be used, at what error, what next."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Final

from forcetorque.evaluation.answers import CONCERN, to_export
from forcetorque.experiment.validation_offset import Offset
from forcetorque.fleet.report import DECISIONS
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, counted
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.fleet.evaluate import DatasetEvaluation
    from forcetorque.fleet.report import FleetReport, RankedSensor
    from forcetorque.fleet.sensor_evaluation import StoredErrors


def evaluation_answers(evaluation: DatasetEvaluation) -> Iterator[Answer]:
    """Give the answer for every calibration.

    Args:
        evaluation: What was evaluated.

    Yields:
        One answer each.
    """
    names = short_names([row.calibration for row in evaluation.errors])
    rows = {(row.serial, row.calibration): row for row in evaluation.errors if row.offset is not Offset.JUDGED_MEAN}
    for (serial, candidate), row in rows.items():
        uses = [use for use in evaluation.load_cases if (use.serial, use.calibration) == (serial, candidate)]
        if not uses:
            continue
        worst = max(uses, key=lambda use: CONCERN[use.decision])
        decision = worst.decision.upper()
        agree = len({use.decision for use in uses}) == 1
        remedy = next((reason.remedy for reason in worst.reasons if reason.remedy is not None), None)
        step, command = to_export(candidate, row.sensor) if remedy is None else (remedy, "")
        yield Answer(
            subject=f"{row.sensor} ({serial}), {names[candidate]}",
            verdict=decision if agree else f"{decision} for {worst.load_case}",
            why=(f"{worst.loads}: {worst.reasons[0].text}", _measured(row, rows.get((serial, row.prior or "")))),
            step=step,
            command=command,
            concern=CONCERN[worst.decision],
        )


def _measured(row: StoredErrors, prior: StoredErrors | None) -> str:
    force, moment = amount(row.force_error_rms_N, "N"), amount(row.moment_error_rms_Nm, "N m")
    before = (
        ""
        if prior is None
        else f" (prior {amount(prior.force_error_rms_N, 'N')}, {amount(prior.moment_error_rms_Nm, 'N m')})"
    )
    recordings = f"{row.recordings} recording{'s' * (row.recordings != 1)}"
    return f"{row.samples} samples not fitted, in {recordings}: {force}, {moment} RMS{before}"


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
