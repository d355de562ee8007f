# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque accept`: thresholds on what the other commands measure, and on the matrix by itself."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from forcetorque.analysis import (
    SensorRun,
    accept_sensor,
    read_acceptance,
    read_population,
)
from forcetorque.analysis.applicability import one_per_sensor
from forcetorque.cli.accept_result import AcceptResult, CriterionRow, criterion_rows, measured_row
from forcetorque.cli.output import Format, console, print_result, start_logging, table
from forcetorque.cli.reading import read_calibrations, read_experiment
from forcetorque.experiment.inputs import stated_in

if TYPE_CHECKING:
    from rich.table import Table


def run(
    path: Path,
    *,
    spec: Path,
    calibrations: Sequence[Path] | None,
    population: Sequence[Path] | None,
    output_format: Format,
) -> None:
    """Judge the calibrated sensors of an experiment, or all by their priors, by an acceptance file.

    Args:
        path: Experiment file.
        spec: Acceptance file.
        calibrations: Calibration files, one per sensor; the priors of all sensors if None.
        population: Matrix files, calibrations or folders of them, of other sensors.
        output_format: Form of the result.

    Raises:
        Exit: With code 1 if a criterion fails.
    """
    log = start_logging()
    stated = read_acceptance(spec)
    loaded = read_calibrations(calibrations)
    others = read_population(population) if population else None
    experiment = read_experiment(path, log)
    chosen = one_per_sensor(experiment, loaded)
    found = []
    for sensor in experiment.sensors:
        if chosen and sensor.name not in chosen:
            continue
        log.info("judging %s", sensor.name)
        mine = chosen.get(sensor.name)
        rest = {file: one for name, (file, one) in chosen.items() if name != sensor.name}
        with stated_in(str(spec)):
            found.append(accept_sensor(SensorRun(experiment, sensor), stated, mine, others=rest, population=others))
    criteria = [row for each in found for row in criterion_rows(each)]
    result = AcceptResult(
        experiment=experiment.name,
        specification=stated.name,
        accepted=all(row.passed for row in criteria),
        criteria=criteria,
        measured=[measured_row(each.checks) for each in found],
    )
    rows = [row.model_dump(mode="json") for row in criteria]
    print_result(
        result.model_dump(mode="json", by_alias=True),
        rows,
        output_format,
        show=lambda: _show(result),
        columns=list(CriterionRow.model_fields),
    )
    if not result.accepted:
        raise typer.Exit(1)


def _show(result: AcceptResult) -> None:
    screen = console()
    for sensor in dict.fromkeys(row.sensor for row in result.criteria):
        screen.print(_table(result, [row for row in result.criteria if row.sensor == sensor]))
    failed = sum(not row.passed for row in result.criteria)
    verdict = "accepted" if result.accepted else "NOT accepted"
    kept = f"{len(result.criteria) - failed} of {len(result.criteria)} criteria hold"
    screen.print(f"{verdict} by {result.specification!r}: {kept}", soft_wrap=True)


def _table(result: AcceptResult, rows: Sequence[CriterionRow]) -> Table:
    first = rows[0]
    made = table(
        "criterion", "measured", "", "limit", "unit", "n", "", "where",
        title=f"{result.experiment}: {first.sensor} ({first.serial}), {first.candidate}",
    )  # fmt: skip
    for row in rows:
        made.add_row(
            row.criterion,
            "infinite" if row.measured is None else f"{row.measured:.4g}",
            "<=" if row.bound == "at most" else ">=",
            f"{row.limit:.4g}",
            row.unit,
            "" if row.count is None else str(row.count),
            "pass" if row.passed else "FAIL",
            row.note,
        )
    return made
