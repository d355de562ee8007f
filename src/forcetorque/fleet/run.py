# SPDX-License-Identifier: BSD-3-Clause
"""Work off a plan: add every recording, then calibrate and evaluate every sensor; errors of jobs are rows."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from forcetorque.base.output_file import real_path
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.calibration.calibrate import calibrate_for_file
from forcetorque.calibration.joint.calibrate import calibration_file
from forcetorque.evaluation.answers import CONCERN
from forcetorque.experiment.validation_offset import Offset
from forcetorque.fleet.added_and_failed_recordings import AddedSensor, Failures, add_recording
from forcetorque.fleet.evaluate import evaluate_records
from forcetorque.fleet.parquet_dataset import Dataset, is_dataset, require_folder
from forcetorque.fleet.plan_file import PlannedRecording, planned_recordings, read_plan
from forcetorque.fleet.process_pool import Pool
from forcetorque.fleet.sensor_record import AddOptions
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.result import DrawnResult, created_now
from forcetorque.results.table import Row, Shown, Table, optional_table


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


def run_add(planned: PlannedRecording, dataset: Path) -> list[AddedSensor]:
    """Add a recording.

    Args:
        planned: The recording.
        dataset: Folder of the dataset.

    Returns:
        A row per sensor.
    """
    return add_recording(planned.source, dataset, AddOptions(robot=planned.robot))


def run_calibrate(
    serial: str, dataset_folder: Path, output_folder: Path, *, code_version: str, created: str
) -> CalibratedSensor:
    """Calibrate a sensor, write its calibration, and evaluate it where there are validation data.

    Args:
        serial: Serial number.
        dataset_folder: Folder of the dataset.
        output_folder: Folder of the calibrations.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.

    Returns:
        The row of the sensor.
    """
    dataset = Dataset.opened(dataset_folder)
    records = dataset.records(dataset.of_sensor(serial))
    moments, left_out = dataset.moments(records)
    identity = records[-1].identity
    file = output_folder / calibration_file(identity.name, identity.serial)
    made = calibrate_for_file(None, file, code_version=code_version, created=created, moments=moments)
    made.save()
    decision, calibrated, prior = None, None, None
    if any(record.evaluation is not None for record in records):
        result = evaluate_records(dataset.folder, serial, records, {str(file): made.calibrations[0].calibration})
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


class FailedJob(Row):
    """A recording that could not be added, or a sensor that could not be calibrated."""

    job: Annotated[Literal["add", "calibrate"], Shown("job")]
    """What failed."""
    subject: Annotated[str, Shown("of", file=True)]
    """Experiment file or log, or serial number."""
    error: Annotated[str, Shown("error")]
    """The error in one line."""
    earlier: Annotated[bool, Shown("earlier")]
    """Whether it failed in an earlier run and was not tried again."""


class FleetRun(DrawnResult):
    """What became of a plan."""

    drawn_by: ClassVar[str] = "forcetorque.fleet.figures:fleet_run_figure"
    outlives_figure = True

    schema_name: Literal["forcetorque/fleet_run/1"] = Field(default="forcetorque/fleet_run/1", alias="schema")
    """Form of the result."""
    plan: str
    """File of the plan."""
    dataset: str
    """Folder of the dataset."""
    recordings: int
    """Number of recordings of the plan."""
    added: int
    """Recordings that were added now."""
    present: int
    """Recordings that were in the dataset already."""
    sensors: tuple[CalibratedSensor, ...]
    """Sensors that were calibrated."""
    failures: tuple[FailedJob, ...]
    """What failed."""

    @property
    def passed(self) -> bool:
        """Whether nothing failed."""
        return not self.failures

    def answers(self) -> Iterator[Answer]:
        """Count what was done, and name what failed.

        Yields:
            One answer.
        """
        failed = sum(one.job == "add" for one in self.failures)
        counts = [f"{self.added} ADDED", f"{self.present} THERE", f"{failed} FAILED"]
        verdicts = {one.decision for one in self.sensors if one.decision is not None}
        of_decision = [
            f"{sum(one.decision == decision for one in self.sensors)} {decision}" for decision in sorted(verdicts)
        ]
        why = [f"{len(self.sensors)} sensors calibrated: {', '.join(of_decision) or 'no validation data'}"]
        if not self.sensors:
            why = []
        if self.failures:
            first = self.failures[0]
            why.append(f"{len(self.failures)} failed, such as {first.subject}: {first.error}")
        yield Answer(
            subject=f"{self.plan}: {self.recordings} recordings",
            verdict=", ".join(text for text in counts if not text.startswith("0 ")) or "NOTHING TO DO",
            why=tuple(why),
            step="correct what failed, and try it again" if self.failures else "show the sensors, the worst first",
            command=(
                typed("fleet", "run", self.plan, "--retry-failed")
                if self.failures
                else typed("fleet", "table", self.dataset)
            ),
            concern=Concern.BAD if self.failures else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table]:
        """List sensors and failures.

        Yields:
            Tables.
        """
        yield from optional_table(self.sensors, f"{self.dataset}: sensors")
        yield from optional_table(self.failures, "failed")

    def records(self) -> list[dict[str, object]]:
        """Give sensors and failures as flat records.

        Returns:
            Records of the sensors, then those of the failures.
        """
        return [row.flat() for row in (*self.sensors, *self.failures)]


def run_plan(file: Path, pool: Pool, *, retry_failed: bool = False, progress: Progress = lambda _: None) -> FleetRun:
    """Work off a plan; what an earlier run has done is not done again.

    Args:
        file: File of the plan.
        pool: Where jobs run.
        retry_failed: Whether recordings that failed in an earlier run are tried again.
        progress: Called with a line for people as jobs are done.

    Returns:
        What was done and what failed.
    """
    plan, code_version = read_plan(file), version("forcetorque")
    dataset = file.parent / plan.dataset
    require_folder(dataset)
    planned = planned_recordings(plan, file)
    failures: list[FailedJob] = []
    waiting = []
    for one in planned:
        kept = Failures(dataset=dataset, options=AddOptions(robot=one.robot), code_version=code_version)
        earlier = None if retry_failed else kept.of(one.source)
        if earlier is None:
            waiting.append((one, kept))
        else:
            failures.append(FailedJob(job="add", subject=earlier.file, error=earlier.error, earlier=True))
    added = present = 0
    left = TimeLeft(progress, f"{len(waiting)} recordings", len(waiting))
    jobs = [replace(one, source=one.source.absolute()) for one, _ in waiting]
    for done, outcome in enumerate(pool.outcomes(partial(run_add, dataset=real_path(dataset)), jobs), start=1):
        one, kept = waiting[outcome.index]
        left.at(done)
        if outcome.value is None:
            error = outcome.error or ""
            if outcome.is_of_data:
                with suppress(OSError):  # on a full disk the row alone has it
                    kept.keep(one.source, error)
            failures.append(FailedJob(job="add", subject=str(one.source.path), error=error, earlier=False))
            continue
        new = any(row.state == "added" for row in outcome.value)
        added, present = added + new, present + (not new)
    sensors: list[CalibratedSensor] = []
    if plan.calibrations is not None and is_dataset(dataset):
        folder = file.parent / plan.calibrations
        for result in _calibrated(dataset, folder, pool, progress):
            (sensors if isinstance(result, CalibratedSensor) else failures).append(result)  # type: ignore[arg-type]
    return FleetRun(
        plan=str(file),
        dataset=str(dataset),
        recordings=len(planned),
        added=added,
        present=present,
        sensors=tuple(sorted(sensors, key=lambda row: (row.sensor, row.serial))),
        failures=tuple(sorted(failures, key=lambda row: (row.job, row.subject))),
        warnings=tuple(f"{row.sensor} ({row.serial}): {text}" for row in sensors for text in row.left_out),
    )


def _calibrated(dataset: Path, folder: Path, pool: Pool, progress: Progress) -> Iterator[CalibratedSensor | FailedJob]:
    serials = sorted(Dataset.opened(dataset).serials)
    calibrate = partial(
        run_calibrate,
        dataset_folder=real_path(dataset),
        output_folder=real_path(folder),
        code_version=version("forcetorque"),
        created=created_now(),
    )
    left = TimeLeft(progress, f"{len(serials)} sensors", len(serials))
    for done, outcome in enumerate(pool.outcomes(calibrate, serials), start=1):
        left.at(done)
        if outcome.value is not None:
            yield outcome.value
        else:
            subject = serials[outcome.index]
            yield FailedJob(job="calibrate", subject=subject, error=outcome.error or "", earlier=False)
