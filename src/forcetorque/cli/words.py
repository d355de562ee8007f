# SPDX-License-Identifier: BSD-3-Clause
"""How numbers are put into tables."""

from __future__ import annotations


def with_error(value: float, error: float | None, *, digits: int) -> str:
    """Write a number with its standard error.

    Args:
        value: The number.
        error: Its standard error; None if it is not known.
        digits: Digits after the point of both.

    Returns:
        Such as `0.38 ±0.02`.
    """
    return f"{value:.{digits}f}" if error is None else f"{value:.{digits}f} ±{error:.{digits}f}"
