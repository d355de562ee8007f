# SPDX-License-Identifier: BSD-3-Clause
"""Commands that read experiment files take the folder of a dataset in their place."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_args, get_origin, get_type_hints

from typer.models import ArgumentInfo

from forcetorque.base.errors import ExperimentError

if TYPE_CHECKING:
    from forcetorque.fleet.from_dataset import DatasetLogs
    from forcetorque.results.result import Result


def with_datasets(name: str, command: Callable[..., Result | None]) -> Callable[..., Result | None]:
    """Let a command take a dataset.

    Args:
        name: Name of the command.
        command: The command.

    Returns:
        The command, of the same signature.
    """
    arguments = _arguments(command)

    @wraps(command)
    def run(**given: Any) -> Result | None:
        inputs = [path for argument in arguments for path in _paths(given[argument])]
        folders = [path for path in inputs if path.is_dir()]
        if folders:
            from forcetorque.fleet.dataset import is_dataset
            from forcetorque.fleet.from_dataset import run_from_dataset

            datasets = [path for path in folders if is_dataset(path)]
            if datasets and len(inputs) > 1:
                raise ExperimentError(
                    f"{datasets[0]}: expected a dataset alone, got it beside other files; add these to it with "
                    "`forcetorque fleet add`"
                )
            if datasets:
                logs = run_from_dataset(name, datasets[0], given)
                if logs is None:
                    return None
                return command(**given | _in_place_of(datasets[0], logs, given, arguments))
        return command(**given)

    return run


def _in_place_of(
    dataset: Path, logs: DatasetLogs, given: Mapping[str, Any], arguments: Sequence[str]
) -> dict[str, Any]:
    """What is typed, with the experiment files of a dataset in its place: all, or the last where there can be one."""
    values: dict[str, Any] = {"sensor": logs.sensors} if "sensor" in given and logs.sensors else {}
    for argument in arguments:
        value = given[argument]
        if isinstance(value, list | tuple) and dataset in value:
            values[argument] = type(value)(logs.files)
        elif value == dataset:
            values[argument] = logs.files[-1]
    if "sensor" in values and not isinstance(given["sensor"], list | tuple):
        (values["sensor"],) = logs.sensors
    return values


def _arguments(command: Callable[..., Any]) -> list[str]:
    """Names of what is typed without a flag."""
    hints = get_type_hints(command, include_extras=True)
    return [
        name
        for name, hint in hints.items()
        if get_origin(hint) is Annotated and any(isinstance(note, ArgumentInfo) for note in get_args(hint))
    ]


def _paths(value: Any) -> list[Path]:
    values = value if isinstance(value, list | tuple) else [value]
    return [one for one in values if isinstance(one, Path)]
