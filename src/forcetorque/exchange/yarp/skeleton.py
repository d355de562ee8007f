# SPDX-License-Identifier: BSD-3-Clause
"""Skeletons: what is left of a line when each number is reduced to the fact that there is one.

A log of a million messages has a handful of skeletons. Lines of one skeleton differ in nothing but
their numbers, so one of them is parsed with care and the others are converted together.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from forcetorque.arrays import BoolArray, IntArray

NUMBER_CHARACTERS = b"0123456789.+-eE"
"""What numbers are made of; everything else is structure."""

_NUMBER_BEFORE = np.uint8(0x80)
"""Bit that marks a character which a number stands before; ASCII leaves it free."""
_LOWER_CASE = np.uint8(0x20)
"""Bit that makes ASCII letters small ones."""
_LINE = re.compile(rb"[^\n\x8a]*[\n\x8a]")
_PIECE_SIZE = 1 << 17
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
    beginnings: bytes
    """What is needed of these lines, each with a line feed: all, or what stands before a certain character."""


def group_lines(text: bytes, *, n_structure: int | None = None) -> list[LineGroup]:
    """Group the lines of a text by their skeletons.

    Args:
        text: ASCII text that ends with a line feed.
        n_structure: Characters of the skeleton that are needed of lines like the first; None for all. What stands
            behind them is cut off if all lines are like the first, where it takes no search.

    Returns:
        One group per skeleton, in the order of first appearance.
    """
    first, _ = _skeletons(text[: text.index(b"\n") + 1], ())
    needed = () if n_structure is None else (n_structure, len(first) - 1)
    skeletons, places = _skeletons(text, [range(place, len(text), len(first)) for place in needed])
    n_lines, remainder = divmod(len(skeletons), len(first))
    if remainder == 0 and skeletons == first * n_lines:
        beginnings = _beginnings(text, *places) if places else text
        return [LineGroup(skeleton=first, rows=np.arange(n_lines), text=text, beginnings=beginnings)]
    rows: dict[bytes, list[int]] = {}
    for row, skeleton in enumerate(_LINE.findall(skeletons)):
        rows.setdefault(skeleton, []).append(row)
    lines = text.split(b"\n")
    texts = {skeleton: b"".join([lines[row] + b"\n" for row in which]) for skeleton, which in rows.items()}
    return [
        LineGroup(skeleton=skeleton, rows=np.array(rows[skeleton]), text=own, beginnings=own)
        for skeleton, own in texts.items()
    ]


def _skeletons(text: bytes, wanted: Sequence[range]) -> tuple[bytes, list[IntArray]]:
    """Give the skeletons of all lines, one after the other, and the places in the text of some of their characters."""
    skeletons: list[bytes] = []
    places: list[list[IntArray]] = [[] for _ in wanted]
    last, n_before = -1, 0
    characters = np.frombuffer(text, dtype=np.uint8)
    for start in range(0, len(text), _PIECE_SIZE):
        piece = characters[start : start + _PIECE_SIZE]
        structure = np.flatnonzero(_is_structure(piece))
        if len(structure):
            follows_number = np.empty(len(structure), dtype=np.bool_)
            follows_number[0] = start + structure[0] > last + 1
            np.greater(structure[1:] - structure[:-1], 1, out=follows_number[1:])
            skeletons.append((piece[structure] | (follows_number * _NUMBER_BEFORE)).tobytes())
            for kept, which in zip(places, wanted, strict=True):
                kept.append(structure[(which.start - n_before) % which.step :: which.step] + start)
            last, n_before = start + int(structure[-1]), n_before + len(structure)
    return b"".join(skeletons), [np.concatenate(kept) for kept in places]


def _is_structure(characters: npt.NDArray[np.uint8]) -> BoolArray:
    """Tell which characters are none of `NUMBER_CHARACTERS`; comparisons take half the time of a table."""
    is_exponent = (characters | _LOWER_CASE) == ord("e")
    is_digit_sign_or_point = (characters - np.uint8(ord("+"))) <= ord("9") - ord("+")  # of + , - . / 0 to 9
    is_neither = (characters == ord(",")) | (characters == ord("/"))
    structure: BoolArray = ~(is_exponent | is_digit_sign_or_point) | is_neither
    return structure


def _beginnings(text: bytes, ends: IntArray, line_ends: IntArray) -> bytes:
    starts = [0, *(line_ends + 1).tolist()]
    return b"\n".join([*(text[start:end] for start, end in zip(starts, ends.tolist(), strict=False)), b""])
