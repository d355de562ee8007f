# SPDX-License-Identifier: BSD-3-Clause
"""Experiment files: from TOML to a checked content."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

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
    except (ValueError, RecursionError) as error:  # not TOML, not UTF-8, or numbers and lists beyond all bounds
        raise FormatError(f"{file}: expected TOML, got {error}") from error
    try:
        return ExperimentFile.model_validate(content)
    except ValidationError as error:
        raise FormatError(_one_line(file, content, error)) from error


def _one_line(file: Path, content: dict[str, Any], error: ValidationError) -> str:
    # a list that is too short because its only element is wrong is no second error
    errors = error.errors()
    places = [e["loc"] for e in errors]
    first, *more = [
        e for e in errors if e["type"] != "too_short" or not any(p[: len(e["loc"])] == e["loc"] != p for p in places)
    ]
    where = _place(content, first["loc"], missing=first["type"] == "missing") or "top level"
    message = first["msg"]
    if first["type"] == "tuple_type":
        message = f"expected a list{f', written [[{where}]]' if isinstance(first['input'], dict) else ''}"
    shown = first["type"] in ("missing", "unknown_key") or isinstance(first["input"], dict)
    got = "" if shown else f", got {first['input']!r}"
    rest = f" (and {len(more)} more)" if more else ""
    return f"{file}: {where}: {message[:400]}{got[:200]}{rest}"


def _place(content: Any, location: tuple[int | str, ...], *, missing: bool) -> str:
    """Name a key as the file has it, such as `sensor[0].serial`; the names of alternatives are no keys."""
    place = ""
    for depth, part in enumerate(location, start=1):
        if isinstance(part, int):
            place, content = f"{place}[{part}]", content[part]
        elif isinstance(content, dict) and part in content:
            place, content = f"{place}.{part}", content[part]
        elif missing and depth == len(location):
            place = f"{place}.{part}"
    return place.removeprefix(".")
