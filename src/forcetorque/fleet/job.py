# SPDX-License-Identifier: BSD-3-Clause
"""What one process does of a plan: add a recording, or calibrate and evaluate a sensor from the dataset."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from forcetorque.calibration.calibrate import calibrate_for_file
from forcetorque.calibration.joint.calibrate import calibration_file
from forcetorque.evaluation.answers import CONCERN
from forcetorque.experiment.validation_offset import Offset
from forcetorque.fleet.add import AddedSensor, add_recording
from forcetorque.fleet.dataset import Dataset
from forcetorque.fleet.evaluate import evaluate_records
from forcetorque.fleet.sensor_record import AddOptions
from forcetorque.fleet.source import RecordingSource
from forcetorque.results.table import Row, Shown


@dataclass(frozen=True, slots=True, kw_only=True)
class AddJob:
    """A recording to add."""

    source: RecordingSource
    """Where it comes from."""
    dataset: Path
    """Folder of the dataset."""
    options: AddOptions
    """What is kept of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrateJob:
    """A sensor to calibrate."""

    serial: str
    """Serial number."""
    dataset: Path
    """Folder of the dataset."""
    folder: Path
    """Folder of the calibrations."""
    code_version: str
    """Version of this library, for the record."""
    created: str
    """Date and time, ISO 8601, for the record."""


class CalibratedSensor(Row):
    """One sensor that was calibrated from the dataset, and its verdict."""

    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor."""
    serial: Annotated[str, Shown("serial")]
    """Its serial number."""
    file: Annotated[str, Shown("calibration", file=True)]
    """Calibration file."""
    recordings: Annotated[int, Shown("recordings")]
    """Recordings with a calibration interval."""
    decision: Annotated[str | None, Shown("verdict")]
    """Verdict on the worst load case; None without validation data or a load case."""
    force_error_rms_N: Annotated[float | None, Shown("force error", "N", digits=2)]
    """Root mean square of the norm of the force error on validation data, with the offset of the fitted data; None
    without validation data."""
    prior_force_error_rms_N: Annotated[float | None, Shown("of the prior", "N", digits=2)]
    """The same of the prior."""
    moment_error_rms_Nm: Annotated[float | None, Shown("moment error", "N m", digits=3)]
    """The same of the moment error."""
    prior_moment_error_rms_Nm: Annotated[float | None, Shown("of the prior", "N m", digits=3)]
    """The same of the prior."""
    left_out: tuple[str, ...]
    """A message for every recording that has readings of a longer one, and therefore does not count."""


def run_add(job: AddJob) -> list[AddedSensor]:
    """Add a recording.

    Args:
        job: The recording.

    Returns:
        A row per sensor.
    """
    return add_recording(job.source, job.dataset, job.options)


def run_calibrate(job: CalibrateJob) -> CalibratedSensor:
    """Calibrate a sensor, write its calibration, and evaluate it where there are validation data.

    Args:
        job: The sensor.

    Returns:
        The row of the sensor.
    """
    dataset = Dataset.opened(job.dataset)
    records = dataset.records(dataset.of_sensor(job.serial))
    moments, left_out = dataset.moments(records)
    identity = records[-1].identity
    file = job.folder / calibration_file(identity.name, identity.serial)
    made = calibrate_for_file(None, file, code_version=job.code_version, created=job.created, moments=moments)
    made.save()
    decision, calibrated, prior = None, None, None
    if any(record.evaluation is not None for record in records):
        result = evaluate_records(dataset.folder, job.serial, records, {str(file): made.calibrations[0].calibration})
        worst = max(result.load_cases, key=lambda use: CONCERN[use.decision], default=None)
        decision = None if worst is None else worst.decision
        left_out = tuple(dict.fromkeys((*left_out, *result.left_out)))
        rows = {row.prior is None: row for row in result.errors if row.offset is not Offset.JUDGED_MEAN}
        calibrated = next(row for row in reversed(result.errors) if row.offset is not Offset.JUDGED_MEAN)
        prior = rows.get(True) if len(rows) > 1 else None
    return CalibratedSensor(
        sensor=identity.name,
        serial=identity.serial,
        file=str(file),
        recordings=len(moments),
        decision=decision,
        force_error_rms_N=None if calibrated is None else calibrated.force_error_rms_N,
        prior_force_error_rms_N=None if prior is None else prior.force_error_rms_N,
        moment_error_rms_Nm=None if calibrated is None else calibrated.moment_error_rms_Nm,
        prior_moment_error_rms_Nm=None if prior is None else prior.moment_error_rms_Nm,
        left_out=left_out,
    )
