# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of an HDF5 file, and of MATLAB 7.3, which is HDF5 with rows and columns the other way round."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.array_file.streams import ArrayContents
from forcetorque.formats.hdf5_file import dataset_numbers, datasets, is_numeric, members, opened_hdf5, require_readable

MAGIC_73 = b"MATLAB 7.3 MAT-file"
"""What files of MATLAB 7.3 begin with, before the signature of HDF5."""


def is_matlab_73(path: Path) -> bool:
    """Check whether a file is one of MATLAB 7.3, by its first bytes.

    Args:
        path: A file.

    Returns:
        Whether the signature is there.
    """
    with path.open("rb") as file:
        return file.read(len(MAGIC_73)) == MAGIC_73


def hdf5_contents(path: Path, *, matlab: bool) -> ArrayContents:
    """List what a file holds, without reading its numbers.

    Args:
        path: The file.
        matlab: Whether names and shapes are those of MATLAB.

    Returns:
        Arrays of real numbers, and what else there is.
    """
    shapes: dict[str, tuple[int, int]] = {}
    skipped: dict[str, str] = {}
    with opened_hdf5(path) as file:
        for entry in members(file):
            name = _name(entry.path, matlab=matlab)
            reason = entry.not_in_file or _not_read(entry.dataset, matlab=matlab)
            if reason is None:
                shapes[name] = _rows_and_columns(entry.dataset.shape, matlab=matlab)
            else:
                skipped[name] = reason
    return dict(sorted(shapes.items())), dict(sorted(skipped.items()))


def read_hdf5(path: Path, names: Collection[str], *, matlab: bool) -> dict[str, FloatArray]:
    """Read arrays of a file.

    Args:
        path: The file.
        names: Those that are wanted; names that are not there are left out.
        matlab: Whether names, rows and columns are those of MATLAB.

    Returns:
        Arrays by name; shape (rows, columns).
    """
    with opened_hdf5(path) as file:
        wanted = {
            name: entry
            for entry in datasets(file)
            if (name := _name(entry.name, matlab=matlab)) in names and _not_read(entry, matlab=matlab) is None
        }
        require_readable(wanted.values())
        arrays = {name: dataset_numbers(entry) for name, entry in wanted.items()}
    return {name: values.T if matlab else values.reshape(len(values), -1) for name, values in arrays.items()}


def _name(path: str, *, matlab: bool) -> str:
    name = path.strip("/")
    return name.replace("/", ".") if matlab else name


def _not_read(dataset: Any, *, matlab: bool) -> str | None:
    """What a dataset is that is no array of real numbers; None where it is one."""
    size = " x ".join(map(str, (dataset.shape or ())[:: -1 if matlab else 1]))
    # what MATLAB calls empty is stored as its shape
    if dataset.shape is None or not dataset.size or "MATLAB_empty" in dataset.attrs:
        return "empty"
    if not is_numeric(dataset):
        kind = {"O": "cell or struct array", "u": "text or truth values"}.get(dataset.dtype.kind) if matlab else None
        return f"{size} {kind or f'values of {dataset.dtype}'}".strip()
    if len(dataset.shape) not in ((2,) if matlab else range(1, 5)):
        return f"{size} numbers" if dataset.shape else "single value"
    return None


def _rows_and_columns(shape: tuple[int, ...], *, matlab: bool) -> tuple[int, int]:
    if matlab:
        return shape[1], shape[0]
    columns = 1
    for length in shape[1:]:
        columns *= length
    return shape[0], columns
