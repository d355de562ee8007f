# SPDX-License-Identifier: BSD-3-Clause
"""How a sensor uses its range, by channel and axis, and the samples that load it most."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.experiment.logged_posture import JointRow, logged_postures
from forcetorque.experiment.raw_counts import RawCounts
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Recording
from forcetorque.results.table import Row, RowOfSensor, Table, Values
from forcetorque.sensor.gains.amplifier_gains import ChannelGain, GainChange, strongest_samples


class StrongestRow(Row):
    """A sample to repeat after a change of gains."""

    channel: str | None
    """Channel that is closest to its limit in it; nothing for the largest norm over all channels."""
    time_s: float
    """Time from the earliest stamp of the recording."""
    stamp_ns: int
    """Stamp."""
    counts: Values
    """What all channels read."""
    joints: tuple[JointRow, ...]
    """Where the joints stood; those that were logged on the sensor's clock."""


def strongest_rows(recording: Recording, counts: RawCounts) -> tuple[StrongestRow, ...]:
    """Find the sample closest to the limit of each channel, then the one of the largest norm.

    Args:
        recording: Recording that holds the joints.
        counts: Raw readings of a sensor.

    Returns:
        A row per channel, and one for all of them.
    """
    stream = counts.stream
    rows, overall = strongest_samples(counts.values)
    chosen = np.append(rows, overall)
    postures = logged_postures(recording, stream, stream.stamp_ns[chosen])
    return tuple(
        StrongestRow(
            channel=channel,
            time_s=float(seconds_since(stream.stamp_ns[row : row + 1], recording.start_ns)[0]),
            stamp_ns=int(stream.stamp_ns[row]),
            counts=counts.values[row],
            joints=posture,
        )
        for channel, row, posture in zip((*counts.channels, None), chosen.tolist(), postures, strict=True)
    )


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


class SensorRow(RowOfSensor):
    """One sensor."""

    samples: int
    """Number of samples in all intervals that are not ignored."""
    missing: int
    """Samples without a reading."""
    frozen: int
    """Samples that a saturated board held, by its status; without one, samples in long segments of one reading."""
    recovered: bool
    """Whether counts came through the inverse of the prior; an offset of the electronics is not in them."""
    limit_counts: float
    """Largest magnitude of a reading."""
    contact_specified: bool
    """Whether the file says of any interval that something touches the robot beyond the sensor."""
    repeat: bool
    """Whether the motion is to be repeated because a channel saturated or the reading froze."""
    channels: tuple[ChannelGain, ...]
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
        if not self.contact_specified and any(channel.change is GainChange.RAISE for channel in self.channels):
            yield (
                "no contact is specified distal to the sensor: whether operating loads were recorded, and the "
                "head-room under contact, is unknown; raise a gain only if nothing will touch the limb, or record the "
                "contacts of operation and state them as [[contact]]"
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


def _channel_line(channel: ChannelGain) -> tuple[str, ...]:
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
