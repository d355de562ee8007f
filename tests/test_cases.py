# SPDX-License-Identifier: BSD-3-Clause
"""Which tests `make test` runs: first cases of a test always, and fewer examples of the tests of Hypothesis."""

from __future__ import annotations

import pytest
from hypothesis import given, is_hypothesis_test, settings, strategies as st

from tests import fuzzing
from tests.cases import some_cases


@given(cases=st.lists(st.integers(), min_size=1), quick=st.integers(1, 5))
def test_the_first_cases_are_quick_and_all_are_there(cases: list[int], quick: int) -> None:
    """In their order; those after the first ones are marked `long`."""
    names, parameters = some_cases("number", cases, quick=quick).args
    assert names == "number"
    assert [parameter.values for parameter in parameters] == [(case,) for case in cases]
    long = [[mark.name for mark in parameter.marks] == ["long"] for parameter in parameters]
    assert long == [k >= quick for k in range(len(cases))]


def test_a_case_may_have_several_values() -> None:
    """One for every name."""
    _, parameters = some_cases(("mass", "unit"), [(1.0, "kg"), (2.0, "g")]).args
    assert [parameter.values for parameter in parameters] == [(1.0, "kg"), (2.0, "g")]


def test_tests_of_hypothesis_draw_all_examples_in_the_long_run(request: pytest.FixtureRequest) -> None:
    """All are marked `fuzz`, which it selects, and draw their share of 100 unless they state a number."""
    drawn = [item for item in request.session.items if is_hypothesis_test(getattr(item, "obj", None))]
    assert drawn
    assert all(item.get_closest_marker("fuzz") for item in drawn)
    assert settings().max_examples == 100 // fuzzing.SHARE[0]
