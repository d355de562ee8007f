# SPDX-License-Identifier: BSD-3-Clause
"""Skeletons: what is left of a line when each number is reduced to the fact that there is one.

A log of a million messages has a handful of skeletons. Lines of one skeleton differ in nothing but
their numbers, so one of them is parsed with care and the others are converted together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from forcetorque.arrays import IntArray

_IS_STRUCTURE = bytes(byte not in b"0123456789.+-eE" for byte in range(256))
_LINE_FEED = ord("\n")
_NUMBER_BEFORE = np.uint8(0x80)
"""Bit that marks a character which a number stands before; ASCII leaves it free."""
_PIECE_SIZE = 1 << 18
"""Bytes taken at a time: the arrays of a piece stay in the processor's cache."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LineGroup:
    """The lines of a text that share a skeleton."""

    skeleton: bytes
    """The characters between the numbers; those right after a number carry the highest bit."""
    rows: IntArray
    """Which lines these are, counted from 0; shape (n,)."""
    text: bytes
    """These lines, each with its line feed."""


def group_lines(text: bytes) -> list[LineGroup]:
    """Group the lines of a text by their skeletons.

    Args:
        text: ASCII text that ends with a line feed.

    Returns:
        One group per skeleton, in the order of first appearance.
    """
    marks = _marks(text)
    is_end = (marks & ~_NUMBER_BEFORE) == _LINE_FEED
    length = int(np.argmax(is_end)) + 1
    n_lines, remainder = divmod(len(marks), length)
    if remainder == 0 and bool((marks.reshape(n_lines, length) == marks[:length]).all()):
        return [LineGroup(skeleton=marks[:length].tobytes(), rows=np.arange(n_lines), text=text)]

    ends = np.flatnonzero(is_end) + 1
    starts = np.concatenate(([0], ends[:-1]))
    skeletons = marks.tobytes()
    rows: dict[bytes, list[int]] = {}
    for row, (start, end) in enumerate(zip(starts.tolist(), ends.tolist(), strict=True)):
        rows.setdefault(skeletons[start:end], []).append(row)
    lines = text.split(b"\n")
    return [
        LineGroup(skeleton=skeleton, rows=np.array(which), text=b"".join(lines[row] + b"\n" for row in which))
        for skeleton, which in rows.items()
    ]


def _marks(text: bytes) -> npt.NDArray[np.uint8]:
    """Give the skeletons of all lines of a text, one after the other."""
    marks = []
    last = -1
    for start in range(0, len(text), _PIECE_SIZE):
        piece = text[start : start + _PIECE_SIZE]
        positions = np.flatnonzero(np.frombuffer(piece.translate(_IS_STRUCTURE), dtype=np.bool_))
        if len(positions):
            gaps = np.diff(positions, prepend=last - start) > 1
            marks.append(np.frombuffer(piece, dtype=np.uint8)[positions] | (gaps * _NUMBER_BEFORE))
            last = start + int(positions[-1])
    return np.concatenate(marks)
