# SPDX-License-Identifier: BSD-3-Clause
"""The report on a fleet: evaluated sensors, the worst first, their errors over time, loads, and what to do next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, ClassVar, Final, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.base.lazy import named
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.calibration.summary import LITTLE_LEARNT, information_gains
from forcetorque.evaluation.answers import CONCERN, is_for_inspect
from forcetorque.evaluation.load_cases.predicted_error import CONFIDENCE
from forcetorque.evaluation.load_cases.verdict import LOOK_FOR_CAUSE, Decision, LoadCaseVerdict
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.fleet.added_and_failed_recordings import stored_failures
from forcetorque.fleet.parquet_dataset import Dataset, RecordingNames
from forcetorque.fleet.sensor_evaluation import RecordingError, SensorEvaluation
from forcetorque.fleet.sensor_record import SensorRecord
from forcetorque.fleet.table import FleetSensor, fleet_sensors
from forcetorque.results.answer import typed
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, ShownWrench, Table, WrenchValues, optional_table, table_of
from forcetorque.results.terminal.command_inputs import read_calibrations

DECISIONS: Final[Sequence[Decision]] = sorted(CONCERN, key=CONCERN.__getitem__, reverse=True)
"""Verdicts, the one that asks most for attention first."""


class ReportedSensor(Row):
    """Which sensor it is, and what to do next."""

    robot: Annotated[str, Shown("robot")]
    """Name of the robot in the dataset."""
    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor."""
    serial: Annotated[str, Shown("serial")]
    """Its serial number."""
    step: str
    """What to do next; empty where nothing is to be done."""
    command: str
    """Command that does it; empty where there is none."""

    @property
    def subject(self) -> str:
        """Which sensor it is, for people."""
        return f"{self.robot} {self.sensor} ({self.serial})"


class RankedSensor(ReportedSensor):
    """A sensor that was evaluated: its error in the last recording, and the verdict on all of them.

    Of several load cases it is the one with the worst verdict.
    """

    rank: Annotated[int, Shown("rank")]
    """Place among the evaluated sensors, the worst is 1."""
    calibration: str
    """File of the evaluated calibration."""
    decision: Annotated[Decision, Shown("verdict")]
    """Whether the calibration may be used: by all validation recordings, and by the last one alone."""
    load_case: str
    """Name of the load case."""
    loads: str
    """What the loads are, as text."""
    quantity: Annotated[Literal["force", "moment"], Shown("error of")]
    """What the error is of: the quantity that is larger against what is allowed."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
    """Unit of the errors."""
    error: Annotated[float, Shown("error", digits=3)]
    """Root mean square of the norm of the error in the last recording, in means over a second; without its mean where
    the load case is tared."""
    error_at_least: Annotated[float, Shown("at least", digits=3)]
    """Lower end of its 95 % interval."""
    error_at_most: Annotated[float | None, Shown("at most", digits=3)]
    """Upper end; None where too few data determine it."""
    allowed: Annotated[float | None, Shown("allowed", digits=3)]
    """Error that is allowed at the load case; None where no limit exists."""
    allowed_N: float | None
    """Allowed force error; None where no limit exists."""
    allowed_Nm: float | None
    """The same of the moment."""
    allowed_is_specified: Annotated[bool, Shown("specified")]
    """Whether the experiment file specifies it; else it is a share of the loads."""
    times_allowed: Annotated[float | None, Shown("times allowed", digits=2)]
    """The error over what is allowed."""
    last_date: Annotated[str, Shown("last on")]
    """Day of the last recording with a validation interval, UTC."""
    last_file: str
    """Its experiment file, or log."""
    recordings: int
    """Number of recordings with a validation interval."""
    findings: Annotated[int, Shown("findings")]
    """Number of findings of `inspect` in all recordings."""
    most_frequent_finding: Annotated[str | None, Shown("most frequent")]
    """Kind of finding that most recordings have; None without any."""
    reason: str
    """Most important reason of the decision."""


class UnrankedSensor(ReportedSensor):
    """A sensor that was not evaluated."""

    recordings: Annotated[int, Shown("recordings")]
    """Number of recordings."""
    reason: Annotated[str, Shown("why it has no rank")]
    """Why it was not evaluated."""


class LoadCoverage(Row):
    """How far the loads of one sensor moved: standard deviations of expected wrenches, fx fy fz (N) tx ty tz (N m)."""

    robot: Annotated[str, Shown("robot")]
    """Name of the robot in the dataset."""
    serial: Annotated[str, Shown("serial")]
    """Serial number of the sensor."""
    fitted_recordings: Annotated[int, Shown("to fit")]
    """Recordings with a calibration interval."""
    fitted: Annotated[WrenchValues | None, ShownWrench(digits=2)]
    """In calibration intervals; N, N m; None without one."""
    validation_recordings: Annotated[int, Shown("to validate")]
    """Recordings with a validation interval."""
    validated: WrenchValues | None
    """In validation intervals; N, N m; None without one."""
    little_known: Annotated[str | None, Shown("little known")]
    """Load components of which the fitted data gave little information, such as `tx, ty`; None where there are none, or
    no calibration states it."""


class FailedRecording(Row):
    """A recording that could not be added to the dataset."""

    file: Annotated[str, Shown("recording", file=True)]
    """Experiment file or log."""
    error: Annotated[str, Shown("error")]
    """The error in one line."""


class FleetReport(DrawnResult):
    """The sensors of a fleet, the worst first."""

    answered_by: ClassVar[str | None] = "forcetorque.fleet.answers:report_answers"

    drawn_by: ClassVar[str] = "forcetorque.fleet.figures:fleet_report_figure"
    outlives_figure = True

    schema_name: Literal["forcetorque/fleet_report/1"] = Field(default="forcetorque/fleet_report/1", alias="schema")
    """Form of the result."""
    dataset: str
    """Folder of the dataset."""
    recordings: int
    """Number of recordings."""
    ranked: tuple[RankedSensor, ...]
    """Sensors that were evaluated, the worst first."""
    unranked: tuple[UnrankedSensor, ...]
    """Sensors that were not evaluated."""
    over_time: tuple[RecordingError, ...]
    """Errors of the evaluated sensors in every recording, in the order of the ranks and of time."""
    coverage: tuple[LoadCoverage, ...]
    """Loads of every sensor, in the same order, then those without a rank."""
    failures: tuple[FailedRecording, ...]
    """Recordings that could not be added."""
    file: str | None = None
    """HTML page; null where none was written."""

    @property
    def sensors(self) -> tuple[ReportedSensor, ...]:
        """All sensors, those with a rank first."""
        return (*self.ranked, *self.unranked)

    def blocks(self) -> Iterator[Table | str]:
        """List sensors, loads and failures.

        Yields:
            Tables.
        """
        yield from optional_table(self.ranked, f"{self.dataset}: evaluated sensors, the worst first")
        yield from optional_table(self.unranked, "sensors that were not evaluated")
        yield table_of(self.coverage, "standard deviation of the expected loads in calibration intervals")
        yield from optional_table(self.failures, "recordings that could not be added")

    def records(self) -> list[dict[str, object]]:
        """Give all sensors as flat records.

        Returns:
            Records of the evaluated sensors, then those of the others.
        """
        return [row.flat() for row in self.sensors]

    def save(self, path: Path | str) -> None:
        """Write the report as one HTML page.

        Args:
            path: File to write or to replace, `.html`.

        Raises:
            ForceTorqueError: If it has another ending, or the extra `report` is not installed.
        """
        named("forcetorque.fleet.report_page:write_page")(self, Path(path))


def fleet_report_of(folder: Path, calibrations: Sequence[Path], progress: Progress = lambda _: None) -> FleetReport:
    """Evaluate the sensors of a dataset and rank them.

    Args:
        folder: Folder of the dataset.
        calibrations: Calibration files, and folders of them; one calibration per sensor.
        progress: Called with a line for people as sensors are evaluated.

    Returns:
        The report.

    Raises:
        MissingFileError: If there is no dataset, or a folder has no calibration.
        ExperimentError: If two calibrations are of one sensor.
    """
    known, dataset = _by_serial(calibrations), Dataset.opened(folder)
    sensors = fleet_sensors(dataset)
    left = TimeLeft(progress, f"{len(sensors)} sensors", len(sensors))
    ranked: list[RankedSensor] = []
    unranked: list[UnrankedSensor] = []
    over_time: dict[str, tuple[RecordingError, ...]] = {}
    coverage: dict[tuple[str, str], LoadCoverage] = {}
    left_out: list[str] = []
    for number, sensor in enumerate(sensors, start=1):
        file, calibration = known.get(sensor.serial, ("", None))
        records: list[SensorRecord] = []
        try:
            records = dataset.records(dataset.of_sensor(sensor.serial))
            if calibration is None:
                raise ExperimentError("no calibration of it was given")
            evaluation = SensorEvaluation(folder, sensor.serial, records, {file: calibration})
            ranked.append(_ranked(sensor, evaluation, file, calibration))
            over_time[sensor.serial] = evaluation.over_time(file)
        except ForceTorqueError as error:
            unranked.append(_unranked(sensor, str(error), folder, records, calibration))
        coverage[sensor.robot, sensor.serial] = _coverage(sensor, records, calibration)
        left_out += (f"{sensor.sensor} ({sensor.serial}): {text}" for text in RecordingNames(records).copies())
        left.at(number)
    ranked.sort(key=lambda row: (-(row.times_allowed or 0.0), -CONCERN[row.decision], row.robot, row.serial))
    serials = {sensor.serial for sensor in sensors}
    order: list[ReportedSensor] = [*ranked, *unranked]
    return FleetReport(
        dataset=str(folder),
        recordings=dataset.recordings,
        ranked=tuple(row.model_copy(update={"rank": rank}) for rank, row in enumerate(ranked, start=1)),
        unranked=tuple(unranked),
        over_time=tuple(row for sensor in ranked for row in over_time[sensor.serial]),
        coverage=tuple(coverage[row.robot, row.serial] for row in order),
        failures=tuple(FailedRecording(file=one.file, error=one.error) for one in stored_failures(folder)),
        warnings=(
            *(
                f"{file}: calibrates {one.sensor.name} ({serial}), which the dataset does not have"
                for serial, (file, one) in known.items()
                if serial not in serials
            ),
            *left_out,
        ),
    )


def _by_serial(paths: Sequence[Path]) -> dict[str, tuple[str, Calibration]]:
    """File and calibration of every serial number."""
    known: dict[str, tuple[str, Calibration]] = {}
    for file, calibration in read_calibrations(paths).items():
        serial = calibration.sensor.serial
        if serial in known:
            raise ExperimentError(
                f"{file}: expected one calibration of every sensor, got {known[serial][0]} of {serial!r} too; name the "
                "one that is in use"
            )
        known[serial] = file, calibration
    return known


def _ranked(sensor: FleetSensor, evaluation: SensorEvaluation, file: str, calibration: Calibration) -> RankedSensor:
    rows = [(_row(sensor, evaluation, verdict, file), verdict) for verdict in evaluation.verdicts()]
    if not rows:
        raise ExperimentError("no load case is known; specify loads to come as [[load_case]] in its experiment files")
    row, verdict = max(rows, key=lambda pair: (CONCERN[pair[0].decision], pair[0].times_allowed or 0.0))
    step, command = _next(row, verdict, calibration)
    return row.model_copy(update={"step": step, "command": command})


def _row(sensor: FleetSensor, evaluation: SensorEvaluation, verdict: LoadCaseVerdict, file: str) -> RankedSensor:
    """The sensor at one load case, by the quantity that is larger against what is allowed."""
    specified = {case.name: case.load_case.states_requirement for one in evaluation.stored for case in one.load_cases}
    limits = {row.quantity: row.allowed for row in verdict.errors}
    worst = evaluation.last_error(verdict)
    allowed = worst.allowed
    return RankedSensor(
        rank=1,
        robot=sensor.robot,
        sensor=sensor.sensor,
        serial=sensor.serial,
        calibration=file,
        decision=verdict.decision,
        load_case=verdict.load_case,
        loads=verdict.loads,
        quantity=worst.quantity,
        unit=worst.unit,
        error=worst.size,
        error_at_least=worst.at_least,
        error_at_most=finite_or_none(worst.at_most),
        allowed=allowed,
        allowed_N=limits.get("force"),
        allowed_Nm=limits.get("moment"),
        allowed_is_specified=specified.get(verdict.load_case, False),
        times_allowed=worst.size / allowed if allowed else None,
        last_date=worst.record.date,
        last_file=worst.record.file,
        recordings=len(evaluation.evaluated),
        findings=sensor.findings,
        most_frequent_finding=sensor.most_frequent_finding,
        reason=verdict.reasons[0].text,
        step="",
        command="",
    )


def _next(row: RankedSensor, verdict: LoadCaseVerdict, calibration: Calibration) -> tuple[str, str]:
    """What to do about an evaluated sensor, and the command: a cause first, then the recordings that are lacking."""
    reason = next((one for one in verdict.reasons if one.against is not None), None)
    # commands take experiment files, not a log that one was applied to
    is_experiment = row.last_file.endswith(".toml")
    inspect = typed("inspect", row.last_file, "--details") if is_experiment else ""
    if reason is not None and reason.against == "use":  # of another remedy `inspect` shows nothing
        return reason.remedy or _sentence(reason.text), inspect if is_for_inspect(verdict) else ""
    if row.allowed is not None and row.error > row.allowed:
        return LOOK_FOR_CAUSE, inspect
    if reason is None:
        return "", ""
    if verdict.within is None or verdict.within >= CONFIDENCE:
        return reason.remedy or _sentence(reason.text), inspect if is_for_inspect(verdict) else ""
    little = _little_known(calibration)
    loads = "" if little is None else f", above all loads along {little}"
    plan = typed("plan", row.last_file, "-c", row.calibration, "--clearance-deg", "10") if is_experiment else ""
    return f"Record what the plan lists{loads}, and calibrate again.", plan


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}."


def _little_known(calibration: Calibration) -> str | None:
    gains = information_gains(calibration) or ()
    return ", ".join(row.direction for row in gains if row.uncertainty_reduction < LITTLE_LEARNT) or None


def _unranked(
    sensor: FleetSensor, error: str, folder: Path, records: Sequence[SensorRecord], calibration: Calibration | None
) -> UnrankedSensor:
    if records and all(record.evaluation is None for record in records):
        reason = "no recording has a validation interval"
        step = 'Record an interval with use = "validation", in which the load moves, and add it.'
        command = typed("fleet", "add", "NEW.toml", "--into", str(folder))
    elif records and calibration is None:
        reason, step = error, "Calibrate it from the dataset, and write this report again with the calibration."
        command = typed("calibrate", str(folder), "--sensor", sensor.serial, "-o", f"{sensor.serial}.json")
    else:
        reason, step, command = error, "Correct what the error names, and write this report again.", ""
    return UnrankedSensor(
        robot=sensor.robot,
        sensor=sensor.sensor,
        serial=sensor.serial,
        recordings=sensor.recordings,
        reason=reason,
        step=step,
        command=command,
    )


def _coverage(sensor: FleetSensor, records: Sequence[SensorRecord], calibration: Calibration | None) -> LoadCoverage:
    names = RecordingNames(records)
    fit_copies, evaluation_copies = names.copies_in_fit(), names.copies_in_evaluation()
    fitted = [
        [one.moments for one in record.moments.intervals]
        for record in records
        if record.moments is not None and names.recording(record) not in fit_copies
    ]
    validated = [
        [one.moments for one in record.evaluation.blocks]
        for record in records
        if record.evaluation and names.recording(record) not in evaluation_copies
    ]
    return LoadCoverage(
        robot=sensor.robot,
        serial=sensor.serial,
        fitted_recordings=len(fitted),
        fitted=_standard_deviation([one for moments in fitted for one in moments]),
        validation_recordings=len(validated),
        validated=_standard_deviation([one for moments in validated for one in moments]),
        little_known=None if calibration is None else _little_known(calibration),
    )


def _standard_deviation(parts: Sequence[Moments]) -> WrenchValues | None:
    """Of the expected wrenches; recordings may differ in channels and variables."""
    if not parts:
        return None
    count = np.array([part.count for part in parts])
    means = np.array([part.reference_mean for part in parts])
    squares = np.array([np.diag(part.reference_reference) for part in parts]) + means**2
    mean = np.average(means, axis=0, weights=count)
    return np.sqrt(np.maximum(np.average(squares, axis=0, weights=count) - mean**2, 0.0))
