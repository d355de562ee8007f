# SPDX-License-Identifier: BSD-3-Clause
"""Answers of evaluations by a dataset: may a calibration be used, at what error, and what to do next."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from forcetorque.evaluation.answers import CONCERN, to_export
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.answer import Answer
from forcetorque.results.number_text import amount
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.fleet.evaluate import DatasetEvaluation
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
