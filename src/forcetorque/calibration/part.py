# SPDX-License-Identifier: BSD-3-Clause
"""The form of everything in a file of ours that holds a calibration."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from forcetorque.errors import FormatError, MissingFileError, ShapeError


class Part(BaseModel):
    """A frozen table of a file; unknown keys are errors."""

    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True)


_Kind = TypeVar("_Kind", bound=Part)


def read_part(path: Path | str, kind: type[_Kind], *, expected: str) -> _Kind:
    """Read a file that holds one table.

    Args:
        path: JSON file.
        kind: Class of the table.
        expected: What is expected and what makes it, in words.

    Returns:
        The table.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not JSON, or not of this form.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected {expected}")
    try:
        return kind.model_validate(json.loads(file.read_text(encoding="utf-8")))
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise FormatError(f"{file}: expected JSON, got {error}") from error
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(place) for place in first["loc"])
        raise FormatError(f"{file}: {where}: {first['msg']}; the file was changed by hand or cut") from error
    except ShapeError as error:
        raise FormatError(f"{file}: {error}") from error
