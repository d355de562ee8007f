# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of a file of NumPy, .npz; nothing in it is ever executed, as a pickle would be."""

from __future__ import annotations

import io
import math
import tokenize
import zipfile
import zlib
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.lib import format as npy

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError, FormatError
from forcetorque.base.input_file import READ_ERRORS, require_file
from forcetorque.formats.array_file.streams import ArrayContents

MOST_ARRAYS = 10_000
"""Arrays of a file."""

_SUFFIX = ".npy"
_ZIP = b"PK\x03\x04"
_HEADERS = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}
_LONGEST_HEADER = 1 << 14
"""Bytes in front of the numbers of an array; NumPy takes no more than 10000 characters."""
_READ_ERRORS = (*READ_ERRORS, EOFError, SyntaxError, tokenize.TokenError, zipfile.BadZipFile, zlib.error)


def is_npz_file(path: Path) -> bool:
    """Check whether a file holds arrays of NumPy, by its table of contents.

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


def npz_contents(path: Path) -> ArrayContents:
    """List what a file holds, without reading its numbers.

    Args:
        path: The file.

    Returns:
        Arrays of real numbers, and what else there is.
    """
    shapes: dict[str, tuple[int, int]] = {}
    skipped: dict[str, str] = {}
    with _opened(path) as archive:
        for entry in _entries(path, archive):
            name = entry.filename.removesuffix(_SUFFIX)
            shape, _, dtype, _ = _header(path, entry, archive)
            if dtype.hasobject:
                skipped[name] = "objects of Python: reading these would run code that the file brings"
            elif not shape or not math.prod(shape):
                skipped[name] = "empty" if shape else "single value"
            elif dtype.kind in "biuf":
                shapes[name] = (shape[0], math.prod(shape[1:]))
            else:
                skipped[name] = f"{' x '.join(map(str, shape))} values of {dtype}"
    return shapes, skipped


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
    require_file(path, "a file of NumPy")
    try:
        with zipfile.ZipFile(path) as archive:
            yield archive
    except ForceTorqueError:
        raise
    except _READ_ERRORS as error:
        reason = " ".join(str(error).split())[:200]
        raise FormatError(f"{path}: expected a whole .npz file, got one that cannot be read: {reason}") from error


def _entries(path: Path, archive: zipfile.ZipFile) -> list[zipfile.ZipInfo]:
    entries = [entry for entry in archive.infolist() if entry.filename.endswith(_SUFFIX)]
    if len(entries) > MOST_ARRAYS:
        raise FormatError(f"{path}: expected at most {MOST_ARRAYS} arrays, got {len(entries)}; split the file")
    return entries


def _header(
    path: Path, entry: zipfile.ZipInfo, archive: zipfile.ZipFile
) -> tuple[tuple[int, ...], bool, np.dtype[Any], int]:
    """Shape of an array, whether it is stored column by column, type, and bytes in front of the numbers."""
    with archive.open(entry) as file:
        member = io.BytesIO(file.read(_LONGEST_HEADER))
    version = npy.read_magic(member)
    if version not in _HEADERS:
        raise FormatError(f"{path}: {entry.filename}: expected version 1 or 2 of .npy, got {version}; save it again")
    try:
        shape, columns_first, dtype = _HEADERS[version](member)
    except _READ_ERRORS as error:
        reason = " ".join(str(error).split())[:200]
        raise FormatError(
            f"{path}: {entry.filename}: expected a header of .npy, got one that cannot be read: {reason}; copy the "
            "file again"
        ) from error
    if any(length < 0 for length in shape):
        raise FormatError(f"{path}: {entry.filename}: expected a shape, got {shape}")
    size = math.prod(shape) * dtype.itemsize
    if size > entry.file_size and not dtype.hasobject:
        raise FormatError(
            f"{path}: {entry.filename}: expected {size} bytes by its shape, got {entry.file_size} in the file; copy it "
            "again"
        )
    return shape, columns_first, dtype, member.tell()


def _array(path: Path, entry: zipfile.ZipInfo, archive: zipfile.ZipFile) -> FloatArray:
    shape, columns_first, dtype, begin = _header(path, entry, archive)
    place = f"{path}: {entry.filename}"
    if dtype.kind not in "biuf" or not shape or not math.prod(shape):
        raise FormatError(f"{place}: expected rows of real numbers, got {dtype} of shape {shape}")
    size = math.prod(shape) * dtype.itemsize
    with archive.open(entry) as member:
        member.read(begin)
        data = member.read(size)
    if len(data) != size:
        raise FormatError(f"{place}: expected {size} bytes, got {len(data)}; copy the file again")
    values = np.frombuffer(data, dtype=dtype).reshape(shape, order="F" if columns_first else "C")
    return np.asarray(values, dtype=np.float64).reshape(shape[0], -1)
