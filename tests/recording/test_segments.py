# SPDX-License-Identifier: BSD-3-Clause
"""Segments of a recording together are the recording; intervals are cut where their blocks end."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.recording.segments import BLOCK_NS, segments_of
from forcetorque.recording.stream import Signal, Stream

_SECOND = 10**9
_SUPPORT = Support(frame="base", gravity_direction=np.array([0.0, 0.0, -1.0]))


def _stream(name: str, period_ns: int, seconds: int) -> Stream:
    stamps = np.arange(0, seconds * _SECOND, period_ns, dtype=np.int64) + 7 * _SECOND
    signal = Signal.of_fixed("temperature", np.sin(stamps * 1e-9)[:, None])
    return Stream(name=name, clock="one", stamp_ns=stamps, signals={"temperature": signal})


def _recording(spans: list[tuple[float, float, Use]], seconds: int = 3600) -> Recording:
    return Recording(
        streams={
            one.name: one for one in (_stream("fast", 50_000_000, seconds), _stream("slow", 60 * _SECOND, seconds))
        },
        intervals=tuple(
            Interval(
                label=f"i{k}",
                start_ns=round((7.0 + start) * _SECOND),
                end_ns=round((7.0 + end) * _SECOND),
                use=use,
                support=_SUPPORT,
            )
            for k, (start, end, use) in enumerate(spans)
        ),
    )


@given(start=st.floats(0.0, 1500.0), length=st.floats(1.0, 2000.0), segment_s=st.floats(200.0, 1300.0))
def test_segments_are_the_recording(start: float, length: float, segment_s: float) -> None:
    """Segments follow each other without a gap, parts of an interval too; a cut is a whole number of blocks away."""
    recording = _recording([(start, start + length, Use.CALIBRATION)])
    (interval,) = recording.intervals
    segments = segments_of(recording, length_s=segment_s, margin_s=5.0)
    begin, end = recording.span_ns
    assert len(segments) == max(round((end - begin) * 1e-9 / segment_s), 1)
    borders = [segments[0].start_ns, *(segment.end_ns for segment in segments)]
    assert borders == sorted(set(borders))
    assert [segment.start_ns for segment in segments] == borders[:-1]
    assert (borders[0], borders[-1]) == (begin, end + 1)
    parts = [one for segment in segments for one in segment.recording.intervals if one.use is Use.CALIBRATION]
    assert [part.end_ns for part in parts[:-1]] == [part.start_ns for part in parts[1:]]
    assert (parts[0].start_ns, parts[-1].end_ns) == (interval.start_ns, interval.end_ns)
    assert all((part.start_ns - interval.start_ns) % BLOCK_NS == 0 for part in parts)


def test_a_segment_has_the_samples_around_it() -> None:
    """Those of its margin, at least a few of a slow stream; and seconds count as in the whole recording."""
    recording = _recording([], seconds=7200)
    stream = recording.streams["fast"]
    segments = segments_of(recording, length_s=1800.0, margin_s=5.0)
    assert len(segments) == 4
    for segment in segments:
        own = segment.recording.streams["fast"].stamp_ns
        inside = (stream.stamp_ns >= segment.start_ns) & (stream.stamp_ns < segment.end_ns)
        assert np.isin(stream.stamp_ns[inside], own).all()
        assert own[0] <= max(segment.start_ns - 5 * _SECOND, stream.stamp_ns[0])
        assert own[-1] >= min(segment.end_ns + 5 * _SECOND, stream.stamp_ns[-1])
        assert len(own) < 0.3 * len(stream)
        assert segment.recording.span_ns == recording.span_ns
        assert len(segment.recording.streams["slow"]) == len(recording.streams["slow"])


def test_nothing_comes_from_a_neighbour_on_another_support() -> None:
    """An interval in the margin is ignored where it has another support, else its samples are as good as others."""
    other = replace(_SUPPORT, frame="hand")
    recording = _recording([(0.0, 1800.0, Use.CALIBRATION), (1800.0, 3600.0, Use.VALIDATION)])
    first, second = recording.intervals
    for support, ignored in ((_SUPPORT, []), (other, ["i1"])):
        both = recording.with_intervals([first, replace(second, support=support)])
        segment = segments_of(both, length_s=1800.0, margin_s=5.0)[0]
        assert [one.label for one in segment.recording.intervals if one.use is Use.IGNORE] == ignored
        assert [one.label for one in segment.recording.intervals if one.use is Use.CALIBRATION] == ["i0"]


@pytest.mark.parametrize("length_s", [3000.0, np.inf])
def test_a_short_recording_is_one_segment(length_s: float) -> None:
    """The recording itself."""
    recording = _recording([])
    (segment,) = segments_of(recording, length_s=length_s, margin_s=5.0)
    assert segment.recording is recording
