# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be drawn is refused by the name of its argument; what is not a finite number is not drawn."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError
from forcetorque.results.figure_style import drawable, drawable_each, instants


def test_what_is_not_finite_becomes_nan_in_a_copy() -> None:
    """The caller's array stays as it is."""
    values = np.array([1.0, np.inf, -np.inf, np.nan])
    np.testing.assert_array_equal(drawable(values, name="values", shape=(None,)), [1.0, np.nan, np.nan, np.nan])
    assert np.isinf(values[1])


@pytest.mark.parametrize("values", [np.zeros((3, 5)), np.zeros(6), np.zeros((0, 6)), 1.0])
def test_other_shapes_are_refused(values: object) -> None:
    """With the name of the argument; no samples are no data either."""
    with pytest.raises(ShapeError, match=r"^force: expected"):
        drawable(values, name="force", shape=(None, 6))


def test_a_mapping_names_the_array_that_is_wrong() -> None:
    """The name within the mapping is part of the message; the order of the mapping is kept."""
    with pytest.raises(ShapeError, match=r"^clouds\['grid'\]: expected an array of shape \(n, 6\), got \(4, 3\)$"):
        drawable_each({"leg": np.zeros((4, 6)), "grid": np.zeros((4, 3))}, name="clouds", shape=(None, 6))
    with pytest.raises(ShapeError, match=r"^clouds: expected at least one name"):
        drawable_each({}, name="clouds", shape=(None, 6))
    assert list(drawable_each({"b": [1.0], "a": [2.0]}, name="x", shape=(1,))) == ["b", "a"]


def test_times_that_stand_still_are_taken() -> None:
    """Two samples of one instant are drawn one above the other."""
    np.testing.assert_array_equal(instants([0, 1, 1, 2]), [0.0, 1.0, 1.0, 2.0])


@pytest.mark.parametrize(
    ("times", "at"), [([0.0, 1.0, 0.5], 2), ([np.nan, 1.0], 0), ([0.0, np.nan, 2.0], 1), ([0.0, 1.0, np.inf], 2)]
)
def test_times_that_fall_or_are_missing_are_refused(times: list[float], at: int) -> None:
    """With the index of the first that is wrong."""
    with pytest.raises(ShapeError, match=rf"time_s: expected finite instants .* at index {at}$"):
        instants(times)
