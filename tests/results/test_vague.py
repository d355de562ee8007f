# SPDX-License-Identifier: BSD-3-Clause
"""Intervals of errors that say nothing give way to a mark, the others stay."""

from __future__ import annotations

import pytest

from forcetorque.results.table import Table, without_vague


@pytest.mark.parametrize(
    ("cell", "shown"),
    [
        ("0.92 ±0.50", "0.92 ±0.50"),
        ("0.92 ±0.92", "0.92 ±0.92"),
        ("0.92 ±0.93", "0.92 ±?"),
        ("0.00 ±0.00", "0.00 ±0.00"),
        ("0.00 ±0.01", "0.00 ±?"),
        ("2.0 ±inf", "2.0 ±?"),
        ("0.92", "0.92"),
        ("-", "-"),
        ("leg ±left.json", "leg ±left.json"),
    ],
)
def test_half_an_interval_that_is_larger_than_the_error_is_a_mark(cell: str, shown: str) -> None:
    """The number stays; what is no number with an interval stays as it is."""
    assert without_vague(Table(caption="c", headings=("h",), rows=((cell,),))).rows == ((shown,),)
