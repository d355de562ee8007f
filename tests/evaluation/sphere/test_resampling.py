# SPDX-License-Identifier: BSD-3-Clause
"""The jackknife against the standard error of a mean, and what counts as a part of a recording."""

from __future__ import annotations

from math import comb

import numpy as np
import pytest
from scipy.stats import t as student

from forcetorque.base.arrays import FloatArray
from forcetorque.evaluation.sphere.affine_fit import _reference_extent
from forcetorque.evaluation.sphere.cloud import QuadricMoments, extent
from forcetorque.evaluation.sphere.resampling import (
    BLOCKS,
    Resampled,
    half_selections,
    resampled,
    split,
    sums_of_products,
    whole,
    window_selections,
)


def _means(values: FloatArray) -> Resampled:
    """Resampled means of columns; everything moves enough."""
    sums = sums_of_products(values, lambda rows: np.column_stack([rows, np.ones(len(rows))]))
    return resampled(sums, lambda mean: mean[:, :-1, -1], extent=lambda mean: np.ones(len(mean)))


def test_the_jackknife_of_a_mean_is_its_standard_error() -> None:
    """For blocks of one size it is the scatter of their means over the root of their number, by Student's t."""
    values = np.random.default_rng(1).normal(size=(400, 2))
    found = _means(values)
    means = values.reshape(BLOCKS, 40, 2).mean(axis=1)
    error = means.std(axis=0, ddof=1) / np.sqrt(BLOCKS)
    np.testing.assert_allclose(found.whole, values.mean(axis=0), atol=1e-14)
    np.testing.assert_allclose(found.margin, student.ppf(0.975, BLOCKS - 1) * error, rtol=1e-10)
    low, high = found.jackknifed
    np.testing.assert_allclose([low, high], [found.whole - found.margin, found.whole + found.margin])


def test_intervals_hold_the_truth_as_often_as_they_say() -> None:
    """Means of correlated samples: 95 % of the intervals, where independent samples would give half of that."""
    rng = np.random.default_rng(2)
    held = np.zeros(2)
    for _ in range(400):
        walk = np.repeat(rng.normal(size=(40, 1)), 25, axis=0) + 0.1 * rng.normal(size=(1000, 1))
        low, high = _means(walk).jackknifed
        naive = 1.96 * walk.std() / np.sqrt(len(walk))
        held += [low[0] < 0.0 < high[0], abs(walk.mean()) < naive]
    assert 0.92 < held[0] / 400 < 0.98
    assert held[1] / 400 < 0.6  # negative control


def test_the_extent_of_references_is_their_root_mean_square_distance_from_the_mean() -> None:
    """Of a part about its own mean, whatever the sensor measured of them meanwhile."""
    rng = np.random.default_rng(4)
    pairs = np.hstack(
        [rng.normal(size=(90, 3)) * [1.0, 5.0, 20.0] + [10.0, -30.0, 7.0], rng.normal(size=(90, 3)) + 40.0]
    )
    rows = np.column_stack([pairs, np.ones(90)])
    distances = np.linalg.norm(pairs[:, :3] - pairs[:, :3].mean(axis=0), axis=1)
    found = _reference_extent((rows.T @ rows / 90.0)[None])
    np.testing.assert_allclose(found, [np.sqrt((distances**2).mean())], rtol=1e-9)


def test_the_extent_of_a_cloud_is_its_root_mean_square_distance_from_the_mean() -> None:
    """In units of that of the whole cloud, so that the whole has 1; of a part about its own mean."""
    cloud = np.random.default_rng(3).normal(size=(200, 3)) * [1.0, 5.0, 20.0] + [100.0, -300.0, 7.0]
    cloud[150:] *= 3.0
    moments = QuadricMoments.of(cloud)
    blocks = np.array_split(cloud, len(moments.sums))
    sums = np.array([moments.sums.sum(axis=0), *moments.sums])
    sizes = [float(np.sqrt(((part - part.mean(axis=0)) ** 2).sum(axis=1).mean())) for part in (cloud, *blocks)]
    assert moments.scale == pytest.approx(sizes[0], rel=1e-12)
    np.testing.assert_allclose(moments.scale * extent(sums / sums[:, 9:, 9:]), sizes, rtol=1e-9)
    assert extent(sums[:1] / sums[:1, 9:, 9:]) == pytest.approx(1.0)


def test_halves_and_windows_are_what_they_say() -> None:
    """Every half of ten blocks, and every run of three or four."""
    halves, windows = half_selections(10), window_selections(10)
    assert (len(halves), len(windows)) == (comb(10, 5), 15)
    assert len(np.unique(halves, axis=0)) == len(halves)
    assert set(halves.sum(axis=1)) == {5.0}
    for row in windows:
        assert row.sum() in (3.0, 4.0)
        assert np.count_nonzero(np.diff(np.concatenate([[0.0], row, [0.0]]))) == 2
    values = np.random.default_rng(3).normal(size=(100, 1))
    blocks = np.array_split(values, 10)
    found = _means(values)
    for row, mean in zip(halves, found.halves, strict=True):
        chosen = np.concatenate([block for block, taken in zip(blocks, row, strict=True) if taken])
        assert mean[0] == pytest.approx(chosen.mean(), abs=1e-13)


def test_parts_in_which_nothing_moves_say_nothing() -> None:
    """A recording that stands still for its second half: windows of it alone are left out."""
    rng = np.random.default_rng(4)
    values = np.concatenate([rng.normal(size=(200, 1)), np.full((200, 1), 3.0)])
    sums = sums_of_products(values, lambda rows: np.column_stack([rows, np.ones(len(rows))]))

    def extent(mean: FloatArray) -> FloatArray:
        spread: FloatArray = np.sqrt(np.maximum(mean[:, 0, 0] - mean[:, 0, 1] ** 2, 0.0))
        return spread

    found = resampled(sums, lambda mean: mean[:, :1, 1], extent=extent)
    everything = _means(values)
    assert 0 < len(found.windows) < len(everything.windows)
    assert 0 < len(found.halves) < len(everything.halves)
    assert (everything.windows == 3.0).any()
    assert not (found.windows == 3.0).any()
    assert found.ranged[1][0] < everything.ranged[1][0]


def test_numbers_made_of_estimates() -> None:
    """The jackknife of a linear function is that function of the jackknife."""
    found = _means(np.random.default_rng(5).normal(size=(300, 2)))
    doubled = found.mapped(lambda values: 2.0 * values[:, :1])
    np.testing.assert_allclose(doubled.margin, 2.0 * found.margin[:1], rtol=1e-12)
    np.testing.assert_allclose(doubled.halved[1], 2.0 * found.halved[1][:1], rtol=1e-12)


def test_short_recordings_have_fewer_blocks() -> None:
    """Blocks of at least two samples, and all samples in some block."""
    for count, blocks in ((10, 5), (13, 6), (24, 10), (999, 10)):
        parts = split(np.zeros((count, 3)))
        assert (len(parts), sum(map(len, parts))) == (blocks, count)
        assert min(map(len, parts)) >= 2


def test_the_whole_is_the_mean_of_all() -> None:
    """Sums of blocks of several sizes add up."""
    values = np.random.default_rng(6).normal(size=(20_011, 2))
    sums = sums_of_products(values, lambda rows: np.column_stack([rows, np.ones(len(rows))]))
    mean = np.column_stack([values, np.ones(len(values))])
    np.testing.assert_allclose(whole(sums)[0], mean.T @ mean / len(values), atol=1e-13)
