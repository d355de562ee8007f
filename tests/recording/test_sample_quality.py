# SPDX-License-Identifier: BSD-3-Clause
"""Runs of equal readings: frozen where the log is noisy, a load at rest where its noise is below the resolution."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.recording.frozen_and_saturated_samples import (
    SampleQuality,
    UnusableCounts,
    at_limit,
    equal_runs,
    noisy_runs,
    repeated_readings,
    repeated_samples,
)

COUNT, PERIOD_NS = 4000, 10_000_000
STAMPS = np.arange(COUNT, dtype=np.int64) * PERIOD_NS
SIZES = np.array([3000.0, 2000.0, 1500.0, 900.0, 700.0, 400.0])
NOISES = (0.0, 1e-9, 0.1, 0.3, 0.5, 1.0, 3.0, 10.0)
"""Standard deviations; counts."""
STEPS = (0.0, 1.0, 10.0, 50.0)
"""Resolutions; counts; 0 for what is not rounded."""


def _motion(*, rests: bool) -> FloatArray:
    """A load that swings, or swings and stands still for 5 s of every 10."""
    time = np.arange(COUNT) * PERIOD_NS * 1e-9
    if rests:
        time = 10.0 * (time // 10.0) + 2.0 * np.minimum(time % 10.0, 5.0)
    return np.stack([size * np.sin(0.7 * time * (1.0 + 0.1 * k)) for k, size in enumerate(SIZES)], axis=1)


def _read(load: FloatArray, noise: float, step: float, seed: int = 1) -> FloatArray:
    values = load + noise * np.random.default_rng(seed).normal(size=load.shape)
    return np.round(values / step) * step if step else values


def _frozen(values: FloatArray, stamps: IntArray = STAMPS) -> list[tuple[int, int]]:
    return noisy_runs(stamps, values, equal_runs(stamps, values))


@pytest.mark.parametrize("noise", NOISES)
@pytest.mark.parametrize("step", STEPS)
def test_a_load_at_rest_is_never_frozen(noise: float, step: float) -> None:
    """Whatever the noise and the resolution; and where both leave equal readings there are runs to judge."""
    for rests in (False, True):
        assert _frozen(_read(_motion(rests=rests), noise, step)) == []
    if noise <= 0.01 * step:
        values = _read(_motion(rests=True), noise, step)
        assert len(equal_runs(STAMPS, values)) >= 4


@pytest.mark.parametrize(("noise", "step"), [(1.5, 0.0), (0.5, 1.0), (3.0, 1.0), (10.0, 10.0)])
def test_a_frozen_reading_of_a_noisy_log_is_found(noise: float, step: float) -> None:
    """Runs of 0.6 s and 5 s, moving or at rest; one of 0.4 s is none."""
    for rests in (False, True):
        values = _read(_motion(rests=rests), noise, step)
        for first, last in ((100, 140), (1200, 1260), (3000, 3500)):
            values[first : last + 1] = values[first]
        assert _frozen(values) == [(1200, 1260), (3000, 3500)]


def test_one_channel_at_rest_is_not_frozen() -> None:
    """Five channels go on."""
    values = _read(_motion(rests=False), 3.0, 1.0)
    values[1000:2000, 2] = values[1000, 2]
    assert equal_runs(STAMPS, values) == []


def test_a_log_that_repeats_every_reading_is_not_frozen() -> None:
    """A sensor of 10 Hz in a log of 100 Hz: ten equal rows are one reading, and a second of them is frozen."""
    slow = _read(_motion(rests=False), 3.0, 1.0)[::10]
    values = np.repeat(slow, 10, axis=0)
    assert _frozen(values) == []
    values[1000:1200] = values[1000]
    assert _frozen(values) == [(1000, 1199)]


@pytest.mark.parametrize("rows", [1, 3, 100])
def test_tables_of_poses_are_not_frozen(rows: int) -> None:
    """A pose a second, noise-free, as one row, three or a hundred; the same pose may come twice behind itself."""
    poses = np.random.default_rng(2).normal(size=(60, 6)) * SIZES
    poses[20] = poses[21] = poses[22]
    values = np.repeat(poses, rows, axis=0)
    stamps = np.arange(len(values), dtype=np.int64) * (10**9 // rows)
    assert equal_runs(stamps, values) != []
    assert _frozen(values, stamps) == []


def test_written_digits_are_no_noise() -> None:
    """A noise-free log of six digits, whose load rests for 5 s of every 10."""
    load = 1e-2 * (_motion(rests=True) + SIZES)
    values = np.array([[float(f"{value:.6g}") for value in row] for row in load])
    assert len(equal_runs(STAMPS, values)) >= 4
    assert _frozen(values) == []


def test_old_stamps_neither_make_a_run_nor_end_one() -> None:
    """Messages that come twice, in the middle of a frozen reading and beside it."""
    values, stamps = _read(_motion(rests=False), 3.0, 1.0), STAMPS.copy()
    values[1000:1101] = values[1000]
    stamps[1050] = stamps[1049]
    stamps[2000], values[2000] = stamps[1999], values[1999]
    assert np.flatnonzero(repeated_samples(stamps)).tolist() == [1050, 2000]
    assert _frozen(values, stamps) == [(1000, 1100)]


def test_the_limit_is_found_in_either_sign_and_doubted_where_readings_go_beyond() -> None:
    """A limit that raw readings exceed is not theirs; recovered ones may, by an offset of the electronics."""
    counts = np.array([[100.0, -32767.0], [32610.0, 5.0], [np.nan, 0.0]])
    assert at_limit(counts, 32767.0, recovered=False).tolist() == [[False, True], [True, False], [False, False]]
    assert not at_limit(10.0 * counts, 32767.0, recovered=False).any()
    assert at_limit(10.0 * counts, 32767.0, recovered=True)[1, 0]
    assert at_limit(np.array([[-32768.0]]), 32767.0, recovered=False).all()  # two's complement


def test_every_unusable_sample_is_counted_once() -> None:
    """A message that comes twice is neither saturated nor frozen beside."""
    flags = np.array([[1, 1, 1], [1, 1, 0], [1, 0, 0], [0, 0, 0], [1, 1, 1]], dtype=bool)
    quality = SampleQuality(frozen=flags[:, 0], saturated=flags[:, 1], repeated=flags[:, 2])
    counts = quality.counted(np.array([True, True, True, True, False]))
    assert counts == UnusableCounts(frozen=1, saturated=1, repeated=1)
    assert quality.unusable.tolist() == [True, True, True, False, True]
    assert UnusableCounts.total([counts, counts]) == UnusableCounts(frozen=2, saturated=2, repeated=2)
    assert (str(counts), bool(UnusableCounts())) == ("1 frozen, 1 saturated, 1 repeated", False)


@pytest.mark.parametrize(
    "repeats",
    [
        np.arange(COUNT) % 3 == 2,  # every third message was lost and replaced
        np.arange(COUNT) % 2 == 1,  # a sensor of half the rate of its log
        (np.arange(COUNT) // 10 % 20 == 3) & (np.arange(COUNT) % 10 > 1),  # frozen for 80 ms every 2 s
    ],
)
@pytest.mark.parametrize(("noise", "step"), [(1.5, 0.0), (3.0, 1.0), (40.0, 10.0)])
def test_readings_that_come_again_under_new_stamps_are_found(repeats: BoolArray, noise: float, step: float) -> None:
    """98 % of what the log repeats at least, and no other sample, moving or at rest."""
    before = np.maximum.accumulate(np.where(repeats, 0, np.arange(COUNT)))
    for rests in (False, True):
        values = _read(_motion(rests=rests), noise, step)[before]
        found = repeated_readings(STAMPS, values)
        assert found[repeats].mean() > 0.98
        assert not found[~repeats].any()


@pytest.mark.parametrize("held", [2, 5, 12, 25])
@pytest.mark.parametrize("noise", [0.0, 0.1, 3.0])
@pytest.mark.parametrize("step", [0.0, 1.0])
def test_a_slow_sensor_is_found_by_the_motion_of_its_load(held: int, noise: float, step: float) -> None:
    """Down to 4 Hz in a log of 100 Hz, whatever its noise, also where readings stay for some samples more or less."""
    read = np.arange(COUNT) % held == 0
    between = np.random.default_rng(5).integers(held // 2 + 1, held + held // 2 + 1, size=COUNT).cumsum()
    uneven = np.isin(np.arange(COUNT), between)
    for reads, least in ((read, 0.98), (uneven, 0.9)) if held > 2 else ((read, 0.98),):
        before = np.maximum.accumulate(np.where(reads, np.arange(COUNT), 0))
        repeats = before != np.arange(COUNT)
        found = repeated_readings(STAMPS, _read(_motion(rests=False), noise, step)[before])
        assert found[repeats].mean() > least
        assert not found[~repeats].any()


def test_pairs_between_gaps_repeat_nothing() -> None:
    """No change is known of them."""
    values = np.repeat(np.random.default_rng(8).normal(size=(4, 6)), 3, axis=0)
    values[2::3] = np.nan
    assert not repeated_readings(STAMPS[:12], values).any()


def test_slower_readings_are_of_poses() -> None:
    """Poses that are held for 0.3 s, or for 1 s with the motion between them, repeat nothing."""
    held = _read(_motion(rests=False), 0.0, 1.0)[np.arange(COUNT) // 30 * 30]
    assert not repeated_readings(STAMPS, held).any()
    moves = np.arange(COUNT) % 120 < 20
    pose = np.cumsum(np.where(moves, 5.0, 0.0))
    values = np.rint(np.sin(0.01 * pose[:, None] * np.arange(1, 7)) * SIZES)
    assert not repeated_readings(STAMPS, values).any()


@pytest.mark.parametrize("noise", NOISES)
@pytest.mark.parametrize("step", STEPS)
def test_a_load_at_rest_repeats_nothing(noise: float, step: float) -> None:
    """Equal readings of a log whose noise gives them by itself, or that has none, are measurements."""
    for rests in (False, True):
        assert not repeated_readings(STAMPS, _read(_motion(rests=rests), noise, step)).any()


@pytest.mark.parametrize("noise", [0.05, 0.1, 0.3])
def test_a_quiet_sensor_that_stops_and_goes_repeats_nothing(noise: float) -> None:
    """It rests for 0.4 s and vibrates for 0.4 s while it moves: of its rests nearly all is used."""
    rng, rests = np.random.default_rng(7), np.arange(COUNT) // 40 % 2 == 0
    load = np.where(rests[:, None], np.repeat(_motion(rests=False)[::80], 80, axis=0)[:COUNT], _motion(rests=False))
    values = np.rint(load + np.where(rests, noise, 2.0)[:, None] * rng.normal(size=load.shape))
    assert repeated_readings(STAMPS, values)[rests].mean() < 0.03


@pytest.mark.parametrize("share", [0.0, 0.01, 0.1, 1.0])
@pytest.mark.parametrize("noise", [0.1, 0.2, 0.3, 0.5, 0.7, 1.0])
def test_a_quiet_sensor_repeats_nothing_where_its_counts_became_wrenches(noise: float, share: float) -> None:
    """No channel shows the step of the converter, and many readings are equal; at rest, in small motions and in all."""
    matrix = np.random.default_rng(2).normal(size=(6, 6)) / 25.0
    for rests in (False, True):
        counts = _read(share * _motion(rests=rests), noise, 1.0)
        assert not repeated_readings(STAMPS, counts).any()
        for wrenches in (counts @ matrix.T, np.round(counts @ matrix.T, 4)):
            assert not repeated_readings(STAMPS, wrenches).any()


@pytest.mark.parametrize("digits", [2, 4, 6])
def test_repeated_wrenches_are_found_however_many_digits_are_written(digits: int) -> None:
    """Of a sensor whose noise is one count and more, every third of whose messages is lost and replaced."""
    matrix = np.random.default_rng(2).normal(size=(6, 6)) / 25.0
    before = np.maximum.accumulate(np.where(np.arange(COUNT) % 3 == 2, 0, np.arange(COUNT)))
    for noise in (1.0, 3.0):
        for rests in (False, True):
            counts = _read(0.1 * _motion(rests=rests), noise, 1.0)[before]
            found = repeated_readings(STAMPS, np.round(counts @ matrix.T, digits))
            assert found[2::3].mean() > 0.98
            assert np.count_nonzero(found) < 1.02 * np.count_nonzero(found[2::3])
