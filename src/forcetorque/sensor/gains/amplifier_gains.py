# SPDX-License-Identifier: BSD-3-Clause
"""Amplifier gains: how far the channels are from their limits, and which gains would use the range better.

Counts are taken to be proportional to the gain of their channel, offset included: the counts that a
recording would have had with another gain are `counts * gain / present gain`. The limits are
symmetric, but an offset moves a channel towards one of them, so that head-room is given towards
each [1].

References:
    [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), 5.5.1 and 4.3.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, require_shape
from forcetorque.base.errors import ForceTorqueError, ShapeError
from forcetorque.recording.stream import Stream
from forcetorque.recording.stream_faults import saturation_findings
from forcetorque.results.table import Row
from forcetorque.sensor.full_scale import axis_resolution as largest_step

MARGIN = 0.2
"""Share of the limit that is kept free for forces that the recording does not hold."""

_ROUNDING = 1e-12
"""A gain this close above the largest that keeps the margin is that one."""


class GainChange(StrEnum):
    """What to do with the gain of a channel."""

    KEEP = "keep"
    """It is the best there is."""
    RAISE = "raise"
    """The channel stays far from its limits."""
    LOWER = "lower"
    """The channel comes closer to a limit than the margin."""
    LOWER_AND_REPEAT = "lower_and_repeat"
    """The channel saturates, so that its range is unknown: repeat the motion with less gain."""
    UNKNOWN = "unknown"
    """The load did not move, so that nothing shows how far the channel goes in use."""
    NONE_FITS = "none_fits"
    """The channel saturates or lacks the margin, and no lower gain is allowed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChannelRange:
    """What a channel read over a recording."""

    channel: str
    """Name of the channel."""
    samples: int
    """Number of samples."""
    smallest_counts: float
    """Smallest reading; counts."""
    largest_counts: float
    """Largest reading; counts."""
    limit_counts: float
    """Largest magnitude of a reading; counts."""
    saturated_samples: int
    """Samples at the limit, as `saturation_findings` has it."""
    moved: bool = True
    """Whether the recording shows a load in this channel that moves."""

    @property
    def headroom_below(self) -> float:
        """What is left towards the negative limit; share of the limit."""
        return 1.0 + self.smallest_counts / self.limit_counts

    @property
    def headroom_above(self) -> float:
        """What is left towards the positive limit; share of the limit."""
        return 1.0 - self.largest_counts / self.limit_counts

    @property
    def peak_counts(self) -> float:
        """Largest magnitude of a reading; counts."""
        return max(abs(self.smallest_counts), abs(self.largest_counts))

    @property
    def saturated_share(self) -> float:
        """Share of samples at the limit."""
        return self.saturated_samples / self.samples


class ChannelGain(Row):
    """The range of a channel over a recording, the gain that it should have, and the range with that gain."""

    channel: str
    """Name of the channel."""
    smallest_counts: float
    """Smallest raw sample."""
    largest_counts: float
    """Largest raw sample."""
    headroom_below: float
    """Distance to the negative limit; share of the limit."""
    headroom_above: float
    """Distance to the positive limit; share of the limit."""
    saturated_share: float
    """Share of samples at a limit."""
    present_gain: float | None
    """Gain with which it was recorded; none if it is not known."""
    recommended_gain: float | None
    """Largest allowed gain that keeps the margin; where none does, the lowest below the present one; none if no gains
    are known, none fits, or the load did not move."""
    largest_factor: float | None
    """Factor on the gain that would leave just the margin; an upper bound where the channel saturates; none for a
    channel that is zero throughout, or whose load did not move."""
    change: GainChange
    """How to change the gain."""
    keeps_margin: bool
    """Whether that leaves the margin, as far as the recording shows."""
    expected_smallest_counts: float
    """Smallest raw sample with the recommended gain, else with the largest factor."""
    expected_largest_counts: float
    """Largest raw sample likewise."""
    expected_headroom_below: float
    """Distance to the negative limit with that gain; share of the limit."""
    expected_headroom_above: float
    """Distance to the positive limit with that gain; share of the limit."""

    @property
    def factor(self) -> float:
        """Factor on the counts of the expected range: that of the recommended gain, else the largest."""
        if self.change in {GainChange.UNKNOWN, GainChange.NONE_FITS}:
            return 1.0
        if self.recommended_gain is not None and self.present_gain is not None:
            return self.recommended_gain / self.present_gain
        return 1.0 if self.largest_factor is None else self.largest_factor

    @property
    def advice(self) -> str:
        """The change of the gain, in a few words."""
        if self.change is GainChange.UNKNOWN:
            return "none: static"
        change = self.change.value.replace("_", " ")
        if self.change in {GainChange.KEEP, GainChange.NONE_FITS}:
            return change
        is_repeated = self.change is GainChange.LOWER_AND_REPEAT
        verb = "repeat" if is_repeated else change
        if self.recommended_gain is not None:
            return f"{verb} {'at' if is_repeated else 'to'} {self.recommended_gain:g}"
        return verb if self.largest_factor is None else f"{verb} x {self.largest_factor:.3g}"


def channel_ranges(
    stream: Stream, counts: FloatArray, channels: Sequence[str], *, limit_counts: float, recovered: bool
) -> tuple[ChannelRange, ...]:
    """Find how far the channels of a sensor went.

    Args:
        stream: Stream that the counts belong to.
        counts: Raw readings, finite; shape (n, c); counts.
        channels: Names of the c channels.
        limit_counts: Largest magnitude that the converter gives; counts.
        recovered: Whether the counts came through an inverse matrix.

    Returns:
        One range per channel.

    Raises:
        ShapeError: If there is no sample, or a value is missing.
    """
    require_shape(counts, name="counts", shape=(len(stream), len(channels)))
    if not len(counts) or not np.isfinite(counts).all():
        raise ShapeError(f"counts: expected at least one sample and no missing value, got {len(counts)} samples")
    findings = saturation_findings(stream, counts, limit_counts=limit_counts, recovered=recovered)
    return tuple(
        ChannelRange(
            channel=channel,
            samples=len(column),
            smallest_counts=float(column.min()),
            largest_counts=float(column.max()),
            limit_counts=limit_counts,
            saturated_samples=sum(finding.count for finding in findings if finding.channel == f"ch{k}"),
        )
        for k, (channel, column) in enumerate(zip(channels, counts.T, strict=True))
    )


def advise_gains(
    ranges: Sequence[ChannelRange],
    *,
    margin: float = MARGIN,
    present: Sequence[float] | None = None,
    allowed: Sequence[float] | None = None,
) -> tuple[ChannelGain, ...]:
    """Choose for each channel the largest gain that keeps the margin to both limits.

    A channel that saturates gets a lower gain in any case, and is to be recorded again. Where no gain
    keeps the margin, the lowest one is taken if it is below the present one. Where present or allowed
    gains are not known, the largest factor takes the place of a gain. A channel in which no load moves and that
    keeps the margin gets no advice.

    Args:
        ranges: What each channel read.
        margin: Share of the limit to keep free, 0 or more and below 1.
        present: Gain of each channel with which it was read.
        allowed: Gains that can be set; the present ones can.

    Returns:
        Range and recommended gain of each channel.

    Raises:
        ForceTorqueError: If the margin is not below 1, or a gain not above 0.
        ShapeError: If there is not one present gain per channel.
    """
    if not 0.0 <= margin < 1.0:
        raise ForceTorqueError(f"margin: expected a share of the limit, 0 or more and below 1, got {margin:g}")
    if present is not None and len(present) != len(ranges):
        raise ShapeError(f"present gains: expected one for each of {len(ranges)} channels, got {len(present)}")
    if any(not (gain > 0.0 and np.isfinite(gain)) for gain in (*(present or ()), *(allowed or ()))):
        raise ForceTorqueError("gains: expected finite numbers above 0")
    gains: Sequence[float | None] = [None] * len(ranges) if present is None else present
    return tuple(_channel_gain(channel, gain, allowed, margin) for channel, gain in zip(ranges, gains, strict=True))


def axis_resolution(matrix: FloatArray, *, factors: Sequence[float] | None = None) -> tuple[FloatArray, FloatArray]:
    """Compute the wrench of one count.

    Args:
        matrix: Matrix for the present gains; shape (6, c); N/count, N m/count.
        factors: Factors on the gain of each channel; a count is then worth less by as much. None for the present.

    Returns:
        Change of each component when every channel is off by one count with the worst signs, the sum of the magnitudes
        of its row of the matrix; and its standard deviation when the channels err independently with a standard
        deviation of one count each, the Euclidean norm of its row; shape (6,); N, N m.
    """
    per_count = matrix if factors is None else matrix / np.asarray(factors, dtype=np.float64)
    return largest_step(per_count), np.linalg.norm(per_count, axis=1)


def strongest_samples(counts: FloatArray) -> tuple[IntArray, int]:
    """Find the samples that come closest to the limits, offsets included.

    Args:
        counts: Raw readings; shape (n, c); counts.

    Returns:
        Row of the largest magnitude of each channel, shape (c,), and the row of the largest
        Euclidean norm over all channels; the first one where several are equal.
    """
    magnitudes = np.abs(counts)
    return magnitudes.argmax(axis=0).astype(np.int64), int(np.linalg.norm(magnitudes, axis=1).argmax())


def _channel_gain(
    channel: ChannelRange, present: float | None, allowed: Sequence[float] | None, margin: float
) -> ChannelGain:
    free = (1.0 - margin) * channel.limit_counts
    largest = free / channel.peak_counts if channel.peak_counts > 0.0 else None
    recommended = None
    if not channel.moved and not channel.saturated_samples and channel.peak_counts <= free:
        largest, factor, change = None, 1.0, GainChange.UNKNOWN
    elif present is not None and allowed:
        recommended = _choose(channel, present, allowed, largest)
        factor = 1.0 if recommended is None else recommended / present
        change = GainChange.NONE_FITS if recommended is None else _change(channel, recommended, present)
    else:
        factor = 1.0 if largest is None else largest
        change = _change(channel, factor, 1.0)
    expected = replace(
        channel,
        smallest_counts=channel.smallest_counts * factor,
        largest_counts=channel.largest_counts * factor,
    )
    return ChannelGain(
        channel=channel.channel,
        smallest_counts=channel.smallest_counts,
        largest_counts=channel.largest_counts,
        headroom_below=channel.headroom_below,
        headroom_above=channel.headroom_above,
        saturated_share=channel.saturated_share,
        present_gain=present,
        recommended_gain=recommended,
        largest_factor=largest,
        change=change,
        keeps_margin=expected.peak_counts <= free * (1.0 + _ROUNDING),
        expected_smallest_counts=expected.smallest_counts,
        expected_largest_counts=expected.largest_counts,
        expected_headroom_below=expected.headroom_below,
        expected_headroom_above=expected.headroom_above,
    )


def _choose(channel: ChannelRange, present: float, allowed: Sequence[float], largest: float | None) -> float | None:
    """The largest gain that keeps the margin, else the lowest if that helps."""
    if largest is None:
        return present  # a channel that reads nothing says nothing about its gain
    lower = [gain for gain in allowed if gain < present]
    candidates = lower if channel.saturated_samples else [*allowed, present]
    fitting = [gain for gain in candidates if gain <= present * largest * (1.0 + _ROUNDING)]
    return max(fitting) if fitting else min(lower, default=None)


def _change(channel: ChannelRange, recommended: float, present: float) -> GainChange:
    if channel.saturated_samples:
        return GainChange.LOWER_AND_REPEAT
    if recommended == present:
        return GainChange.KEEP
    return GainChange.RAISE if recommended > present else GainChange.LOWER
