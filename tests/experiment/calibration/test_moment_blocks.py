# SPDX-License-Identifier: BSD-3-Clause
"""Moments add up in any grouping, and blocks put together are the interval that they were cut from."""

from __future__ import annotations

from functools import reduce

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.experiment.calibration.moment_blocks import in_blocks, joined, pairwise_sum
from forcetorque.experiment.calibration.moments import DataSet, Moments
from forcetorque.experiment.calibration.provenance import FittedInterval
from forcetorque.experiment.calibration.stored_moments import IntervalMoments

SAME = 1e-12
"""Rounding of sums in another order, over the size of the moments."""


def _data(seed: int, samples: int, variables: int, rate_hz: float = 4.0) -> DataSet:
    rng = np.random.default_rng(seed)
    return DataSet(
        label="a",
        recording="r",
        session="s",
        raw=20_000.0 + 100.0 * rng.normal(size=(samples, 6)),
        reference=10.0 * rng.normal(size=(samples, 6)),
        variables=30.0 + rng.normal(size=(samples, variables)),
        time_s=1.7e9 + np.arange(samples) / rate_hz,
    )


def _moments(data: DataSet) -> Moments:
    return Moments.of(data.raw, data.reference, data.variables)


def _assert_same(one: Moments, other: Moments) -> None:
    assert one.count == other.count
    assert np.abs(one.mean - other.mean).max() <= SAME * np.abs(other.mean).max()
    assert np.abs(one.second - other.second).max() <= SAME * np.abs(other.second).max()


@given(
    seed=st.integers(0, 2**32 - 1),
    cuts=st.sets(st.integers(1, 199), max_size=12),
    groups=st.lists(st.integers(1, 4), min_size=13, max_size=13),
)
def test_any_grouping_gives_the_same(seed: int, cuts: set[int], groups: list[int]) -> None:
    """Parts of any length, summed in pairs, one after the other, or in groups of any size first."""
    data = _data(seed, 200, 1)
    ends = [0, *sorted(cuts), 200]
    parts = [
        Moments.of(data.raw[a:b], data.reference[a:b], data.variables[a:b])
        for a, b in zip(ends, ends[1:], strict=False)
    ]
    grouped, rest = [], list(parts)
    for size in groups:
        if rest:
            grouped.append(pairwise_sum(rest[:size]))
            rest = rest[size:]
    for total in (pairwise_sum(parts), reduce(Moments.__add__, parts), pairwise_sum([*grouped, *rest])):
        _assert_same(total, _moments(data))
    assert np.array_equal(pairwise_sum(parts).second, pairwise_sum(list(parts)).second)


@pytest.mark.parametrize("variables", [0, 2])
def test_blocks_put_together_are_the_interval(variables: int) -> None:
    """Windows, ranges and ends to the last bit, moments but for rounding; blocks are no longer than they may be."""
    data = _data(1, 1003, variables)
    interval = FittedInterval(label="a", start_ns=0, end_ns=1)
    whole = IntervalMoments.of(data, interval, dropped=7)
    blocks = in_blocks(whole, data, 60.0)
    assert len(blocks) == 5
    assert all(np.ptp(block.time_s) < 60.0 for block in blocks)
    (again,) = joined(blocks)
    _assert_same(again.moments, whole.moments)
    same = ("mean", "second_moment")
    assert again.model_copy(update={name: getattr(whole, name) for name in same}) == whole
    (fewer,) = joined(blocks[:2] + blocks[3:])
    assert fewer.samples == whole.samples - blocks[2].samples
    assert len(fewer.means) == len(whole.means) - len(blocks[2].means)


def test_a_short_interval_is_one_block() -> None:
    """The same object, with nothing computed again."""
    data = _data(2, 100, 0)
    whole = IntervalMoments.of(data, FittedInterval(label="a", start_ns=0, end_ns=1), dropped=0)
    assert in_blocks(whole, data) == (whole,)
