# SPDX-License-Identifier: BSD-3-Clause
"""The text form of one YARP message, and one line of a log with its sequence number and stamps."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeAlias, TypeGuard

from forcetorque.base.decimal_text import DECIMAL_NUMBER
from forcetorque.base.errors import FormatError

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
        FormatError: If the line is anything else; the text does not say where.
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
        FormatError: If it does not; the text does not say where.
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
    """Tell whether an element is a number.

    Args:
        value: One element of a message.

    Returns:
        True for numbers; false for words, vocabs and lists.
    """
    return isinstance(value, int | float)


def _shown(text: bytes) -> str:
    return quote(text.decode("ascii", "backslashreplace"))
