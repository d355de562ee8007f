# SPDX-License-Identifier: BSD-3-Clause
"""Messages that are a fixed number of plain numbers."""

from __future__ import annotations

from collections.abc import Sequence

from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.bottle import Bottle
from forcetorque.exchange.yarp.message_line import is_number


def expect_numbers(message: Bottle, names: Sequence[str], *, advice: str) -> range:
    """Choose all numbers of a message of plain numbers.

    Args:
        message: The message.
        names: Names of the numbers that are expected.
        advice: What to do if it holds something else.

    Returns:
        The place of every number.

    Raises:
        FormatError: If it holds something else; the text does not say where.
    """
    numbers = sum(map(is_number, message))
    others = len(message) - numbers
    if numbers != len(names) or others:
        also = f" and {others} lists or flags" if others else ""
        raise FormatError(f"expected {len(names)} numbers {' '.join(names)}, got {numbers}{also}; {advice}")
    return range(numbers)
