# SPDX-License-Identifier: BSD-3-Clause
"""What is shown, an experiment or the experiment and calibrations of a report, and where."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import BaseModel, Field, ValidationError

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError
from forcetorque.base.run_files import declare_input
from forcetorque.results.result import Result
from forcetorque.results.table import Table
from forcetorque.viewer.build import BuiltScene


class View(Result):
    """An experiment as the viewer shows it."""

    schema_name: Literal["forcetorque/view/1"] = Field(default="forcetorque/view/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    sensors: tuple[str, ...]
    """Sensors that are shown."""
    skin: tuple[str, ...] = ()
    """Patches of skin, and streams of contacts that a skinManager saw, that are shown."""
    samples: int
    """Number of samples."""
    url: str | None
    """Address of the page while it is served; null otherwise."""
    file: str | None
    """File of the page, where one was written."""
    file_bytes: int | None
    """Its size."""
    video: str | None
    """File of the video, where one was written."""
    video_frames: int | None
    """Its number of frames."""
    notes: tuple[str, ...]
    """What is absent, and why."""

    @classmethod
    def of(cls, built: BuiltScene) -> Self:
        """Say what a scene shows, before it is shown anywhere.

        Args:
            built: The scene.

        Returns:
            The view, without address and files.
        """
        return cls(
            experiment=built.scene.title,
            sensors=tuple(sensor.name for sensor in built.scene.sensors if sensor.acting is not None),
            skin=(*(one.name for one in built.scene.skin), *(one.name for one in built.scene.skin_events)),
            samples=built.scene.samples,
            url=None,
            file=None,
            file_bytes=None,
            video=None,
            video_frames=None,
            notes=tuple(built.scene.notes),
        )

    def blocks(self) -> Iterator[Table | str]:
        """Say what is shown, and where.

        Yields:
            Sentences.
        """
        yield f"{self.experiment}: {self.samples} samples of {', '.join((*self.sensors, *self.skin))}"
        if self.file is not None and self.file_bytes is not None:
            yield f"page of {self.file_bytes / 1e6:.1f} MB written to {self.file}"
        if self.video is not None:
            yield f"video of {self.video_frames} frames written to {self.video}"
        if self.url is not None:
            yield f"open {self.url}"

    def records(self) -> list[dict[str, object]]:
        """Give one line.

        Returns:
            What is single.
        """
        several = ("schema", "sensors", "skin", "notes")
        return [{name: value for name, value in self.flat().items() if name not in several}]


class _Sensor(BaseModel):
    calibrations: dict[str, Any]


class _Experiment(BaseModel):
    file: str
    sensors: tuple[_Sensor, ...]


class _Numbers(BaseModel):
    """Of the numbers of a report, those that say what it was made from."""

    schema_name: Literal["forcetorque/report/1"] = Field(alias="schema")
    experiments: tuple[_Experiment, ...]


def view_source(path: Path, calibrations: Sequence[Path] = ()) -> tuple[Path, list[Path]]:
    """Find the experiment to view and the calibrations to read its sensors by.

    Args:
        path: Experiment file, or the numbers of a report, whose paths are meant from the working folder, as they were
            when it was made.
        calibrations: Calibration files beside those of the report.

    Returns:
        Experiment file and calibration files.

    Raises:
        ForceTorqueError: If it is a table, or a report of several experiments.
        FormatError: If it is JSON and no report.
        MissingFileError: If it does not exist, or a file of the report is no longer there.
    """
    if path.suffix in (".parquet", ".csv"):
        raise ForceTorqueError(
            f"{path}: expected an experiment file or the numbers of a report, got a table of results, which holds no "
            "robot and no motion; view the experiment that it was made from"
        )
    if path.suffix != ".json":
        return path, list(calibrations)
    if not path.is_file():
        raise MissingFileError(f"{path}: expected the numbers of a report, there is none")
    numbers = _read(path)
    files = [experiment.file for experiment in numbers.experiments]
    if len(files) != 1:
        raise ForceTorqueError(f"{path}: expected a report of one experiment, got {', '.join(files)}; view one of them")
    used = [Path(file) for sensor in numbers.experiments[0].sensors for file in sensor.calibrations]
    for file in (Path(files[0]), *used):
        if not file.is_file():
            raise MissingFileError(f"{path}: {file}: expected the file that the report was made from, there is none")
    return Path(files[0]), list(dict.fromkeys([*used, *calibrations]))


def _read(path: Path) -> _Numbers:
    declare_input(path)
    try:
        return _Numbers.model_validate_json(path.read_bytes())
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(key) for key in first["loc"]) or "content"
        raise FormatError(f"{path}: expected the numbers of a report: {where}: {first['msg']}") from error
