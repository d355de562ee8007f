# SPDX-License-Identifier: BSD-3-Clause
"""What is viewed: an experiment, or the experiment and the calibrations of a report."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, Field, ValidationError

from forcetorque.errors import ForceTorqueError, FormatError, MissingFileError
from forcetorque.run_files import declare_input


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
