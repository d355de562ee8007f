# SPDX-License-Identifier: BSD-3-Clause
"""What a skinManager saw over a recording; what its messages call force is a heuristic, never given in newtons."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.recording import Recording, Stream
from forcetorque.recording.alignment import seconds_since, usable_samples
from forcetorque.result import Row, Shown
from forcetorque.skin.contact import followed_places


class SkinEventRow(Row):
    """Contacts of one patch, as a skinManager tells them."""

    stream: Annotated[str, Shown("stream")]
    """Stream."""
    messages: Annotated[int, Shown("messages")]
    """Messages."""
    touched: Annotated[int, Shown("with a contact")]
    """Messages with a contact."""
    contacts: Annotated[int, Shown("contacts")]
    """Contacts of all messages."""
    most: Annotated[int, Shown("most at once")]
    """Contacts of the message with the most."""
    followed: Annotated[int, Shown("followed")]
    """Contacts, where what is at one place in successive messages is one: a skinManager numbers them anew each time."""
    largest_heuristic: Annotated[float, Shown("largest heuristic", digits=2)]
    """Largest sum of norms of what a message calls forces: a heuristic, not newtons."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinEventPicture:
    """The heuristic of one stream over time."""

    stream: str
    """Stream."""
    seconds: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    heuristic: FloatArray
    """Sum of the norms of the contacts' heuristics, 0 without a contact; shape (n,); not newtons."""


def skin_event_rows(recording: Recording) -> tuple[tuple[SkinEventRow, ...], tuple[SkinEventPicture, ...]]:
    """Sum up every stream of skin events on a clock that other streams have too, or of a recording of nothing else.

    Args:
        recording: The recording.

    Returns:
        A row per stream, and what is drawn of it.
    """
    others = [stream.clock for stream in recording.streams.values() if "skin_event" not in stream.signals]
    clocks = others or [stream.clock for stream in recording.streams.values()]
    summaries = [
        _summary(stream, recording.start_ns)
        for stream in recording.streams.values()
        if "skin_event" in stream.signals and stream.clock in clocks
    ]
    return tuple(row for row, _ in summaries), tuple(picture for _, picture in summaries)


def _summary(stream: Stream, start_ns: int) -> tuple[SkinEventRow, SkinEventPicture]:
    signal, rows = stream.signal("skin_event"), usable_samples(stream.stamp_ns)
    columns = [k for k, name in enumerate(signal.columns) if ".heuristic_" in name]
    vectors = signal.values[rows][:, columns].reshape(len(rows), -1, 3)
    sizes = np.linalg.norm(vectors, axis=2)  # (n, contacts), NaN where a message has fewer
    counts = np.count_nonzero(np.isfinite(sizes), axis=1)
    heuristic: FloatArray = np.nansum(sizes, axis=1)
    seconds = seconds_since(stream.stamp_ns[rows], start_ns)
    pressed = [k for k, name in enumerate(signal.columns) if ".pressed_" in name]
    places = signal.values[rows][:, pressed].reshape(len(rows), -1, 3)
    identities = followed_places(seconds, [one[np.isfinite(one).all(axis=1)] for one in places])
    row = SkinEventRow(
        stream=stream.name,
        messages=len(rows),
        touched=int(np.count_nonzero(counts)),
        contacts=int(counts.sum()),
        most=int(counts.max(initial=0)),
        followed=int(np.concatenate([[0], *identities]).max()),
        largest_heuristic=float(heuristic.max(initial=0.0)),
    )
    return row, SkinEventPicture(stream=stream.name, seconds=seconds, heuristic=heuristic)
