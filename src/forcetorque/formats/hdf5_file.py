# SPDX-License-Identifier: BSD-3-Clause
"""HDF5 files: all errors of h5py become one error, and nothing is read that is not in the file itself.

A file can name others: by external links, virtual datasets and external storage, which are any files of the machine.
None is followed. The library decodes what a virtual dataset is made of where it opens it, and ends the process if that
is damaged: so the object header is read here first (The HDF Group, HDF5 File Format Specification 3.0, IV.A: object
headers, layout message).
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError, FormatError, needs_extra
from forcetorque.base.input_file import READ_ERRORS, require_file, require_unpacked

if TYPE_CHECKING:
    import h5py


_LAYOUT, _EXTERNAL, _CONTINUATION = 0x08, 0x07, 0x10
_VIRTUAL = 3
_SHARED = 0x02
_MOST_BLOCKS = 1000
_LARGEST_BLOCK = 1 << 24


def not_in_file(group: Any, name: str) -> str | None:
    """Give the reason why the numbers of a dataset are not in its file, without opening it.

    Args:
        group: An open group.
        name: Name of a member that is no link.

    Returns:
        `virtual dataset` or `dataset in external storage`; None for any other dataset, and for a group.

    Raises:
        FormatError: If its header is damaged.
    """
    creation = group.file.id.get_create_plist()
    address_size, length_size = creation.get_sizes()
    base = creation.get_userblock()
    address = group.id.links.get_info(name.encode()).u
    path = Path(group.file.filename)
    found = None
    try:
        for kind, flags, data in _messages(path, base, address, address_size, length_size):
            if kind == _EXTERNAL:
                found = "dataset in external storage"
            if kind == _LAYOUT and (flags & _SHARED or data[1 if data[0] > 2 else 2] == _VIRTUAL):
                return "virtual dataset"
    except (struct.error, IndexError, ValueError, OverflowError, OSError) as error:
        raise FormatError(
            f"{path}: {group.name}: {name[:100]}: expected the header of a dataset or group, got one that is damaged: "
            f"{error}; copy the file again"
        ) from error
    return found


def _messages(
    path: Path, base: int, address: int, address_size: int, length_size: int
) -> Iterator[tuple[int, int, bytes]]:
    """Type, flags and bytes of the messages of an object, in all blocks of its header."""
    with path.open("rb") as file:

        def block(start: int, size: int) -> bytes:
            if size > _LARGEST_BLOCK:
                raise ValueError(f"a block of {size} bytes")
            file.seek(base + start)
            return file.read(size)

        head = block(address, 64)
        if head.startswith(b"OHDR"):
            flags = head[5]
            at = 6 + (16 if flags & 0x20 else 0) + (4 if flags & 0x10 else 0)
            width = 1 << (flags & 3)
            size = int.from_bytes(head[at : at + width], "little")
            ordered = 2 if flags & 0x04 else 0
            pending = [block(address + at + width, size)]
        elif head[:1] == b"\x01":
            (size,) = struct.unpack_from("<I", head, 8)
            pending, ordered = [block(address + 16, size)], None
        else:
            raise ValueError(f"version {head[:1].hex()}")
        blocks = 0
        while pending:
            blocks += 1
            if blocks > _MOST_BLOCKS:
                raise ValueError(f"over {_MOST_BLOCKS} blocks")
            for kind, flags, data in _in_block(pending.pop(), ordered):
                yield kind, flags, data
                if kind == _CONTINUATION:
                    start = int.from_bytes(data[:address_size], "little")
                    size = int.from_bytes(data[address_size : address_size + length_size], "little")
                    content = block(start, size)
                    # of version 2 a signature in front, a checksum behind
                    pending.append(content if ordered is None else content[4:-4])


def _in_block(content: bytes, ordered: int | None) -> Iterator[tuple[int, int, bytes]]:
    """Messages of one block; `ordered` is the size of their numbers in version 2, None in version 1."""
    at, head = 0, 8 if ordered is None else 4 + ordered
    while at + head <= len(content):
        if ordered is None:
            kind, size, flags = struct.unpack_from("<HHB", content, at)
        else:
            kind, size, flags = struct.unpack_from("<BHB", content, at)
        yield kind, flags, content[at + head : at + head + size]
        at += head + size


SIGNATURE = b"\x89HDF\r\n\x1a\n"
"""What the file begins with, or what stands at byte 512, 1024, 2048, ... behind a header of another program."""
LARGEST_RATIO = 1100
"""Bytes of a dataset for each byte of its file: what gzip packs at most. A file that claims more is damaged."""
MOST_OBJECTS = 10_000
"""Groups and datasets of a file: the robots with most channels have hundreds."""
DEEPEST = 32
"""Groups inside each other."""

_LONGEST_HEADER = 1 << 16
_CHECKSUM_SIZE = 4


def is_hdf5_file(path: Path) -> bool:
    """Check whether a file is one of HDF5, by its signature.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether the signature is where it may be.
    """
    if not path.is_file():
        return False
    with path.open("rb") as file:
        offset = 0
        while offset <= _LONGEST_HEADER:
            file.seek(offset)
            start = file.read(len(SIGNATURE))
            if start == SIGNATURE:
                return True
            if not start:
                return False
            offset = max(512, 2 * offset)
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
    with needs_extra(f"{path}: HDF5 is read by h5py", "hdf5"):
        import h5py
    require_file(path, "an HDF5 file")
    if not is_hdf5_file(path):
        raise FormatError(f"{path}: expected an HDF5 file, got another one; name the file of the log")
    try:
        with h5py.File(path, "r") as file:
            yield file
    except ForceTorqueError:
        raise
    except READ_ERRORS as error:
        reason = " ".join(str(error).split())[:200]
        raise FormatError(f"{path}: expected a whole HDF5 file, got one that cannot be read: {reason}") from error


@dataclass(frozen=True, slots=True, kw_only=True)
class Member:
    """A dataset of a file, or what stands in place of one."""

    path: str
    """Its path in the file."""
    dataset: Any
    """The dataset; None where its numbers are elsewhere."""
    not_in_file: str | None
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
                yield Member(path=f"{here.name.rstrip('/')}/{name}", dataset=None, not_in_file="link")
                continue
            reason = not_in_file(here, name)
            if reason is not None:
                yield Member(path=f"{here.name.rstrip('/')}/{name}", dataset=None, not_in_file=reason)
                continue
            entry = here[name]
            if isinstance(entry, h5py.Dataset):
                yield Member(path=entry.name, dataset=entry, not_in_file=None)
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
    yield from (entry.dataset for entry in members(group) if entry.not_in_file is None)


def is_member(group: Any, name: str) -> bool:
    """Check whether a group has a member of its own, not a link to one.

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
        reason = not_in_file(here, part)
        if reason is not None:
            raise FormatError(
                f"{group.file.filename}: {group.name}: {name}: expected numbers in the file itself, got a {reason}; "
                "save them in one file"
            )
        here = here[part]
    return here


def is_numeric(dataset: Any) -> bool:
    """Check whether a dataset holds real numbers; texts and objects of MATLAB are numbers too, but no samples.

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
