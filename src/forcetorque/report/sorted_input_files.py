# SPDX-License-Identifier: BSD-3-Clause
"""Files of any kind, sorted by the schema that they state."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import forcetorque
from forcetorque.base.errors import ExperimentError, FormatError, MissingFileError
from forcetorque.base.run_files import declare_input
from forcetorque.base.toml_file import toml_content
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile, read_acceptance
from forcetorque.experiment.applicability import calibrations_of
from forcetorque.experiment.calibration.calibration_file import Calibration, calibrations_in, read_calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.results.result import result_classes

_KINDS = "an experiment file, a calibration, an acceptance file or the JSON result of a command"

_NOT_DRAWN = {"report", "view"}
"""Results that a report does not show: itself, and the page of the viewer."""


def sort_sources(
    paths: Sequence[Path],
) -> tuple[list[Path], dict[str, Calibration], AcceptanceFile | None, dict[str, dict[str, Any]]]:
    """Sort files by the schema that they state.

    Args:
        paths: The files, and folders of calibrations.

    Returns:
        Experiment files, at least one; calibrations by name of their file; limits, if there are any; results of other
        commands by name of their file.

    Raises:
        MissingFileError: If one does not exist.
        FormatError: If one states no schema that a report knows, if there is no experiment file, or there are two
            acceptance files.
    """
    experiments: list[Path] = []
    calibrations: dict[str, Calibration] = {}
    acceptance: list[AcceptanceFile] = []
    results: dict[str, dict[str, Any]] = {}
    for path in dict.fromkeys(paths):
        if path.is_dir():
            calibrations |= calibrations_in(path)
            continue
        content = _content(path)
        match str(content.get("schema")).split("/")[:2]:
            case ["forcetorque", "experiment"]:
                experiments.append(path)
            case ["forcetorque", "acceptance"]:
                acceptance.append(read_acceptance(path))
            case ["forcetorque", "calibration"]:
                calibrations[str(path)] = read_calibration(path)
            case ["forcetorque", kind] if kind in result_classes(forcetorque).keys() - _NOT_DRAWN:
                results[str(path)] = content
            case _:
                raise FormatError(f"{path}: expected {_KINDS}, got the schema {content.get('schema')!r}")
    if not experiments:
        got = ", a folder gives its calibrations alone" if any(path.is_dir() for path in paths) else ""
        raise FormatError(f"report: expected an experiment file among the files, its samples are drawn; got none{got}")
    if len(acceptance) > 1:
        raise FormatError(f"report: expected one acceptance file, got {len(acceptance)}")
    return experiments, calibrations, acceptance[0] if acceptance else None, results


def assign_calibrations(
    experiments: Sequence[Experiment], calibrations: Mapping[str, Calibration]
) -> list[dict[str, dict[str, Calibration]]]:
    """Find the sensors that calibrations are of, by name and serial number: robots share names.

    Args:
        experiments: The experiments.
        calibrations: Calibrations by name of their file.

    Returns:
        For every experiment the calibrations of its sensors, by sensor and name.

    Raises:
        ExperimentError: If a calibration is of no sensor of any experiment.
    """
    assigned = [
        {sensor.name: calibrations_of(experiment, sensor, calibrations) for sensor in experiment.sensors}
        for experiment in experiments
    ]
    used = {file for own in assigned for group in own.values() for file in group}
    for file, calibration in calibrations.items():
        if file not in used:
            sensors = (sensor for experiment in experiments for sensor in experiment.sensors)
            known = sorted({f"{sensor.name} ({sensor.serial})" for sensor in sensors})
            raise ExperimentError(
                f"{file}: calibrates {calibration.sensor.name} ({calibration.sensor.serial}), which none of the "
                f"experiments has; they have {', '.join(known)}"
            )
    return [{name: group for name, group in own.items() if group} for own in assigned]


def _content(path: Path) -> dict[str, Any]:
    if not path.is_file():
        raise MissingFileError(f"{path}: expected a file to report on, there is none")
    if path.suffix not in (".toml", ".json"):  # so that no calibration is called as priors are in the tables
        raise FormatError(f"{path}: expected {_KINDS}, whose names end in .toml or .json")
    try:
        content = toml_content(path)[1] if path.suffix == ".toml" else _json(path)
    except ValueError as error:  # also what is no UTF-8, no TOML or no JSON
        raise FormatError(f"{path}: expected {_KINDS}: {error}") from error
    if not isinstance(content, dict):
        raise FormatError(f"{path}: expected {_KINDS}, got a {type(content).__name__}")
    return content


def _json(path: Path) -> Any:
    declare_input(path)
    return json.loads(path.read_text(encoding="utf-8"))
