# SPDX-License-Identifier: BSD-3-Clause
"""Commands that read experiment files take the folder of a dataset in their place."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import wraps
from pathlib import Path
from typing import Any, Final

from forcetorque.base.errors import ExperimentError

_ARGUMENTS: Final = ("experiment", "experiments")
"""Names of the arguments that are experiment files."""


def with_datasets(name: str, command: Callable[..., None]) -> Callable[..., None]:
    """Let a command take a dataset.

    Args:
        name: Name of the command.
        command: The command.

    Returns:
        The command, of the same signature.
    """

    @wraps(command)
    def run(**given: Any) -> None:
        folders = [path for path in _inputs(given) if path.is_dir()]
        if folders:
            from forcetorque.fleet.dataset import is_dataset
            from forcetorque.fleet.from_dataset import run_from_dataset

            datasets = [path for path in folders if is_dataset(path)]
            if datasets and len(list(_inputs(given))) > 1:
                raise ExperimentError(
                    f"{datasets[0]}: expected a dataset alone, got it beside other files; add these to it with "
                    "`forcetorque fleet add`"
                )
            if datasets:
                run_from_dataset(name, datasets[0], given)
                return
        command(**given)

    return run


def _inputs(given: Mapping[str, Any]) -> Iterator[Path]:
    for name in _ARGUMENTS:
        value = given.get(name)
        yield from [value] if isinstance(value, Path) else (value or ())
