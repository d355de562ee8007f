# SPDX-License-Identifier: BSD-3-Clause
"""Excitation in numbers that a hand can check: standard deviations, rank, condition and explained shares."""

from __future__ import annotations

import math

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.calibration.excitation import Excitation, excitation_of
from forcetorque.experiment.calibration.moments import Moments


def _with_variances(*variance: float) -> Excitation:
    count = len(variance)
    return Excitation(
        variance=np.array(variance),
        directions=np.eye(count),
        explained=np.ones(count),
        expected_wrench_sd=np.ones(6),
    )


def test_condition_is_the_ratio_of_standard_deviations() -> None:
    """Not of variances: 100 counts2 and 4 counts2 are 10 and 2 counts."""
    assert _with_variances(100.0, 25.0, 4.0).condition == 5.0


def test_a_direction_that_stands_still_has_no_finite_condition() -> None:
    """It is infinite, without a division by zero."""
    assert _with_variances(100.0, 0.0).condition == math.inf


@pytest.mark.parametrize(("smallest", "rank"), [(4.0, 3), (1.1e-10, 3), (0.9e-10, 2), (0.0, 2)])
def test_rank_counts_what_is_more_than_rounding_of_the_strongest(smallest: float, rank: int) -> None:
    """A variance of 1e-12 of the largest and less is rounding; what is rounding is not excited either."""
    excitation = _with_variances(100.0, 25.0, smallest)
    assert excitation.rank == rank
    assert excitation.excited == (True, True, rank == 3)


def _loads(count: int) -> FloatArray:
    """Independent loads of variance 1 and mean 0, exactly."""
    drawn = np.random.default_rng(1).normal(size=(count, 12))
    columns, _ = np.linalg.qr(drawn - drawn.mean(axis=0))
    return np.sqrt(count) * columns


def test_variances_come_strongest_first_with_their_directions() -> None:
    """Channels that move by known amounts, in any order, of which loads explain all: rank, condition, directions."""
    loads = _loads(200)[:, :6]
    amplitude = np.array([3.0, 50.0, 7.0, 2.0, 11.0, 5.0])
    excitation = excitation_of(Moments.of(loads * amplitude + 24000.0, loads))
    np.testing.assert_allclose(excitation.variance, np.sort(amplitude)[::-1] ** 2, rtol=1e-9)
    np.testing.assert_allclose(np.abs(excitation.directions), np.eye(6)[np.argsort(-amplitude)], atol=1e-9)
    assert (excitation.rank, excitation.excited) == (6, (True,) * 6)
    assert excitation.condition == pytest.approx(25.0)
    np.testing.assert_allclose(excitation.expected_wrench_sd, 1.0, rtol=1e-9)


@pytest.mark.parametrize("still", [0, 2])
def test_the_share_is_adjusted_for_the_loads_that_move(still: int) -> None:
    """Half of the variance is load: with r of six loads moving, 1 - (n - 1) / (2 (n - 1 - r)) is left."""
    count = 40
    columns = _loads(count)
    reference = columns[:, :6] * (np.arange(6) >= still)
    # amplitudes of their own keep the directions along the channels
    raw = np.array([10.0, 20.0, 30.0, 40.0, 50.0, 60.0]) * (columns[:, :6] + columns[:, 6:])
    excitation = excitation_of(Moments.of(raw, reference))
    expected = 1.0 - 0.5 * (count - 1) / (count - 1 - (6 - still))
    np.testing.assert_allclose(excitation.explained, [expected] * (6 - still) + [0.0] * still, atol=1e-9)


def test_as_many_loads_as_samples_explain_nothing() -> None:
    """Seven samples and six loads leave no freedom to tell load from chance."""
    values = np.random.default_rng(3).normal(size=(7, 12))
    excitation = excitation_of(Moments.of(100.0 * values[:, :6], values[:, 6:]))
    np.testing.assert_array_equal(excitation.explained, 0.0)
    assert not any(excitation.excited)
