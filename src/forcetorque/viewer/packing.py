# SPDX-License-Identifier: BSD-3-Clause
"""Arrays over time packed for a page: compressed blocks of 16-bit differences, unpacked when they are first looked at.

A packed array of n rows and c columns is, little-endian:

- uint32: rows of a block, and number of blocks b; b + 1 uint32: where each block begins, from the first one;
- c float64: step of each column; every part starts at a multiple of 8;
- b blocks, each of: c int32 values before the first, c int32 differences before the first, c uint8 exponents, c uint8
  orders, 128 more where the first row is absent; then raw DEFLATE of, for every column, the low bytes of the
  differences of its rows and the high bytes. So the first row of a block is known before it is unpacked.

A value is an integer times the step times 2 to the exponent of its block and column, so it is off by half of that at
most. The integers are sums of the differences, or sums of sums where the order is 2. Differences are zigzag (0, -1, 1,
-2, ...); 65535 stands for NaN, and the sum goes on as if it were 0. An exponent above 0 keeps differences in 16 bits.

A calibration is a linear map of what the first measured series of its sensor shows, and an offset. Where that holds,
the map is in the header (`ArrayRef.matrix`), and what is packed is the difference, which is constant.

Extremes and sums of blocks of a long log come with it, so that the page draws all of it before it unpacks a sample.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.viewer.scene import ArrayRef, Scene, Sensor, SeriesOverview, WrenchSeries
from forcetorque.viewer.scene_arrays import ALIGNMENT, Block, peak, read_array
from forcetorque.viewer.scene_builder import BuiltScene

BLOCK = 256
"""Samples of a block; about as many as a pixel of the plots shows of half an hour at 100 Hz."""
FEWEST_SAMPLES = 1 << 16
"""Samples from which on a log has an overview; of fewer the page unpacks all as quickly."""
MOST_POINTS = 5_000
"""Largest number of points of a series in the space of forces."""

_Table = npt.NDArray[np.float32]


def with_overviews(built: BuiltScene) -> BuiltScene:
    """Add to every series over time what the page shows of all of it.

    Args:
        built: A scene whose arrays are not packed.

    Returns:
        The same scene, with overviews at the end of its block where it has at least `FEWEST_SAMPLES`.
    """
    scene = built.scene
    if scene.time_s.shape[0] < FEWEST_SAMPLES:
        return built
    added = Block(begin=len(built.block))
    ignored = _ignored(scene, built.block)
    sensors = tuple(_with_overview(sensor, built.block, ignored, added) for sensor in scene.sensors)
    return replace(built, scene=replace(scene, sensors=sensors), block=built.block + added.bytes())


def _ignored(scene: Scene, block: bytes) -> BoolArray:
    """Samples of ignored intervals, as the page finds them; shape (n,)."""
    time_s = read_array(block, scene.time_s)
    ignored = np.zeros(len(time_s), dtype=bool)
    for interval in scene.intervals:
        if interval.use == "ignore":
            start, end = np.searchsorted(time_s, [interval.start_s, interval.end_s])
            ignored[start:end] = True
    return ignored


def _with_overview(sensor: Sensor, block: bytes, ignored: BoolArray, added: Block) -> Sensor:
    expected = next((series for series in sensor.wrenches if series.role == "expected"), None)
    reference = None if expected is None else _series_columns(read_array(block, expected.values))

    def seen(series: WrenchSeries) -> WrenchSeries:
        values = read_array(block, series.values)
        wrench = _series_columns(values)
        error = deviation = None
        if reference is not None and series is not expected:
            difference = wrench - reference
            difference[:, ignored] = np.nan
            error = added.add(_with_sums(_with_norms(difference)), "float32")
        if series.deviation is not None:
            spread = _with_norms(_series_columns(read_array(block, series.deviation)))
            deviation = added.add(np.concatenate(_extremes(spread)).T, "float32")
        every = -(-len(values) // MOST_POINTS)
        return replace(
            series,
            overview=SeriesOverview(
                samples=BLOCK,
                wrench=added.add(np.concatenate(_extremes(_with_norms(wrench))).T, "float32"),
                error=error,
                deviation=deviation,
                every=every,
                points=added.add(values[::every], "float32"),
            ),
        )

    return replace(sensor, wrenches=tuple(map(seen, sensor.wrenches)))


def _series_columns(values: npt.NDArray[np.float32]) -> _Table:
    """Each column without gaps in memory; shape (6, n)."""
    return np.ascontiguousarray(values.T)


def _with_norms(wrench: _Table) -> _Table:
    """Components of force and moment, each followed by its norm; shape (8, n)."""
    rows = [np.vstack([wrench[part], np.sqrt(np.square(wrench[part]).sum(axis=0))]) for part in FORCE_AND_MOMENT]
    return np.concatenate(rows)


def _blocks(values: _Table) -> _Table:
    """Whole blocks; shape (8, b, BLOCK)."""
    count = values.shape[1] // BLOCK
    return values[:, : count * BLOCK].reshape(len(values), count, BLOCK)


def _extremes(values: _Table) -> tuple[_Table, _Table]:
    """Lowest and highest value of each block, NaN where all are absent; shape (8, b) each."""
    blocks = _blocks(values)
    absent = np.isnan(blocks)
    if not absent.any():
        return blocks.min(axis=2), blocks.max(axis=2)
    low = np.where(absent, np.float32(np.inf), blocks).min(axis=2)
    high = np.where(absent, np.float32(-np.inf), blocks).max(axis=2)
    none = low > high
    return np.where(none, np.float32(np.nan), low), np.where(none, np.float32(np.nan), high)


def _with_sums(values: _Table) -> npt.NDArray[np.float64]:
    """Lowest, highest, sum, sum of squares and number of the values of each block; shape (b, 40)."""
    blocks = _blocks(values)
    known = ~np.isnan(blocks)
    filled = np.where(known, blocks, np.float32(0.0))
    sums = filled.sum(axis=2, dtype=np.float64), np.einsum("cbs,cbs->cb", filled, filled, dtype=np.float64)
    return np.concatenate([*_extremes(values), *sums, known.sum(axis=2)]).T


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
BAND_STEP = 2.0**-8
"""Step of a standard deviation, as a share of the largest of its column: bands are drawn, not read."""
ARROW_STEP = 2.0**-11
"""Step of contact wrenches and of the points of overviews, as a share of the largest: both are drawn, not read."""
_ABSENT, _LARGEST = 65535, 32767
_FIRST_ABSENT = 128
_LINEAR, _ALMOST_ALL = 0.1, 0.99
"""Largest change of what a linear map leaves, in steps, and the share of samples that hold it."""
_FEWEST = 20
"""Changes for each column from which a linear map is computed."""
_FINER = 16.0
"""Steps of what a linear map leaves, in a step of the values."""
_AMPLIFIED = 2.0
"""Largest step that a linear map makes of those of its argument, in steps of the result."""
_LEVEL = 4
_OUTLYING = 100.0
"""Range of a column from which on it has outliers, as a multiple of the range without its outermost samples."""
_OUTERMOST = 0.1
"""Share of the samples at each end of that range that are the outermost, at least one; %."""


def packed(built: BuiltScene, progress: Progress = lambda _: None) -> BuiltScene:
    """Pack the arrays of a scene that have a row for each sample, or are points of its overviews; no others.

    Overviews are added first, so that they are of the values before packing.

    So does an array with outliers: one damaged sample would set the step of its column, and hide all others.

    Args:
        built: A scene whose arrays are not packed.
        progress: Called with the time that is left, of a scene that takes longer than a few seconds.

    Returns:
        The scene with a smaller block.
    """
    built = with_overviews(built)
    parts: list[bytes] = []
    size = done = 0
    time_left = TimeLeft(progress, "packing the page", len(built.block))
    known: dict[tuple[int, tuple[int, ...]], ArrayRef] = {}
    steps, bases = _largest_steps(built), _bases(built.scene)
    points = {overview.points.offset for overview in _overviews(built.scene)}

    def moved(reference: ArrayRef) -> ArrayRef:
        nonlocal size, done
        key = (reference.offset, reference.shape)
        if key in known:
            return known[key]
        values = read_array(built.block, reference)
        moved_to = reference
        time_left.at(done)
        done += values.nbytes
        has_rows = reference.offset in points or len(values) == built.scene.samples
        over_time = reference.dtype == "float32" and has_rows and values.ndim == 2
        if over_time and values.size and not _has_outliers(values):
            base = bases.get(reference.offset)
            rest = None if base is None else _rest(values, read_array(built.block, base))
            if base is not None and rest is not None:
                matrix, left, step = rest
                data = pack(left, step)
                moved_to = replace(reference, base=moved(base), matrix=tuple(matrix.ravel().tolist()))
            else:
                data = pack(values, steps.get(reference.offset))
            moved_to = replace(moved_to, offset=size, packed_bytes=len(data))
        else:
            data = values.tobytes()
            moved_to = replace(moved_to, offset=size)
        data += b"\0" * (-len(data) % ALIGNMENT)
        parts.append(data)
        size += len(data)
        known[key] = moved_to
        return moved_to

    scene: Scene = _with_references(built.scene, moved)
    return replace(built, scene=scene, block=b"".join(parts))


def _largest_steps(built: BuiltScene) -> dict[int, FloatArray | float]:
    """Steps of arrays, by their place, that range and noise do not set."""
    scene, block = built.scene, built.block
    steps: dict[int, FloatArray | float] = {array.offset: POSE_STEP for array in (scene.positions, scene.root)}
    for array in (one.deviation for sensor in scene.sensors for one in sensor.wrenches):
        if array is not None:
            steps[array.offset] = _some(BAND_STEP * np.nanmax(read_array(block, array), axis=0, initial=0.0))
    peaks = [peak(read_array(block, contact.values)) for contact in scene.contacts]
    if peaks:
        arrow = _some(ARROW_STEP * np.repeat(np.max(peaks, axis=0), 3))
        steps |= {contact.values.offset: arrow for contact in scene.contacts}
    for overview in _overviews(scene):
        points = read_array(block, overview.points)
        steps[overview.points.offset] = _some(ARROW_STEP * np.repeat(peak(points), 3))
    return steps


def _overviews(scene: Scene) -> Iterator[SeriesOverview]:
    for sensor in scene.sensors:
        yield from (series.overview for series in sensor.wrenches if series.overview is not None)


def _some(steps: FloatArray) -> FloatArray:
    """1 where nothing is above 0."""
    return np.where(steps > 0.0, steps, 1.0)


def _bases(scene: Scene) -> dict[int, ArrayRef]:
    """The first measured series of the sensor, by the place of each calibrated one."""
    bases: dict[int, ArrayRef] = {}
    for sensor in scene.sensors:
        measured = [series.values for series in sensor.wrenches if series.role == "measured"]
        bases |= {values.offset: measured[0] for values in measured[1:]}
    return bases


def _rest(values: npt.NDArray[Any], base: npt.NDArray[Any]) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """Linear map of other wrenches, what it leaves, and steps of that; None where it leaves more than constants."""
    table, other = _columns(values), _columns(base)
    known: BoolArray = np.asarray(np.isfinite(other).all(axis=0))
    both: BoolArray = np.asarray(known & np.isfinite(table).all(axis=0))
    changes = both[1:] & both[:-1]
    lost = np.isfinite(table[:, ~known]).any()  # a value that the map of an absent one would hide
    if lost or changes.sum() < _FEWEST * len(table):
        return None
    before, after = (np.diff(one)[:, changes] for one in (other, table))
    matrix = _linear_map(before, after)
    left = np.abs(after - matrix @ before).max(axis=0)
    same = left <= 10.0 * np.median(left)  # the offset of another power cycle is a jump
    matrix = _linear_map(before[:, same], after[:, same])
    rest = table - matrix @ other
    step, base_step = (_steps(_filled(one, ~np.isfinite(one))) for one in (table, other))
    held = (np.abs(np.diff(rest)[:, changes]) < _LINEAR * step[:, None]).all(axis=0)
    if held.mean() < _ALMOST_ALL or (np.abs(matrix) @ base_step > _AMPLIFIED * step).any():
        return None
    return matrix, rest.T, step / _FINER  # half a step of a constant would be a bias


def _linear_map(before: FloatArray, after: FloatArray) -> FloatArray:
    """Least squares by the normal equations: who uses the map sees what it leaves."""
    return np.asarray(np.linalg.lstsq(before @ before.T, before @ after.T, rcond=None)[0].T, dtype=np.float64)


def _columns(values: npt.NDArray[Any]) -> FloatArray:
    """Each column without gaps in memory, which is several times as fast to sum up as rows of six; shape (c, n)."""
    return np.ascontiguousarray(np.asarray(values).T, dtype=np.float64)


def _has_outliers(values: npt.NDArray[Any]) -> bool:
    """Whether a few samples span far more than all others of their column."""
    for column in _columns(values):
        known = column[np.isfinite(column)]
        if not len(known):
            continue
        spread, middle = np.ptp(known), known.mean()
        half = 0.5 * spread / _OUTLYING
        outermost = _OUTERMOST / 100.0 * len(known) + 1.0
        if min((known <= middle - half).sum(), (known >= middle + half).sum()) > outermost:
            continue  # so low and high below are at least that far from each other
        low = np.percentile(known, _OUTERMOST, method="higher")
        high = np.percentile(known, 100.0 - _OUTERMOST, method="lower")
        if spread > _OUTLYING * (high - low):
            return True
    return False


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


def pack(values: npt.NDArray[Any], step: FloatArray | float | None = None) -> bytes:
    """Pack one array.

    Args:
        values: Rows over time, NaN where absent; shape (n, c).
        step: Step of all columns, or of each; None for one by range and noise of each.

    Returns:
        The packed form, as above.
    """
    table = _columns(values)
    columns, rows = table.shape
    absent = ~np.isfinite(table)
    filled = _filled(table, absent)
    steps = _steps(filled) if step is None else np.broadcast_to(step, columns)
    blocks = [
        _block(filled[:, start : start + ROWS], absent[:, start : start + ROWS], steps)
        for start in range(0, rows, ROWS)
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
        head = data[first + starts[k] : first + starts[k + 1]]
        part = zlib.decompress(head[10 * columns :], -15)
        length = min(rows, samples - k * rows)
        begin, slope = np.frombuffer(head, "<i4", 2 * columns).reshape(2, columns).astype(np.int64)
        exponents, orders = np.frombuffer(head, np.uint8, 2 * columns, 8 * columns).reshape(2, columns)
        pieces = np.frombuffer(part, np.uint8).reshape(columns, 2, length)
        coded = pieces[:, 0].astype(np.int64) + 256 * pieces[:, 1].astype(np.int64)
        differences = np.where(coded == _ABSENT, 0, (coded >> 1) ^ -(coded & 1))
        for column in range(columns):
            change = differences[column]
            if orders[column] % _FIRST_ABSENT == 2:
                change = slope[column] + np.cumsum(change)
            whole = begin[column] + np.cumsum(change)
            whole = np.where(coded[column] == _ABSENT, np.nan, whole)
            values[k * rows : k * rows + length, column] = whole * steps[column] * 2.0 ** int(exponents[column])
    return values


def _aligned(size: int) -> int:
    return size + -size % ALIGNMENT


def _filled(table: FloatArray, absent: BoolArray) -> FloatArray:
    """The last value before where one is absent, the first one at the beginning, 0 where there is none; (c, n)."""
    if not absent.any():
        return table
    last = np.maximum.accumulate(np.where(absent, -1, np.arange(table.shape[1])), axis=1)
    first = np.argmax(~absent, axis=1)[:, None]
    filled = np.take_along_axis(table, np.where(last < 0, first, last), axis=1)
    return np.where(np.asarray(absent.all(axis=1))[:, None], 0.0, filled)


def _steps(filled: FloatArray) -> FloatArray:
    """A step that is far below range and noise of each column; shape (c,)."""
    spread = np.ptp(filled, axis=1)
    # fourth differences of independent samples have 70 times their variance; those of a motion nearly vanish
    fourth = np.abs(np.diff(filled, n=4)) if filled.shape[1] > 4 else np.zeros((len(filled), 1))
    noise = np.median(fourth, axis=1) * (1.4826 / np.sqrt(70.0))
    steps: FloatArray = np.maximum(RESOLUTION * spread, 0.0)
    steps = np.where(noise > 0.0, np.maximum(steps, np.minimum(NOISE_SHARE * noise, LEAST_STEPS * spread)), steps)
    return np.where(steps > 0.0, steps, 2.0**-30 * _some(np.abs(filled).max(axis=1)))


def _block(filled: FloatArray, absent: BoolArray, steps: FloatArray) -> bytes:
    sizes = [np.abs(np.diff(filled, n=order)).sum(axis=1) for order in (1, 2)]
    # a sum of sums would run on where values are absent
    orders = np.where((sizes[1] < sizes[0]) & ~absent.any(axis=1), 2, 1)
    exponents = np.zeros(len(filled), dtype=np.uint8)
    while True:
        whole = np.rint(filled / (steps * 2.0**exponents)[:, None]).astype(np.int64)
        change = np.diff(whole, prepend=whole[:, :1])
        slope = change[:, min(1, change.shape[1] - 1)]
        twice = np.diff(change, prepend=change[:, :1])
        twice[:, :2] = 0  # the slope before the first value is that after it
        differences = np.where(orders[:, None] == 2, twice, change)
        too_large = (np.abs(differences) >= _LARGEST).any(axis=1) | (np.abs(whole[:, 0]) >= 2**30)
        if not too_large.any():
            break
        exponents[too_large] += 1
    begin = np.where(orders == 2, whole[:, 0] - slope, whole[:, 0])
    zigzag = np.where(differences < 0, -2 * differences - 1, 2 * differences)
    coded = np.where(absent, _ABSENT, zigzag).astype("<u2")
    pieces = np.stack([(coded & 255).astype(np.uint8), (coded >> 8).astype(np.uint8)], axis=1)
    orders = orders + np.where(absent[:, 0], _FIRST_ABSENT, 0)
    head = np.stack([begin, slope]).astype("<i4").tobytes() + exponents.tobytes() + orders.astype(np.uint8).tobytes()
    deflate = zlib.compressobj(_LEVEL, zlib.DEFLATED, -15)
    return head + deflate.compress(pieces.tobytes()) + deflate.flush()
