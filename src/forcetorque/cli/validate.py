# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque validate`: contact forces that sensors report where nothing touches."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.cli.output import Format, console, finite_or_none, print_result, start_logging, table
from forcetorque.cli.reading import read_calibrations, read_experiment
from forcetorque.evaluation import OtherSensors
from forcetorque.experiment import ContactForceVerdict, validate_sensor
from forcetorque.experiment.fitness import by_sensor, one_per_sensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

if TYPE_CHECKING:
    from rich.table import Table


class ContactForceRow(BaseModel):
    """Contact wrench that a candidate reports where nothing touches, in the sensor's frame; per axis fx ... tz."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    sub_model: str
    """Sub-model that nothing touches."""
    candidate: str
    """The calibration file, or `prior`."""
    offset: Literal["re-estimated", "fitted"]
    """Offset from the first second of every judged interval, or that of the candidate."""
    samples: int
    """Number of judged samples."""
    force_mean_N: float
    """Mean norm of the force."""
    force_mean_error_N: float | None
    """Standard error of that mean, from blocks of time."""
    moment_mean_Nm: float
    """Mean norm of the moment."""
    mean_absolute: list[float]
    """Mean absolute value per component; N, N m."""


class BestRow(BaseModel):
    """The best candidate of a sensor in one offset mode."""

    sensor: str
    """Sensor."""
    offset: Literal["re-estimated", "fitted"]
    """Offset mode."""
    by_magnitude: str
    """Candidate with the smallest mean norm of the force."""
    by_axis: list[str]
    """Candidate with the smallest mean absolute value, per component."""


class ValidateResult(BaseModel):
    """What `forcetorque validate` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/validate/1"] = Field(default="forcetorque/validate/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    other_sensors: Literal["model", "measured"]
    """What the other sensors of the sub-model were taken to read."""
    contact_forces: list[ContactForceRow]
    """One per sensor, candidate and offset."""
    best: list[BestRow]
    """One per sensor and offset."""


def run(
    path: Path,
    *,
    calibrations: Sequence[Path] | None,
    sensors: Sequence[str] | None,
    sub_model: str | None,
    contact: str | None,
    other_sensors: OtherSensors,
    output_format: Format,
) -> None:
    """Judge candidates by the contact wrench of sub-models that nothing touches.

    Args:
        path: Experiment file.
        calibrations: Calibration files; of a judged sensor any number.
        sensors: Judged sensors; those that are calibrated, or all, if None.
        sub_model: Sub-model that is free, by the sensor at its base or the root link.
        contact: Link at whose origin the contact is estimated.
        other_sensors: Whether the other sensors read what the model expects or what they measured.
        output_format: Form of the result.
    """
    log = start_logging()
    loaded = read_calibrations(calibrations)
    experiment = read_experiment(path, log)
    groups = by_sensor(experiment, loaded)
    judged = [experiment.sensor(name).name for name in sensors or groups or (s.name for s in experiment.sensors)]
    verdicts: list[ContactForceVerdict] = []
    for name in dict.fromkeys(judged):
        log.info("validating %s", name)
        rest = {file: one for other, group in groups.items() if other != name for file, one in group.items()}
        if other_sensors is OtherSensors.MEASURED:
            one_per_sensor(experiment, rest)
        with stated_in(f"{path}: sensor {name!r}"):
            verdicts += validate_sensor(
                experiment,
                experiment.sensor(name),
                groups.get(name, {}),
                others=rest,
                other_sensors=other_sensors,
                sub_model=sub_model,
                contact=contact,
            )
    result = ValidateResult(
        experiment=experiment.name,
        other_sensors=other_sensors.value,
        contact_forces=[_row(verdict) for verdict in verdicts],
        best=_best(verdicts),
    )
    rows = [_flat(row) for row in result.contact_forces]
    print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(result))


def _best(verdicts: Sequence[ContactForceVerdict]) -> list[BestRow]:
    groups: dict[tuple[str, str], list[ContactForceVerdict]] = {}
    for verdict in verdicts:
        groups.setdefault((verdict.sensor, verdict.offset.value), []).append(verdict)
    return [
        BestRow(
            sensor=sensor,
            offset=group[0].offset.value,
            by_magnitude=min(group, key=lambda one: one.errors.force_mean).candidate,
            by_axis=[
                min(group, key=lambda one, k=axis: float(one.errors.mean_absolute[k])).candidate  # type: ignore[misc]
                for axis in range(6)
            ],
        )
        for (sensor, _), group in groups.items()
    ]


def _row(verdict: ContactForceVerdict) -> ContactForceRow:
    errors = verdict.errors
    return ContactForceRow(
        sensor=verdict.sensor,
        serial=verdict.serial,
        sub_model=verdict.sub_model,
        candidate=verdict.candidate,
        offset=verdict.offset.value,
        samples=errors.count,
        force_mean_N=errors.force_mean,
        force_mean_error_N=finite_or_none(errors.force_mean_error),
        moment_mean_Nm=errors.moment_mean,
        mean_absolute=errors.mean_absolute.tolist(),
    )


def _flat(row: ContactForceRow) -> dict[str, object]:
    flat: dict[str, object] = row.model_dump(exclude={"mean_absolute"})
    return flat | dict(zip(WRENCH_COMPONENTS, row.mean_absolute, strict=True))


def _show(result: ValidateResult) -> None:
    screen = console()
    for sensor in dict.fromkeys(row.sensor for row in result.contact_forces):
        screen.print(_table([row for row in result.contact_forces if row.sensor == sensor]))
    several = len({row.candidate for row in result.contact_forces}) > 1
    for best in result.best if several else ():
        other = [f"{a} {n}" for a, n in zip(WRENCH_COMPONENTS, best.by_axis, strict=True) if n != best.by_magnitude]
        words = f"; but for {', '.join(other)}" if other else ", on every axis"
        screen.print(f"{best.sensor}, offset {best.offset}: best is {best.by_magnitude}{words}", soft_wrap=True)
    screen.print(f"other sensors: as {'the model expects' if result.other_sensors == 'model' else 'they measured'}")


def _table(rows: Sequence[ContactForceRow]) -> Table:
    headings = [f"{component}, {unit}" for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)]
    first = rows[0]
    made = table(
        "candidate", "offset", *headings, "force, N", "moment, N m",
        title=f"{first.sensor} ({first.serial}): contact wrench of the free sub-model {first.sub_model}, "
        f"{first.samples} samples; per axis: mean absolute value",
    )  # fmt: skip
    for row in rows:
        error = "" if row.force_mean_error_N is None else f" ±{row.force_mean_error_N:.2f}"
        values = [f"{value:.3f}" for value in row.mean_absolute]
        made.add_row(row.candidate, row.offset, *values, f"{row.force_mean_N:.2f}{error}", f"{row.moment_mean_Nm:.3f}")
    return made
