# SPDX-License-Identifier: BSD-3-Clause
"""What a network does to a recording: jitter, lost and late messages, failed groups, clocks that are apart.

Every function gives a new recording and draws from the generator that it is handed, so that the
same seed gives the same bits. Streams with the same stamps and sequence numbers are sent in the same
messages: where several of them are chosen, they suffer the same faults. Faults at random places spare
the first and the last message and never touch another of their kind, so that the findings of
`stream_findings` can be counted against what was requested.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from typing import TypeVar

import numpy as np

from forcetorque.base.arrays import IntArray
from forcetorque.base.errors import RecordingError
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Stream

Drawn = TypeVar("Drawn")


def jitter_stamps(
    recording: Recording, *, largest_s: float, rng: np.random.Generator, streams: Collection[str] | None = None
) -> Recording:
    """Move every stamp by a random time, equally likely up to a largest one both ways.

    More than half a period makes stamps step back, which is a fault of its own.

    Args:
        recording: The recording.
        largest_s: Largest move; s.
        rng: Source of the moves.
        streams: Names of streams; all if left out.

    Returns:
        A recording with other stamps.
    """
    return _each_port(
        recording,
        streams,
        draw=lambda stream: np.rint(rng.uniform(-largest_s, largest_s, len(stream)) * 1e9).astype(np.int64),
        change=lambda stream, moves: replace(stream, stamp_ns=stream.stamp_ns + moves),
    )


def lose_messages(
    recording: Recording,
    *,
    bursts: int,
    length: int = 1,
    rng: np.random.Generator,
    streams: Collection[str] | None = None,
) -> Recording:
    """Lose messages at random places; the sequence numbers show how many.

    Args:
        recording: The recording.
        bursts: Number of places in each stream.
        length: Messages that are lost at each.
        rng: Source of the places.
        streams: Names of streams; all if left out.

    Returns:
        A recording with `bursts * length` messages less per stream. Streams without sequence numbers get them.
    """

    def without(stream: Stream, starts: IntArray) -> Stream:
        kept = np.ones(len(stream), dtype=np.bool_)
        kept[_rows(starts, length)] = False
        sequence = np.arange(len(stream)) if stream.sequence is None else stream.sequence
        return replace(
            stream,
            stamp_ns=stream.stamp_ns[kept],
            sequence=sequence[kept],
            signals={name: replace(signal, values=signal.values[kept]) for name, signal in stream.signals.items()},
        )

    return _each_port(
        recording, streams, draw=lambda stream: _starts(stream, bursts, length=length, rng=rng), change=without
    )


def step_back(
    recording: Recording,
    *,
    count: int,
    seconds: float,
    rng: np.random.Generator,
    streams: Collection[str] | None = None,
) -> Recording:
    """Let random messages carry a stamp before that of the one before, as messages that are late.

    Args:
        recording: The recording.
        count: Number of messages in each stream.
        seconds: How far before; s.
        rng: Source of the places.
        streams: Names of streams; all if left out.

    Returns:
        A recording with other stamps.
    """

    def late(stream: Stream, rows: IntArray) -> Stream:
        stamps = np.array(stream.stamp_ns)
        stamps[rows] = stamps[rows - 1] - round(seconds * 1e9)
        return replace(stream, stamp_ns=stamps)

    return _each_port(recording, streams, draw=lambda stream: _starts(stream, count, length=1, rng=rng), change=late)


def fail_groups(
    recording: Recording,
    *,
    quantity: str,
    bursts: int,
    length: int = 1,
    rng: np.random.Generator,
    streams: Collection[str] | None = None,
) -> Recording:
    """Let a device flag a quantity as failed at random places: all of its columns are NaN there.

    Args:
        recording: The recording.
        quantity: Quantity that fails, such as `position`.
        bursts: Number of places in each stream.
        length: Messages at each.
        rng: Source of the places.
        streams: Names of streams; all that hold the quantity if left out.

    Returns:
        A recording with missing values.

    Raises:
        RecordingError: If no stream holds the quantity.
    """

    def failed(stream: Stream, starts: IntArray) -> Stream:
        signal = stream.signal(quantity)
        values = np.array(signal.values)
        values[_rows(starts, length)] = np.nan
        return replace(stream, signals={**stream.signals, quantity: replace(signal, values=values)})

    if streams is None:
        streams = [name for name, stream in recording.streams.items() if quantity in stream.signals]
    if not streams:
        raise RecordingError(f"expected a stream with {quantity} to fail, the recording has none")
    return _each_port(
        recording, streams, draw=lambda stream: _starts(stream, bursts, length=length, rng=rng), change=failed
    )


def offset_clocks(
    recording: Recording, seconds: Mapping[str, float], *, clocks: Mapping[str, str] | None = None
) -> Recording:
    """Let machines stamp their streams with clocks that are apart.

    Args:
        recording: The recording.
        seconds: How far the clock of a stream is ahead, by name of the stream; s.
        clocks: Other names for the clocks of streams that are known to be apart; the others keep
            the name of theirs, as if nobody knew.

    Returns:
        A recording with other stamps.
    """
    changed = dict(recording.streams)
    for name, ahead in seconds.items():
        stream = recording.stream(name)
        changed[name] = replace(stream, stamp_ns=stream.stamp_ns + round(ahead * 1e9))
    for name, clock in (clocks or {}).items():
        recording.stream(name)
        changed[name] = replace(changed[name], clock=clock)
    return replace(recording, streams=changed)


def _each_port(
    recording: Recording,
    names: Collection[str] | None,
    *,
    draw: Callable[[Stream], Drawn],
    change: Callable[[Stream, Drawn], Stream],
) -> Recording:
    """Change the chosen streams, those that share their messages by what was drawn once."""
    for name in names or ():
        recording.stream(name)
    drawn: dict[tuple[bytes, bytes], Drawn] = {}
    changed = dict(recording.streams)
    for name, stream in recording.streams.items():
        if names is None or name in names:
            key = (stream.stamp_ns.tobytes(), b"" if stream.sequence is None else stream.sequence.tobytes())
            if key not in drawn:
                drawn[key] = draw(stream)
            changed[name] = change(stream, drawn[key])
    return replace(recording, streams=changed)


def _starts(stream: Stream, count: int, *, length: int, rng: np.random.Generator) -> IntArray:
    """First rows of segments that neither touch each other nor the first and the last message."""
    if count < 0 or length < 1:
        raise RecordingError(f"expected 0 or more faults of 1 or more messages, got {count} of {length}")
    # with the segments taken out, any distinct places are far enough apart
    places = len(stream) - 2 - count * length + 1
    if count > max(places, 0):
        raise RecordingError(
            f"stream {stream.name!r}: expected room for {count} segments of {length} message(s) that do not touch, "
            f"got {len(stream)} messages"
        )
    chosen = np.sort(rng.choice(places, size=count, replace=False)) if count else np.empty(0)
    return 1 + chosen.astype(np.int64) + length * np.arange(count)


def _rows(starts: IntArray, length: int) -> IntArray:
    return (starts[:, None] + np.arange(length)).ravel()
