# SPDX-License-Identifier: BSD-3-Clause
"""Extremes and sums of blocks of samples: the page draws all of a long log of them before it unpacks a sample."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import BoolArray
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.viewer.scene import Scene, Sensor, SeriesOverview, WrenchSeries
from forcetorque.viewer.scene_arrays import Block, read_array
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
    reference = None if expected is None else _columns(read_array(block, expected.values))

    def seen(series: WrenchSeries) -> WrenchSeries:
        values = read_array(block, series.values)
        wrench = _columns(values)
        error = deviation = None
        if reference is not None and series is not expected:
            difference = wrench - reference
            difference[:, ignored] = np.nan
            error = added.add(_with_sums(_with_norms(difference)), "float32")
        if series.deviation is not None:
            spread = _with_norms(_columns(read_array(block, series.deviation)))
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


def _columns(values: npt.NDArray[np.float32]) -> _Table:
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
