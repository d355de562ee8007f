# SPDX-License-Identifier: BSD-3-Clause
"""Numbers that are kept in a temporary file and mapped for reading, where they would fill the memory, else in it."""

from __future__ import annotations

import ctypes
import errno
import math
import mmap
import sys
import tempfile
import weakref
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import IO, Any, Final

import numpy as np
import numpy.typing as npt

from forcetorque.base.errors import OutputError

IN_MEMORY: Final = 1 << 24
"""Bytes of a stream up to which it is held in memory."""
BLOCK_ROWS: Final = 1 << 19
"""Rows of a block: 87 min at 100 Hz."""
_FEW_ROWS: Final = 1 << 14
"""The same of rows with many columns."""
_WITHOUT_FILE: Final = 1 << 20
"""Bytes of rows up to which they need no file, of which a process may have a limited number open."""


class RowsInMemory:
    """Rows that are written one after the other, in memory."""

    def __init__(self, count: int, shape: tuple[int, ...] = (), dtype: npt.DTypeLike = np.float64) -> None:
        """Take the memory.

        Args:
            count: How many rows there will be.
            shape: Shape of a row.
            dtype: Kind of the numbers.
        """
        self._rows, self._length = np.empty((count, *shape), dtype=dtype), 0

    def append(self, rows: npt.NDArray[Any]) -> None:
        """Write rows behind the others.

        Args:
            rows: Numbers; shape (n, *shape).
        """
        self._rows[self._length : self._length + len(rows)] = rows
        self._length += len(rows)

    def mapped(self) -> npt.NDArray[Any]:
        """Give all rows; no more can be written.

        Returns:
            The rows, read-only; shape (count, *shape).
        """
        self._rows.setflags(write=False)
        return self._rows


class RowsOnDisk:
    """Rows that are written one after the other, then read as one array; nothing of them is left when it is gone."""

    def __init__(self, shape: tuple[int, ...] = (), dtype: npt.DTypeLike = np.float64) -> None:
        """Begin; a file in the folder for temporary files is made when there are many rows.

        Args:
            shape: Shape of a row.
            dtype: Kind of the numbers.
        """
        self._shape, self._dtype, self._rows = shape, np.dtype(dtype), 0
        self._held: list[npt.NDArray[Any]] = []
        self._file: IO[bytes] | None = None

    def __len__(self) -> int:
        return self._rows

    def append(self, rows: npt.NDArray[Any]) -> None:
        """Write rows behind the others.

        Args:
            rows: Numbers; shape (n, *shape).

        Raises:
            OutputError: If the disk is full, or no more files can be open.
        """
        self._rows += len(rows)
        if self._file is None and self._rows * self._dtype.itemsize * math.prod(self._shape) <= _WITHOUT_FILE:
            self._held.append(np.array(rows, dtype=self._dtype))
            return
        with _named_folder():
            if self._file is None:
                self._file = tempfile.TemporaryFile()  # noqa: SIM115 closed when it is mapped, or no longer wanted
                self._close = weakref.finalize(self, self._file.close)
            for few in (*self._held, rows):
                for part in np.array_split(few, max(few.nbytes // IN_MEMORY, 1)):
                    self._file.write(np.ascontiguousarray(part, dtype=self._dtype).tobytes())
        self._held = []

    def mapped(self) -> npt.NDArray[Any]:
        """Read all rows; no more can be written.

        Returns:
            The rows, read-only; shape (n, *shape).

        Raises:
            OutputError: If the disk is full, or no more files can be open.
        """
        if self._file is None:
            rows = np.concatenate([np.zeros((0, *self._shape), dtype=self._dtype), *self._held])
            rows.setflags(write=False)
            return rows
        with _named_folder():
            self._file.flush()
            pages = mmap.mmap(self._file.fileno(), 0, access=mmap.ACCESS_READ)
        self._close()
        return np.frombuffer(pages, dtype=self._dtype).reshape(-1, *self._shape)


def rows_for(count: int, kinds: Iterable[tuple[tuple[int, ...], npt.DTypeLike]]) -> list[RowsInMemory | RowsOnDisk]:
    """Begin to write arrays, in temporary files where all together are large.

    Args:
        count: Rows that each will have.
        kinds: Shape of a row and kind of the numbers of each.

    Returns:
        A place for each.
    """
    arrays = [(shape, np.dtype(dtype)) for shape, dtype in kinds]
    if count * sum(dtype.itemsize * math.prod(shape) for shape, dtype in arrays) > IN_MEMORY:
        return [RowsOnDisk(shape, dtype) for shape, dtype in arrays]
    return [RowsInMemory(count, shape, dtype) for shape, dtype in arrays]


def _kind(array: npt.NDArray[Any]) -> tuple[tuple[int, ...], npt.DTypeLike]:
    return array.shape[1:], array.dtype


def concatenated(arrays: Sequence[npt.NDArray[Any]]) -> npt.NDArray[Any]:
    """Put arrays behind each other, in a temporary file where they are large.

    Args:
        arrays: At least one, of rows of one shape and kind.

    Returns:
        All rows, read-only.
    """
    return written(arrays, sum(map(len, arrays)), arrays[0].shape[1:], arrays[0].dtype)


def written(
    blocks: Iterable[npt.NDArray[Any]], count: int, shape: tuple[int, ...], dtype: npt.DTypeLike = np.float64
) -> npt.NDArray[Any]:
    """Put blocks of rows behind each other as they come, in a temporary file where there are many.

    Args:
        blocks: The rows.
        count: How many there are in all.
        shape: Shape of a row.
        dtype: Kind of the numbers.

    Returns:
        All rows, read-only.
    """
    (rows,) = rows_for(count, [(shape, dtype)])
    for block in blocks:
        rows.append(block)
        forget_pages([block])
    return rows.mapped()


def row_blocks(
    *arrays: npt.NDArray[Any], rows: int | None = None, overlap: int = 0
) -> Iterator[tuple[npt.NDArray[Any], ...]]:
    """Give arrays some rows at a time, and let go of the memory that mapped ones take.

    Args:
        arrays: At least one; all of n rows.
        rows: Rows of a block; few if None.
        overlap: Rows that each block has in common with the next.

    Yields:
        The same rows of each array; of at most `overlap` rows nothing.
    """
    step = _FEW_ROWS if rows is None else rows
    for start in range(0, len(arrays[0]) - overlap, step):
        yield tuple(array[start : start + step + overlap] for array in arrays)
        forget_pages(arrays)


def in_blocks(*arrays: npt.NDArray[Any]) -> Iterator[tuple[npt.NDArray[Any], ...]]:
    """Give arrays block by block, and let go of the memory that each block takes where it is mapped.

    Args:
        arrays: At least one, all of one length.

    Yields:
        The same rows of all arrays; one block of arrays with at most `BLOCK_ROWS` rows.
    """
    yield from row_blocks(*arrays, rows=BLOCK_ROWS) if len(arrays[0]) else [arrays]


def mean_over_rows(compute: Callable[..., npt.NDArray[Any]], *arrays: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Average over all rows what is computed of each, block by block.

    Args:
        compute: Computes it of a block of every array; a row per row.
        arrays: At least one, all of one length, at least one row.

    Returns:
        The mean over the rows.
    """
    return np.asarray(sum(compute(*block).sum(axis=0) for block in in_blocks(*arrays)) / len(arrays[0]))


def computed_rows(
    compute: Callable[..., tuple[npt.NDArray[Any], ...]], *arrays: npt.NDArray[Any]
) -> tuple[npt.NDArray[Any], ...]:
    """Compute rows of rows, some at a time; they are in a temporary file where they are large.

    Args:
        compute: Gives float64 arrays with a row for each row of its arguments.
        arrays: Its arguments; all of n rows, at least one.

    Returns:
        What it gives, for all rows, read-only.
    """
    count, all_rows = len(arrays[0]), None
    for blocks in row_blocks(*arrays):
        computed = compute(*blocks)
        if all_rows is None:
            all_rows = rows_for(count, map(_kind, computed))
        for rows, block in zip(all_rows, computed, strict=True):
            rows.append(block)
    return tuple(rows.mapped() for rows in all_rows or ())


def rows_where(kept: npt.NDArray[np.bool_], arrays: Sequence[npt.NDArray[Any]]) -> tuple[npt.NDArray[Any], ...]:
    """Leave rows out.

    Args:
        kept: Rows to keep; shape (n,).
        arrays: Arrays of n rows.

    Returns:
        The others, read-only where some are left out; in a temporary file where they are large.
    """
    if kept.all():
        return tuple(arrays)
    chosen = rows_for(int(kept.sum()), map(_kind, arrays))
    for is_kept, *blocks in row_blocks(kept, *arrays):
        for rows, block in zip(chosen, blocks, strict=True):
            rows.append(block[is_kept])
    return tuple(rows.mapped() for rows in chosen)


@contextmanager
def _named_folder() -> Iterator[None]:
    try:
        yield
    except OSError as error:
        expected, remedy = _EXPECTED.get(error.errno or 0, _A_FILE)
        folder = tempfile.tempdir or "folder for temporary files"
        got = error.strerror or error
        raise OutputError(
            f"{folder}: expected {expected} for a long recording while it is read, got {got}; {remedy}"
        ) from error


_ROOM: Final = "room", "name a folder of a larger disk in the environment variable TMPDIR"
_A_FILE: Final = "a temporary file", "name another folder in the environment variable TMPDIR"
_ONE_MORE: Final = "one more temporary file", "allow more open files (ulimit -n)"
_EXPECTED: Final = {
    errno.ENOSPC: _ROOM,
    errno.EDQUOT: _ROOM,
    errno.EMFILE: _ONE_MORE,
    errno.ENFILE: _ONE_MORE,
}
"""What was expected, and what to do, by the number of an error."""


def forget_pages(arrays: Iterable[npt.NDArray[Any]]) -> None:
    """Let go of memory that mapped arrays take; what is looked at again is read from the file again.

    Args:
        arrays: Arrays, of which those that are no view of a mapped file are left alone.
    """
    for pages in {id(pages): pages for pages in map(_pages_of, arrays) if pages is not None}.values():
        if sys.platform != "win32":
            pages.madvise(mmap.MADV_DONTNEED)


def return_freed_memory() -> None:
    """Give the system back what was freed, which glibc keeps between large arrays; other C libraries are left alone."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None) if sys.platform == "linux" else None
    if trim is not None:
        trim(ctypes.c_size_t(0))


def _pages_of(array: Any) -> mmap.mmap | None:
    while isinstance(array, np.ndarray):
        array = array.base
    if isinstance(array, memoryview):
        array = array.obj
    return array if isinstance(array, mmap.mmap) else None
