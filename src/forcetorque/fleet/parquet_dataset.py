# SPDX-License-Identifier: BSD-3-Clause
"""A dataset: Parquet files in folders robot=/sensor=/date=, one per sensor and recording, named by what they are of.

A file is written under a temporary name and renamed, and its name is a hash of inputs, options and version. So any
number of processes may add to one dataset without a lock, a killed one leaves nothing that is read, and the same
recording has the same name whoever adds it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import IO, Any, Final, Self
from urllib.parse import quote, unquote

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from forcetorque.base.arrow import require_small_parquet
from forcetorque.base.errors import ExperimentError, FormatError, MissingFileError, OutputError, known_names
from forcetorque.base.output_file import temporary_beside
from forcetorque.base.rows_on_disk import forget_pages
from forcetorque.base.run_files import declare_input
from forcetorque.base.stored_table import validated_table
from forcetorque.experiment.calibration.moment_blocks import joined
from forcetorque.experiment.calibration.provenance import Content, SensorIdentity, readings_twice
from forcetorque.experiment.calibration.stored_moments import RecordingMoments
from forcetorque.experiment.named_files import distinct_files, recording_name
from forcetorque.fleet.parquet_columns import columns_of, rows_of, schema_of
from forcetorque.fleet.sensor_record import SCHEMA, AddOptions, SensorRecord, path_digest

_NAME: Final = re.compile(r"(?P<path>[0-9a-f]{12})-(?P<recording>[0-9a-f]{20})-(?P<options>[0-9a-f]{8})\.parquet")
_METADATA: Final = (("schema", SCHEMA),)
_READ: Final = (SCHEMA, "forcetorque/dataset/1")
"""Forms that are read: in the first, a file has one row however long the recording is."""
_ROW_WINDOWS: Final = 1800
"""Windows of a second in the blocks of one row: half an hour, since a row is written from memory as a whole."""


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class RecordFile:
    """File of one sensor in one recording."""

    robot: str
    """Name of the robot."""
    serial: str
    """Serial number of the sensor."""
    date: str
    """Day of the recording."""
    recording: str
    """First 20 digits of the recording's hash."""
    options: str
    """Hash of options and version."""
    path_hash: str
    """Hash of the path of the experiment file."""

    @classmethod
    def of(cls, record: SensorRecord, options: AddOptions) -> Self:
        """Name the file of a record.

        Args:
            record: The record.
            options: How it was made.

        Returns:
            Its file.
        """
        return cls(
            robot=options.robot or record.identity.robot,
            serial=record.identity.serial,
            date=record.date,
            recording=record.recording[:20],
            options=options.digest(record.code_version),
            path_hash=path_digest(record.file),
        )

    @classmethod
    def read(cls, path: Path) -> Self | None:
        """Understand the name of a file.

        Args:
            path: The file in its folders.

        Returns:
            What it is of; None where the name is of another form.
        """
        match = _NAME.fullmatch(path.name)
        folders = [folder.name.partition("=") for folder in reversed(path.parents[:3])]
        if match is None or [key for key, _, _ in folders] != ["robot", "sensor", "date"]:
            return None
        robot, serial, date = (unquote(value) for _, _, value in folders)
        return cls(
            robot=robot,
            serial=serial,
            date=date,
            recording=match["recording"],
            options=match["options"],
            path_hash=match["path"],
        )

    @property
    def path(self) -> Path:
        """Path from the folder of the dataset."""
        robot, serial = quote(self.robot, safe=" "), quote(self.serial, safe=" ")
        name = f"{self.path_hash}-{self.recording}-{self.options}.parquet"
        return Path(f"robot={robot}") / f"sensor={serial}" / f"date={self.date}" / name


def is_dataset(path: Path) -> bool:
    """Tell whether a path is the folder of a dataset.

    Args:
        path: Any path.

    Returns:
        Whether it is.
    """
    return path.is_dir() and any(path.glob("robot=*/sensor=*"))


def require_folder(path: Path) -> None:
    """Refuse a path for a dataset at which there is a file.

    Args:
        path: Folder of a dataset, there or not.

    Raises:
        OutputError: If it is a file.
    """
    if path.exists() and not path.is_dir():
        raise OutputError(f"{path}: expected a folder for the dataset, got a file; choose another name")


@dataclass(frozen=True)
class Dataset:
    """The files of a dataset."""

    folder: Path
    """Its folder."""

    @classmethod
    def opened(cls, folder: Path | str) -> Self:
        """Open a dataset that is there.

        Args:
            folder: Its folder.

        Returns:
            The dataset.

        Raises:
            MissingFileError: If there is none.
        """
        if not is_dataset(Path(folder)):
            raise MissingFileError(
                f"{folder}: expected a dataset, there is none; a dataset is a folder with robot=.../sensor=..., which "
                "`forcetorque fleet add EXPERIMENT --into FOLDER` makes"
            )
        return cls(Path(folder))

    def present(self, serial: str | None = None) -> list[RecordFile]:
        """List the files that are there now.

        Args:
            serial: Serial number of the sensor; None for all sensors.

        Returns:
            The files, sorted.
        """
        sensor = "*" if serial is None else quote(serial, safe=" ").translate({ord(c): f"[{c}]" for c in "[*?"})
        found = (RecordFile.read(path) for path in self.folder.glob(f"robot=*/sensor={sensor}/date=*/*.parquet"))
        return sorted(file for file in found if file is not None)

    def of_path(self, path_hash: str) -> list[RecordFile]:
        """List the files of one experiment file or log that are there now.

        Args:
            path_hash: Hash of its path.

        Returns:
            The files, sorted.
        """
        found = (RecordFile.read(path) for path in self.folder.glob(f"robot=*/sensor=*/date=*/{path_hash}-*.parquet"))
        return sorted(file for file in found if file is not None)

    @cached_property
    def files(self) -> tuple[RecordFile, ...]:
        """Files that count: one per sensor and recording, of several versions that of the newest library.

        Listed once, so that all that is computed from one dataset is of the same files.
        """
        chosen: dict[tuple[str, str], RecordFile] = {}
        for file in self.present():
            key = (file.serial, file.recording)
            chosen[key] = max(chosen.get(key, file), file, key=self._age) if key in chosen else file
        return tuple(chosen.values())

    def _age(self, file: RecordFile) -> tuple[list[int], RecordFile]:
        row = self.rows([file], ["code_version"])[0]
        return [int(number) for number in re.findall(r"\d+", row["code_version"])], file

    @property
    def recordings(self) -> int:
        """Number of recordings."""
        return len({file.recording for file in self.files})

    @property
    def serials(self) -> dict[str, str]:
        """Serial number of every sensor, and its robot."""
        return {file.serial: file.robot for file in self.files}

    def of_sensor(self, sensor: str) -> list[RecordFile]:
        """Find the files of a sensor.

        Args:
            sensor: Serial number, or a name that only one sensor of the dataset has.

        Returns:
            Its files.

        Raises:
            ExperimentError: If there is no such sensor, the name is of several, or two robots have one of that serial
                number.
        """
        own = [file for file in self.files if file.serial == sensor]
        if not own:
            own = self._named(sensor)
        robots = sorted({file.robot for file in own})
        if len(robots) > 1:
            raise ExperimentError(
                f"{self.folder}: expected the sensor with the serial number {sensor!r} on one robot, got it on "
                f"{' and '.join(robots)}; correct serial in [[sensor]] of the one that is wrong and add it again, or "
                "keep the robots in datasets of their own"
            )
        return own

    def identity(self, sensor: str) -> SensorIdentity:
        """Say which sensor it is.

        Args:
            sensor: As of `of_sensor`.

        Returns:
            The sensor as its last file has it.
        """
        values = self.rows([self.of_sensor(sensor)[-1]], ["identity"])[0]["identity"]
        return SensorIdentity.model_validate(values)

    def _named(self, name: str) -> list[RecordFile]:
        names = {file.serial: self.rows([file], ["identity"])[0]["identity"]["name"] for file in self.files}
        serials = [serial for serial, own in names.items() if own == name]
        if len(serials) == 1:
            return [file for file in self.files if file.serial == serials[0]]
        if serials:
            raise ExperimentError(
                f"{self.folder}: {len(serials)} sensors are called {name!r}; name one by its serial number: "
                f"{', '.join(serials[:5])}{' ...' if len(serials) > 5 else ''}"
            )
        raise ExperimentError(f"{self.folder}: no sensor has the serial number {name!r}; {known_names(name, names)}")

    def rows(self, files: Collection[RecordFile], columns: Sequence[str]) -> list[dict[str, Any]]:
        """Read some columns of files.

        Args:
            files: The files.
            columns: Names of columns.

        Returns:
            Values by column, a dictionary per file.
        """
        return [self._row(self.folder / file.path, columns) for file in files]

    def _row(self, path: Path, columns: Sequence[str]) -> dict[str, Any]:
        declare_input(path)
        try:
            with pq.ParquetFile(path) as parquet:
                _require_version(path, parquet.schema_arrow.metadata or {})
                require_small_parquet(path, parquet.metadata, parquet.schema.names)
                # rows after the first have only blocks of moments
                groups = range(parquet.num_row_groups if "moments" in columns else 1)
                row = _one_record(
                    [
                        row
                        for group in groups
                        for row in rows_of(SensorRecord, parquet.read_row_group(group, columns=list(columns)))
                    ]
                )
        except FileNotFoundError:
            raise MissingFileError(f"{path}: expected a file of the dataset, it was removed meanwhile") from None
        except (pa.ArrowException, ValueError, KeyError, TypeError, OSError) as error:
            if isinstance(error, FormatError):
                raise
            words = " ".join(str(error).split())
            raise FormatError(
                f"{path}: expected a file of the form {SCHEMA}, got {words}; remove it and add again"
            ) from error
        return row

    def records(self, files: Collection[RecordFile]) -> list[SensorRecord]:
        """Read files as a whole.

        Args:
            files: The files.

        Returns:
            Their records in the order of time: the same whatever the order in which they were added.
        """
        names = schema_of(SensorRecord).names
        made = [
            validated_table(self.folder / file.path, SensorRecord, self._row(self.folder / file.path, names))
            for file in files
        ]
        return sorted(made, key=lambda record: (record.start_ns, record.recording))

    def moments(self, records: Sequence[SensorRecord]) -> tuple[list[RecordingMoments], tuple[str, ...]]:
        """Give what a calibration needs of recordings of one sensor, under names that tell them apart.

        Args:
            records: Records of one sensor, in the order of time.

        Returns:
            Moments of those that have calibration intervals and no readings of a longer one, and a message for every
            recording that has: it is left out.

        Raises:
            ExperimentError: If none has any.
        """
        names = RecordingNames(records)
        copies = names.copies_in_fit()
        found = [
            names.named(record, record.moments)
            for record in records
            if record.moments is not None and names.recording(record) not in copies
        ]
        if not found:
            logs = ", ".join(record.file for record in records[:3])
            raise ExperimentError(f'{self.folder}: expected an interval with use = "calibration", got none in {logs}')
        return found, tuple(copies.values())

    def write(self, record: SensorRecord, options: AddOptions) -> Path:
        """Write a record to its file; readers see all of it or nothing.

        Args:
            record: The record.
            options: How it was made.

        Returns:
            The file.

        Raises:
            OutputError: If it cannot be written, such as on a full disk; nothing is left of it then.
        """
        target = self.folder / RecordFile.of(record, options).path
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            with temporary_beside(target) as temporary:
                with temporary.open("wb") as stream:
                    _write_rows(stream, record)
                    stream.flush()
                    # otherwise a power cut after the rename can leave an empty file
                    os.fsync(stream.fileno())
                temporary.replace(target)
        except OSError as error:
            raise OutputError(
                f"{target}: expected to write the file, got {error.strerror or error}; nothing was added; free space "
                "there, and add the recording again"
            ) from error
        return target


def _one_record(rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Columns of a record whose further blocks are in the rows after the first."""
    record, *others = rows
    for other in others:
        if any(value for name, value in other.items() if name not in ("recording", "moments")):
            raise ValueError("rows of several recordings")
        if "moments" in other:
            record["moments"]["intervals"] += other["moments"]["intervals"]
    return record


def _write_rows(stream: IO[bytes], record: SensorRecord) -> None:
    """Write a record row by row, each a row group, so that what is written does not fill the memory."""
    schema = schema_of(SensorRecord, _METADATA)
    # a dictionary of numbers that do not repeat takes time and twenty times their memory
    with pq.ParquetWriter(stream, schema, compression="zstd", use_dictionary=False) as writer:
        for row in _rows(record):
            writer.write_table(columns_of(SensorRecord, [row], _METADATA))
            if row.moments is not None:
                forget_pages(block.model for block in row.moments.intervals if block.model is not None)


def _rows(record: SensorRecord) -> Iterator[SensorRecord]:
    """A record as rows: the first has all but further blocks of moments, the others have these and the recording."""
    if record.moments is None:
        yield record
        return
    blocks = record.moments.intervals
    row_numbers = (np.cumsum([len(block.time_s) for block in blocks]) - 1) // _ROW_WINDOWS
    starts = np.flatnonzero(np.diff(row_numbers, prepend=-1)).tolist()
    moments, row = record.moments, record
    for first, last in zip(starts, [*starts[1:], len(blocks)], strict=True):
        yield row.model_copy(update={"moments": moments.model_copy(update={"intervals": blocks[first:last]})})
        moments = RecordingMoments.model_construct(**dict.fromkeys(RecordingMoments.model_fields))
        row = SensorRecord.model_construct(**dict.fromkeys(SensorRecord.model_fields) | {"recording": record.recording})


def _require_version(path: Path, metadata: Mapping[bytes, bytes]) -> None:
    got = metadata.get(b"schema", b"").decode(errors="replace")
    if got in _READ:
        return
    family, _, version = got.rpartition("/")
    own_family, _, own = SCHEMA.rpartition("/")
    if family == own_family and version.isdigit() and int(version) > int(own):
        raise FormatError(
            f"{path}: expected a dataset of the form {SCHEMA} or earlier, got {got}, of a newer version of "
            "forcetorque; install that version"
        )
    raise FormatError(f"{path}: expected a file of the form {SCHEMA}, got {got or 'another Parquet file'}")


class RecordingNames:
    """Names that tell recordings of one sensor, their sessions and intervals apart, as those of a campaign."""

    def __init__(self, records: Sequence[SensorRecord]) -> None:
        """Name recordings.

        Args:
            records: Records of one sensor.
        """
        self._records = records
        endings = distinct_files([Path(record.file) for record in records])
        experiments = [record.experiment for record in records]
        sessions = {
            record.recording: {one.interval.session for one in record.moments.intervals} - {record.experiment}
            for record in records
            if record.moments is not None
        }
        labels = [label for record in records for label in _labels(record)]
        self._recordings, self._labels = {}, {}
        for record in records:
            ending = endings[Path(record.file)]
            elsewhere = {name for key, own in sessions.items() if key != record.recording for name in own}
            clash = experiments.count(record.experiment) > 1 or record.experiment in elsewhere
            name = recording_name(record.experiment, ending) if clash else record.experiment
            self._recordings[record.recording] = name
            self._labels[record.recording] = {
                label: label if labels.count(label) == 1 else f"{ending}/{label}" for label in _labels(record)
            }

    def recording(self, record: SensorRecord) -> str:
        """Name a recording.

        Args:
            record: Its record.

        Returns:
            Its name.
        """
        return self._recordings[record.recording]

    def copies_in_fit(self) -> dict[str, str]:
        """Find recordings whose calibration intervals have readings of a longer recording.

        Returns:
            By name of each a message that names the longer one and says that it is left out.
        """
        return _copies(
            (self.recording(record), one.samples, one.interval.content)
            for record in self._records
            if record.moments is not None
            for one in record.moments.intervals
        )

    def copies_in_evaluation(self) -> dict[str, str]:
        """Find recordings whose validation intervals have readings of a longer recording.

        Returns:
            By name of each a message that names the longer one and says that it is left out.
        """
        return _copies(
            (self.recording(record), samples, content)
            for record in self._records
            if record.evaluation is not None
            for samples, content in record.evaluation.contents()
        )

    def copies(self) -> tuple[str, ...]:
        """Name recordings that are left out of fit or evaluation.

        Returns:
            Every message once.
        """
        return tuple(dict.fromkeys((*self.copies_in_fit().values(), *self.copies_in_evaluation().values())))

    def named(self, record: SensorRecord, moments: RecordingMoments) -> RecordingMoments:
        """Put blocks of a recording together, under the names of this recording and its intervals.

        Args:
            record: The record.
            moments: Its moments, in blocks.

        Returns:
            The moments of whole intervals.
        """
        recording, labels = self.recording(record), self._labels[record.recording]
        made = []
        for interval in joined(moments.intervals):
            stated = interval.interval
            session = recording if stated.session == interval.recording else stated.session
            fitted = stated.model_copy(update={"label": labels[stated.label], "session": session})
            made.append(interval.model_copy(update={"interval": fitted, "recording": recording}))
        return moments.model_copy(update={"intervals": tuple(made)})


def _labels(record: SensorRecord) -> Iterator[str]:
    """Labels of fitted and evaluated intervals, each once."""
    fitted = () if record.moments is None else (one.interval.label for one in record.moments.intervals)
    evaluated = () if record.evaluation is None else (one.label for one in record.evaluation.intervals)
    yield from dict.fromkeys((*fitted, *evaluated))


def _copies(contents: Iterable[tuple[str, float, Content | None]]) -> dict[str, str]:
    return {name: one.left_out for name, one in readings_twice(contents).items()}
