# SPDX-License-Identifier: BSD-3-Clause
"""Intervals of errors that say nothing are words, the others stay."""

from __future__ import annotations

import pytest

from forcetorque.report.vague import in_words
from forcetorque.result import Table


@pytest.mark.parametrize(
    ("cell", "shown"),
    [
        ("0.92 ±0.50", "0.92 ±0.50"),
        ("0.92 ±4.60", "0.92 ±4.60"),
        ("0.92 ±4.70", "0.92 (too few data for an interval)"),
        ("0.00 ±0.01", "0.00 (too few data for an interval)"),
        ("2.0 ±inf", "2.0 (too few data for an interval)"),
        ("0.92", "0.92"),
        ("-", "-"),
        ("leg ±left.json", "leg ±left.json"),
    ],
)
def test_an_interval_wider_than_ten_times_the_error_is_words(cell: str, shown: str) -> None:
    """The number stays; what is no number with an interval stays as it is."""
    assert in_words(Table(caption="c", headings=("h",), rows=((cell,),))).rows == ((shown,),)
