# SPDX-License-Identifier: BSD-3-Clause
"""Rows in a temporary file are the rows that were written, also after their memory was given back."""

from __future__ import annotations

import errno
import mmap
import os
import platform
import tempfile
from pathlib import Path
from typing import IO

import numpy as np
import pytest

from forcetorque.base import rows_on_disk
from forcetorque.base.arrays import FloatArray, IntArray, is_frozen
from forcetorque.base.errors import OutputError
from forcetorque.base.rows_on_disk import (
    RowsOnDisk,
    computed_rows,
    concatenated,
    forget_pages,
    return_freed_memory,
    row_blocks,
    rows_where,
)


@pytest.mark.parametrize("dtype", [np.float64, np.int64])
def test_rows_are_those_that_were_written(monkeypatch: pytest.MonkeyPatch, dtype: type) -> None:
    """Of any parts, read-only, with views that keep the file; an array in memory has nothing to forget."""
    written: FloatArray | IntArray = (np.random.default_rng(1).normal(size=(1000, 3)) * 1e6).astype(dtype)
    monkeypatch.setattr(rows_on_disk, "_WITHOUT_FILE", 0)
    rows = RowsOnDisk((3,), dtype)
    for part in np.array_split(written, 7):
        rows.append(part)
    assert len(rows) == 1000
    mapped = rows.mapped()
    view = mapped[100:200]
    assert is_frozen(mapped, dtype)
    assert is_frozen(view, dtype)
    forget_pages([mapped, view, written])
    assert np.array_equal(mapped, written)
    assert np.array_equal(view, written[100:200])


def test_freed_memory_is_returned() -> None:
    """What lies between arrays that are kept, which glibc holds back; without glibc nothing is done."""
    arrays = [np.ones(10_000) for _ in range(1000)]
    full = _resident_bytes()
    arrays = arrays[::20]
    freed = _resident_bytes()
    return_freed_memory()
    assert len(arrays) == 50
    if platform.libc_ver()[0] == "glibc":
        assert full - freed < 10e6 < 50e6 < freed - _resident_bytes()


def _resident_bytes() -> int:
    statistics = Path("/proc/self/statm")
    return int(statistics.read_text(encoding="ascii").split()[1]) * mmap.PAGESIZE if statistics.exists() else 0


@pytest.mark.parametrize("count", [1, 6, 7, 8, 50])
def test_rows_are_computed_and_chosen_block_by_block(monkeypatch: pytest.MonkeyPatch, count: int) -> None:
    """As all at once, in memory and in files; blocks with an overlap have every pair of neighbours once."""
    numbers = np.random.default_rng(count).normal(size=(count, 3))
    stamps, kept = np.arange(count), numbers[:, 0] > 0.0
    monkeypatch.setattr(rows_on_disk, "_FEW_ROWS", 7)
    for limit in (1 << 24, 1):
        monkeypatch.setattr(rows_on_disk, "IN_MEMORY", limit)
        double, sums = computed_rows(lambda rows, k: (2.0 * rows, rows.sum(axis=1) + k), numbers, stamps)
        assert np.array_equal(double, 2.0 * numbers)
        assert np.array_equal(sums, numbers.sum(axis=1) + stamps)
        assert is_frozen(double)
        for one, other in zip(rows_where(kept, [numbers, stamps]), (numbers, stamps), strict=True):
            assert one.dtype == other.dtype
            assert np.array_equal(one, other[kept])
    assert rows_where(np.ones(count, dtype=bool), [numbers])[0] is numbers
    steps = [np.diff(rows) for (rows,) in row_blocks(stamps**2, overlap=1)]
    assert np.array_equal(np.concatenate([np.zeros(0, dtype=np.int64), *steps]), np.diff(stamps**2))


def test_few_rows_need_no_file(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of many intervals each has few; they are copies, and come first in the file when there are more."""
    made: list[IO[bytes]] = []
    temporary_file = tempfile.TemporaryFile

    def counted() -> IO[bytes]:
        made.append(temporary_file())
        return made[-1]

    monkeypatch.setattr(tempfile, "TemporaryFile", counted)
    few = np.arange(30.0).reshape(10, 3)
    rows, again = RowsOnDisk((3,)), RowsOnDisk((3,))
    for one in (rows, again):
        one.append(few)
    few += 1.0
    assert np.array_equal(rows.mapped(), few - 1.0)
    assert is_frozen(rows.mapped())
    assert not made
    again.append(np.ones((1 << 17, 3)))
    assert np.array_equal(again.mapped()[:11], [*(few - 1.0), np.ones(3)])
    assert len(made) == 1


@pytest.mark.parametrize("place", ["TemporaryFile", "mmap"])
def test_too_many_open_files_are_no_full_disk(monkeypatch: pytest.MonkeyPatch, place: str) -> None:
    """Where a file is made, and where it is mapped."""

    class NoMore(mmap.mmap):
        def __new__(cls, *_: object, **__: object) -> NoMore:
            raise OSError(errno.EMFILE, os.strerror(errno.EMFILE))

    monkeypatch.setattr(rows_on_disk, "IN_MEMORY", 1 << 20)
    monkeypatch.setattr(tempfile if place == "TemporaryFile" else mmap, place, NoMore)
    with pytest.raises(OutputError, match=r"expected one more temporary file .* Too many open files; .*ulimit -n"):
        concatenated([np.zeros(1 << 18)])


def test_no_rows_are_an_empty_array() -> None:
    """A file without a byte cannot be mapped."""
    assert RowsOnDisk((4,)).mapped().shape == (0, 4)
    assert is_frozen(RowsOnDisk().mapped())


def test_a_full_disk_names_the_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    """And the variable that names another one."""
    full = Path("/dev/full")
    if not full.exists():
        pytest.skip("no device that is always full")
    monkeypatch.setattr(tempfile, "TemporaryFile", lambda: full.open("wb"))
    rows = RowsOnDisk()
    with pytest.raises(OutputError, match=r"No space left on device; name a folder .* TMPDIR"):
        rows.append(np.zeros(1_000_000))


@pytest.mark.parametrize("in_memory", [0, 1000, 1 << 20])
def test_arrays_behind_each_other(monkeypatch: pytest.MonkeyPatch, in_memory: int) -> None:
    """In a file or in memory, of arrays in memory or in files, in any number of parts."""
    monkeypatch.setattr(rows_on_disk, "IN_MEMORY", max(in_memory, 1))
    arrays = np.array_split(np.random.default_rng(2).normal(size=(1000, 3)), 4)
    first = concatenated(arrays[:2])
    whole = concatenated([first, *arrays[2:]])
    assert is_frozen(whole)
    assert np.array_equal(whole, np.concatenate(arrays))
