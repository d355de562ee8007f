# SPDX-License-Identifier: BSD-3-Clause
"""HDF5 files: whatever h5py stumbles over is one error, and nothing is read that is not in the file itself.

A file can name others: by external links, virtual datasets and external storage, which are any files of the machine.
None is followed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError, FormatError, MissingExtraError
from forcetorque.base.input_file import require_file, require_unpacked
from forcetorque.formats.hdf5_layout import elsewhere

if TYPE_CHECKING:
    import h5py


SIGNATURE = b"\x89HDF\r\n\x1a\n"
"""What the file begins with, or what stands at byte 512, 1024, 2048, ... behind a header of somebody else's."""
LARGEST_RATIO = 1100
"""Bytes of a dataset for each byte of its file: what gzip packs at most. A file that claims more is damaged."""
MOST_OBJECTS = 10_000
"""Groups and datasets of a file: the robots with most channels have hundreds."""
DEEPEST = 32
"""Groups inside each other."""

_LONGEST_HEADER = 1 << 16
_CHECKSUM_SIZE = 4
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
    require_file(path, "an HDF5 file")
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Member:
    """A dataset of a file, or what stands in place of one."""

    path: str
    """Its path in the file."""
    dataset: Any
    """The dataset; None where its numbers are elsewhere."""
    elsewhere: str | None
    """Why its numbers are not in the file; None where they are."""


def members(group: h5py.Group) -> Iterator[Member]:
    """Give all datasets and links below a group; links are not followed, nor what MATLAB keeps for itself.

    Args:
        group: A group of an open file.

    Yields:
        Its datasets and links.

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
            if name.startswith("#"):
                continue
            if not is_member(here, name):
                yield Member(path=f"{here.name.rstrip('/')}/{name}", dataset=None, elsewhere="link")
                continue
            place = elsewhere(here, name)
            if place is not None:
                yield Member(path=f"{here.name.rstrip('/')}/{name}", dataset=None, elsewhere=place)
                continue
            entry = here[name]
            if isinstance(entry, h5py.Dataset):
                yield Member(path=entry.name, dataset=entry, elsewhere=None)
            elif isinstance(entry, h5py.Group):
                pending.append((entry, depth + 1))


def datasets(group: h5py.Group) -> Iterator[h5py.Dataset]:
    """Give the datasets below a group whose numbers are in the file.

    Args:
        group: A group of an open file.

    Yields:
        Its datasets.

    Raises:
        FormatError: If it holds more than a log can.
    """
    yield from (entry.dataset for entry in members(group) if entry.elsewhere is None)


def is_member(group: Any, name: str) -> bool:
    """Tell whether a group has a member of its own, not a link to one.

    Args:
        group: A group of an open file.
        name: Name of the member.

    Returns:
        Whether it has.
    """
    import h5py

    return isinstance(group.get(name, getlink=True), h5py.HardLink)


def member(group: h5py.Group, name: str) -> Any:
    """Give a group or dataset by its name, which must be in the file itself.

    Args:
        group: A group of an open file.
        name: Name in the group, or path below it.

    Returns:
        The group or dataset.

    Raises:
        FormatError: If it is not there, or a link.
    """
    import h5py

    here = group
    for part in name.split("/"):
        if not isinstance(here, h5py.Group) or not is_member(here, part):
            raise FormatError(
                f"{group.file.filename}: {group.name}: expected {name} in the file itself, got none or a link; copy it "
                "there"
            )
        place = elsewhere(here, part)
        if place is not None:
            raise FormatError(
                f"{group.file.filename}: {group.name}: {name}: expected numbers in the file itself, got a {place}; "
                "save them in one file"
            )
        here = here[part]
    return here


def is_numeric(dataset: Any) -> bool:
    """Tell whether a dataset holds real numbers; texts and objects of MATLAB are numbers too, but no samples.

    Args:
        dataset: A dataset whose numbers are in the file.

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
        FormatError: If it holds something else, or is not readable.
    """
    require_readable([dataset])
    if not is_numeric(dataset):
        raise FormatError(f"{_place(dataset)}: expected real numbers, got {dataset.dtype}; name another dataset")
    return np.asarray(dataset[()], dtype=np.float64)


def require_readable(several: Iterable[Any]) -> None:
    """Refuse datasets that are more than their file may unpack to, before any is read.

    Args:
        several: Datasets of an open file that are read together, by `members` or `member`.

    Raises:
        FormatError: If they are too large.
    """
    import h5py

    unpacked = 0
    for dataset in several:
        if not isinstance(dataset, h5py.Dataset):
            raise FormatError(f"{_place(dataset)}: expected a dataset, got a group; name another one")
        path, size = Path(dataset.file.filename), dataset.size or 0
        limit = LARGEST_RATIO * path.stat().st_size
        if size * dataset.dtype.itemsize > limit:
            raise FormatError(
                f"{_place(dataset)}: expected at most {LARGEST_RATIO} bytes for each of the file, got "
                f"{size * dataset.dtype.itemsize}; copy the file again"
            )
        unpacked += size * max(dataset.dtype.itemsize, np.dtype(np.float64).itemsize)
        require_unpacked(path, unpacked, where=str(dataset.name)[:100])
        _require_whole_chunks(dataset)


def _require_whole_chunks(dataset: Any) -> None:
    """Refuse chunks shorter than their checksum: the library subtracts its length and reads until the process ends."""
    from h5py import h5z

    creation = dataset.id.get_create_plist()
    filters = [creation.get_filter(k)[0] for k in range(creation.get_nfilters())]
    if h5z.FILTER_FLETCHER32 not in filters:
        return
    # what a filter behind the checksum unpacks to is not known
    if filters.index(h5z.FILTER_FLETCHER32) != len(filters) - 1:
        raise FormatError(
            f"{_place(dataset)}: expected the checksum as the last filter, got another; copy the file again"
        )
    sizes: list[int] = []
    dataset.id.chunk_iter(lambda chunk: sizes.append(chunk.size))
    if sizes and min(sizes) <= _CHECKSUM_SIZE:
        raise FormatError(
            f"{_place(dataset)}: expected chunks of more than their checksum of {_CHECKSUM_SIZE} bytes, got one of "
            f"{min(sizes)}; copy the file again"
        )


def _place(dataset: Any) -> str:
    return f"{dataset.file.filename}: {str(dataset.name)[:100]}"
