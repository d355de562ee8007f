# SPDX-License-Identifier: BSD-3-Clause
"""Streams are aligned by straight lines between neighbours in time, and never across gaps."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import RecordingError
from forcetorque.recording.alignment import (
    GAP_PERIODS,
    gap_limit_ns,
    interpolate,
    require_overlap,
    seconds_since,
    usable_samples,
)
from tests.recording.recordings import EPOCH_NS, even_stamps, jittered_stamps, refused, stream

ROUNDING = 1e-14
"""A weighted mean of two numbers of order 10 errs by a few units in their last place, 2e-15 each."""


def _at(stamps: Any, values: Any, *instants: int) -> list[Any]:
    """Interpolate one column at instants given as ns after the epoch."""
    held = stream(EPOCH_NS + np.asarray(stamps))
    column = np.asarray(values, dtype=np.float64)[:, None]
    return interpolate(held, column, EPOCH_NS + np.array(instants, dtype=np.int64))[:, 0].tolist()  # type: ignore[no-any-return]


def test_straight_lines_are_exact() -> None:
    """Linear functions of time come out exactly at any instant between jittered samples; a parabola does not."""
    stamps = jittered_stamps(300, seed=1)
    at = np.sort(np.random.default_rng(2).integers(stamps[0], stamps[-1], 1000))
    slopes = np.array([3.0, -2.0, 0.0])
    of_samples, expected = (10.0 + seconds_since(t, EPOCH_NS)[:, None] * slopes for t in (stamps, at))
    result = interpolate(stream(stamps), of_samples, at)
    assert result.shape == (1000, 3)
    np.testing.assert_allclose(result, expected, rtol=0.0, atol=ROUNDING)
    bent = interpolate(stream(stamps), of_samples**2, at)
    assert np.abs(bent - expected**2)[:, 0].max() > 1e3 * ROUNDING


def test_nanoseconds_survive_the_size_of_the_epoch() -> None:
    """By hand: a third of a second into a slope of 3 per second, with stamps of the year 2023 in ns."""
    (value,) = _at([0, 1_000_000_000], [0.0, 3.0], 333_333_333)
    assert value == pytest.approx(0.999999999, abs=ROUNDING)
    in_float_seconds = 3.0 * ((EPOCH_NS + 333_333_333) * 1e-9 - EPOCH_NS * 1e-9)
    assert abs(in_float_seconds - 0.999999999) > 1e6 * ROUNDING


def test_seconds_count_from_the_origin() -> None:
    """By hand: one nanosecond is 1e-9 s, before and after the origin, at any size of the stamps."""
    stamps = np.array([EPOCH_NS - 1, EPOCH_NS, EPOCH_NS + 1, EPOCH_NS + 1_500_000_000])
    assert seconds_since(stamps, EPOCH_NS).tolist() == [-1e-9, 0.0, 1e-9, 1.5]


def test_nothing_is_made_up_outside() -> None:
    """Before the first and after the last sample is NaN, at them is their value, by a nanosecond."""
    assert _at([0, 10, 20], [1.0, 2.0, 3.0], 0, 20) == [1.0, 3.0]
    assert np.isnan(_at([0, 10, 20], [1.0, 2.0, 3.0], -1, 21)).all()


def test_nothing_is_made_up_inside_a_gap() -> None:
    """Between the edges of a pause longer than the limit is NaN; the samples at the edges stay exactly."""
    stamps, values = [0, 10, 20, 30, 81, 91, 101], [0.0, 0.1, 0.2, 0.3, 0.7, 0.8, 0.9]
    assert np.isnan(_at(stamps, values, 31, 55, 80)).all()
    assert _at(stamps, values, 30, 81) == [0.3, 0.7]
    assert _at([0, 10, 20, 200], [1.0, 2.0, 3.0, 4.0], 200) == [4.0]  # also one alone at the end
    stamps[4] = 80  # exactly the limit is no gap
    assert np.isfinite(_at(stamps, values, 31, 55, 79)).all()


def test_a_gap_is_measured_in_median_periods() -> None:
    """By hand: five median periods; too few samples have none."""
    assert gap_limit_ns(np.array([0, 10, 20, 32, 500])) == GAP_PERIODS * 11
    assert gap_limit_ns(np.array([7])) == 0
    assert gap_limit_ns(np.array([], dtype=np.int64)) == 0


def test_missing_values_spread_to_their_neighbours_only() -> None:
    """NaN reaches up to the samples before and after it, and no further."""
    stamps, values = [0, 10, 20, 30, 40], [0.0, 1.0, np.nan, 3.0, 4.0]
    assert np.isnan(_at(stamps, values, 11, 19, 20, 21, 29)).all()
    assert _at(stamps, values, 5, 10, 30, 35) == [0.5, 1.0, 3.0, 3.5]


def test_missing_values_stay_in_their_column() -> None:
    """A NaN in one column leaves the others alone."""
    result = interpolate(stream([0, 10]), np.array([[np.nan, 1.0], [0.0, 3.0]]), np.array([5]))
    assert np.isnan(result[0, 0])
    assert result[0, 1] == 2.0


def test_infinite_samples_do_not_spoil_exact_stamps() -> None:
    """At a sample's own stamp its neighbour has no say, also where the neighbour is infinite."""
    assert _at([0, 10, 20], [1.0, np.inf, 3.0], 0, 10, 20) == [1.0, np.inf, 3.0]


def test_samples_that_do_not_step_forward_are_left_out() -> None:
    """By hand: repeated stamps and steps back have no place on the clock; the first of its kind stays."""
    assert usable_samples(np.array([5, 5, 7, 6, 3, 7, 8])).tolist() == [0, 2, 6]
    assert usable_samples(np.array([], dtype=np.int64)).tolist() == []
    assert _at([0, 10, 10, 5, 20], [0.0, 1.0, 99.0, 99.0, 2.0], 5, 10, 15) == [0.5, 1.0, 1.5]


def test_no_instants_give_no_values() -> None:
    """Nothing asked, nothing answered, with the columns in place."""
    result = interpolate(stream(even_stamps(4)), np.zeros((4, 3)), np.array([], dtype=np.int64))
    assert result.shape == (0, 3)


@pytest.mark.parametrize("stamps", [[], [5], [5, 5, 4]])
def test_one_sample_makes_no_line(stamps: list[int]) -> None:
    """Fewer than two samples that step forward are refused, with their number."""
    with refused(RecordingError, f"stream 's': expected at least two samples to align, got {min(len(stamps), 1)}"):
        interpolate(stream(stamps), np.zeros((len(stamps), 1)), np.array([5]))


def test_streams_that_share_an_instant_overlap() -> None:
    """One instant in common is enough, in either order; a nanosecond between them is too much."""
    first, second = stream([30, 10, 20], name="a"), stream([40, 30], name="b")
    require_overlap(first, second)
    require_overlap(second, first)
    later = stream([31, 40], name="b")
    for pair in ((first, later), (later, first)):
        with refused(RecordingError, "do not overlap in time: 0.000 s lie between them; expected recordings of the"):
            require_overlap(*pair)


def test_the_time_between_streams_is_told() -> None:
    """The message says how far two recordings lie apart."""
    with refused(RecordingError, "streams 'a' and 'b' do not overlap in time: 1.500 s lie between"):
        require_overlap(stream([0, 10**9], name="a"), stream([25 * 10**8], name="b"))


def test_clocks_are_not_mixed() -> None:
    """Streams of two clocks are refused even where their stamps overlap; both clocks are named."""
    with refused(RecordingError, "stamped by the clocks 'robot' and 'board'; bring them to one clock"):
        require_overlap(stream([1, 2], name="a"), stream([1, 2], name="b", clock="board"))


def test_empty_streams_do_not_overlap() -> None:
    """A stream without samples is named."""
    with refused(RecordingError, "stream 'b': expected samples, got none"):
        require_overlap(stream([1, 2], name="a"), stream([], name="b"))
