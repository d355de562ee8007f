# SPDX-License-Identifier: BSD-3-Clause
"""Add recordings to a dataset: each is read once, and adding it again changes nothing; those that failed are kept."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.base.errors import ChangingFileError, ExperimentError, MissingFileError
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.base.stored_table import StoredTable, read_stored_table
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.named_files import stated_in
from forcetorque.fleet.parquet_dataset import Dataset, RecordFile, require_folder
from forcetorque.fleet.recording_source import RecordingSource
from forcetorque.fleet.sensor_record import AddOptions, path_digest, recording_digest, sensor_records
from forcetorque.results.answer import Answer, typed
from forcetorque.results.number_text import counted
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, table_of


class StoredFailure(StoredTable):
    """Why a recording could not be added."""

    schema_name: Literal["forcetorque/failure/1"] = Field(default="forcetorque/failure/1", alias="schema")
    """Form of the file."""
    file: str
    """Experiment file, or log that one was applied to."""
    error: str
    """The error in one line."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Failures:
    """The failures of a dataset."""

    dataset: Path
    """Folder of the dataset."""
    options: AddOptions
    """What is kept of every recording."""
    code_version: str
    """Version of this library: another one tries again."""

    def _path(self, source: RecordingSource) -> Path:
        try:
            content = source.experiment.read_bytes()
        except OSError:
            content = b""
        # a log that was cut off may be whole in a later run
        digest = hashlib.sha256(content + repr(source.log_state()).encode()).hexdigest()[:20]
        name = f"{path_digest(source.path)}-{digest}-{self.options.digest(self.code_version)}.json"
        return self.dataset / "failures" / name

    def of(self, source: RecordingSource) -> StoredFailure | None:
        """Find the failure of an earlier run, of the same experiment file, log, options and version.

        Args:
            source: The recording.

        Returns:
            The failure; None where there is none.
        """
        path = self._path(source)
        return read_stored_table(path, StoredFailure, expected="a failure") if path.is_file() else None

    def keep(self, source: RecordingSource, error: str) -> None:
        """Keep a failure.

        Args:
            source: The recording.
            error: The error in one line.
        """
        path = self._path(source)
        path.parent.mkdir(parents=True, exist_ok=True)
        stored = StoredFailure.model_validate({"file": str(source.path), "error": error})
        write_bytes_atomically(path, (stored.model_dump_json(by_alias=True) + "\n").encode())


def forget_failures(dataset: Path, source: RecordingSource) -> None:
    """Remove what is kept of a recording that was added.

    Args:
        dataset: Folder of the dataset.
        source: The recording.
    """
    for path in dataset.glob(f"failures/{path_digest(source.path)}-*.json"):
        path.unlink(missing_ok=True)


def stored_failures(dataset: Path) -> list[StoredFailure]:
    """List the failures of a dataset.

    Args:
        dataset: Its folder.

    Returns:
        The failures, sorted by file.
    """
    failures = [
        read_stored_table(path, StoredFailure, expected="a failure") for path in dataset.glob("failures/*.json")
    ]
    return sorted(failures, key=lambda failure: (failure.file, failure.error))


class AddedSensor(Row):
    """One sensor of one recording."""

    file: Annotated[str, Shown("experiment", file=True)]
    """Experiment file."""
    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor."""
    serial: Annotated[str, Shown("serial")]
    """Its serial number."""
    state: Annotated[Literal["added", "present"], Shown("state")]
    """Whether it was added now, or was in the dataset already."""


class Added(Result):
    """What was added to a dataset."""

    schema_name: Literal["forcetorque/fleet_add/1"] = Field(default="forcetorque/fleet_add/1", alias="schema")
    """Form of the result."""
    dataset: str
    """Folder of the dataset."""
    sensors: tuple[AddedSensor, ...]
    """One per recording and sensor."""

    def answers(self) -> Iterator[Answer]:
        """Count what was added.

        Yields:
            One answer.
        """
        added = sum(row.state == "added" for row in self.sensors)
        present = len(self.sensors) - added
        recordings = len({row.file for row in self.sensors})
        sensors = len({row.serial for row in self.sensors})
        yield Answer(
            subject=f"{self.dataset}: {counted(recordings, 'recording')} of {counted(sensors, 'sensor')}",
            verdict=f"{added} ADDED, {present} ALREADY THERE" if present else f"{added} ADDED",
            why=("nothing was changed; the same inputs, options and version were added before",) if not added else (),
            step="show the sensors, the worst first",
            command=typed("fleet", "table", self.dataset),
        )

    def blocks(self) -> Iterator[Table]:
        """List what was added.

        Yields:
            A table.
        """
        yield table_of(self.sensors, f"{self.dataset}: recordings and sensors")


def add_recordings(
    experiments: Sequence[Path],
    dataset: Path,
    options: AddOptions,
    *,
    replace: bool = False,
    progress: Progress = lambda _: None,
) -> Added:
    """Add recordings to a dataset.

    Args:
        experiments: Experiment files, at least one.
        dataset: Folder of the dataset, which is made where it is missing.
        options: What is kept of each.
        replace: Whether a recording that changed after it was added takes the place of what was added.
        progress: Called with a line for people as recordings are added.

    Returns:
        What was added and what was there.

    Raises:
        ExperimentError: If no experiment is named.
    """
    if not experiments:
        raise ExperimentError("expected at least one experiment file to add, got none")
    require_folder(dataset)
    left = TimeLeft(progress, "adding", len(experiments))
    rows: list[AddedSensor] = []
    for number, file in enumerate(experiments):
        source = RecordingSource(experiment=file)
        rows += add_recording(source, dataset, options, replace=replace, progress=progress)
        left.at(number + 1)
    return Added(dataset=str(dataset), sensors=tuple(rows))


def add_recording(
    source: RecordingSource,
    folder: Path,
    options: AddOptions,
    *,
    replace: bool = False,
    progress: Progress = lambda _: None,
) -> list[AddedSensor]:
    """Add one recording to a dataset.

    Args:
        source: The recording.
        folder: As of `add_recordings`.
        options: As of `add_recordings`.
        replace: As of `add_recordings`.
        progress: Called with the time that is left, of a long recording.

    Returns:
        A row per sensor.
    """
    rows = _added(source, Dataset(folder), options, replace=replace, progress=progress)
    forget_failures(folder, source)
    return rows


def _added(
    source: RecordingSource, dataset: Dataset, options: AddOptions, *, replace: bool, progress: Progress
) -> list[AddedSensor]:
    code_version = version("forcetorque")
    if (unchanged := _unchanged(source, dataset, options.digest(code_version))) is not None:
        return unchanged
    experiment = source.load()
    digest, wanted = recording_digest(experiment)[:20], options.digest(code_version)
    own = dataset.of_path(path_digest(source.path))
    there = {sensor.serial: dataset.present(sensor.serial) for sensor in experiment.sensors}
    for sensor in experiment.sensors:
        others = [one for one in there[sensor.serial] if not (replace and one in own)]
        with stated_in(str(source.path)):
            sensor.require_six_components("a dataset")
        _refuse_other_robot(source, experiment, sensor, others, options)
    changed = [one for one in own if one.recording != digest]
    if not replace:
        _refuse_changed(source, experiment, dataset, changed)
    present = {
        serial: any((one.recording, one.options) == (digest, wanted) for one in files)
        for serial, files in there.items()
    }
    # what the recording gave before, and results of other options or versions, which the new ones replace
    earlier = {*changed, *(one for files in there.values() for one in files if one.recording == digest), *own}
    replaced = [one for one in sorted(earlier) if (one.recording, one.options) != (digest, wanted)]
    for one in replaced:
        with suppress(MissingFileError):  # another process replaced it meanwhile
            dataset.rows([one], ["code_version"])  # refuses one of a newer form, which this version cannot replace
    if not all(present.values()):
        for number, record in enumerate(sensor_records(experiment, options, code_version, progress=progress)):
            if not number:
                _refuse_changing(experiment, source)
            if source.address is not None:
                record = record.model_copy(update={"file": source.address})
            if not present[record.identity.serial]:
                dataset.write(record, options)
    for one in replaced:
        (dataset.folder / one.path).unlink(missing_ok=True)
    return [
        AddedSensor(
            file=str(source.path),
            sensor=sensor.name,
            serial=sensor.serial,
            state="present" if present[sensor.serial] else "added",
        )
        for sensor in experiment.sensors
    ]


def _unchanged(source: RecordingSource, dataset: Dataset, wanted: str) -> list[AddedSensor] | None:
    """Rows of a recording all of whose sensors are there, if no input changed since; None if it must be read."""
    files = [one for one in dataset.of_path(path_digest(source.path)) if one.options == wanted]
    rows = dataset.rows(files, ["identity", "sensors", "inputs_sha256"])
    if not rows or len(rows) != rows[0]["sensors"] or len({file.recording for file in files}) != 1:
        return None
    written_ns = min((dataset.folder / file.path).stat().st_mtime_ns for file in files)
    # a new file in a folder that is a log may belong to it
    if (
        source.address is not None
        or source.changed(rows[0]["inputs_sha256"])
        or any(one.stat().st_mtime_ns > written_ns for one in source.log_folders())
    ):
        return None
    return [
        AddedSensor(file=str(source.path), sensor=name, serial=serial, state="present")
        for name, serial in ((row["identity"]["name"], row["identity"]["serial"]) for row in rows)
    ]


def _refuse_changing(experiment: Experiment, source: RecordingSource) -> None:
    """Refuse a recording that was written to while it was read."""
    changed = source.changed(experiment.inputs_sha256)
    if changed:
        raise ChangingFileError(
            f"{source.path}: expected inputs that do not change while they are read, got {', '.join(changed)}, which "
            "did; add the recording when its log is complete"
        )


def _refuse_other_robot(
    source: RecordingSource,
    experiment: Experiment,
    sensor: ExperimentSensor,
    there: Sequence[RecordFile],
    options: AddOptions,
) -> None:
    robot = options.robot or experiment.model.name
    other = next((one.robot for one in there if one.robot != robot), None)
    if other is not None:
        raise ExperimentError(
            f"{source.path}: sensor {sensor.name!r}: expected a serial number that no other robot has, got "
            f"{sensor.serial!r}, "
            f"which the dataset has of robot {other!r}, here it is of {robot!r}; correct serial in [[sensor]], name "
            "the robot with --robot, or, where this recording itself was added with another, put it right by --replace"
        )


def _refuse_changed(
    source: RecordingSource, experiment: Experiment, dataset: Dataset, changed: Sequence[RecordFile]
) -> None:
    for earlier in changed:
        before = dataset.rows([earlier], ["inputs_sha256"])[0]["inputs_sha256"]
        now = experiment.inputs_sha256
        names = sorted(name for name in before.keys() | now.keys() if before.get(name) != now.get(name))
        raise ExperimentError(
            f"{source.path}: changed after it was added to {dataset.folder}: {', '.join(names)}; --replace "
            "puts what it is now in the place of what was added"
        )
