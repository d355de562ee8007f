# SPDX-License-Identifier: BSD-3-Clause
"""The text of YARP messages: one message, one line of a log, and many lines of one skeleton at once."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeGuard

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.csv as pacsv

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.arrow import arrow_numbers, arrow_text
from forcetorque.base.errors import FormatError
from forcetorque.base.units import DECIMAL_NUMBER

_TOKEN = re.compile(r"""(?P<space>\ +)|(?P<bracket>[()])|\[(?P<vocab>[^][()"\s]*)\]
                        |"(?P<text>(?:[^"\\]|\\.)*)"|(?P<word>[^][()"\ ]+)""", re.VERBOSE)  # fmt: skip
_INTEGER = re.compile(r"-?[0-9]{1,18}")
_ESCAPE = re.compile(r"\\(.)", re.DOTALL)
_CLIP = 40
"""Length to which a text is cut in messages."""


@dataclass(frozen=True, slots=True)
class Vocab:
    """A short code in square brackets, such as the `[ok]` and `[fail]` that stand for true and false."""

    text: str
    """The code without its brackets."""


BottleValue: TypeAlias = "int | float | str | Vocab | Bottle"
"""One element: words and quoted strings are `str`, nested lists are tuples."""

Bottle: TypeAlias = tuple[BottleValue, ...]
"""The elements of a message or of a list in it."""


def parse_bottle(text: str) -> Bottle:
    """Parse the text of one message.

    Elements may stand apart by any number of spaces, also by none where brackets separate them.
    Integers of up to 18 digits become `int`, every other number `float`.

    Args:
        text: One line without its end.

    Returns:
        The elements of the message.

    Raises:
        FormatError: If a list, a vocab or a string is not closed.
    """
    open_lists: list[list[BottleValue]] = [[]]
    end = 0
    for token in _TOKEN.finditer(text):
        if token.start() != end:
            break
        end = token.end()
        if token["bracket"] == "(":
            open_lists.append([])
        elif token["bracket"] == ")":
            if len(open_lists) == 1:
                raise FormatError(f'expected "(" before ")", got {quote(text[:end][-_CLIP:])}')
            closed = tuple(open_lists.pop())
            open_lists[-1].append(closed)
        elif token["space"] is None:
            open_lists[-1].append(_element(token))
    if end != len(text):
        raise FormatError(f"expected numbers, words, lists, [vocabs] or closed strings, got {quote(text[end:])}")
    if len(open_lists) > 1:
        raise FormatError(f'expected ")" for every "(", got {len(open_lists) - 1} open list(s) at the end of the line')
    return tuple(open_lists[0])


def leaves(bottle: Iterable[BottleValue]) -> Iterator[int | float | str | Vocab]:
    """Walk through everything that is not a list, at any depth, in the order of the text.

    Args:
        bottle: Elements of a message.

    Yields:
        Numbers, words and vocabs.
    """
    pending = [iter(bottle)]
    while pending:
        for value in pending[-1]:
            if isinstance(value, tuple):
                pending.append(iter(value))
                break
            yield value
        else:
            pending.pop()


def quote(text: str) -> str:
    """Show a text of unknown content on one short line of ASCII.

    Args:
        text: Anything.

    Returns:
        The text in quotes, escaped and cut.
    """
    return ascii(text if len(text) <= _CLIP else text[:_CLIP] + "...")


def _element(token: re.Match[str]) -> BottleValue:
    if token["vocab"] is not None:
        return Vocab(token["vocab"])
    if token["text"] is not None:
        return _ESCAPE.sub(r"\1", token["text"])
    word = token["word"]
    if _INTEGER.fullmatch(word):
        return int(word)
    return float(word) if DECIMAL_NUMBER.fullmatch(word) else word


OK, FAIL = Vocab("ok"), Vocab("fail")
"""How the dumper writes true and false."""

_STAMP = re.compile(rb"[-+]?[0-9]{1,10}(?:\.[0-9]{0,9})?")
_STAMP_LIMIT = 9_223_372_036
"""Seconds whose count of ns an int64 still holds."""


def parse_line(line: bytes) -> Bottle:
    """Parse one line of a log of numbers.

    Args:
        line: The line without its end.

    Returns:
        Sequence number, stamps and the elements of the message; no words, no vocabs other than
        `[ok]` and `[fail]`, and only finite numbers.

    Raises:
        FormatError: If the line is anything else; the message does not name the line.
    """
    if not line:
        raise FormatError("expected a message, got a blank line; delete it")
    bottle = parse_bottle(line.decode("ascii", "backslashreplace"))
    for value in leaves(bottle):
        if isinstance(value, float) and not math.isfinite(value):
            raise FormatError("expected finite numbers, got one beyond the range of float64; delete the line")
        if not is_number(value) and value not in (OK, FAIL):
            shown = f"[{value.text}]" if isinstance(value, Vocab) else value
            raise FormatError(f"expected numbers, lists, [ok] and [fail], got {quote(str(shown))}; delete the line")
    return bottle


def check_head(line: bytes, bottle: Bottle, *, n_stamps: int) -> None:
    """Check that a line begins with a sequence number and exact stamps.

    Args:
        line: The line without its end.
        bottle: The same line, parsed.
        n_stamps: Stamps that stand before the message, 1 or 2.

    Raises:
        FormatError: If it does not; the message does not name the line.
    """
    head = bottle[: 1 + n_stamps]
    if len(head) <= n_stamps or not all(is_number(value) for value in head):
        stamps = "one stamp" if n_stamps == 1 else "two stamps"
        raise FormatError(
            f"expected a sequence number and {stamps} before the message, got {_shown(line)}; delete the line"
        )
    if not isinstance(head[0], int):
        raise FormatError(f"expected an integer sequence number of at most 18 digits, got {head[0]}; delete the line")
    for token, stamp in zip(line.split()[1 : 1 + n_stamps], head[1:], strict=True):
        if not _STAMP.fullmatch(token) or not (is_number(stamp) and abs(stamp) < _STAMP_LIMIT):
            raise FormatError(
                f"expected a stamp in s below {_STAMP_LIMIT} with at most 9 decimals, "
                f"got {_shown(token)}; delete the line"
            )


def is_number(value: BottleValue) -> TypeGuard[int | float]:
    """Check whether an element is a number.

    Args:
        value: One element of a message.

    Returns:
        True for numbers; false for words, vocabs and lists.
    """
    return isinstance(value, int | float)


def _shown(text: bytes) -> str:
    return quote(text.decode("ascii", "backslashreplace"))


NUMBER_CHARACTERS = b"0123456789.+-eE"
"""What numbers are made of; everything else is structure."""

_NUMBER_BEFORE = np.uint8(0x80)
"""Bit that marks a character which a number stands before; ASCII leaves it free."""
_LOWER_CASE = np.uint8(0x20)
"""Bit that makes ASCII letters small ones."""
_LINE = re.compile(rb"[^\n\x8a]*[\n\x8a]")
_PIECE_SIZE = 1 << 17
"""Bytes taken at a time: the arrays of so many stay in the processor's cache."""


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
    """Find which characters are none of `NUMBER_CHARACTERS`; comparisons take half the time of a table."""
    is_exponent = (characters | _LOWER_CASE) == ord("e")
    is_digit_sign_or_point = (characters - np.uint8(ord("+"))) <= ord("9") - ord("+")  # of + , - . / 0 to 9
    is_neither = (characters == ord(",")) | (characters == ord("/"))
    return ~(is_exponent | is_digit_sign_or_point) | is_neither


def _beginnings(text: bytes, ends: IntArray, line_ends: IntArray) -> bytes:
    starts = [0, *(line_ends + 1).tolist()]
    return b"\n".join([*(text[start:end] for start, end in zip(starts, ends.tolist(), strict=False)), b""])


_BRACKETS = b"()[]"
_LETTERS = b"okfail"
"""What stands in a line besides brackets, numbers and spaces; no `e`, which belongs to numbers."""
_AS_SPACES = bytes.maketrans(_BRACKETS, b" " * len(_BRACKETS))
_NUMBER = re.compile(rb"[0-9.+\-eE]+")
_STAMP_TYPE = pa.decimal128(19, 9)
"""A float64 resolves 240 ns at today's epoch, so stamps are read as decimals, which are exact."""
_NS_TYPE = pa.decimal128(19, 0)
_ARROW_BLOCK_SIZE = 1 << 20
"""Bytes that one thread of Arrow converts at a time."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Numbers:
    """Numbers of n lines."""

    sequence: IntArray
    """Sequence numbers; shape (n,)."""
    stamp_ns: IntArray
    """Stamps; shape (n,); ns."""
    by_dumper: BoolArray
    """Whether the dumper's stamp stands in for one that the sender did not give; shape (n,)."""
    values: FloatArray
    """Chosen numbers of the messages; shape (n, width); NaN where a message has none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberLayout:
    """Where the numbers of a skeleton stand among the spaces once brackets and flags are deleted."""

    n_structure: int | None
    """Characters of the skeleton that are needed, because nothing behind them is wanted; None for all."""
    spaced: bool
    """Whether brackets become spaces, because some numbers have only brackets between them."""
    sequence: int
    """Cell of the sequence number."""
    stamps: tuple[int, ...]
    """Cell of the stamp that is taken, and of the one that is taken where that is not positive."""
    wanted: tuple[int | None, ...]
    """Cell of each value that is wanted; None where the message has none."""


def layout_of(line: bytes, bottle: Bottle, *, stamps: Sequence[str], chosen: Sequence[int | None]) -> NumberLayout:
    """Find the cells of the numbers in one line; every line of the same skeleton has the same.

    Args:
        line: The line without its end.
        bottle: The same line, parsed.
        stamps: Stamps before the message in their order, out of `tx`, `rx` and `unknown`.
        chosen: For each value that is wanted, which number of the message it is; None: not there.

    Returns:
        The layout.
    """
    first = 1 + len(stamps)
    last = max([first - 1, *(first + which for which in chosen if which is not None)])
    end = [number.end() for number in _NUMBER.finditer(line)][last]
    spaced = len(_filled_cells(line, spaced=False)) != sum(map(is_number, leaves(bottle)))
    cells = _filled_cells(line, spaced=spaced)
    sender_first = sorted(range(len(stamps)), key=lambda i: stamps[i] != "tx")
    return NumberLayout(
        n_structure=len(line[:end].translate(None, NUMBER_CHARACTERS)) if 2 * end < len(line) else None,
        spaced=spaced,
        sequence=cells[0],
        stamps=tuple(cells[1 + i] for i in sender_first),
        wanted=tuple(None if which is None else cells[first + which] for which in chosen),
    )


def convert(group: LineGroup, layout: NumberLayout) -> Numbers | None:
    """Convert the sequence numbers, the stamps and the wanted numbers of some lines.

    Numbers that are not wanted are not converted: in logs of boards they are two thirds.

    Args:
        group: Lines of the layout.
        layout: Where their numbers stand.

    Returns:
        The numbers, or None if something made of the characters of numbers is not a finite number.
    """
    types = dict(zip((layout.sequence, *layout.stamps), (pa.int64(), _STAMP_TYPE, _STAMP_TYPE), strict=False))
    types |= {cell: pa.float64() for cell in layout.wanted if cell is not None}
    names = {str(cell): kind for cell, kind in types.items()}
    text = _plain(group.beginnings, spaced=layout.spaced)
    n_cells = text.count(b" ", 0, text.index(b"\n")) + 1
    try:
        table = pacsv.read_csv(
            arrow_text(text),
            read_options=pacsv.ReadOptions(
                column_names=[str(cell) for cell in range(n_cells)], block_size=_ARROW_BLOCK_SIZE
            ),
            parse_options=pacsv.ParseOptions(delimiter=" ", quote_char=False, ignore_empty_lines=False),
            convert_options=pacsv.ConvertOptions(column_types=names, include_columns=list(names), null_values=[]),
        )
        stamps = [_nanoseconds(table.column(str(cell))) for cell in layout.stamps]
    except pa.ArrowException:
        return None
    values = np.full((table.num_rows, len(layout.wanted)), np.nan)
    for column, cell in zip(values.T, layout.wanted, strict=True):
        if cell is not None:
            column[:] = arrow_numbers(table.column(str(cell)))
            if not np.isfinite(column).all():
                return None
    stamp_ns = np.where(stamps[0] > 0, stamps[0], stamps[-1])
    return Numbers(
        sequence=arrow_numbers(table.column(str(layout.sequence))),
        stamp_ns=stamp_ns,
        by_dumper=stamp_ns != stamps[0],
        values=values,
    )


def _nanoseconds(seconds: Any) -> IntArray:
    """Read stamps, which are decimals with nine digits after the point, as the integers that they are stored as."""
    return arrow_numbers(seconds.combine_chunks().view(_NS_TYPE).cast(pa.int64()))


def _plain(text: bytes, *, spaced: bool) -> bytes:
    return text.translate(_AS_SPACES, _LETTERS) if spaced else text.translate(None, _BRACKETS + _LETTERS)


def _filled_cells(line: bytes, *, spaced: bool) -> list[int]:
    return [i for i, text in enumerate(_plain(line, spaced=spaced).split(b" ")) if text]
