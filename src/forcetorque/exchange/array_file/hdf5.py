# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of an HDF5 file, and of MATLAB 7.3, which is HDF5 with rows and columns the other way round."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any

from forcetorque.arrays import FloatArray
from forcetorque.exchange.hdf5_file import dataset_numbers, datasets, is_numeric, opened_hdf5
from forcetorque.exchange.robometry.channel import log_group

MAGIC_73 = b"MATLAB 7.3 MAT-file"
"""What files of MATLAB 7.3 begin with, before the signature of HDF5."""


def is_matlab_73(path: Path) -> bool:
    """Tell whether a file is one of MATLAB 7.3, by its first bytes.

    Args:
        path: A file.

    Returns:
        Whether it says so.
    """
    with path.open("rb") as file:
        return file.read(len(MAGIC_73)) == MAGIC_73


def labels_itself(path: Path) -> bool:
    """Tell whether a file is a log of robometry, which says what it holds.

    Args:
        path: An HDF5 file.

    Returns:
        Whether it is.
    """
    with opened_hdf5(path) as file:
        return log_group(file) is not None


def hdf5_shapes(path: Path, *, matlab: bool) -> dict[str, tuple[int, int]]:
    """Tell the shapes of all arrays of a file, without reading them.

    Args:
        path: The file.
        matlab: Whether names and shapes are those of MATLAB.

    Returns:
        Rows and columns by name.
    """
    with opened_hdf5(path) as file:
        arrays = [entry for entry in datasets(file) if _is_array(entry, matlab=matlab)]
        shapes = {_name(entry, matlab=matlab): entry.shape for entry in arrays}
    return {name: _rows_and_columns(shape, matlab=matlab) for name, shape in sorted(shapes.items())}


def read_hdf5(path: Path, names: Collection[str], *, matlab: bool) -> dict[str, FloatArray]:
    """Read arrays of a file.

    Args:
        path: The file.
        names: Those that are wanted; names that are not there are left out.
        matlab: Whether names, rows and columns are those of MATLAB.

    Returns:
        Arrays by name; shape (rows, columns).
    """
    arrays = {}
    with opened_hdf5(path) as file:
        for entry in datasets(file):
            name = _name(entry, matlab=matlab)
            if name in names and _is_array(entry, matlab=matlab):
                values = dataset_numbers(entry)
                arrays[name] = values.T if matlab else values.reshape(len(values), -1)
    return arrays


def _name(entry: Any, *, matlab: bool) -> str:
    name = str(entry.name).strip("/")
    return name.replace("/", ".") if matlab else name


def _is_array(entry: Any, *, matlab: bool) -> bool:
    # what MATLAB calls empty is stored as its shape
    dimensions = (2,) if matlab else range(1, 5)
    return is_numeric(entry) and len(entry.shape) in dimensions and entry.size > 0 and "MATLAB_empty" not in entry.attrs


def _rows_and_columns(shape: tuple[int, ...], *, matlab: bool) -> tuple[int, int]:
    if matlab:
        return shape[1], shape[0]
    columns = 1
    for length in shape[1:]:
        columns *= length
    return shape[0], columns
