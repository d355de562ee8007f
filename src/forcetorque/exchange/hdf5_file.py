# SPDX-License-Identifier: BSD-3-Clause
"""HDF5 files: whatever h5py stumbles over is one error, and no dataset is larger than its file can fill."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import ForceTorqueError, FormatError, MissingExtraError, MissingFileError

if TYPE_CHECKING:
    import h5py

SIGNATURE = b"\x89HDF\r\n\x1a\n"
"""What the file begins with, or what stands at byte 512, 1024, 2048, ... behind a header of somebody else's."""
LARGEST_DATASET = 1 << 28
"""Numbers of one dataset, 2 GiB: an hour of 1 kHz with 70 columns."""
LARGEST_RATIO = 1100
"""Bytes of a dataset for each byte of its file: what gzip packs at most. A file that claims more is damaged, or made to
fill the memory."""
MOST_OBJECTS = 10_000
"""Groups and datasets of a file: the robots with most channels have hundreds."""
DEEPEST = 32
"""Groups inside each other."""

_LONGEST_HEADER = 1 << 16
_STUMBLES = (ArithmeticError, AttributeError, LookupError, OSError, RuntimeError, TypeError, ValueError, MemoryError)


def is_hdf5_file(path: Path) -> bool:
    """Tell whether a file is one of HDF5, by its signature.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether the signature is where it may be.
    """
    if not path.is_file():
        return False
    with path.open("rb") as file:
        place = 0
        while place <= _LONGEST_HEADER:
            file.seek(place)
            start = file.read(len(SIGNATURE))
            if start == SIGNATURE:
                return True
            if not start:
                return False
            place = max(512, 2 * place)
    return False


@contextmanager
def opened_hdf5(path: Path) -> Iterator[h5py.File]:
    """Open a file for reading.

    Args:
        path: The file.

    Yields:
        The open file.

    Raises:
        MissingExtraError: If h5py is not installed.
        MissingFileError: If there is no such file.
        FormatError: If it is another file, or what is read inside the context is damaged.
        ForceTorqueError: As it was raised inside the context.
    """
    try:
        import h5py
    except ImportError as error:
        raise MissingExtraError(f"{path}: HDF5 is read by h5py: pip install forcetorque[hdf5]") from error
    if not path.is_file():
        raise MissingFileError(f"{path}: expected an HDF5 file, there is none")
    if not is_hdf5_file(path):
        raise FormatError(f"{path}: expected an HDF5 file, got another one; name the file of the log")
    try:
        with h5py.File(path, "r") as file:
            yield file
    except ForceTorqueError:
        raise
    except _STUMBLES as error:
        reason = " ".join(str(error).split())[:200]
        raise FormatError(f"{path}: expected a whole HDF5 file, got one that cannot be read: {reason}") from error


def datasets(group: h5py.Group) -> Iterator[h5py.Dataset]:
    """Give all datasets below a group; links are not followed, nor what MATLAB keeps for itself.

    Args:
        group: A group of an open file.

    Yields:
        Its datasets.

    Raises:
        FormatError: If it holds more than a log can.
    """
    import h5py

    pending, count = [(group, 0)], 0
    while pending:
        here, depth = pending.pop()
        for name in here:
            count += 1
            if count > MOST_OBJECTS or depth > DEEPEST:
                raise FormatError(
                    f"{group.file.filename}: expected at most {MOST_OBJECTS} datasets, groups {DEEPEST} deep, got more"
                )
            hard = isinstance(here.get(name, getlink=True), h5py.HardLink)
            entry = here[name] if hard and not name.startswith("#") else None
            if isinstance(entry, h5py.Dataset):
                yield entry
            elif isinstance(entry, h5py.Group):
                pending.append((entry, depth + 1))


def is_numeric(dataset: Any) -> bool:
    """Tell whether a dataset holds real numbers; texts and objects of MATLAB are numbers too, but no samples.

    Args:
        dataset: A dataset.

    Returns:
        Whether it does.
    """
    text = "MATLAB_int_decode" in dataset.attrs or "MATLAB_object_decode" in dataset.attrs
    return dataset.dtype.kind in "biuf" and not text and dataset.shape is not None


def dataset_numbers(dataset: Any) -> FloatArray:
    """Read a dataset of real numbers.

    Args:
        dataset: A dataset of an open file.

    Returns:
        Its numbers, in its shape.

    Raises:
        FormatError: If it holds something else, or is larger than its file can fill.
    """
    require_size(dataset)
    if not is_numeric(dataset):
        raise FormatError(f"{_place(dataset)}: expected real numbers, got {dataset.dtype}; name another dataset")
    return np.asarray(dataset[()], dtype=np.float64)


def require_size(dataset: Any) -> None:
    """Refuse a dataset that claims to be larger than its file can fill, before it is read.

    Args:
        dataset: A dataset of an open file.

    Raises:
        FormatError: If it is.
    """
    size, limit = dataset.size or 0, LARGEST_RATIO * Path(dataset.file.filename).stat().st_size
    if size > LARGEST_DATASET or size * dataset.dtype.itemsize > limit:
        raise FormatError(
            f"{_place(dataset)}: expected at most {LARGEST_DATASET} numbers, and {LARGEST_RATIO} bytes for each of the "
            f"file, got {size}; split the log, or copy the file again"
        )


def _place(dataset: Any) -> str:
    return f"{dataset.file.filename}: {str(dataset.name)[:100]}"
