# SPDX-License-Identifier: BSD-3-Clause
"""The samples that load a sensor most, and where the joints stood, to be repeated after a change of gains."""

from __future__ import annotations

import numpy as np

from forcetorque.analysis.runs.raw_counts import RawCounts
from forcetorque.arrays import IntArray
from forcetorque.evaluation import strongest_samples
from forcetorque.recording import Recording, Stream
from forcetorque.recording.alignment import interpolate, seconds_since, usable_samples
from forcetorque.result import Row, Values, finite_or_none


class JointRow(Row):
    """Where a joint stood."""

    joint: str
    """Name of the joint."""
    position: float | None
    """Its position; nothing where its stream has a gap."""
    unit: str
    """rad or m."""


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
    postures = _postures(recording, stream, stream.stamp_ns[chosen])
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


def _postures(recording: Recording, source: Stream, at_ns: IntArray) -> list[tuple[JointRow, ...]]:
    """Positions of all logged joints at given instants; joints of another clock cannot be placed and are left out."""
    postures: list[list[JointRow]] = [[] for _ in at_ns]
    for joint, (stream, signal) in recording.joint_signals("position").items():
        if stream.clock != source.clock or len(usable_samples(stream.stamp_ns)) < 2:
            continue
        positions = interpolate(stream, signal.column(joint)[:, None], at_ns)[:, 0]
        unit = signal.units[signal.columns.index(joint)]
        for posture, position in zip(postures, positions.tolist(), strict=True):
            posture.append(JointRow(joint=joint, position=finite_or_none(position), unit=unit))
    return [tuple(posture) for posture in postures]
