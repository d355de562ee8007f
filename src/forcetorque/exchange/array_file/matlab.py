# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of MATLAB files of version 5 to 7, by their names; a field of a struct is `struct.field`."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FormatError, MissingFileError

MAGIC = b"MATLAB 5.0 MAT-file"
"""What files of version 5 to 7 begin with."""


def is_matlab_file(path: Path) -> bool:
    """Tell whether a file is one of MATLAB, by its first bytes.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it says so.
    """
    if not path.is_file():
        return False
    with path.open("rb") as stream:
        return stream.read(len(MAGIC)) == MAGIC


def read_variables(path: Path) -> dict[str, FloatArray]:
    """Read the matrices of real numbers of a MATLAB file.

    Args:
        path: File of version 5 to 7.

    Returns:
        Matrices by name; shape (rows, columns). Texts, cells, objects and lists of structs are left out.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is another file, or damaged.
    """
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError

    if not path.is_file():
        raise MissingFileError(f"{path}: expected a MATLAB file, there is none")
    if not is_matlab_file(path):
        raise FormatError(
            f"{path}: expected a MATLAB file of version 5 to 7, got another file; name the file of the log"
        )
    # what the reader of SciPy raises on damaged files is whatever it stumbles over
    stumbles = (ArithmeticError, AttributeError, LookupError, NameError, RuntimeError, TypeError, ValueError)
    try:
        content = loadmat(path)
    except (*stumbles, EOFError, MemoryError, OSError, MatReadError, zlib.error, struct.error) as error:
        raise FormatError(
            f"{path}: expected a whole MATLAB file, got one that cannot be read: {str(error)[:200]}"
        ) from error
    return dict(_matrices({name: value for name, value in content.items() if not name.startswith("__")}))


def _matrices(values: dict[str, Any], before: str = "") -> Iterator[tuple[str, FloatArray]]:
    for name, value in values.items():
        if not isinstance(value, np.ndarray):
            continue
        if value.dtype.names is not None and value.size == 1:
            fields = {field: value[field].flat[0] for field in value.dtype.names}
            yield from _matrices(fields, f"{before}{name}.")
        elif value.dtype.kind in "biuf" and value.ndim == 2:
            yield before + name, np.asarray(value, dtype=np.float64)
