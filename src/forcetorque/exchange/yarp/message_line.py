# SPDX-License-Identifier: BSD-3-Clause
"""One line of a log, read with care: `<sequence> <stamp> <message>`, or with two stamps."""

from __future__ import annotations

import math
import re
from typing import TypeGuard

from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.bottle import Bottle, BottleValue, Vocab, leaves, parse_bottle, quote

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
