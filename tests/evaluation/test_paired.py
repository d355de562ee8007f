# SPDX-License-Identifier: BSD-3-Clause
"""Paired differences: by hand, how often one is found that is not there, and that one that is there is found."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.special import stdtrit

from forcetorque.arrays import FloatArray
from forcetorque.errors import ShapeError
from forcetorque.evaluation import PairedMean, paired_difference

EXACT = 1e-12
"""N, N m: norms of some 10 N by two ways."""

COUNT, STEP_S, RECORDINGS = 1000, 0.01, 1000

FALSE = 0.07 + 2.0 * math.sqrt(0.07 * 0.93 / RECORDINGS)
"""Largest share of recordings in which a difference that is not there may be found: 7 %, and two standard deviations of
what is counted in 1000 of them."""

LEVEL_N = 50.0
"""Force error that both candidates have, so large that its norm changes by what is added along it."""


def _of_blocks(values: FloatArray) -> float:
    """Standard error of a mean by ten blocks."""
    means = [block.mean() for block in np.array_split(values, min(10, len(values)))]
    return float(np.std(means, ddof=1)) / math.sqrt(len(means))


def _time(count: int = COUNT) -> FloatArray:
    return STEP_S * np.arange(count)


def _process(effective: float, rng: np.random.Generator) -> FloatArray:
    """AR(1) process of mean 0 and variance 1 that is worth so many independent samples."""
    phi = (COUNT - effective) / (COUNT + effective)
    noise = rng.normal(size=COUNT)
    noise[0] /= math.sqrt(1.0 - phi**2)
    return np.asarray(lfilter([math.sqrt(1.0 - phi**2)], [1.0, -phi], noise))


def _force(difference: FloatArray) -> PairedMean:
    """Two candidates whose force errors differ by this much in every sample."""
    reference = np.zeros((len(difference), 6))
    second = np.zeros_like(reference)
    second[:, 2] = LEVEL_N
    first = second.copy()
    first[:, 2] += difference
    return paired_difference(first, second, reference, _time(len(difference))).force


def test_by_hand() -> None:
    """Errors 3 4 0 and 0 0 1 N: norms 5 and 1, so a difference of 4 N; the moments' is -2 N m; both change a little."""
    ripple = 0.1 * np.random.default_rng(1).normal(size=(200, 1))
    reference = np.tile([1.0, 2.0, 3.0, 0.1, 0.2, 0.3], (200, 1))
    first = reference + (1.0 + ripple) * [3.0, 4.0, 0.0, 0.0, 0.0, 1.0]
    second = reference + [0.0, 0.0, 1.0, 0.0, 3.0, 0.0]
    found = paired_difference(first, second, reference, _time(200))
    norms = 5.0 * (1.0 + ripple[:, 0]) - 1.0
    assert found.count == 200
    assert found.force.mean == pytest.approx(norms.mean(), abs=EXACT)
    assert found.moment.mean == pytest.approx((norms.mean() + 1.0) / 5.0 - 3.0, abs=EXACT)
    n = found.force.effective_count**2 / (found.force.effective_count + 7.0)
    error = max(_of_blocks(norms), norms.std() / math.sqrt(n - 1.0))
    assert found.force.degrees_of_freedom == 9.0
    assert found.force.standard_error == pytest.approx(error, abs=EXACT)
    assert found.force.high - found.force.mean == pytest.approx(stdtrit(9.0, 0.975) * error, abs=EXACT)
    assert (found.force.is_higher, found.force.is_lower) == (True, False)
    assert (found.moment.is_higher, found.moment.is_lower) == (False, True)


@pytest.mark.parametrize(
    ("effective", "plain_errs"), [(5.0, 0.25), (10.0, 0.14), (30.0, 0.08), (160.0, 0.05)], ids=["5", "10", "30", "160"]
)
def test_a_difference_that_is_not_there_is_seldom_found(effective: float, plain_errs: float) -> None:
    """Whatever the number of independent samples, at most 7 % of recordings say better or worse.

    Negative control: mean and two standard errors of ten blocks err far more often where samples repeat each other.
    """
    rng = np.random.default_rng(int(effective))
    wrong, plain = 0, 0
    for _ in range(RECORDINGS):
        difference = _process(effective, rng)
        found = _force(difference)
        wrong += found.is_lower or found.is_higher
        plain += abs(difference.mean()) > 2.0 * _of_blocks(difference)
    assert wrong / RECORDINGS <= FALSE
    assert plain / RECORDINGS > plain_errs


def test_a_difference_that_is_there_is_found() -> None:
    """One of its standard deviation, worth 30 samples: mostly found, never with the wrong sign; from 5 seldom."""
    rng = np.random.default_rng(3)
    many = [_force(_process(30.0, rng) - 1.0) for _ in range(100)]
    assert sum(found.is_lower for found in many) > 90
    assert not any(found.is_higher for found in many)
    few = [_force(_process(5.0, rng) - 1.0) for _ in range(100)]
    assert sum(found.is_lower for found in few) < 50


def test_exchanged_candidates_have_the_opposite_difference() -> None:
    """Mean and interval change their sign; the standard error stays."""
    rng = np.random.default_rng(4)
    first, second, reference = rng.normal(size=(3, COUNT, 6))
    one = paired_difference(first, second, reference, _time())
    other = paired_difference(second, first, reference, _time())
    for a, b in ((one.force, other.force), (one.moment, other.moment)):
        assert (a.mean, a.low, a.high) == pytest.approx((-b.mean, -b.high, -b.low), abs=EXACT)
        assert a.standard_error == pytest.approx(b.standard_error, abs=EXACT)


def test_samples_with_a_gap_in_either_are_left_out() -> None:
    """They change nothing but the count, where a pause is taken for one."""
    rng = np.random.default_rng(5)
    first, second, reference = rng.normal(size=(3, COUNT, 6))
    kept = np.ones(COUNT, dtype=bool)
    kept[[3, 500, 501, 900]] = False
    expected = paired_difference(first[kept], second[kept], reference[kept], _time()[kept])
    first[3, 0] = second[500:502, 4] = reference[900, 2] = np.nan
    assert paired_difference(first, second, reference, _time()) == expected
    assert expected.count == COUNT - 4


@pytest.mark.parametrize("count", [1, 2, 300])
def test_where_nothing_can_be_told_it_is_undecided(count: int) -> None:
    """A single sample, and candidates that never differ or differ by one constant: no finite interval."""
    for constant in (0.0, -3.0):
        found = _force(np.full(count, constant))
        assert found.mean == pytest.approx(constant, abs=EXACT)
        assert math.isnan(found.standard_error)
        assert (found.low, found.high) == (-math.inf, math.inf)
        assert not found.is_lower
        assert not found.is_higher


def test_bad_input_is_refused() -> None:
    """Other shapes, and nothing that is whole."""
    good = np.zeros((5, 6))
    with pytest.raises(ShapeError, match="reference: expected an array of shape"):
        paired_difference(good, good, np.zeros(6), _time(5))
    with pytest.raises(ShapeError, match="second: expected an array of shape"):
        paired_difference(good, good[:4], good, _time(5))
    with pytest.raises(ShapeError, match="time_s: expected an array of shape"):
        paired_difference(good, good, good, _time(4))
    with pytest.raises(
        ShapeError, match="expected at least one sample in which everything is finite, got none among 5"
    ):
        paired_difference(good, np.full((5, 6), np.nan), good, _time(5))
