# SPDX-License-Identifier: BSD-3-Clause
"""Arrays over time packed for a page: compressed blocks of 16-bit differences, unpacked when they are first looked at.

A packed array of n rows and c columns is, little-endian:

- uint32: rows of a block, and number of blocks b; b + 1 uint32: where each block begins, from the first one;
- c float64: step of each column; every part starts at a multiple of 8;
- b blocks, each raw DEFLATE of: c int32 values before the first, c int32 differences before the first, c uint8
  exponents, c uint8 orders, then for every column the low bytes of the differences of its rows and the high bytes.

A value is an integer times the step times 2 to the exponent of its block and column, so it is off by half of that at
most. The integers are sums of the differences, or sums of sums where the order is 2. Differences are zigzag (0, -1, 1,
-2, ...); 65535 stands for NaN, and the sum goes on as if it were 0. An exponent above 0 keeps differences in 16 bits.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray
from forcetorque.viewer.arrays import ALIGNMENT, read_array
from forcetorque.viewer.scene import ArrayRef, Scene
from forcetorque.viewer.scene_builder import BuiltScene

ROWS = 4096
"""Rows of a block."""
RESOLUTION = 2.0**-17
"""Largest step, as a share of the range of a column."""
NOISE_SHARE = 0.25
"""Largest step, as a share of the noise of a column where that is larger."""
LEAST_STEPS = 1.0 / 32.0
"""Largest step, as a share of the range, of a column that is nothing but noise."""
POSE_STEP = 5e-7
"""Step of joint positions and of the pose of the root; rad, m, or a component of a quaternion."""
_ABSENT, _LARGEST = 65535, 32767
_LEVEL = 4
_OUTLYING = 100.0
"""Range of a column from which on it has outliers, as a multiple of the range without its outermost samples."""
_OUTERMOST = 0.1
"""Share of the samples at each end of that range that are the outermost, at least one; %."""


def packed(built: BuiltScene) -> BuiltScene:
    """Pack the arrays of a scene that have a row for each sample; all others stay as they are.

    So does an array with outliers: one damaged sample would set the step of its column, and hide all others.

    Args:
        built: A scene whose arrays are not packed.

    Returns:
        The scene with a smaller block.
    """
    parts: list[bytes] = []
    size = 0
    known: dict[tuple[int, tuple[int, ...]], ArrayRef] = {}

    def moved(reference: ArrayRef) -> ArrayRef:
        nonlocal size
        key = (reference.offset, reference.shape)
        if key in known:
            return known[key]
        values = read_array(built.block, reference)
        over_time = reference.dtype == "float32" and len(values) == built.scene.samples and values.ndim == 2
        if over_time and values.size and not _has_outliers(values):
            poses = reference in (built.scene.positions, built.scene.root)
            data = pack(values, POSE_STEP if poses else None)
            moved_to = replace(reference, offset=size, packed_bytes=len(data))
        else:
            data = values.tobytes()
            moved_to = replace(reference, offset=size)
        data += b"\0" * (-len(data) % ALIGNMENT)
        parts.append(data)
        size += len(data)
        known[key] = moved_to
        return moved_to

    scene: Scene = _with_references(built.scene, moved)
    return replace(built, scene=scene, block=b"".join(parts))


def _has_outliers(values: npt.NDArray[Any]) -> bool:
    """Whether a few samples span far more than all others of their column."""
    table = np.where(np.isfinite(values), values, np.nan).astype(np.float64)
    table = table[:, ~np.isnan(table).all(axis=0)]
    if not table.size:
        return False
    low = np.nanpercentile(table, _OUTERMOST, axis=0, method="higher")
    high = np.nanpercentile(table, 100.0 - _OUTERMOST, axis=0, method="lower")
    return bool((np.nanmax(table, axis=0) - np.nanmin(table, axis=0) > _OUTLYING * (high - low)).any())


def _with_references(node: Any, moved: Any) -> Any:
    """The same with every reference to an array exchanged."""
    if isinstance(node, ArrayRef):
        return moved(node)
    if isinstance(node, tuple):
        return tuple(_with_references(one, moved) for one in node)
    if is_dataclass(node) and not isinstance(node, type):
        values = {field.name: getattr(node, field.name) for field in fields(node)}
        return replace(node, **{name: _with_references(value, moved) for name, value in values.items()})
    return node


def pack(values: npt.NDArray[Any], step: float | None = None) -> bytes:
    """Pack one array.

    Args:
        values: Rows over time, NaN where absent; shape (n, c).
        step: Largest step of all columns; None for one by range and noise of each.

    Returns:
        The packed form, as above.
    """
    table = np.asarray(values, dtype=np.float64)
    columns = table.shape[1]
    absent = ~np.isfinite(table)
    filled = _filled(table, absent)
    steps = np.full(columns, step) if step is not None else _steps(filled)
    blocks = [
        _block(filled[start : start + ROWS], absent[start : start + ROWS], steps)
        for start in range(0, len(table), ROWS)
    ]
    starts = np.concatenate([[0], np.cumsum([len(block) for block in blocks])]).astype("<u4")
    head = struct.pack("<II", ROWS, len(blocks)) + starts.tobytes()
    head += b"\0" * (-len(head) % ALIGNMENT)
    return b"".join([head, steps.astype("<f8").tobytes(), *blocks])


def unpack(data: bytes, shape: tuple[int, int]) -> FloatArray:
    """Read one array, as the page does.

    Args:
        data: The packed form.
        shape: Its shape (n, c).

    Returns:
        Values of that shape.
    """
    rows, count = struct.unpack_from("<II", data)
    samples, columns = shape
    starts = np.frombuffer(data, "<u4", count + 1, 8)
    place = _aligned(8 + 4 * (count + 1))
    steps = np.frombuffer(data, "<f8", columns, place)
    first = place + 8 * columns
    values = np.empty(shape)
    for k in range(count):
        part = zlib.decompress(data[first + starts[k] : first + starts[k + 1]], -15)
        length = min(rows, samples - k * rows)
        begin, slope = np.frombuffer(part, "<i4", 2 * columns).reshape(2, columns).astype(np.int64)
        exponents, orders = np.frombuffer(part, np.uint8, 2 * columns, 8 * columns).reshape(2, columns)
        pieces = np.frombuffer(part, np.uint8, 2 * columns * length, 10 * columns).reshape(columns, 2, length)
        coded = pieces[:, 0].astype(np.int64) + 256 * pieces[:, 1].astype(np.int64)
        differences = np.where(coded == _ABSENT, 0, (coded >> 1) ^ -(coded & 1))
        for column in range(columns):
            change = differences[column]
            if orders[column] == 2:
                change = slope[column] + np.cumsum(change)
            whole = begin[column] + np.cumsum(change)
            whole = np.where(coded[column] == _ABSENT, np.nan, whole)
            values[k * rows : k * rows + length, column] = whole * steps[column] * 2.0 ** int(exponents[column])
    return values


def _aligned(size: int) -> int:
    return size + -size % ALIGNMENT


def _filled(table: FloatArray, absent: npt.NDArray[np.bool_]) -> FloatArray:
    """The last value before where one is absent, the first one at the beginning, 0 where there is none."""
    if not absent.any():
        return table
    rows = np.arange(len(table))[:, None]
    last = np.maximum.accumulate(np.where(absent, -1, rows), axis=0)
    first = np.argmax(~absent, axis=0)
    filled = np.take_along_axis(table, np.where(last < 0, first, last), axis=0)
    return np.where(absent.all(axis=0), 0.0, filled)


def _steps(filled: FloatArray) -> FloatArray:
    """A step that is far below range and noise of each column."""
    spread = np.ptp(filled, axis=0)
    # fourth differences of independent samples have 70 times their variance; those of a motion nearly vanish
    fourth = np.abs(np.diff(filled, n=4, axis=0)) if len(filled) > 4 else np.zeros((1, filled.shape[1]))
    noise = np.median(fourth, axis=0) * (1.4826 / np.sqrt(70.0))
    steps: FloatArray = np.maximum(RESOLUTION * spread, 0.0)
    steps = np.where(noise > 0.0, np.maximum(steps, np.minimum(NOISE_SHARE * noise, LEAST_STEPS * spread)), steps)
    return np.where(steps > 0.0, steps, np.maximum(np.abs(filled).max(axis=0), 1.0) * 2.0**-30)


def _block(filled: FloatArray, absent: npt.NDArray[np.bool_], steps: FloatArray) -> bytes:
    sizes = [np.abs(np.diff(filled, n=order, axis=0)).sum(axis=0) for order in (1, 2)]
    # a sum of sums would run on where values are absent
    orders = np.where((sizes[1] < sizes[0]) & ~absent.any(axis=0), 2, 1)
    exponents = np.zeros(filled.shape[1], dtype=np.uint8)
    while True:
        whole = np.rint(filled / (steps * 2.0**exponents)).astype(np.int64)
        change = np.diff(whole, axis=0, prepend=whole[:1])
        slope = change[1] if len(change) > 1 else change[0]
        twice = np.diff(change, axis=0, prepend=change[:1])
        twice[:2] = 0  # the slope before the first value is that after it
        differences = np.where(orders == 2, twice, change)
        too_large = (np.abs(differences) >= _LARGEST).any(axis=0) | (np.abs(whole[0]) >= 2**30)
        if not too_large.any():
            break
        exponents[too_large] += 1
    begin = np.where(orders == 2, whole[0] - slope, whole[0])
    zigzag = np.where(differences < 0, -2 * differences - 1, 2 * differences)
    coded = np.ascontiguousarray(np.where(absent, _ABSENT, zigzag).T.astype("<u2"))
    pieces = np.stack([(coded & 255).astype(np.uint8), (coded >> 8).astype(np.uint8)], axis=1)
    payload = np.stack([begin, slope]).astype("<i4").tobytes()
    payload += exponents.tobytes() + orders.astype(np.uint8).tobytes() + pieces.tobytes()
    deflate = zlib.compressobj(_LEVEL, zlib.DEFLATED, -15)
    return deflate.compress(payload) + deflate.flush()
