# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `bench workbench` in a few lines: whether a sensor passes, why, and what to hang next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.number_text import amount

if TYPE_CHECKING:
    from forcetorque.base.arrays import FloatArray
    from forcetorque.workbench.result import BenchSensorRow, Workbench


_MOST_NAMED = 4
"""Positions that are named; more are counted."""


def workbench_answers(workbench: Workbench) -> Iterator[Answer]:
    """Give the answer for every sensor.

    Args:
        workbench: The calibrations.

    Yields:
        One answer each; of a bench without measurements what to record first.
    """
    written = (workbench.file, workbench.figure_file)
    for row in workbench.sensors:
        step, command = _step(workbench, row)
        verdict, concern = _verdict(workbench, row)
        yield Answer(
            subject=f"{row.sensor} ({row.serial}), {row.positions} positions",
            verdict=verdict,
            why=tuple(_reasons(workbench, row)),
            step=step,
            command=command,
            written=written,
            concern=concern,
        )
    if not workbench.sensors:
        step, wanted = _next(workbench)
        done = None if wanted else workbench.next
        yield Answer(
            subject=_serials(workbench),
            verdict="NOT CALIBRATED YET",
            why=(done,) if done else (),
            step="fit them: the same command without --next" if done else step,
            written=written,
        )


def _serials(workbench: Workbench) -> str:
    names = dict.fromkeys(row.serial for row in workbench.blocks_checked)
    return f"workbench, {', '.join(names)}" if names else "workbench"


def _verdict(workbench: Workbench, row: BenchSensorRow) -> tuple[str, Concern]:
    faults = sum(fault.serial == row.serial for fault in workbench.faults)
    if not row.fitted:
        return "NO MATRIX", Concern.BAD
    if faults:
        return f"{faults} FAULT{'S' * (faults > 1)} OF THE BENCH", Concern.BAD
    if any(not criterion.passed for criterion in workbench.criteria if criterion.serial == row.serial):
        return "REJECTED", Concern.BAD
    if row.offset_changes:
        return "FITTED, OFFSET CHANGES", Concern.UNCERTAIN
    if row.unmoved:
        return "FITTED, LOADS NOT EXCITED", Concern.UNCERTAIN
    if len(row.components) < len(WRENCH_COMPONENTS):
        return f"FITTED, {', '.join(row.components)}", Concern.NONE
    return "FITTED, NO FAULT OF THE BENCH", Concern.NONE


def _reasons(workbench: Workbench, row: BenchSensorRow) -> Iterator[str]:
    if not row.fitted and row.without_load:
        unused = row.without_load
        yield (
            f"{len(unused)} of {len(unused) + row.positions} positions are not used, their load or raw sample is not "
            f"fully known: {', '.join(unused[:_MOST_NAMED])}{', …' if len(unused) > _MOST_NAMED else ''}"
        )
    if row.reason:
        yield row.reason
    if row.offset_changes and row.fitted:
        yield row.offset_changes
    faults = [fault.message for fault in workbench.faults if fault.serial == row.serial]
    failed = [one for one in workbench.criteria if one.serial == row.serial and not one.passed]
    if faults:
        yield "; ".join(faults[:2]) + (f"; {len(faults) - 2} more" if len(faults) > 2 else "")
    elif failed:
        yield f"failed: {', '.join(criterion.criterion for criterion in failed[:4])}"
    elif row.unmoved and row.fitted:
        yield f"no position loads {', '.join(row.unmoved)}: there the matrix is the prior matrix, or undetermined"
    if row.held_out is not None:
        beside = f", prior {_sizes(row.prior, row.components)}" if row.prior is not None else ""
        yield f"error of positions that are left out one by one: {_sizes(row.held_out, row.components)}{beside}"


def _sizes(error: FloatArray, components: Sequence[str]) -> str:
    """Root mean square of the norms of force and moment, of those that are measured."""
    return " and ".join(
        amount(float((error[part] ** 2).sum() ** 0.5), WRENCH_UNITS[part][0])
        for part in FORCE_AND_MOMENT
        if set(WRENCH_COMPONENTS[part]) & set(components)
    )


def _next(workbench: Workbench) -> tuple[str, bool]:
    """What to record, and whether there is something."""
    if workbench.next is None:
        return "", False
    prefix, _, setup = workbench.next.partition(": ")
    words = {"next": f"record {setup}", "again": f"record again {setup}"}
    return words.get(prefix, ""), prefix in words


def _step(workbench: Workbench, row: BenchSensorRow) -> tuple[str, str]:
    words, wanted = _next(workbench)
    if wanted:
        return words, ""
    if any(fault.serial == row.serial for fault in workbench.faults):
        return "correct the position in the workbench file, or record it again", ""
    if not row.fitted or any(not criterion.passed for criterion in workbench.criteria):
        return "", ""
    if workbench.file is None:
        return "write the calibration", typed("bench", "workbench", row.file, "-o", f"{row.serial}.json")
    return "export the matrix to the robot", typed("export", workbench.file, "--to", "csv", "-o", f"{row.serial}.csv")
