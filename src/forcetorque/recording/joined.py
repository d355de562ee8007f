# SPDX-License-Identifier: BSD-3-Clause
"""One stream that was logged in several files, one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from forcetorque.errors import RecordingError
from forcetorque.recording.stream import Signal, Stream


def joined_stream(pieces: Sequence[Stream], names: Sequence[str]) -> Stream:
    """Put pieces of one stream behind each other, in the order in which they are stated.

    Nothing is sorted and nothing is left out: pieces that overlap are two recordings, or one that is stated twice.

    Args:
        pieces: Streams of the same clock and signals, at least one.
        names: What each is called in messages, such as its file.

    Returns:
        The stream, named as the first piece.

    Raises:
        RecordingError: If a piece begins before the one in front of it ends, or holds something else.
    """
    first = pieces[0]
    if len(pieces) == 1:
        return first
    for (before, name), (after, other) in zip(
        zip(pieces, names, strict=True), zip(pieces[1:], names[1:], strict=True), strict=False
    ):
        if _form(after) != _form(first):
            raise RecordingError(f"{other}: expected {_form(first)} as in {names[0]}, got {_form(after)}")
        if not len(before) or not len(after):
            raise RecordingError(f"{other if len(before) else name}: expected samples to join, got none")
        overlap = int(before.stamp_ns.max() - after.stamp_ns.min())
        if overlap >= 0:
            raise RecordingError(
                f"{other}: expected samples after the last of {name}, got the first one {overlap * 1e-9:.6g} s before "
                "it; state the files in the order of time, each once"
            )
    counted = all(piece.sequence is not None for piece in pieces)
    return replace(
        first,
        stamp_ns=np.concatenate([piece.stamp_ns for piece in pieces]),
        signals={quantity: _joined(quantity, pieces) for quantity in first.signals},
        sequence=np.concatenate([piece.sequence for piece in pieces if piece.sequence is not None])
        if counted
        else None,
    )


def _form(stream: Stream) -> str:
    signals = "; ".join(
        f"{quantity} {' '.join(signal.columns)} in {' '.join(signal.units)} of {signal.frame}"
        for quantity, signal in sorted(stream.signals.items())
    )
    return f"{signals}, clock {stream.clock}"


def _joined(quantity: str, pieces: Sequence[Stream]) -> Signal:
    values = np.concatenate([piece.signals[quantity].values for piece in pieces])
    return replace(pieces[0].signals[quantity], values=values)
