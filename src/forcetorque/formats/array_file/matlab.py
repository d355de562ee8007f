# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of MATLAB files of version 5 to 7, by their names; a field of a struct is `struct.field`."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import require_file
from forcetorque.formats.array_file.contents import ArrayContents
from forcetorque.formats.array_file.matlab_elements import read_matrices

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


def matlab_contents(path: Path) -> ArrayContents:
    """Tell what a file holds.

    Args:
        path: File of version 5 to 7.

    Returns:
        Matrices of real numbers, and what else there is.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is another file, or damaged.
    """
    _require_matlab(path)
    shapes: dict[str, tuple[int, int]] = {}
    skipped: dict[str, str] = {}
    for matrix in read_matrices(path):
        if matrix.content is None:
            shapes[matrix.name] = (matrix.shape[0], matrix.shape[1])
        else:
            skipped[matrix.name] = matrix.content
    return ArrayContents(shapes=shapes, skipped=skipped)


def read_matlab(path: Path, names: Collection[str]) -> dict[str, FloatArray]:
    """Read matrices of real numbers.

    Args:
        path: File of version 5 to 7.
        names: Those that are wanted; names that are not there are left out.

    Returns:
        Matrices by name; shape (rows, columns).

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is another file, or damaged.
    """
    _require_matlab(path)
    return {
        matrix.name: matrix.values()
        for matrix in read_matrices(path)
        if matrix.content is None and matrix.name in names
    }


def _require_matlab(path: Path) -> None:
    require_file(path, "a MATLAB file")
    if not is_matlab_file(path):
        raise FormatError(
            f"{path}: expected a MATLAB file of version 5 to 7, got another file; name the file of the log"
        )
