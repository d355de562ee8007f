# SPDX-License-Identifier: BSD-3-Clause
"""Packed parts of bags, unpacked no further than they may: rosbags itself unpacks whatever is claimed.

What it unpacks by is replaced where it keeps that: for chunks of ROS 1 in each reader, for MCAP in its table of
methods.
"""

from __future__ import annotations

import bz2
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import require_unpacked

LARGEST_CHUNK = 1 << 28
"""Bytes that a packed part of a bag may unpack to."""

_BLOCK = 1 << 20


def bound_mcap() -> None:
    """Let rosbags unpack no more of a chunk of MCAP than the chunk says, and that within the limit."""
    from rosbags.rosbag2 import storage_mcap

    for name in ("lz4", "zstd"):
        storage_mcap.DECOMPRESSORS[name] = _chunk_method(name)


def bound_reader(path: Path, reader: Any) -> Callable[[bytes], bytes]:
    """Let an open reader unpack no more than it may.

    Args:
        path: File or folder, for messages.
        reader: Reader of rosbags.

    Returns:
        What to unpack each message by.

    Raises:
        FormatError: If chunks claim more than they may.
    """
    if hasattr(reader, "chunks"):
        _bound_chunks(path, reader.chunks)
    storage = getattr(reader, "storage", None)
    claimed = 0
    for file in (storage, *getattr(storage, "storages", ())):
        for chunk in getattr(file, "chunks", ()):
            if chunk.uncompressed_size > LARGEST_CHUNK:
                raise FormatError(
                    f"{path}: expected packed parts of at most {LARGEST_CHUNK} bytes, got one of "
                    f"{chunk.uncompressed_size}; write the bag with smaller chunks"
                )
            claimed += chunk.uncompressed_size
    require_unpacked(path, claimed)
    metadata = getattr(storage, "metadata", None)
    if storage is None or getattr(metadata, "compression_mode", None) != "message":
        return bytes
    storage.metadata = storage.metadata._replace(compression_mode=None)
    return lambda message: _unpacked("zstd", message, LARGEST_CHUNK)


def require_small_files(folder: Path) -> None:
    """Refuse packed files of a bag that unpack to more than they may, before rosbags unpacks them to the disk.

    Args:
        folder: Folder of a bag.
    """
    for file in folder.glob("*.zstd"):
        size = 0
        with _zstd().open(file, "rb") as packed:
            while block := packed.read(_BLOCK):
                size += len(block)
                require_unpacked(file, size)


def _bound_chunks(path: Path, chunks: dict[int, Any]) -> None:
    """Replace what chunks of ROS 1 are unpacked by."""
    from rosbags.rosbag1 import reader as rosbag1

    names = {method: name for name, method in rosbag1.decompressors.items() if name in ("bz2", "lz4")}
    sizes: dict[int, int] = {}

    def unpack(name: str, place: int, data: bytes) -> bytes:
        content = _unpacked(name, data, LARGEST_CHUNK)
        sizes[place] = len(content)
        require_unpacked(path, sum(sizes.values()))
        return content

    for place, chunk in chunks.items():
        if chunk.decompressor in names:
            name = names[chunk.decompressor]
            chunks[place] = chunk._replace(decompressor=lambda data, name=name, place=place: unpack(name, place, data))


def _chunk_method(name: str) -> Callable[[bytes, int], bytes]:
    def unpack(data: bytes, size: int) -> bytes:
        if size > LARGEST_CHUNK:
            raise ValueError(f"expected packed parts of at most {LARGEST_CHUNK} bytes, got one of {size}")
        return _unpacked(name, data, size)

    return unpack


def _unpacked(name: str, data: bytes, most: int) -> bytes:
    """What packed bytes hold, of which there may be several streams behind each other; who opened the bag names it."""
    content = b""
    while data:
        unpacker = _unpacker(name)
        content += unpacker.decompress(data, max_length=most - len(content))
        # what is as long as allowed ends where the next byte is asked for
        if not unpacker.eof and unpacker.decompress(b"", max_length=1):
            raise ValueError(f"expected a packed part of a bag of at most {most} bytes, got more")
        if not unpacker.eof:
            raise ValueError("expected a whole packed part of a bag, got one that is cut off")
        data = unpacker.unused_data
    return content


def _unpacker(name: str) -> Any:
    if name == "bz2":
        return bz2.BZ2Decompressor()
    if name == "lz4":
        # rosbags brings it along, and reads by it
        return import_module("lz4.frame").LZ4FrameDecompressor()
    return _zstd().ZstdDecompressor()


def _zstd() -> Any:
    from rosbags.rosbag2 import reader

    return reader.zstd  # type: ignore[attr-defined]  # of Python 3.14, or its copy for older ones
