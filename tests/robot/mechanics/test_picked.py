# SPDX-License-Identifier: BSD-3-Clause
"""The ends of an interval are filtered as its middle is: what lies around it is taken, where it belongs to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support, Use
from forcetorque.recording.smoothing import SavitzkyGolay, smooth
from forcetorque.robot.mechanics.measured_and_expected_wrench import PaddedSamples, padded_samples
from tests.recording.recordings import EPOCH_NS, recording, signal, stream

WINDOW = SavitzkyGolay(window_s=0.2, order=2)
"""21 samples of 10 ms."""
HALF = 10
COUNT = 1200
ROUNDING = 1e-11
"""Of values up to 5, over a window."""
SUPPORT = Support(frame="base", gravity_direction=np.array([0.0, 0.0, -1.0]))


def _jittered() -> IntArray:
    """Twelve seconds with jitter, two gaps, lost samples and stamps that step back."""
    rng = np.random.default_rng(3)
    stamps = EPOCH_NS + np.cumsum(rng.integers(8_000_000, 12_500_000, COUNT))
    stamps[500:] += 150_000_000
    stamps[800:] += 90_000_000
    stamps[300] = stamps[298]
    return np.delete(stamps, [100, 101, 640])


STAMPS = _jittered()
NOISE = np.random.default_rng(4).normal(size=(len(STAMPS), 2))
HOLED = np.where(np.isin(np.arange(len(STAMPS)), [50, 210, 211, 700, *range(900, 912)])[:, None], np.nan, NOISE)


def _log(*intervals: Interval) -> Recording:
    return recording(stream(STAMPS, signal("scalar", NOISE, ("a", "b")), name="board"), intervals=intervals)


def _span(first: int, last: int, *, label: str = "judged", use: Use = Use.VALIDATION) -> Interval:
    """From one sample to before another."""
    support = None if use is Use.IGNORE else SUPPORT
    return Interval(label=label, start_ns=int(STAMPS[first]), end_ns=int(STAMPS[last]), use=use, support=support)


def _padded(span: Interval, *others: Interval, apart: tuple[str, ...] = ()) -> PaddedSamples:
    log = _log(*others)
    return padded_samples(log, log.stream("board"), span, WINDOW, apart=apart)


def _over(span: Interval, values: FloatArray, *others: Interval, apart: tuple[str, ...] = ()) -> FloatArray:
    padded = _padded(span, *others, apart=apart)
    return padded.smoothed(values[padded.rows])


def _rows(span: Interval) -> IntArray:
    padded = _padded(span)
    return padded.rows[padded.inside]


@pytest.mark.parametrize("values", [NOISE, HOLED], ids=["complete", "with missing values"])
@pytest.mark.parametrize(
    ("first", "last"), [(200, 250), (205, 206), (0, 12), (4, 9), (490, 520), (505, 508), (795, 1000), (913, 930)]
)
def test_an_interval_is_smoothed_as_a_longer_one_is(first: int, last: int, values: FloatArray) -> None:
    """Also beside gaps, at the end of the log and where it is shorter than the window."""
    short, long = _span(first, last), _span(0, len(STAMPS) - 1)
    kept = np.isin(_rows(long), _rows(short))
    np.testing.assert_allclose(_over(short, values), _over(long, values)[kept], rtol=0.0, atol=ROUNDING)


def test_the_whole_log_is_smoothed_as_one_stream_is() -> None:
    """The longest interval is the plain filter of all its samples, one-sided at the ends of the log."""
    whole = replace(_span(0, 1), end_ns=int(STAMPS[-1]) + 1)
    rows = _rows(whole)
    np.testing.assert_allclose(_over(whole, NOISE), smooth(STAMPS[rows], NOISE[rows], WINDOW), rtol=0.0, atol=ROUNDING)


@pytest.mark.parametrize("values", [NOISE, HOLED], ids=["complete", "with missing values"])
def test_how_a_span_is_cut_does_not_matter(values: FloatArray) -> None:
    """Two ways of cutting give what the span gives; filters of the pieces alone do not: 0.1 and more at their ends."""
    whole = _over(_span(20, 1100), values)
    for cuts in ([20, 350, 1100], [20, 27, 260, 499, 503, 780, 1100]):
        pieces = [_span(*ends) for ends in zip(cuts, cuts[1:], strict=False)]
        joined = np.concatenate([_over(piece, values) for piece in pieces])
        np.testing.assert_allclose(joined, whole, rtol=0.0, atol=ROUNDING)
        alone = np.concatenate([smooth(STAMPS[_rows(p)], values[_rows(p)], WINDOW) for p in pieces])
        assert np.nanmax(np.abs(alone - whole)) > 0.1


def _moving(span: Interval) -> Interval:
    return replace(span, support=MovingSupport(frame="base", motion_streams=("imu",)))


def _tilted(span: Interval) -> Interval:
    return replace(span, support=Support(frame="base", gravity_direction=np.array([0.0, 0.6, -0.8])))


@pytest.mark.parametrize(
    "other",
    [
        _span(250, 400, label="other", use=Use.IGNORE),
        _tilted(_span(250, 400, label="other")),
        _moving(_span(250, 400, label="other")),
        replace(_span(250, 400, label="other"), support=replace(SUPPORT, frame="hand")),
    ],
    ids=["ignored", "another direction", "moving", "another frame"],
)
def test_nothing_comes_from_where_the_interval_does_not_hold(other: Interval) -> None:
    """Ignored samples and those on another support change nothing, bit by bit; those on the same support do."""
    span = _span(200, 250)
    changed = NOISE + 100.0 * ((np.arange(len(STAMPS)) >= 250) & (np.arange(len(STAMPS)) < 400))[:, None]
    assert _over(span, NOISE, other).tobytes() == _over(span, changed, other).tobytes()
    alike = replace(_span(250, 400, label="other"), support=replace(SUPPORT))
    moved = np.abs(_over(span, NOISE, alike) - _over(span, changed, alike)).max(axis=1) > 1e-3
    assert np.flatnonzero(moved)[0] in (50 - HALF - 1, 50 - HALF)  # jitter shifts the grid by up to a sample
    assert (
        _over(span, NOISE, alike, apart=("other",)).tobytes() == _over(span, changed, alike, apart=("other",)).tobytes()
    )


def test_a_tilted_interval_reads_its_own_samples_although_another_covers_them() -> None:
    """What lies inside is never left out for the sake of another interval, unless that is to be ignored."""
    span = _span(200, 250)
    assert len(_over(_tilted(span), NOISE, _span(190, 300, label="other"))) == 50
    assert len(_over(span, NOISE, _span(240, 300, label="other", use=Use.IGNORE))) == 40


def test_without_a_filter_nothing_lies_around() -> None:
    """The samples of the interval are all, and stay as they are."""
    log, span = _log(), _span(200, 250)
    padded = padded_samples(log, log.stream("board"), span, None)
    assert padded.inside.all()
    assert padded.rows.tolist() == list(range(200, 250))
    assert padded.smoothed(NOISE[padded.rows]).tobytes() == NOISE[200:250].tobytes()
