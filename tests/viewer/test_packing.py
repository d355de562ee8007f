# SPDX-License-Identifier: BSD-3-Clause
"""What a page holds is what was measured, to a part of its noise or of its range."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays

from forcetorque.base.arrays import FloatArray
from forcetorque.base.progress import TimeLeft
from forcetorque.viewer.packing import (
    LEAST_STEPS,
    NOISE_SHARE,
    POSE_STEP,
    RESOLUTION,
    ROWS,
    _has_outliers,
    _steps,
    pack,
    packed,
    unpack,
)
from forcetorque.viewer.scene import ArrayRef
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene

SAMPLES = 2 * ROWS + 123
MOTION = 8
"""Steps of the fast robot of the tests, whose second differences exceed 16 bits, are as many times as large."""


def _signals(noise: float) -> FloatArray:
    """A slow motion and a fast one with noise, with absent values at the start, inside and at the end of one."""
    rng, time = np.random.default_rng(1), np.arange(SAMPLES) / 100.0
    values = np.column_stack([50.0 * np.sin(0.3 * time), 3.0 * np.sin(5.0 * time), np.zeros(SAMPLES)])
    values[:, :2] += noise * rng.normal(size=(SAMPLES, 2))
    values[:7, 1] = values[ROWS - 5 : ROWS + 9, 1] = values[-3:, 1] = np.nan
    return values


@pytest.mark.parametrize("noise", [0.0, 0.1])
def test_values_come_back_to_a_part_of_their_noise_or_range(noise: float) -> None:
    """Absent values stay absent, and others are off by half a step at most, also where a value jumps."""
    values = _signals(noise)
    back = unpack(pack(values), (SAMPLES, 3))
    assert np.array_equal(np.isnan(back), np.isnan(values))
    step = np.maximum(RESOLUTION * np.nanmax(np.ptp(values[:, 0])), 1.2 * NOISE_SHARE * noise)
    np.testing.assert_allclose(back[:, 0], values[:, 0], rtol=0, atol=0.5 * step)
    assert (back[:, 2] == 0.0).all()


def test_a_jump_costs_precision_in_its_block_alone_at_a_fixed_step() -> None:
    """Differences have 16 bits: a block with a larger one has a larger step, of at most 1/32766 of the jump."""
    values = _signals(0.0)[:, :1]
    values[100] += 1e5
    back = unpack(pack(values, 1e-5), (SAMPLES, 1))
    np.testing.assert_allclose(back[:ROWS], values[:ROWS], rtol=0, atol=2e5 / 32766)
    np.testing.assert_allclose(back[ROWS:], values[ROWS:], rtol=0, atol=0.51e-5)


def test_one_damaged_sample_leaves_all_others_as_they_are(built: BuiltScene) -> None:
    """At 1e6 N it would set the step of its column, and all others would read 0."""
    series = built.scene.sensors[0].wrenches[-1].values
    values = read_array(built.block, series).copy()
    values[len(values) // 2, 2] = 1e6
    data = values.tobytes()
    block = built.block[: series.offset] + data + built.block[series.offset + len(data) :]
    small = packed(replace(built, block=block))
    back = read_array(small.block, small.scene.sensors[0].wrenches[-1].values)
    np.testing.assert_array_equal(back, values)


def _with_calibrated(built: BuiltScene, values: FloatArray) -> BuiltScene:
    """The scene with one more series of its first sensor."""
    first = built.scene.sensors[0]
    place = ArrayRef(offset=len(built.block), shape=values.shape, dtype="float32")
    series = replace(first.wrenches[-1], name="fitted", calibrated=True, values=place)
    scene = replace(built.scene, sensors=(replace(first, wrenches=(*first.wrenches, series)),))
    return replace(built, scene=scene, block=built.block + values.astype("<f4").tobytes())


@pytest.mark.parametrize("linear", [True, False])
def test_a_calibration_is_a_linear_map_of_the_first_series_where_it_is_one(built: BuiltScene, linear: bool) -> None:
    """With an offset for each power cycle it takes next to no bytes; with a quadratic term it is packed whole."""
    prior = read_array(built.block, built.scene.sensors[0].wrenches[-1].values).astype(np.float64)
    assert built.scene.sensors[0].wrenches[-1].role == "measured"
    coupling = 0.02 * np.random.default_rng(4).normal(size=(6, 6)) * np.divide.outer(_steps(prior.T), _steps(prior.T))
    values = prior @ (np.eye(6) + coupling).T + 3.0
    values[len(values) // 2 :] += 5.0
    if not linear:
        values[:, 2] += 1e-3 * prior[:, 0] ** 2
    small = packed(_with_calibrated(built, values))
    base, fitted = (series.values for series in small.scene.sensors[0].wrenches[-2:])
    back, rest = (
        unpack(small.block[one.offset : one.offset + (one.packed_bytes or 0)], (len(values), 6))
        for one in (base, fitted)
    )
    assert (fitted.base is not None) is linear
    if fitted.matrix is not None:
        assert fitted.base == base
        rest += back @ np.reshape(fitted.matrix, (6, 6)).T
        assert (fitted.packed_bytes or 0) < 0.1 * (base.packed_bytes or 0)
    steps = _steps(values.T)
    assert (np.abs(rest - values) < 1.1 * steps).all()
    assert (np.abs(np.nanmean(rest - values, axis=0)) < 0.1 * steps).all(), "rounding is no bias"


def test_first_rows_of_blocks_are_known_before_they_are_unpacked() -> None:
    """From the head of a block alone, with what is absent; the page looks at postures over the log so."""
    values = _signals(0.1)
    values[ROWS, 0] = np.nan
    data = pack(values)
    back = unpack(data, (SAMPLES, 3))
    blocks = int(np.frombuffer(data, "<u4", 1, 4)[0])
    starts = np.frombuffer(data, "<u4", blocks + 1, 8)
    place = 8 + 4 * (blocks + 1)
    place += -place % 8
    steps, first = np.frombuffer(data, "<f8", 3, place), place + 24
    assert blocks == 3
    for k in range(blocks):
        begin, slope = np.frombuffer(data, "<i4", 6, first + starts[k]).reshape(2, 3)
        exponents, orders = np.frombuffer(data, np.uint8, 6, first + starts[k] + 24).reshape(2, 3)
        row = np.where(orders % 128 == 2, begin + slope, begin) * steps * 2.0**exponents
        np.testing.assert_array_equal(np.where(orders >= 128, np.nan, row), back[k * ROWS])


@pytest.mark.parametrize("samples", [300, SAMPLES])
def test_outliers_are_a_few_samples_far_from_all_others(samples: int) -> None:
    """In any column of a series of any length; a constant, an absent one and noise have none."""
    values = np.random.default_rng(3).normal(size=(samples, 3))
    values[:, 1], values[:, 2] = 5.0, np.nan
    assert not _has_outliers(values)
    assert not _has_outliers(values[:, 2:])
    for column in (0, 1):
        damaged = values.copy()
        damaged[200, column] = 1e6
        assert _has_outliers(damaged)


@given(arrays(np.float32, (50, 2), elements=st.floats(-1e6, 1e6, width=32) | st.just(np.nan)))
def test_any_values_come_back(values: FloatArray) -> None:
    """To half a step, which is a 32nd of the range at most."""
    back = unpack(pack(values), (50, 2))
    assert np.array_equal(np.isnan(back), np.isnan(values))
    spread = 2.0 * float(np.nanmax(np.abs(values), initial=1e-30))
    np.testing.assert_allclose(back, values, rtol=0, atol=0.501 * LEAST_STEPS * spread)


def test_noise_takes_fewer_bytes_than_its_numbers() -> None:
    """A quarter of 32 bits, where a step is a quarter of the noise."""
    values = np.random.default_rng(2).normal(size=(SAMPLES, 6))
    assert len(pack(values)) < 0.25 * 4 * values.size


def test_progress_is_told_of_a_scene_that_takes_long(built: BuiltScene, monkeypatch: pytest.MonkeyPatch) -> None:
    """A line for every array but the first where each is due, none of a scene that is packed at once."""
    lines: list[str] = []
    packed(built, lines.append)
    assert lines == []
    monkeypatch.setattr("forcetorque.viewer.packing.TimeLeft", partial(TimeLeft, every_s=0.0))
    packed(built, lines.append)
    assert len(lines) > 3
    assert all(re.fullmatch(r"packing the page: \d+ %, \d+ s left", line) for line in lines)


def test_a_packed_scene_has_the_same_arrays(built: BuiltScene) -> None:
    """Poses and wrenches to their steps; the clock, and what has no row for each sample, as they are."""
    small = packed(built)
    assert len(small.block) < 0.5 * len(built.block)
    before, after = built.scene, small.scene
    assert np.array_equal(read_array(small.block, after.time_s), read_array(built.block, before.time_s))
    for one, other, step in (
        (before.positions, after.positions, POSE_STEP * MOTION),
        (before.root, after.root, POSE_STEP),
        (before.sensors[0].wrenches[0].values, after.sensors[0].wrenches[0].values, 0.02),
    ):
        assert other.packed_bytes is not None
        back = unpack(small.block[other.offset : other.offset + other.packed_bytes], (one.shape[0], one.shape[1]))
        np.testing.assert_allclose(back, read_array(built.block, one), rtol=0, atol=0.51 * step)
    meshes = zip(before.robot.meshes, after.robot.meshes, strict=True)
    assert all(np.array_equal(read_array(built.block, a.faces), read_array(small.block, b.faces)) for a, b in meshes)
    assert small.scene.samples == built.scene.samples
