# SPDX-License-Identifier: BSD-3-Clause
"""Head-room, advice and resolution against numbers that were worked out by hand."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import assume, given, strategies as st

from forcetorque.base.errors import ForceTorqueError, ShapeError
from forcetorque.recording.stream import Stream
from forcetorque.sensor.gains.amplifier_gains import (
    ChannelGain,
    ChannelRange,
    GainChange,
    advise_gains,
    axis_resolution,
    channel_ranges,
    strongest_samples,
)
from tests.recording.recordings import even_stamps, signal, stream

LIMIT = 1000.0
ALLOWED = (1.0, 2.0, 4.0, 8.0, 16.0)
COUNTS = np.array([[100.0, -900.0, 0.0], [-50.0, -300.0, 0.0], [250.0, 1000.0, 0.0], [200.0, 998.0, 0.0]])
"""One channel with plenty of room, one that saturates twice, one that reads nothing."""


def _stream(counts: np.ndarray) -> Stream:
    return stream(even_stamps(len(counts)), signal("raw", counts), name="ft")


def _range(smallest: float, largest: float, saturated: int = 0) -> ChannelRange:
    return ChannelRange(
        channel="a",
        samples=200,
        smallest_counts=smallest,
        largest_counts=largest,
        limit_counts=LIMIT,
        saturated_samples=saturated,
    )


def _advice(
    seen: ChannelRange, margin: float, present: float | None = None, allowed: Sequence[float] | None = None
) -> ChannelGain:
    (advice,) = advise_gains([seen], margin=margin, present=None if present is None else [present], allowed=allowed)
    return advice


def test_ranges_by_hand() -> None:
    """Smallest, largest, what is left towards each limit, and the share of samples within 0.5 % of it."""
    ranges = channel_ranges(_stream(COUNTS), COUNTS, ("a", "b", "c"), limit_counts=LIMIT, recovered=False)
    free, full, dead = ranges
    assert (free.channel, free.smallest_counts, free.largest_counts) == ("a", -50.0, 250.0)
    assert (free.headroom_below, free.headroom_above) == pytest.approx((0.95, 0.75))
    assert (free.peak_counts, free.saturated_share) == (250.0, 0.0)
    assert (full.headroom_below, full.headroom_above) == pytest.approx((0.1, 0.0))
    assert (full.saturated_samples, full.saturated_share) == (2, 0.5)
    assert (dead.headroom_below, dead.headroom_above, dead.peak_counts) == (1.0, 1.0, 0.0)


def test_an_offset_takes_head_room_on_one_side() -> None:
    """The same motion about an offset of 600 counts leaves less above, more than all below."""
    swing = np.linspace(-100.0, 100.0, 21)[:, None]
    (centred,) = channel_ranges(_stream(swing), swing, "a", limit_counts=LIMIT, recovered=False)
    (shifted,) = channel_ranges(_stream(swing), swing + 600.0, "a", limit_counts=LIMIT, recovered=False)
    assert (centred.headroom_below, centred.headroom_above) == pytest.approx((0.9, 0.9))
    assert (shifted.headroom_below, shifted.headroom_above) == pytest.approx((1.5, 0.3))
    assert _advice(centred, 0.2).largest_factor == pytest.approx(8.0)
    assert _advice(shifted, 0.2).largest_factor == pytest.approx(800.0 / 700.0)


@pytest.mark.parametrize(
    ("smallest", "largest", "margin", "recommended", "change", "keeps"),
    [
        (-50.0, 150.0, 0.2, 16.0, GainChange.RAISE, True),
        (-50.0, 200.0, 0.2, 16.0, GainChange.RAISE, True),  # 200 * 4 is the margin's edge exactly
        (-50.0, 201.0, 0.2, 8.0, GainChange.RAISE, True),
        (-201.0, 50.0, 0.2, 8.0, GainChange.RAISE, True),
        (-50.0, 201.0, 0.1, 16.0, GainChange.RAISE, True),
        (-50.0, 500.0, 0.2, 4.0, GainChange.KEEP, True),
        (-50.0, 801.0, 0.2, 2.0, GainChange.LOWER, True),
        (-50.0, 801.0, 0.0, 4.0, GainChange.KEEP, True),
        (300.0, 900.0, 0.9, 1.0, GainChange.LOWER, False),  # even the lowest leaves less than 90 %
    ],
)
def test_the_largest_gain_that_keeps_the_margin(
    smallest: float, largest: float, margin: float, recommended: float, change: GainChange, keeps: bool
) -> None:
    """With a present gain of 4, by hand; the expected readings are the read ones times the ratio of gains."""
    advice = _advice(_range(smallest, largest), margin, 4.0, ALLOWED[::-1])
    assert (advice.recommended_gain, advice.change, advice.keeps_margin) == (recommended, change, keeps)
    assert advice.factor == recommended / 4.0
    assert advice.expected_smallest_counts == smallest * recommended / 4.0
    assert advice.expected_largest_counts == largest * recommended / 4.0
    assert advice.largest_factor == pytest.approx((1.0 - margin) * LIMIT / max(-smallest, largest))


@pytest.mark.parametrize(
    ("present", "allowed", "recommended", "change"),
    [
        (4.0, ALLOWED, 2.0, GainChange.LOWER_AND_REPEAT),
        (4.0, (3.5, 4.0, 8.0), 3.5, GainChange.LOWER_AND_REPEAT),  # below, though not by the margin
        (4.0, (3.0, 3.2, 3.5), 3.2, GainChange.LOWER_AND_REPEAT),  # by the margin exactly: 0.8 of the present
        (1.0, ALLOWED, None, GainChange.NONE_FITS),
    ],
)
def test_a_saturated_channel_gets_the_next_lower_gain(
    present: float, allowed: tuple[float, ...], recommended: float | None, change: GainChange
) -> None:
    """Its range is not known: never the same or a higher gain, whatever the margin, and the motion again."""
    advice = _advice(_range(-400.0, 1000.0, saturated=3), 0.2, present, allowed)
    assert (advice.recommended_gain, advice.change) == (recommended, change)
    assert advice.factor == (1.0 if recommended is None else recommended / present)


def test_a_saturated_channel_is_lowered_also_without_a_margin() -> None:
    """At 0.4 % below the limit no margin would keep the gain; control: unsaturated, it stays."""
    assert _advice(_range(-400.0, 996.0, saturated=1), 0.0, 4.0, ALLOWED).recommended_gain == 2.0
    assert _advice(_range(-400.0, 994.0), 0.0, 4.0, ALLOWED).recommended_gain == 4.0


def test_without_gains_a_factor_is_recommended() -> None:
    """Neither the present gain alone nor none at all make a gain; the expected readings leave just the margin."""
    for present in (None, 4.0):
        advice = _advice(_range(-50.0, 160.0), 0.2, present)
        assert (advice.recommended_gain, advice.present_gain, advice.factor) == (None, present, pytest.approx(5.0))
        assert (advice.change, advice.expected_headroom_above) == (GainChange.RAISE, pytest.approx(0.2))
    assert _advice(_range(-50.0, 900.0), 0.2).change is GainChange.LOWER
    assert _advice(_range(-50.0, 1000.0, saturated=1), 0.2).change is GainChange.LOWER_AND_REPEAT


def test_no_lower_gain_and_no_margin() -> None:
    """The lowest gain leaves too little: there is nothing to recommend, and the readings stay."""
    advice = _advice(_range(-50.0, 900.0), 0.2, 1.0, ALLOWED)
    assert (advice.recommended_gain, advice.change, advice.factor) == (None, GainChange.NONE_FITS, 1.0)
    assert not advice.keeps_margin


def test_a_channel_that_reads_nothing_keeps_its_gain() -> None:
    """Zeros say nothing about a gain; no factor is infinite."""
    advice = _advice(_range(0.0, 0.0), 0.2, 4.0, ALLOWED)
    assert (advice.recommended_gain, advice.largest_factor, advice.change) == (4.0, None, GainChange.KEEP)
    assert _advice(_range(0.0, 0.0), 0.2).factor == 1.0


@given(
    peak=st.floats(1.0, 990.0),
    margin=st.floats(0.0, 0.9),
    present=st.sampled_from(ALLOWED),
    allowed=st.sets(st.sampled_from(ALLOWED), min_size=1),
)
def test_no_larger_allowed_gain_would_keep_the_margin(
    peak: float, margin: float, present: float, allowed: set[float]
) -> None:
    """What is recommended keeps the margin if anything does, and anything above it does not."""
    advice = _advice(_range(-peak, 0.5 * peak), margin, present, sorted(allowed))
    free = (1.0 - margin) * LIMIT
    # at the very edge both ways to round are right
    assume(all(abs(peak * gain / present - free) > 1e-9 * free for gain in {*allowed, present}))
    fitting = {gain for gain in {*allowed, present} if peak * gain / present <= free}
    if fitting:
        assert advice.recommended_gain == max(fitting)
        assert advice.keeps_margin
    else:
        assert advice.recommended_gain == min((gain for gain in allowed if gain < present), default=None)
        assert not advice.keeps_margin


def test_resolution_by_hand() -> None:
    """Sum and Euclidean norm of a row; a doubled gain halves what its channel's count is worth, not the others'."""
    matrix = np.zeros((6, 2))
    matrix[0], matrix[4] = (0.3, -0.4), (-0.006, 0.008)
    now_worst, now_rms = axis_resolution(matrix)
    np.testing.assert_allclose(now_worst, [0.7, 0, 0, 0, 0.014, 0], rtol=1e-15)
    np.testing.assert_allclose(now_rms, [0.5, 0, 0, 0, 0.01, 0], rtol=1e-15)
    then_worst, then_rms = axis_resolution(matrix, factors=[2.0, 1.0])
    np.testing.assert_allclose(then_worst, [0.55, 0, 0, 0, 0.011, 0], rtol=1e-15)
    np.testing.assert_allclose(then_rms[0], np.hypot(0.15, 0.4), rtol=1e-15)


def test_resolution_is_what_whole_counts_do_to_a_wrench() -> None:
    """By simulation: rounding errs by 1 / sqrt 12 count a channel, so the wrench by the rms over that; never worse."""
    rng = np.random.default_rng(2)
    matrix = rng.normal(size=(6, 6))
    counts = rng.uniform(-1e4, 1e4, (20000, 6))
    error = (np.rint(counts) - counts) @ matrix.T
    worst, rms = axis_resolution(matrix)
    # the standard deviation of 20000 samples is known to 0.5 %
    np.testing.assert_allclose(error.std(axis=0), rms / np.sqrt(12.0), rtol=0.03)
    assert (np.abs(error).max(axis=0) <= 0.5 * worst).all()
    assert (np.abs(error).max(axis=0) > 0.5 * rms).all()


def test_strongest_samples_by_hand() -> None:
    """Largest magnitude of each channel, largest norm over all; the first of equals."""
    rows, overall = strongest_samples(np.array([[1.0, 0.0, 5.0], [-3.0, 4.0, 0.0], [3.0, -1.0, 5.0], [0.0, 0.0, 5.5]]))
    assert rows.tolist() == [1, 1, 3]
    assert overall == 2


def test_what_makes_no_sense_is_refused() -> None:
    """Margins, gains and counts that are none."""
    seen = [_range(-1.0, 1.0)]
    for margin in (-0.1, 1.0, float("nan")):
        with pytest.raises(ForceTorqueError, match="margin: expected a share of the limit"):
            advise_gains(seen, margin=margin)
    for present, allowed in (([0.0], [1.0]), ([1.0], [-1.0]), ([float("inf")], None)):
        with pytest.raises(ForceTorqueError, match="gains: expected finite numbers above 0"):
            advise_gains(seen, present=present, allowed=allowed)
    with pytest.raises(ShapeError, match="expected one for each of 1 channels, got 2"):
        advise_gains(seen, present=[1.0, 2.0])
    for counts in (np.zeros((0, 1)), np.array([[np.nan]])):
        with pytest.raises(ShapeError, match="expected at least one sample and no missing value"):
            channel_ranges(_stream(counts), counts, "a", limit_counts=LIMIT, recovered=False)
