# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque evaluate`: prior against new on data that was not fitted."""

from __future__ import annotations

from pathlib import Path

from forcetorque.analysis import (
    Verdict,
    beyond_fitted_range,
    evaluate_sensor,
    judged_where_chosen,
)
from forcetorque.analysis.applicability import by_sensor
from forcetorque.cli.evaluate_result import EvaluateResult, VerdictRow, verdict_row
from forcetorque.cli.output import Format, console, print_result, start_logging, table
from forcetorque.cli.reading import read_calibrations, read_experiment
from forcetorque.cli.words import with_error
from forcetorque.experiment.inputs import stated_in
from forcetorque.result.names import short_names
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

_SUFFIX = {"N": "N", "N m": "Nm"}


def run(path: Path, *, calibrations: list[Path], output_format: Format) -> None:
    """Judge calibrations and their priors on the validation intervals.

    Args:
        path: Experiment file.
        calibrations: Calibration files.
        output_format: Form of the result.
    """
    log = start_logging()
    loaded = read_calibrations(calibrations)
    experiment = read_experiment(path, log)
    verdicts: list[Verdict] = []
    for sensor_name, group in by_sensor(experiment, loaded).items():
        log.info("judging %s", sensor_name)
        with stated_in(f"{path}: sensor {sensor_name!r}"):
            verdicts += evaluate_sensor(experiment, experiment.sensor(sensor_name), group)
        for file, calibration in group.items():
            for sentence in beyond_fitted_range(experiment, experiment.sensor(sensor_name), calibration):
                log.warning("%s: %s", file, sentence)
            for label in judged_where_chosen(experiment, calibration):
                log.warning("%s was chosen among others on %r too, so the verdict on it flatters", file, label)
    result = EvaluateResult(experiment=experiment.name, verdicts=[verdict_row(verdict) for verdict in verdicts])
    rows = [_flat(row) for row in result.verdicts]
    print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(result))


def _flat(row: VerdictRow) -> dict[str, object]:
    flat: dict[str, object] = {}
    for key, value in row.model_dump().items():
        if isinstance(value, list):
            for component, unit, number in zip(WRENCH_COMPONENTS, WRENCH_UNITS, value, strict=True):
                flat[f"{key}_{component}_{_SUFFIX[unit]}"] = number
        else:
            flat[key] = value
    return flat


def _show(result: EvaluateResult) -> None:
    screen = console()
    headings = [f"{component}, {unit}" for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)]
    labels = short_names([row.candidate for row in result.verdicts])
    for sensor in dict.fromkeys(row.sensor for row in result.verdicts):
        rows = [row for row in result.verdicts if row.sensor == sensor]
        title = f"{result.experiment}: {sensor} ({rows[0].serial}), {rows[0].samples} samples that were not fitted"
        made = table("candidate", "offset", *headings, "force, N", "moment, N m", title=title)
        for row in rows:
            made.add_row(
                labels[row.candidate],
                row.offset,
                *(f"{value:.3f}" for value in row.rmse),
                with_error(row.force_error_mean_N, row.force_error_standard_error_N, digits=2),
                with_error(row.moment_error_mean_Nm, row.moment_error_standard_error_Nm, digits=3),
            )
        screen.print(made)
    screen.print("per axis: RMSE; force and moment: mean norm of the error ± its standard error")
