# SPDX-License-Identifier: BSD-3-Clause
"""MATLAB files of version 5 to 7 are read as SciPy reads them, and say what of them is no array of numbers."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from scipy.io import loadmat, savemat
from scipy.sparse import csc_array

from forcetorque.base.errors import FormatError
from forcetorque.formats.array_file.matlab import DEEPEST, matlab_contents, read_matlab
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.inspect import inspect_log
from tests.fuzzing import examples

KINDS = ["f8", "f4", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "?"]
MIXED: dict[str, Any] = {
    "t": np.arange(3.0)[:, None],
    "log": {"ft": np.ones((3, 6)), "note": "a text", "arm": {"q": np.eye(3)}},
    "runs": np.array([(1.0, 2.0), (3.0, 4.0)], dtype=[("force", "O"), ("time", "O")])[None, :],
    "cells": np.array([np.eye(2), "a"], dtype=object),
    "none": np.zeros((0, 3)),
    "cube": np.zeros((2, 3, 4)),
    "phasor": np.eye(2) * 1j,
    "sparse": csc_array(np.eye(6)),
}


@settings(max_examples=examples(40), deadline=None)
@given(data=st.data(), packed=st.booleans())
def test_numbers_are_those_that_scipy_reads(
    data: st.DataObject, packed: bool, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Every type of numbers, in a struct or not, packed or not, bit by bit."""
    path = tmp_path_factory.getbasetemp() / "numbers.mat"
    shapes = array_shapes(min_dims=2, max_dims=2, max_side=7)
    written = {}
    for k in range(data.draw(st.integers(1, 3))):
        written[f"v{k}"] = data.draw(arrays(np.dtype(data.draw(st.sampled_from(KINDS))), shapes))
    savemat(path, {**written, "s": written}, do_compression=packed)
    expected = loadmat(path)
    names = [*written, *(f"s.{name}" for name in written)]
    got = read_matlab(path, names)
    assert sorted(got) == sorted(names)
    for name in written:
        for read in (got[name], got[f"s.{name}"]):
            np.testing.assert_array_equal(read, np.asarray(expected[name], dtype=np.float64))


def test_what_is_no_array_of_numbers_is_named(tmp_path: Path) -> None:
    """Arrays of structs, cells, texts and others, by their size."""
    savemat(tmp_path / "log.mat", MIXED)
    shapes, skipped = matlab_contents(tmp_path / "log.mat")
    assert shapes == {"t": (3, 1), "log.ft": (3, 6), "log.arm.q": (3, 3)}
    assert skipped == {
        "log.note": "1 x 6 text",
        "runs": "1 x 2 struct array",
        "cells": "1 x 2 cell array",
        "none": "empty",
        "cube": "2 x 3 x 4 numbers",
        "phasor": "2 x 2 complex numbers",
        "sparse": "6 x 6 sparse matrix",
    }


def _element(order: str, kind: int, data: bytes) -> bytes:
    return struct.pack(f"{order}2I", kind, len(data)) + data + bytes(-len(data) % 8)


def _matrix(order: str, name: str, values: np.ndarray) -> bytes:
    flags = _element(order, 6, struct.pack(f"{order}2I", 6, 0))
    shape = _element(order, 5, struct.pack(f"{order}2i", *values.shape))
    numbers = _element(order, 9, values.astype(f"{order}f8").tobytes(order="F"))
    return _element(order, 14, flags + shape + _element(order, 1, name.encode()) + numbers)


def _file(order: str, *elements: bytes) -> bytes:
    header = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack(f"{order}H", 0x0100) + struct.pack(f"{order}H", 0x4D49)
    return header + b"".join(elements)


@pytest.mark.parametrize("order", ["<", ">"])
def test_either_order_of_bytes_is_read(tmp_path: Path, order: str) -> None:
    """Written by hand; SciPy reads the same."""
    values = np.arange(12.0).reshape(4, 3)
    path = tmp_path / "log.mat"
    path.write_bytes(_file(order, _matrix(order, "ft", values)))
    np.testing.assert_array_equal(read_matlab(path, ["ft"])["ft"], values)
    np.testing.assert_array_equal(loadmat(path)["ft"], values)


def _packed(element: bytes) -> bytes:
    data = zlib.compress(element)
    return struct.pack("<2I", 15, len(data)) + data


SOUND = _matrix("<", "q", np.eye(3))
DAMAGED = {
    "size beyond the file": (SOUND[:4] + b"\xff\xff\xff\x7f" + SOUND[8:], "the file ends|beyond its end"),
    "other element": (b"\x09" + SOUND[1:], "an element of type 9"),
    "class": (SOUND.replace(struct.pack("<4I", 6, 8, 6, 0), struct.pack("<4I", 6, 8, 99, 0)), "class 99"),
    "fewer numbers": (SOUND.replace(struct.pack("<2i", 3, 3), struct.pack("<2i", 3, 4)), "72 bytes for 3 x 4 numbers"),
    "negative size": (SOUND.replace(struct.pack("<2i", 3, 3), struct.pack("<2i", -3, -3)), "dimensions"),
    "numbers of no type": (SOUND.replace(struct.pack("<2I", 9, 72), struct.pack("<2I", 8, 72)), "numbers of type 8"),
    "packed, cut": (_packed(SOUND)[:-9], "beyond its end"),
    "packed, longer than it says": (_packed(SOUND + SOUND), "not as many as its tag specifies"),
    "packed, shorter than it says": (_packed(SOUND[:-16]), "not as many as its tag specifies"),
    "packed twice": (_packed(_packed(SOUND)), "a packed element of type 15"),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_what_is_damaged_is_refused_by_its_place(tmp_path: Path, name: str) -> None:
    """Behind a sound variable, which begins at byte 128."""
    element, message = DAMAGED[name]
    path = tmp_path / "log.mat"
    path.write_bytes(_file("<", SOUND, element))
    with pytest.raises(FormatError, match=rf"log.mat: variable at byte {128 + len(SOUND)}: .*({message})"):
        matlab_contents(path)


def test_structs_in_structs_end_somewhere(tmp_path: Path) -> None:
    """As deep as anyone needs, and no deeper."""
    inner: dict[str, Any] = {"q": np.eye(2)}
    for _ in range(DEEPEST - 1):
        inner = {"s": inner}
    savemat(tmp_path / "log.mat", {"s": inner})
    assert list(matlab_contents(tmp_path / "log.mat")[0]) == [f"{'s.' * DEEPEST}q"]
    savemat(tmp_path / "log.mat", {"s": {"s": inner}})
    with pytest.raises(FormatError, match=f"expected structs at most {DEEPEST} deep"):
        matlab_contents(tmp_path / "log.mat")


def test_what_cannot_be_read_is_said(tmp_path: Path) -> None:
    """By `inspect`, and by `init` in its answer and in the file; a file of nothing else is refused."""
    savemat(tmp_path / "log.mat", MIXED)
    inspection = inspect_log(tmp_path / "log.mat")
    words = (
        "not read, for only arrays of real numbers within the file are: log.note (1 x 6 text), "
        "runs (1 x 2 struct array), "
    )
    assert inspection.skipped_arrays["runs"] == "1 x 2 struct array"
    assert any(str(block).startswith(words) for block in inspection.blocks())
    draft = draft_experiment(tmp_path / "log.mat")
    assert any(note.startswith(words) for note in draft.notes)
    assert f"# {words}" in draft.content
    savemat(tmp_path / "log.mat", {"runs": MIXED["runs"]})
    for read in (inspect_log, draft_experiment):
        with pytest.raises(
            FormatError, match=r"expected arrays of real numbers, got runs \(1 x 2 struct array\); save"
        ):
            read(tmp_path / "log.mat")
