# SPDX-License-Identifier: BSD-3-Clause
"""Numbers, lists of numbers and words, as the parameter files of loads have them in YAML."""

from __future__ import annotations

import json
from collections.abc import Iterable

import numpy as np


def number(value: float) -> str:
    """Write a number that YAML and ROS read as one with a fraction, and that reads back exactly.

    Returns:
        Its digits, without an exponent: YAML 1.1 takes 1e-05 for a word.
    """
    return np.format_float_positional(value + 0.0, unique=True, trim="0")  # + 0.0: no -0.0


def numbers(values: Iterable[float]) -> str:
    """Write a list of numbers.

    Returns:
        The list.
    """
    return "[" + ", ".join(number(float(value)) for value in values) + "]"


def word(text: str) -> str:
    """Write a word, in quotes.

    Returns:
        The word as YAML and JSON read it.
    """
    return json.dumps(text)
