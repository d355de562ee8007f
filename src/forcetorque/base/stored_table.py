# SPDX-License-Identifier: BSD-3-Clause
"""The form of everything in a file of ours that holds a calibration, of a sensor or of skin."""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ConfigDict, ValidationError

from forcetorque.base.arrays import ArrayModel
from forcetorque.base.errors import FormatError, MissingFileError, ShapeError
from forcetorque.base.output_file import refuse_output, write_bytes_atomically
from forcetorque.base.run_files import declare_input
from forcetorque.base.toml_file import first_error


class StoredTable(ArrayModel):
    """A frozen table of a file; unknown keys are errors."""

    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True)


def write_stored_table(
    path: Path | str,
    table: StoredTable,
    *,
    inputs_sha256: Collection[str] = (),
    force: bool = False,
    indent: int | None = None,
) -> None:
    """Write a table as JSON; on any error the file keeps what it held before.

    Args:
        path: File to write or to replace, in an existing folder.
        table: The table.
        inputs_sha256: Hashes of its inputs, none of which the file may be.
        force: Whether a file that is neither a result nor a figure may be replaced; an input never is.
        indent: Spaces by which every level is indented; None for one line.

    Raises:
        OutputError: If the file is an input of it, or a file that `force` is needed for.
    """
    refuse_output(path, inputs_sha256=inputs_sha256, force=force)
    text = json.dumps(table.model_dump(mode="json", by_alias=True), indent=indent, allow_nan=False)
    write_bytes_atomically(Path(path), (text + "\n").encode())


_Kind = TypeVar("_Kind", bound=StoredTable)


def read_stored_table(path: Path | str, kind: type[_Kind], *, expected: str) -> _Kind:
    """Read a file that holds one table.

    Args:
        path: JSON file.
        kind: Class of the table.
        expected: What is expected and what makes it, as text.

    Returns:
        The table.
    """
    file = Path(path)
    return validated_table(file, kind, read_json(file, expected=expected))


def read_json(file: Path, *, expected: str) -> Any:
    """Read a file.

    Args:
        file: JSON file.
        expected: As of `read_part`.

    Returns:
        Its content.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not JSON.
    """
    if not file.is_file():
        raise MissingFileError(f"{file}: expected {expected}")
    declare_input(file)
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
        got = "TOML, as of an experiment file" if file.suffix.lower() == ".toml" else error
        raise FormatError(f"{file}: expected JSON, got {got}") from error


def validated_table(file: Path, kind: type[_Kind], content: Any) -> _Kind:
    """Make a table of the content of a file.

    Args:
        file: The file, for messages.
        kind: Class of the table.
        content: Its content.

    Returns:
        The table.

    Raises:
        FormatError: If it is not of this form.
    """
    try:
        return kind.model_validate(content)
    except ValidationError as error:
        raise FormatError(f"{file}: {first_error(error)}; the file was changed by hand or cut") from error
    except ShapeError as error:
        raise FormatError(f"{file}: {error}") from error
