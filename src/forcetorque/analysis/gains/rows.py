# SPDX-License-Identifier: BSD-3-Clause
"""How a sensor uses its range, channel by channel and axis by axis."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.analysis.gains.strongest import StrongestRow
from forcetorque.evaluation import GainChange
from forcetorque.result import Row, Table


class ChannelRow(Row):
    """One channel of a sensor."""

    channel: str
    """Name of the channel."""
    smallest_counts: float
    """Smallest reading."""
    largest_counts: float
    """Largest reading."""
    headroom_below: float
    """What is left towards the negative limit; share of the limit."""
    headroom_above: float
    """What is left towards the positive limit; share of the limit."""
    saturated_share: float
    """Share of samples at a limit."""
    present_gain: float | None
    """Gain with which it was recorded."""
    recommended_gain: float | None
    """Largest allowed gain that keeps the margin; where none does, the lowest below the present one."""
    largest_factor: float | None
    """Factor on the gain that would leave just the margin; an upper bound where the channel saturates."""
    change: GainChange
    """What to do."""
    keeps_margin: bool
    """Whether that leaves the margin, as far as the recording can tell."""
    expected_smallest_counts: float
    """Smallest reading with the recommended gain, else with the largest factor."""
    expected_largest_counts: float
    """Largest reading likewise."""
    expected_headroom_below: float
    """What would be left towards the negative limit; share of the limit."""
    expected_headroom_above: float
    """What would be left towards the positive limit; share of the limit."""

    @property
    def advice(self) -> str:
        """What to do, in a word or two."""
        if self.change is GainChange.UNKNOWN:
            return "none: still"
        words = self.change.value.replace("_", " ")
        if self.change in {GainChange.KEEP, GainChange.NONE_FITS}:
            return words
        is_repeated = self.change is GainChange.LOWER_AND_REPEAT
        verb = "repeat" if is_repeated else words
        if self.recommended_gain is not None:
            return f"{verb} {'at' if is_repeated else 'to'} {self.recommended_gain:g}"
        return verb if self.largest_factor is None else f"{verb} x {self.largest_factor:.3g}"


class ResolutionRow(Row):
    """What one count is worth along an axis."""

    component: str
    """Component of the wrench."""
    unit: str
    """N/count or N m/count."""
    worst: float
    """Every channel off by one count with the worst signs: sum of the magnitudes of the matrix's row."""
    rms: float
    """Independent errors of one count standard deviation in every channel: Euclidean norm of the row."""
    expected_worst: float
    """The first with the recommended gains."""
    expected_rms: float
    """The second with the recommended gains."""


class SensorRow(Row):
    """One sensor."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    samples: int
    """Number of samples in all intervals that are not ignored."""
    missing: int
    """Samples without a reading."""
    frozen: int
    """Samples that a saturated board held, by its status; without one, samples in long stretches of one reading."""
    recovered: bool
    """Whether counts came through the inverse of the prior; an offset of the electronics is not in them."""
    limit_counts: float
    """Largest magnitude of a reading."""
    contact_stated: bool
    """Whether the file says of any interval that something touches the robot beyond the sensor."""
    repeat: bool
    """Whether the motion is to be repeated because a channel saturated or the reading froze."""
    channels: tuple[ChannelRow, ...]
    """Channels in the order of the electronics."""
    matrix: str | None
    """Where the matrix for the resolution comes from."""
    resolution: tuple[ResolutionRow, ...]
    """One per component of the wrench; empty without a matrix."""
    strongest: tuple[StrongestRow, ...]
    """One per channel, then the one of the largest norm."""

    def blocks(self) -> Iterator[Table | str]:
        """Give channels, resolution and the posture of the highest excitation.

        Yields:
            Tables and sentences.
        """
        yield _channel_table(self)
        if not self.contact_stated and any(channel.change is GainChange.RAISE for channel in self.channels):
            yield (
                "no contact is stated beyond the sensor: whether loads of use were recorded, and the head-room under "
                "contact, is unknown; raise a gain only if nothing will touch the limb, or record the contacts of use "
                "and state them as [[contact]]"
            )
        if self.resolution:
            yield _resolution_table(self.resolution)
            yield (
                f"by the matrix of {self.matrix}; worst: all channels off by one with the worst signs; "
                "rms: each by itself"
            )
        overall = self.strongest[-1]
        joints = ", ".join(
            f"{joint.joint} {'-' if joint.position is None else f'{joint.position:.3f}'} {joint.unit}"
            for joint in overall.joints
        )
        yield f"highest excitation at {overall.time_s:.2f} s: {joints or 'no joint was logged'}"


def _channel_table(row: SensorRow) -> Table:
    return Table(
        caption=f"{row.sensor} ({row.serial}), {row.samples} samples, limit {row.limit_counts:g} counts",
        headings=(
            *("channel", "counts", "left -", "left +", "saturated"),
            *("gain", "advice", "counts then", "left -", "left +"),
        ),
        rows=tuple(_channel_line(channel) for channel in row.channels),
    )


def _channel_line(channel: ChannelRow) -> tuple[str, ...]:
    return (
        channel.channel,
        f"{channel.smallest_counts:.0f} to {channel.largest_counts:.0f}",
        _percent(channel.headroom_below),
        _percent(channel.headroom_above),
        f"{100.0 * channel.saturated_share:.2g} %",
        "-" if channel.present_gain is None else f"{channel.present_gain:g}",
        channel.advice,
        f"{channel.expected_smallest_counts:.0f} to {channel.expected_largest_counts:.0f}",
        _percent(channel.expected_headroom_below),
        _percent(channel.expected_headroom_above),
    )


def _resolution_table(resolution: tuple[ResolutionRow, ...]) -> Table:
    lines = (
        ("worst, now", [row.worst for row in resolution]),
        ("worst, after", [row.expected_worst for row in resolution]),
        ("rms, now", [row.rms for row in resolution]),
        ("rms, after", [row.expected_rms for row in resolution]),
    )
    return Table(
        caption="",
        headings=("one count is", *(f"{row.component}, m{row.unit.partition('/')[0]}" for row in resolution)),
        rows=tuple((name, *(f"{1e3 * value:.3g}" for value in values)) for name, values in lines),
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"
