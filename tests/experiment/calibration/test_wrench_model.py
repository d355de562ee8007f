# SPDX-License-Identifier: BSD-3-Clause
"""The same model, stated with other reference values, gives the same wrenches."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError
from forcetorque.experiment.calibration.sensor_model import WrenchModel

RNG = np.random.default_rng(1)
MODEL = WrenchModel(
    matrix=RNG.normal(size=(6, 6)),
    offset=RNG.normal(size=6),
    coefficients=RNG.normal(size=(6, 2)),
    reference_values=np.array([25.0, -3.0]),
)
RAW = RNG.normal(size=(20, 6))
VARIABLES = RNG.normal(size=(20, 2))

ROUNDING = 1e-13
"""Sums of ten numbers of size 100."""


def test_counting_from_zero_changes_no_wrench() -> None:
    """Only where the offset is stated moves; it moves by what the reference values are worth."""
    same = MODEL.counted_from_zero(2)
    np.testing.assert_array_equal(same.reference_values, 0.0)
    np.testing.assert_allclose(same.wrench(RAW, VARIABLES), MODEL.wrench(RAW, VARIABLES), atol=100 * ROUNDING)
    assert np.abs(same.offset - MODEL.offset).max() > 1.0


def test_a_model_of_no_variable_ignores_those_it_gets() -> None:
    """Coefficients of zero."""
    plain = WrenchModel(matrix=MODEL.matrix, offset=MODEL.offset)
    np.testing.assert_array_equal(plain.counted_from_zero(2).wrench(RAW, VARIABLES), plain.wrench(RAW))


def test_other_variables_are_refused() -> None:
    """A model of two is not one of three."""
    with pytest.raises(ShapeError, match="expected 3 variables or none, got 2"):
        MODEL.counted_from_zero(3)
