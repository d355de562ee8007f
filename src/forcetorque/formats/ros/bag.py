# SPDX-License-Identifier: BSD-3-Clause
"""Bags, opened with rosbags: topics, bytes of messages, packed parts within a limit of size; and written, in MCAP.

What rosbags unpacks by is replaced where it keeps that: for chunks of ROS 1 in each reader, for MCAP in its table of
methods.
"""

from __future__ import annotations

import bz2
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import IntArray
from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError, needs_extra
from forcetorque.base.input_file import accept_input, require_unpacked
from forcetorque.base.output_file import replaced_file

LARGEST_CHUNK = 1 << 28
"""Bytes that a packed part of a bag may unpack to."""

_BLOCK = 1 << 20


def bound_mcap() -> None:
    """Let rosbags unpack no more of a chunk of MCAP than the chunk states, and that within the limit."""
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
        # what is as long as allowed ends where the next byte is requested
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


BATCH_MESSAGES = 1 << 14
"""Messages that are held as bytes at a time."""
LARGEST_MESSAGE = 1 << 20
"""Bytes of a message of those that are read."""

_INDEX, _INDEX_KEY, _INDEX_SIZE = "metadata.yaml", b"rosbag2_bagfile_information", 1 << 20
_SIGNS = {".bag": b"#ROSBAG V2.0\n", ".mcap": b"\x89MCAP0\r\n", ".db3": b"SQLite format 3\0"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Bag:
    """An open bag."""

    path: Path
    """File or folder."""
    reader: Any
    """The reader of rosbags."""
    cdr: bool
    """Whether it is one of ROS 2."""
    unpack: Callable[[bytes], bytes]
    """What each of its messages is unpacked by."""

    @property
    def types(self) -> dict[str, str]:
        """Type of message of every topic.

        Raises:
            FormatError: If messages of two types go by one topic.
        """
        types: dict[str, str] = {}
        for connection in self.reader.connections:
            if types.setdefault(connection.topic, connection.msgtype) != connection.msgtype:
                raise FormatError(f"{self.path}: topic {connection.topic!r}: expected one type of message, got two")
        return types

    def messages(self, topic: str, *, largest: int = LARGEST_MESSAGE) -> Iterator[tuple[IntArray, list[bytes]]]:
        """Give the messages of a topic.

        Args:
            topic: The topic.
            largest: Bytes that a message may have.

        Yields:
            When some messages were received, shape (k,), ns, and their bytes.

        Raises:
            FormatError: If a message is too large.
        """
        connections = [connection for connection in self.reader.connections if connection.topic == topic]
        stamps: list[int] = []
        data: list[bytes] = []
        for _, stamp, message in self.reader.messages(connections=connections):
            content = self.unpack(message)
            if len(content) > largest:
                raise FormatError(f"{self.path}: {topic}: expected messages of at most {largest} bytes")
            stamps.append(stamp)
            data.append(content)
            if len(data) == BATCH_MESSAGES:
                yield np.array(stamps, dtype=np.int64), data
                stamps, data = [], []
        if data:
            yield np.array(stamps, dtype=np.int64), data


def is_bag(path: Path) -> bool:
    """Check whether a path is a bag, by the first bytes of a file or by the index of a folder.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it is.
    """
    if path.is_dir():
        return (path / _INDEX).is_file() and _INDEX_KEY in _first_bytes(path / _INDEX, 4096)
    return _kind(path) is not None


@contextmanager
def opened_bag(path: Path) -> Iterator[Bag]:
    """Open a bag for reading.

    Args:
        path: File or folder.

    Yields:
        The open bag.

    Raises:
        MissingExtraError: If rosbags is not installed.
        MissingFileError: If there is no such file.
        FormatError: If it is no bag, or what is read inside the context is damaged.
        ForceTorqueError: As it was raised inside the context.
    """
    with needs_extra(f"{path}: bags are read by rosbags", "ros"):
        from rosbags.rosbag1 import Reader as Reader1
        from rosbags.rosbag2 import Reader as Reader2
    _require_bag(path)
    bound_mcap()
    cdr = path.suffix != ".bag" or path.is_dir()
    try:
        require_small_files(path)
        with Reader2(path) if cdr else Reader1(path) as reader:
            yield Bag(path=path, reader=reader, cdr=cdr, unpack=bound_reader(path, reader))
    except ForceTorqueError:
        raise
    # rosbags hands on what YAML, SQLite, zstd and lz4 raise, and none of these names its errors as its own
    except Exception as error:
        reason = " ".join(f"{type(error).__name__} {error}".split())[:200]
        raise FormatError(
            f"{path}: expected a whole bag, got one that cannot be read: {reason}; `ros2 bag reindex` or `rosbag "
            "reindex` mend some"
        ) from error


def _require_bag(path: Path) -> None:
    if not path.exists():
        raise MissingFileError(f"{path}: expected a bag, there is none")
    for file in path.iterdir() if path.is_dir() else (path,):
        accept_input(file)
    if not is_bag(path):
        raise FormatError(f"{path}: expected a bag of ROS, got something else; name its file or folder")
    if path.is_dir():
        if (path / _INDEX).stat().st_size > _INDEX_SIZE:
            raise FormatError(f"{path / _INDEX}: expected at most {_INDEX_SIZE} bytes, got more; reindex the bag")
    elif path.suffix != _kind(path):
        raise FormatError(f"{path}: expected a name that ends in {_kind(path)}, by its content; rename it")


def _kind(path: Path) -> str | None:
    if not path.is_file():
        return None
    start = _first_bytes(path, 16)
    return next((suffix for suffix, sign in _SIGNS.items() if start.startswith(sign)), None)


def _first_bytes(path: Path, count: int) -> bytes:
    with path.open("rb") as file:
        return file.read(count)


def bag_files() -> Sequence[str]:
    """Name the files of a bag, for the inputs of an experiment.

    Returns:
        Patterns of their names.
    """
    return (_INDEX, "*.db3", "*.mcap", "*.zstd")


def typestore(path: Path) -> Any:
    """Give the types of messages of ROS 2.

    Args:
        path: File that they are needed for.

    Returns:
        Their store, of rosbags.

    Raises:
        MissingExtraError: If rosbags is not installed.
    """
    with needs_extra(f"{path}: MCAP is written by rosbags", "ros"):
        from rosbags.typesys import Stores, get_typestore
    return get_typestore(Stores.ROS2_HUMBLE)


@contextmanager
def mcap_writer(path: Path) -> Iterator[Any]:
    """Write a bag under a temporary name, and rename it at the end; on an error there is none.

    Args:
        path: File to write or to replace.

    Yields:
        The writer of rosbags.
    """
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

    with replaced_file(path) as temporary:
        bag = temporary.with_suffix(".bag")
        writer = Writer(bag, version=9, storage_plugin=StoragePlugin.MCAP)
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with writer:
            yield writer
        next(bag.glob("*.mcap")).replace(temporary)
