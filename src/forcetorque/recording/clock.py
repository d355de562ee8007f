# SPDX-License-Identifier: BSD-3-Clause
"""Clocks: a stream whose stamps come later, or run fast, is brought to the clock of another."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.errors import RecordingError
from forcetorque.recording.stream import Stream


@dataclass(frozen=True, slots=True, kw_only=True)
class ClockShift:
    """How the stamps of a stream differ from those of another clock, stated or estimated."""

    stream: str
    """Stream that is brought to the other's clock."""
    to: str
    """Stream whose clock that is."""
    delay_s: float
    """By how much its stamps are later, in the middle of the stream; s."""
    drift: float = 0.0
    """Seconds by which that grows in a second."""
    delay_half_width_s: float | None = None
    """Half of the 95 % interval of the delay; s; None where it was stated."""
    drift_half_width: float | None = None
    """Half of the 95 % interval of the drift; None where it was stated."""
    shown_by: str | None = None
    """What both show, by which it was estimated; None where it was stated."""
    explained: float | None = None
    """Share of its movement that the one explains of the other; None where it was stated."""
    unasked_drift: float | None = None
    """Drift of an estimated delay that nobody asked for; None where it was asked for, or the interval holds none."""
    untold: str | None = None
    """Why the recording does not tell the delay that was to be estimated; None where it does, or it was stated."""

    @property
    def words(self) -> str:
        """What was done, and how surely."""
        # epochs are apart by years, and what is within them counts all the same
        size = f"{1e3 * abs(self.delay_s):.4g} ms" if abs(self.delay_s) < 1.0 else f"{abs(self.delay_s):.4f} s"
        later = f"{size} {'later' if self.delay_s >= 0.0 else 'earlier'} than {self.to!r}"
        brought = "its stamps are brought to that clock"
        growing = f", growing by {1e6 * self.drift:.4g} us a second" if self.drift else ""
        if self.shown_by is None or self.delay_half_width_s is None or self.explained is None:
            return f"stamped {later}{growing}, as stated: {brought}"
        within = f"± {1e3 * self.delay_half_width_s:.2g} ms"
        if self.drift_half_width is not None:
            within = f"{within}, growing by {1e6 * self.drift:.4g} ± {1e6 * self.drift_half_width:.2g} us a second"
        unasked = ""
        if self.unasked_drift is not None:
            unasked = (
                f"; the delay seems to grow by {1e6 * self.unasked_drift:.4g} us a second, which the interval leaves "
                'out: state drift = "estimate"'
            )
        return (
            f"stamped {later} ({within}, 95 %), estimated by {self.shown_by}, one of which explains "
            f"{self.explained:.0%} of the other: {brought}{unasked}"
        )


def on_clock_of(stream: Stream, other: Stream, shift: ClockShift, *, of: Stream | None = None) -> Stream:
    """Bring a stream to the clock of another.

    Args:
        stream: The stream.
        other: The other one, whose stamps are taken as they are.
        shift: How its stamps differ.
        of: Stream of the same clock in whose middle the delay is stated; the stream itself if left out.

    Returns:
        The stream with the stamps that the other clock would have given it.

    Raises:
        RecordingError: If it has no sample.
    """
    stamps = (stream if of is None else of).stamp_ns
    if not len(stamps):
        raise RecordingError(f"stream {stream.name!r}: expected samples, got none")
    first, last = int(stamps.min()), int(stamps.max())
    since = (stream.stamp_ns - first - (last - first) // 2).astype(np.float64)
    late = np.rint(shift.delay_s * 1e9 + shift.drift * since).astype(np.int64)
    return replace(stream, clock=other.clock, stamp_ns=stream.stamp_ns - late)
