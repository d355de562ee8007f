# SPDX-License-Identifier: BSD-3-Clause
"""How names and numbers are put into tables."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path


def short_names(candidates: Sequence[str]) -> dict[str, str]:
    """Leave the folders of calibration files out, unless files in several folders share a name.

    Args:
        candidates: Names of calibration files, `prior`, or `prior of` such a name.

    Returns:
        What to show by the name.
    """
    labels = {}
    for candidate in candidates:
        words = "prior of " if candidate.startswith("prior of ") else ""
        labels[candidate] = words + Path(candidate.removeprefix(words)).name
    return labels if len(set(labels.values())) == len(labels) else {candidate: candidate for candidate in labels}


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
