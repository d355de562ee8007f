# SPDX-License-Identifier: BSD-3-Clause
"""Products under slow noise, against covariances written out."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.base.noise.slow_noise import CANDIDATES, SlowNoise, Timeline


def _written_out(line: Timeline, noise: SlowNoise) -> FloatArray:
    apart = np.abs(line.time_s[:, None] - line.time_s)
    same = line.recording[:, None] == line.recording
    slow = noise.ratio * np.exp(-apart / noise.time_constant_s) * same if noise.ratio else 0.0
    return np.diag(1.0 / line.share) + slow


def _two_recordings(rng: np.random.Generator) -> Timeline:
    # a pause in the first, and clocks of the second that started anew
    time = np.concatenate([np.arange(40.0), 90.0 + np.arange(25.0), np.arange(30.0)])
    return Timeline.of(time, np.repeat([0, 1], [65, 30]), rng.uniform(0.5, 1.0, 95))


@pytest.mark.parametrize("noise", CANDIDATES, ids=lambda noise: f"{noise.time_constant_s:g}s-{noise.ratio:g}")
def test_product_and_determinant_are_those_of_the_covariance_written_out(noise: SlowNoise) -> None:
    """The cheap way and the plain one."""
    rng = np.random.default_rng(1)
    line = _two_recordings(rng)
    columns = rng.normal(size=(95, 4))
    product, log_determinant = line.product(columns, noise)
    covariance = _written_out(line, noise)
    np.testing.assert_allclose(product, columns.T @ np.linalg.solve(covariance, columns), rtol=1e-9, atol=1e-9)
    assert log_determinant == pytest.approx(np.linalg.slogdet(covariance)[1], rel=1e-9)


def test_blocks_add_up_to_the_product() -> None:
    """Blocks end within recordings and between them; negative control: what goes on from one to the next counts."""
    line, noise = _two_recordings(np.random.default_rng(3)), SlowNoise(time_constant_s=50.0, ratio=3.0)
    columns = np.random.default_rng(4).normal(size=(95, 4))
    factors, before, product, across = line.factors(noise), None, np.zeros((4, 4)), np.zeros((4, 4))
    for start, end in ((0, 30), (30, 65), (65, 80), (80, 95)):
        block = factors.solve(columns[start:end], slice(start, end), before)
        product += columns[start:end].T @ block.columns
        if before is not None:
            across += np.outer(before, block.across)
        before = block.after
    whole = line.product(columns, noise)[0]
    np.testing.assert_allclose(product + across, whole, rtol=1e-12, atol=1e-12 * np.abs(whole).max())
    assert np.abs(product - whole).max() > 1e-3 * np.abs(whole).max()


@pytest.mark.parametrize("noise", CANDIDATES[::5], ids=lambda noise: f"{noise.time_constant_s:g}s-{noise.ratio:g}")
def test_what_an_instant_is_worth_is_the_diagonal_of_the_inverse(noise: SlowNoise) -> None:
    """The cheap way and the plain one; and of one instant alone."""
    line = _two_recordings(np.random.default_rng(2))
    inverse = np.linalg.inv(_written_out(line, noise))
    np.testing.assert_allclose(line.precision_diagonal(noise), np.diag(inverse), rtol=1e-9)
    single = Timeline.of([0.0], share=[0.5])
    np.testing.assert_allclose(single.precision_diagonal(noise), 1.0 / _written_out(single, noise)[0], rtol=1e-12)


@pytest.mark.parametrize("noise", CANDIDATES[::5], ids=lambda noise: f"{noise.time_constant_s:g}s-{noise.ratio:g}")
def test_one_instant_has_factors_too(noise: SlowNoise) -> None:
    """As a log that gives one mean."""
    line, columns = Timeline.of([3.0], share=[0.5]), np.array([[2.0, -1.0]])
    factors, variance = line.factors(noise), _written_out(line, noise)[0, 0]
    np.testing.assert_allclose(factors.solve(columns, slice(0, 1)).columns, columns / variance, rtol=1e-12)
    assert factors.log_determinant == pytest.approx(np.log(variance), rel=1e-12)


def test_a_recording_of_its_own_is_not_correlated_with_the_one_before() -> None:
    """Negative control: as one recording the same instants have another determinant."""
    noise = SlowNoise(time_constant_s=50.0, ratio=1.0)
    time = np.arange(20.0)
    apart = Timeline.of(time, np.repeat([0, 1], 10)).product(np.ones((20, 1)), noise)
    together = Timeline.of(time).product(np.ones((20, 1)), noise)
    assert apart[1] == pytest.approx(2.0 * Timeline.of(time[:10]).product(np.ones((10, 1)), noise)[1])
    assert abs(apart[1] - together[1]) > 1.0


def test_two_means_at_one_instant_are_no_reason_to_fail() -> None:
    """Intervals may touch."""
    product, log_determinant = Timeline.of([0.0, 0.0, 1.0]).product(
        np.eye(3), SlowNoise(time_constant_s=200.0, ratio=100.0)
    )
    assert np.isfinite(product).all()
    assert np.isfinite(log_determinant)


def test_a_single_mean_has_a_variance() -> None:
    """That of both noises, be there no neighbour."""
    noise = SlowNoise(time_constant_s=5.0, ratio=3.0)
    product, log_determinant = Timeline.of([7.0], share=[0.5]).product(np.array([[2.0, 1.0]]), noise)
    np.testing.assert_allclose(product, np.array([[4.0, 2.0], [2.0, 1.0]]) / 5.0)
    assert log_determinant == pytest.approx(np.log(5.0))


def test_what_is_no_timeline_is_refused() -> None:
    """Each with its reason."""
    with pytest.raises(FitError, match="do not fall"):
        Timeline.of([1.0, 0.0])
    with pytest.raises(FitError, match="above 0"):
        Timeline.of([0.0, 1.0], share=[1.0, 0.0])
    with pytest.raises(ShapeError, match="recording"):
        Timeline.of([0.0, 1.0], [0])
    with pytest.raises(FitError, match="ratio"):
        SlowNoise(time_constant_s=5.0, ratio=0.0)
