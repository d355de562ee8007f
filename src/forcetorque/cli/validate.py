# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque validate`: contact forces that sensors report where nothing touches, and joint torques from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypedDict

from forcetorque.analysis import (
    ContactForceVerdict,
    JointTorqueVerdict,
    SensorRun,
    compare_contact_forces,
    compare_joint_torques,
)
from forcetorque.analysis.applicability import by_sensor, one_per_sensor
from forcetorque.calibration import Calibration
from forcetorque.cli.output import Format, console, print_result, start_logging, table
from forcetorque.cli.reading import read_calibrations, read_experiment
from forcetorque.cli.validate_result import (
    ContactForceRow,
    JointTorqueRow,
    ValidateResult,
    best_rows,
    contact_force_row,
    joint_torque_row,
)
from forcetorque.cli.words import with_error
from forcetorque.evaluation import Offset, OtherSensors
from forcetorque.experiment.inputs import stated_in
from forcetorque.result.names import short_names
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

if TYPE_CHECKING:
    from rich.table import Table


class _Question(TypedDict):
    """What both comparisons of a sensor are asked."""

    others: Mapping[str, Calibration]
    other_sensors: OtherSensors
    sub_model: str | None
    contact: str | None


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
    """Judge candidates by the contact wrench of sub-models that nothing touches, and by joint torques.

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
    torques: list[JointTorqueVerdict] = []
    left_out: dict[str, None] = {}
    for name in dict.fromkeys(judged):
        log.info("validating %s", name)
        rest = {file: one for other, group in groups.items() if other != name for file, one in group.items()}
        if other_sensors is OtherSensors.MEASURED:
            one_per_sensor(experiment, rest)
        with stated_in(f"{path}: sensor {name!r}"):
            question: _Question = {
                "others": rest,
                "other_sensors": other_sensors,
                "sub_model": sub_model,
                "contact": contact,
            }
            run = SensorRun(experiment, name)
            forces = compare_contact_forces(run, groups.get(name, {}), **question)
            compared = compare_joint_torques(run, groups.get(name, {}), **question)
            verdicts += forces.verdicts
            torques += compared.verdicts
            left_out |= dict.fromkeys(f"{name}: {words}" for words in (*forces.left_out, *compared.left_out))
    result = ValidateResult(
        experiment=experiment.name,
        other_sensors=other_sensors.value,
        contact_forces=[contact_force_row(verdict) for verdict in verdicts],
        best=best_rows(verdicts),
        joint_torques=[joint_torque_row(verdict) for verdict in torques],
        left_out=list(left_out),
    )
    for words in result.left_out:
        log.warning("left out: %s", words)
    rows = [_flat(row) for row in result.contact_forces]
    rows += [{"what": "joint_torque", **row.model_dump()} for row in result.joint_torques]
    print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(result))


def _flat(row: ContactForceRow) -> dict[str, object]:
    flat: dict[str, object] = {"what": "contact_force", **row.model_dump(exclude={"mean_absolute"})}
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
    for sensor in dict.fromkeys(row.sensor for row in result.contact_forces):
        for candidate, words in _without_offset(result, sensor).items():
            screen.print(f"{sensor}, {candidate}, offset fitted: read by {words}", soft_wrap=True)
        torques = [row for row in result.joint_torques if row.sensor == sensor]
        if torques:
            screen.print(_torque_table(torques))
        else:
            screen.print(f"{sensor}: no joint torque is estimated from it", soft_wrap=True)
    screen.print(f"other sensors: as {'the model expects' if result.other_sensors == 'model' else 'they measured'}")


def _without_offset(result: ValidateResult, sensor: str) -> dict[str, str]:
    """What candidates are read by whose wrenches have whatever offset the sensor has."""
    rows = [row for row in result.contact_forces if row.sensor == sensor]
    return {row.candidate: row.offset_source for row in rows if row.offset is Offset.NONE}


def _table(rows: Sequence[ContactForceRow]) -> Table:
    headings = [f"{component}, {unit}" for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)]
    first = rows[0]
    alike = len({row.samples for row in rows}) == 1
    count = f", {first.samples} samples" if alike else ""
    made = table(
        "candidate", "offset", *headings, "force, N", "moment, N m", *([] if alike else ["samples"]),
        title=f"{first.sensor} ({first.serial}): contact wrench of the free sub-model {first.sub_model}{count}; "
        "per axis: mean absolute value",
    )  # fmt: skip
    labels = short_names([row.candidate for row in rows])
    for row in rows:
        error = "" if row.force_mean_error_N is None else f" ±{row.force_mean_error_N:.2f}"
        values = [f"{value:.3f}" for value in row.mean_absolute]
        norms = [f"{row.force_mean_N:.2f}{error}", f"{row.moment_mean_Nm:.3f}"]
        made.add_row(labels[row.candidate], row.offset, *values, *norms, *([] if alike else [str(row.samples)]))
    return made


def _torque_table(rows: Sequence[JointTorqueRow]) -> Table:
    has_logged = any(row.logged_rmse is not None for row in rows)
    made = table(
        "joint", "offset", "candidate", "RMSE", "mean", "largest", "unit", "samples",
        *(["RMSE from logged"] if has_logged else []),
        title=f"{rows[0].sensor} ({rows[0].serial}): joint torques estimated from it, less those of the model",
    )  # fmt: skip
    labels = short_names([row.candidate for row in rows])
    for row in sorted(rows, key=_place(rows)):
        values = [
            with_error(row.rmse, row.rmse_error, digits=3),
            with_error(row.mean, row.mean_error, digits=3),
            f"{row.largest:.3f}",
        ]
        from_logged = [] if row.logged_rmse is None else [with_error(row.logged_rmse, row.logged_rmse_error, digits=3)]
        made.add_row(row.joint, row.offset, labels[row.candidate], *values, row.unit, str(row.samples), *from_logged)
    return made


def _place(rows: Sequence[JointTorqueRow]) -> Callable[[JointTorqueRow], tuple[int, int]]:
    """Order that puts the candidates of a joint, with one offset, under each other."""
    joints, offsets = ([*dict.fromkeys(names)] for names in ((r.joint for r in rows), (r.offset for r in rows)))
    return lambda row: (joints.index(row.joint), offsets.index(row.offset))
