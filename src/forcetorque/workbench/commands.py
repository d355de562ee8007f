# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench workbench`: known loads to a matrix, what to hang next, faults of the bench; and its answer."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.command import Option, Saved, command
from forcetorque.results.number_text import amount

if TYPE_CHECKING:
    from forcetorque.base.arrays import FloatArray
    from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
    from forcetorque.workbench.bench_recording import BenchRecording
    from forcetorque.workbench.result import BenchSensorRow, Workbench


@command(
    "forces on the spheres of their loads, and of errors",
    Saved(
        flags=("--output", "-o"),
        help="File of the calibration (JSON) to write; of one sensor.",
        standard_output=True,
    ),
)
def workbench(
    *files: Annotated[
        "BenchRecording | Path | str", Option("Workbench files (TOML), one per sensor; see docs/workbench.md.")
    ],
    only_next: Annotated[
        bool, Option("Only check the blocks that are there, and say what to hang next.", "--next")
    ] = False,
    full_matrix: Annotated[bool, Option("Refuse loads that do not move all six directions.")] = False,
    spec: Annotated[
        "AcceptanceFile | Path | str | None", Option("Acceptance file (TOML) with limits; exit code 1 if one fails.")
    ] = None,
    seed: Annotated[int, Option("Seed of the partitions into folds.", python_only=True)] = 0,
) -> "Workbench":
    """Calibrate sensors with known loads, and find faults of the workbench.

    Example: forcetorque bench workbench SN170.toml -o SN170.json

    The exit code is 1 where a sensor has no matrix, or a limit of --spec fails.

    Python: `app.workbench("SN170.toml")`

    Returns:
        Faults, errors and matrices; `save` writes the calibration of a single sensor.
    """
    from importlib.metadata import version

    from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance
    from forcetorque.results.result import created_now
    from forcetorque.workbench.bench_recording import BenchRecording, read_bench
    from forcetorque.workbench.calibrate import workbench

    return workbench(
        [given if isinstance(given, BenchRecording) else read_bench(given) for given in files],
        code_version=version("forcetorque"),
        created=created_now(),
        full_matrix=full_matrix,
        only_next=only_next,
        spec=read_acceptance(spec) if isinstance(spec, (Path, str)) else spec,
        seed=seed,
    )


_MOST_NAMED = 4
"""Positions that are named; more are counted."""


def workbench_answers(workbench: "Workbench") -> Iterator[Answer]:
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


def _serials(workbench: "Workbench") -> str:
    names = dict.fromkeys(row.serial for row in workbench.blocks_checked)
    return f"workbench, {', '.join(names)}" if names else "workbench"


def _verdict(workbench: "Workbench", row: "BenchSensorRow") -> tuple[str, Concern]:
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


def _reasons(workbench: "Workbench", row: "BenchSensorRow") -> Iterator[str]:
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


def _sizes(error: "FloatArray", components: Sequence[str]) -> str:
    """Root mean square of the norms of force and moment, of those that are measured."""
    return " and ".join(
        amount(float((error[part] ** 2).sum() ** 0.5), WRENCH_UNITS[part][0])
        for part in FORCE_AND_MOMENT
        if set(WRENCH_COMPONENTS[part]) & set(components)
    )


def _next(workbench: "Workbench") -> tuple[str, bool]:
    """What to record, and whether there is something."""
    if workbench.next is None:
        return "", False
    prefix, _, setup = workbench.next.partition(": ")
    words = {"next": f"record {setup}", "again": f"record again {setup}"}
    return words.get(prefix, ""), prefix in words


def _step(workbench: "Workbench", row: "BenchSensorRow") -> tuple[str, str]:
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
