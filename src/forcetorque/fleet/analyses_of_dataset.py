# SPDX-License-Identifier: BSD-3-Clause
"""What commands do with a dataset in place of experiment files, and what they refuse because it needs samples."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

from forcetorque.base.errors import ExperimentError, ForceTorqueError, MissingFileError
from forcetorque.base.output_file import declare_outputs
from forcetorque.calibration.calibrate import SensorCalibrations, calibrate_for_file
from forcetorque.calibration.commands import calibration_files
from forcetorque.experiment.calibration.stored_moments import RecordingMoments
from forcetorque.experiment.named_files import stated_in
from forcetorque.fleet.evaluate import evaluate_dataset
from forcetorque.fleet.parquet_dataset import Dataset
from forcetorque.results.result import created_now
from forcetorque.results.terminal.command_inputs import read_calibrations
from forcetorque.results.terminal.command_output import (
    drawn_to,
    end_with,
    refuse_figure,
    refuse_standard_output,
    show,
    start_logging,
)

_MOST_LOGS: Final = 3
"""Logs that a refusal names."""


def calibrate_sensors(
    dataset: Dataset,
    sensors: Sequence[str],
    files: Sequence[Path],
    *,
    code_version: str,
    created: str,
    nonlinear: bool | None = None,
) -> tuple[list[SensorCalibrations], list[ForceTorqueError]]:
    """Fit sensors from the moments of a dataset.

    Args:
        dataset: The dataset.
        sensors: Serial numbers or names.
        files: File that `save` of each calibration writes.
        code_version: As of `calibrate_sensor`.
        created: As of `calibrate_sensor`.
        nonlinear: As of `calibrate_sensor`.

    Returns:
        The calibrations of those that could be fitted, and the errors of the others.
    """
    results, refusals = [], []
    for sensor, file in zip(sensors, files, strict=True):
        try:
            with stated_in(f"{dataset.folder}: sensor {sensor!r}"):
                moments, warnings, left_out = _moments(dataset, sensor)
                made = calibrate_for_file(
                    None,
                    file,
                    code_version=code_version,
                    created=created,
                    moments=moments,
                    nonlinear=nonlinear,
                )
                others = [text for text in made.warnings if text not in warnings]
                results.append(made.model_copy(update={"warnings": (*left_out, *warnings, *others)}))
        except ForceTorqueError as error:
            refusals.append(error)
    return results, refusals


def _moments(dataset: Dataset, sensor: str) -> tuple[list[RecordingMoments], list[str], tuple[str, ...]]:
    """Moments of a sensor without the records that they were in, warnings of these, each once, and what is left out."""
    records = dataset.records(dataset.of_sensor(sensor))
    warnings = list(dict.fromkeys(text for record in records for text in record.warnings))
    moments, left_out = dataset.moments(records)
    return moments, warnings, left_out


def _calibrate(dataset: Dataset, given: Mapping[str, Any]) -> None:
    """The command `calibrate` with a dataset in place of experiment files."""
    log = start_logging()
    refuse_standard_output("--output", given["output"])
    for option, name in (
        ("--lambda", "regularisation"),
        ("--type", "kind"),
        ("--jointly", "jointly"),
        ("--moments", "moments"),
        ("--write-urdf", "write_urdf"),
    ):
        if given[name] and given[name] != "generative":
            raise ExperimentError(f"{option}: {needs_samples(dataset, given['sensor'] or ())}")
    refuse_figure(given["figure"], force=given["force"])
    sensors = list(dict.fromkeys(given["sensor"] or dataset.serials))
    names = [dataset.identity(sensor) for sensor in sensors]
    files = calibration_files(given["output"], [(one.name, one.serial) for one in names])
    declare_outputs(*filter(Path.exists, files), force=given["force"])
    log.info("fitting %d sensor(s) of %s", len(sensors), dataset.folder)
    results, refusals = calibrate_sensors(
        dataset,
        sensors,
        files,
        code_version=version("forcetorque"),
        created=created_now(),
        nonlinear=given["nonlinear"],
    )
    if results:
        result = SensorCalibrations.together(results).save(force=given["force"])
        if given["figure"] is not None:
            result = drawn_to(result, given["figure"])
        show(result, given["output_format"], details=given["details"], experiments=[dataset.folder])
    end_with(refusals)


def _evaluate(dataset: Dataset, given: Mapping[str, Any]) -> None:
    """The command `evaluate` with a dataset in place of experiment files."""
    start_logging()
    refuse_figure(given["figure"])
    result = evaluate_dataset(dataset, read_calibrations(given["calibration"], given["sensor"]))
    if given["figure"] is not None:
        result = drawn_to(result, given["figure"])
    show(result, given["output_format"], details=given["details"], experiments=[dataset.folder])


COMMANDS: Final[Mapping[str, Callable[[Dataset, Mapping[str, Any]], None]]] = MappingProxyType(
    {"calibrate": _calibrate, "evaluate": _evaluate}
)
"""Commands that take a dataset, and what they then do."""
FROM_LOGS: Final = (
    "accept",
    "balance",
    "coherence",
    "compare",
    "estimate",
    "fits",
    "inspect",
    "payload",
    "plan",
    "sphere",
    "tare",
    "validate",
    "view",
)
"""Commands that need samples of recordings: they read the experiment files that a dataset names."""


def needs_samples(dataset: Dataset, sensors: Sequence[str] = ()) -> str:
    """Say that something needs samples, and where they are.

    Args:
        dataset: The dataset.
        sensors: Serial numbers or names; none for all.

    Returns:
        The text, with the experiment files of the last recordings.
    """
    names = list(dict.fromkeys(reversed(_files_in_time(dataset, sensors))))
    more = f" and {len(names) - _MOST_LOGS} more" if len(names) > _MOST_LOGS else ""
    return (
        f"needs samples, which a dataset does not keep; name experiment files in place of {dataset.folder}: "
        f"{', '.join(names[:_MOST_LOGS])}{more}"
    )


def _files_in_time(dataset: Dataset, sensors: Sequence[str]) -> list[str]:
    """Files of the recordings of sensors, or of all, as they were recorded."""
    chosen = [file for sensor in sensors for file in dataset.of_sensor(sensor)] or list(dataset.files)
    rows = sorted(dataset.rows(chosen, ["start_ns", "file"]), key=lambda row: (row["start_ns"], row["file"]))
    return [row["file"] for row in rows]


DatasetLogs = tuple[tuple[Path, ...], tuple[str, ...]]
"""Experiment files of a dataset in the order of time, and the names in them of the sensors that were chosen."""


def dataset_logs(dataset: Dataset, command: str, sensors: Sequence[str]) -> DatasetLogs:
    """Find the experiment files of recordings, for what needs samples.

    Args:
        dataset: The dataset.
        command: Name of the command, for messages.
        sensors: Serial numbers or names; none for all.

    Returns:
        The files, and the names of the chosen sensors, none where no sensor was chosen.

    Raises:
        ExperimentError: If a recording is a log to which an experiment file was applied.
        MissingFileError: If a file is not there any more.
    """
    files = tuple(dict.fromkeys(_files_in_time(dataset, sensors)))
    why = f"{dataset.folder}: {command} needs samples, which a dataset does not keep; expected"
    for file in files:
        if not file.lower().endswith(".toml"):
            raise ExperimentError(
                f"{why} recordings with an experiment file each, got the log {file}; name an experiment file of it"
            )
        if not Path(file).exists():
            raise MissingFileError(
                f"{why} the recording where it was added from, {file}, which is not there; name experiment files "
                "instead"
            )
    return tuple(map(Path, files)), tuple(dict.fromkeys(dataset.identity(sensor).name for sensor in sensors))


def run_from_dataset(command: str, folder: Path, given: Mapping[str, Any]) -> DatasetLogs | None:
    """Run a command on a dataset.

    Args:
        command: Name of the command.
        folder: Folder of the dataset.
        given: What was typed, by name.

    Returns:
        The recordings that the command is to be run on, where it needs samples; None where it was run.

    Raises:
        ExperimentError: If the command reads something else than recordings.
    """
    dataset = Dataset.opened(folder)
    if command in COMMANDS:
        COMMANDS[command](dataset, given)
        return None
    sensors = given.get("sensor") or ()
    if command not in FROM_LOGS:
        raise ExperimentError(f"{folder}: {command} {needs_samples(dataset, sensors)}")
    files, names = dataset_logs(dataset, command, [sensors] if isinstance(sensors, str) else list(sensors))
    listed = ", ".join(map(str, files[-_MOST_LOGS:][::-1]))
    more = f" and {len(files) - _MOST_LOGS} more" if len(files) > _MOST_LOGS else ""
    start_logging().info("%s needs samples: reading the recordings of %s: %s%s", command, folder, listed, more)
    return files, names
