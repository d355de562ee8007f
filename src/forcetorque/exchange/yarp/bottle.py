# SPDX-License-Identifier: BSD-3-Clause
"""Bottles: the text form of one YARP message, a list of numbers, words, vocabs and lists."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

from forcetorque.decimal_text import DECIMAL_NUMBER
from forcetorque.errors import FormatError

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
