# SPDX-License-Identifier: BSD-3-Clause
"""Where the numbers of a dataset are, by the object header of HDF5 [1]: read here before the library opens a dataset.

The library decodes what a virtual dataset is made of where it opens it, and ends the process if that is damaged.

References:
    [1] The HDF Group, HDF5 File Format Specification 3.0, IV.A: object headers, layout message.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from forcetorque.base.errors import FormatError

_LAYOUT, _EXTERNAL, _CONTINUATION = 0x08, 0x07, 0x10
_VIRTUAL = 3
_SHARED = 0x02
_MOST_BLOCKS = 1000
_LARGEST_BLOCK = 1 << 24


def elsewhere(group: Any, name: str) -> str | None:
    """Tell why the numbers of a dataset are not in its file, without opening it.

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
