# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque evaluate`: prior against new on data that was not fitted."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.cli.output import Format, console, finite_or_none, print_result, start_logging, table
from forcetorque.cli.reading import read_calibrations, read_experiment
from forcetorque.experiment import (
    Verdict,
    beyond_fitted_range,
    evaluate_sensor,
    judged_where_chosen,
)
from forcetorque.experiment.fitness import by_sensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

_SUFFIX = {"N": "N", "N m": "Nm"}


class VerdictRow(BaseModel):
    """Errors of one candidate with one offset; per axis in the order fx fy fz (N) tx ty tz (N m)."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """The calibration file, or its prior: `prior`, and `prior of FILE` among several files."""
    offset: Literal["fitted", "re-estimated"]
    """Offset of the fitted data, or re-estimated on the judged samples."""
    samples: int
    """Number of judged samples."""
    rmse: list[float]
    """Root mean square error per component; N, N m."""
    bias: list[float]
    """Mean error per component; N, N m."""
    largest: list[float]
    """Largest absolute error per component; N, N m."""
    force_error_mean_N: float
    """Mean norm of the force error."""
    force_error_standard_error_N: float | None
    """Standard error of that mean, from contiguous blocks; None for one sample."""
    force_error_largest_N: float
    """Largest norm of the force error."""
    moment_error_mean_Nm: float
    """Mean norm of the moment error."""
    moment_error_standard_error_Nm: float | None
    """Standard error of that mean, from contiguous blocks; None for one sample."""
    moment_error_largest_Nm: float
    """Largest norm of the moment error."""


class EvaluateResult(BaseModel):
    """What `forcetorque evaluate` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/evaluate/1"] = Field(default="forcetorque/evaluate/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    verdicts: list[VerdictRow]
    """One per sensor, candidate and offset."""


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
    result = EvaluateResult(experiment=experiment.name, verdicts=[_row(verdict) for verdict in verdicts])
    rows = [_flat(row) for row in result.verdicts]
    print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(result))


def _row(verdict: Verdict) -> VerdictRow:
    errors = verdict.errors
    return VerdictRow(
        sensor=verdict.sensor,
        serial=verdict.serial,
        candidate=verdict.candidate,
        offset="fitted" if verdict.offset == "fitted" else "re-estimated",
        samples=errors.count,
        rmse=errors.rmse.tolist(),
        bias=errors.bias.tolist(),
        largest=errors.largest.tolist(),
        force_error_mean_N=errors.force_mean,
        force_error_standard_error_N=finite_or_none(errors.force_mean_error),
        force_error_largest_N=errors.force_largest,
        moment_error_mean_Nm=errors.moment_mean,
        moment_error_standard_error_Nm=finite_or_none(errors.moment_mean_error),
        moment_error_largest_Nm=errors.moment_largest,
    )


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
    labels = _labels([row.candidate for row in result.verdicts])
    for sensor in dict.fromkeys(row.sensor for row in result.verdicts):
        rows = [row for row in result.verdicts if row.sensor == sensor]
        title = f"{result.experiment}: {sensor} ({rows[0].serial}), {rows[0].samples} samples that were not fitted"
        made = table("candidate", "offset", *headings, "force, N", "moment, N m", title=title)
        for row in rows:
            made.add_row(
                labels[row.candidate],
                row.offset,
                *(f"{value:.3f}" for value in row.rmse),
                _with_error(row.force_error_mean_N, row.force_error_standard_error_N, digits=2),
                _with_error(row.moment_error_mean_Nm, row.moment_error_standard_error_Nm, digits=3),
            )
        screen.print(made)
    screen.print("per axis: RMSE; force and moment: mean norm of the error ± its standard error")


def _labels(candidates: list[str]) -> dict[str, str]:
    """Leave the folders of calibration files out, unless files in several folders share a name."""
    labels = {}
    for candidate in candidates:
        words = "prior of " if candidate.startswith("prior of ") else ""
        labels[candidate] = words + Path(candidate.removeprefix(words)).name
    return labels if len(set(labels.values())) == len(labels) else {candidate: candidate for candidate in labels}


def _with_error(value: float, error: float | None, *, digits: int) -> str:
    return f"{value:.{digits}f}" if error is None else f"{value:.{digits}f} ±{error:.{digits}f}"
