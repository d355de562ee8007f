# SPDX-License-Identifier: BSD-3-Clause
"""Positions of the logged joints at instants of another stream, to take a posture up again."""

from __future__ import annotations

from forcetorque.base.arrays import IntArray
from forcetorque.recording.alignment import interpolate, usable_samples
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Stream
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import Row


class JointRow(Row):
    """Where a joint stood."""

    joint: str
    """Name of the joint."""
    position: float | None
    """Its position; nothing where its stream has a gap."""
    unit: str
    """rad or m."""


def logged_postures(recording: Recording, source: Stream, at_ns: IntArray) -> list[tuple[JointRow, ...]]:
    """Give the positions of all logged joints; joints of another clock cannot be placed and are left out.

    Args:
        recording: The streams.
        source: Stream whose instants they are.
        at_ns: Instants; shape (n,); ns.

    Returns:
        A posture for each instant.
    """
    postures: list[list[JointRow]] = [[] for _ in at_ns]
    for joint, (stream, signal) in recording.joint_signals("position").items():
        if stream.clock != source.clock or len(usable_samples(stream.stamp_ns)) < 2:
            continue
        positions = interpolate(stream, signal.column(joint)[:, None], at_ns)[:, 0]
        unit = signal.units[signal.columns.index(joint)]
        for posture, position in zip(postures, positions.tolist(), strict=True):
            posture.append(JointRow(joint=joint, position=finite_or_none(position), unit=unit))
    return [tuple(posture) for posture in postures]
