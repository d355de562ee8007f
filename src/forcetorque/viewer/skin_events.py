# SPDX-License-Identifier: BSD-3-Clause
"""Contacts that a skinManager sees, in a scene; what it calls force is a heuristic and is never shown as newtons."""

from __future__ import annotations

from collections.abc import Container
from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.recording import Recording, Signal, Stream
from forcetorque.recording.alignment import gap_limit_ns, seconds_since, usable_samples
from forcetorque.skin.contact import followed_places
from forcetorque.viewer.block import Block
from forcetorque.viewer.draft import SceneDraft
from forcetorque.viewer.scene import SkinEventSeries
from forcetorque.viewer.skin_contacts import contact_frames

MOST_MESSAGES: Final = 50_000
"""Messages of a stream that a page holds: 17 minutes at 50 Hz; of longer logs one in so many."""


def scene_skin_events(
    recording: Recording, clock: str, links: Container[str], draft: SceneDraft
) -> tuple[SkinEventSeries, ...]:
    """Collect the contacts of every stream of skin events.

    Args:
        recording: The recording.
        clock: Clock of what is shown besides.
        links: Links of the robot.
        draft: Takes the arrays, and what is missing.

    Returns:
        The streams of that clock whose frame the robot has.
    """
    shown = []
    for stream in recording.streams.values():
        if "skin_event" not in stream.signals:
            continue
        frame = stream.signal("skin_event").frame or ""
        if stream.clock != clock:
            draft.notes.append(
                f"contacts of {stream.name!r} are not shown: their clock is {stream.clock!r}, not {clock!r}"
            )
            continue
        if frame not in links:
            draft.notes.append(f"contacts of {stream.name!r} are not shown: the robot has no link {frame!r}")
            continue
        shown.append(_series(stream, frame, recording.start_ns, draft.block))
        draft.notes.append(f"contacts of {stream.name!r}: their arrows are the skinManager's heuristic, not newtons")
    return tuple(shown)


def _series(stream: Stream, frame: str, start_ns: int, block: Block) -> SkinEventSeries:
    signal = stream.signal("skin_event")
    rows = usable_samples(stream.stamp_ns)
    rows = rows[:: -(-len(rows) // MOST_MESSAGES)]
    places, heuristics = _vectors(signal, "pressed")[rows], _vectors(signal, "heuristic")[rows]
    seen: BoolArray = np.logical_and.reduce(np.isfinite(places), axis=2)
    times = seconds_since(stream.stamp_ns[rows], start_ns)
    pressed = [place[one] for place, one in zip(places, seen, strict=True)]
    return SkinEventSeries(
        name=stream.name,
        link=frame,
        contacts=contact_frames(
            block,
            time_s=times,
            hold_s=1e-9 * gap_limit_ns(stream.stamp_ns[rows]),
            places=pressed,
            forces=[heuristic[one] for heuristic, one in zip(heuristics, seen, strict=True)],
            identities=followed_places(times, pressed),
        ),
    )


def _vectors(signal: Signal, name: str) -> FloatArray:
    """Vectors of a name; of every message and of as many contacts as a message has at most; shape (n, slots, 3)."""
    slots = dict.fromkeys(column.partition(".")[0] for column in signal.columns)
    columns = [signal.columns.index(f"{slot}.{name}_{axis}") for slot in slots for axis in "xyz"]
    return signal.values[:, columns].reshape(len(signal.values), len(slots), 3)
