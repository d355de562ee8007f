# SPDX-License-Identifier: BSD-3-Clause
"""Experiment files: from TOML to a checked content."""

from __future__ import annotations

import tomllib
from pathlib import Path

from pydantic import ValidationError

from forcetorque.errors import FormatError, MissingFileError
from forcetorque.experiment.schema import ExperimentFile


def parse_experiment(path: Path | str) -> ExperimentFile:
    """Read and check an experiment file, without opening what it points to.

    Args:
        path: TOML file.

    Returns:
        Its content.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not TOML, or a key is unknown, missing or has a wrong value.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected an experiment file, there is none")
    try:
        content = tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FormatError(f"{file}: expected TOML, got {error}") from error
    try:
        return ExperimentFile.model_validate(content)
    except ValidationError as error:
        raise FormatError(_one_line(file, error)) from error


def _one_line(file: Path, error: ValidationError) -> str:
    first, *more = error.errors()
    where = ".".join(str(part) for part in first["loc"]) or "top level"
    got = "" if first["type"] in ("missing", "unknown_key") else f", got {first['input']!r}"
    rest = f" (and {len(more)} more)" if more else ""
    return f"{file}: {where}: {first['msg'][:400]}{got[:200]}{rest}"
