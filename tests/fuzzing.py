# SPDX-License-Identifier: BSD-3-Clause
"""How many random examples a test of damaged or random input draws: a quarter in every run, all in the long one.

Tests of Hypothesis that state no number draw 100 in the long run (`tests/conftest.py`).

Every run draws others, so that a day of runs has met more of them than one long run.
"""

from __future__ import annotations

SHARE = [4]
"""One of so many examples is drawn; `--all-examples` makes it 1 before tests are imported."""


def examples(count: int) -> int:
    """Give the number of examples of this run.

    Args:
        count: Number of the long run.

    Returns:
        That number, or a quarter of it.
    """
    return count // SHARE[0]


def sampled(count: int) -> int:
    """Give the number of examples of this run for readers of which one takes tens of milliseconds.

    Args:
        count: Number of the long run.

    Returns:
        That number, or a two-hundredth of it.
    """
    return count if SHARE[0] == 1 else count // 200
