# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of a file of NumPy, .npz; nothing in it is ever executed, as a pickle would be."""

from __future__ import annotations

import math
import zipfile
import zlib
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.lib import format as npy

from forcetorque.arrays import FloatArray
from forcetorque.errors import ForceTorqueError, FormatError, MissingFileError

LARGEST_ARRAY = 1 << 28
"""Numbers of one array, 2 GiB of float64."""
MOST_ARRAYS = 10_000
"""Arrays of a file."""

_SUFFIX = ".npy"
_ZIP = b"PK\x03\x04"
_HEADERS = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}
_STUMBLES = (ArithmeticError, AttributeError, LookupError, NotImplementedError, RuntimeError, TypeError, ValueError)


def is_npz_file(path: Path) -> bool:
    """Tell whether a file holds arrays of NumPy, by its table of contents.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it does.
    """
    if not path.is_file():
        return False
    with path.open("rb") as file:
        if file.read(len(_ZIP)) != _ZIP:
            return False
    try:
        with _opened(path) as archive:
            return any(entry.filename.endswith(_SUFFIX) for entry in _entries(path, archive))
    except FormatError:
        return path.suffix == ".npz"


def npz_shapes(path: Path) -> dict[str, tuple[int, int]]:
    """Tell the shapes of all arrays of real numbers, without reading them.

    Args:
        path: The file.

    Returns:
        Rows and columns by name.
    """
    shapes = {}
    with _opened(path) as archive:
        for entry in _entries(path, archive):
            with archive.open(entry) as member:
                shape, _, dtype = _header(path, entry, member)
            columns = int(np.prod(shape[1:], dtype=np.float64))
            if dtype.kind in "biuf" and shape and shape[0] * columns:
                shapes[entry.filename.removesuffix(_SUFFIX)] = (shape[0], columns)
    return shapes


def read_npz(path: Path, names: Collection[str]) -> dict[str, FloatArray]:
    """Read arrays of real numbers.

    Args:
        path: The file.
        names: Those that are wanted; names that are not there are left out.

    Returns:
        Arrays by name; shape (rows, columns): axes behind the first are columns.
    """
    with _opened(path) as archive:
        return {
            name: _array(path, entry, archive)
            for entry in _entries(path, archive)
            if (name := entry.filename.removesuffix(_SUFFIX)) in names
        }


@contextmanager
def _opened(path: Path) -> Iterator[zipfile.ZipFile]:
    if not path.is_file():
        raise MissingFileError(f"{path}: expected a file of NumPy, there is none")
    try:
        with zipfile.ZipFile(path) as archive:
            yield archive
    except ForceTorqueError:
        raise
    except (*_STUMBLES, EOFError, MemoryError, OSError, zipfile.BadZipFile, zlib.error, SyntaxError) as error:
        reason = " ".join(str(error).split())[:200]
        raise FormatError(f"{path}: expected a whole .npz file, got one that cannot be read: {reason}") from error


def _entries(path: Path, archive: zipfile.ZipFile) -> list[zipfile.ZipInfo]:
    entries = [entry for entry in archive.infolist() if entry.filename.endswith(_SUFFIX)]
    if len(entries) > MOST_ARRAYS:
        raise FormatError(f"{path}: expected at most {MOST_ARRAYS} arrays, got {len(entries)}; split the file")
    return entries


def _header(path: Path, entry: zipfile.ZipInfo, member: IO[bytes]) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    version = npy.read_magic(member)
    if version not in _HEADERS:
        raise FormatError(f"{path}: {entry.filename}: expected version 1 or 2 of .npy, got {version}; save it again")
    shape, columns_first, dtype = _HEADERS[version](member)
    if dtype.hasobject:
        raise FormatError(
            f"{path}: {entry.filename}: expected numbers, got objects of Python: reading these would run code that "
            "the file brings; save arrays of numbers"
        )
    if any(length < 0 for length in shape):
        raise FormatError(f"{path}: {entry.filename}: expected a shape, got {shape}")
    return shape, columns_first, dtype


def _array(path: Path, entry: zipfile.ZipInfo, archive: zipfile.ZipFile) -> FloatArray:
    with archive.open(entry) as member:
        shape, columns_first, dtype = _header(path, entry, member)
        place = f"{path}: {entry.filename}"
        if dtype.kind not in "biuf" or not shape or not math.prod(shape):
            raise FormatError(f"{place}: expected rows of real numbers, got {dtype} of shape {shape}")
        count = math.prod(shape)
        size = count * dtype.itemsize
        if count > LARGEST_ARRAY or size > entry.file_size:
            raise FormatError(
                f"{place}: expected at most {LARGEST_ARRAY} numbers, all of them in the file, got {size} bytes by its "
                f"shape and {entry.file_size} in the file; split it, or copy it again"
            )
        data = member.read(size)
        if len(data) != size:
            raise FormatError(f"{place}: expected {size} bytes, got {len(data)}; copy the file again")
    values = np.frombuffer(data, dtype=dtype).reshape(shape, order="F" if columns_first else "C")
    return np.asarray(values, dtype=np.float64).reshape(shape[0], -1)
