# SPDX-License-Identifier: BSD-3-Clause
"""Symmetric matrices in JSON: half of them is written, all of them read; numbers of few digits."""

from __future__ import annotations

import json
from typing import Annotated, Any

import numpy as np
import pytest
from pydantic import ValidationError

from forcetorque.base.arrays import ArrayModel, FloatArray, SymmetricField, rounded


class _Covariance(ArrayModel):
    matrix: Annotated[FloatArray, SymmetricField()]
    """A covariance."""


def _random(n: int) -> FloatArray:
    root = np.random.default_rng(n).normal(size=(n, n))
    return np.asarray(root @ root.T)


@pytest.mark.parametrize("n", [0, 1, 2, 7])
def test_a_symmetric_matrix_is_written_by_half(n: int) -> None:
    """The numbers of the lower triangle, and read again to the last bit; so is what an earlier version wrote."""
    matrix = 0.5 * (_random(n) + _random(n).T)
    written = json.loads(_Covariance(matrix=matrix).model_dump_json())["matrix"]
    assert [len(row) for row in written] == list(range(1, n + 1))
    for content in (written, matrix.tolist()):
        read = _Covariance.model_validate({"matrix": content}).matrix
        assert read.shape == (n, n)
        np.testing.assert_array_equal(read, matrix)


def test_a_matrix_that_is_not_symmetric_keeps_all_of_it() -> None:
    """One that differs in the last bit too."""
    matrix = 0.5 * (_random(4) + _random(4).T)
    matrix[0, 3] = np.nextafter(matrix[0, 3], np.inf)
    written = json.loads(_Covariance(matrix=matrix).model_dump_json())["matrix"]
    assert [len(row) for row in written] == [4] * 4
    np.testing.assert_array_equal(_Covariance.model_validate({"matrix": written}).matrix, matrix)


@pytest.mark.parametrize("content", [[[1.0], [2.0]], [[1.0], [2.0, "b"]], [[1.0], [2.0, None]], [1.0, 2.0], "text"])
def test_what_is_no_matrix_is_refused(content: Any) -> None:
    """Rows that are cut, and what are no numbers."""
    with pytest.raises((ValidationError, ValueError), match="expected"):
        _Covariance.model_validate({"matrix": content})


def _digits(number: float) -> int:
    """Digits of the text of a number."""
    return len(repr(float(number)).partition("e")[0].replace("-", "").replace(".", "").strip("0"))


def test_rounded_numbers_have_few_digits() -> None:
    """Nine significant ones of any size, within half a unit of the last; zero and symmetry stay."""
    values = np.random.default_rng(3).normal(size=(9, 9)) * 10.0 ** np.arange(-12, 6, 2)
    values = values + values.T
    values[3, 3] = 0.0
    few = rounded(values, 9)
    np.testing.assert_array_equal(few, few.T)
    np.testing.assert_allclose(few, values, rtol=5e-9, atol=0.0)
    digits = [_digits(number) for number in few.ravel()]
    assert max(digits) == 9
    assert max(_digits(number) for number in values.ravel()) > 14


def test_numbers_near_the_end_of_floating_point_are_rounded_too() -> None:
    """None becomes what JSON does not have."""
    values = np.array([5e-324, -1e-305, 1.2345e-291, -1.23456e300, 0.0])
    with np.errstate(all="raise"):
        few = rounded(values, 4)
    np.testing.assert_allclose(few, [0.0, 0.0, 1.23e-291, -1.235e300, 0.0], rtol=1e-15, atol=0.0)
