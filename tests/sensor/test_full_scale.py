# SPDX-License-Identifier: BSD-3-Clause
"""Resolution of the axes of a matrix."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.sensor.full_scale import axis_resolution

MATRIX = np.vstack(
    [0.02 * np.array([[1.0, -2, 0, 0, 0, 1], [0, 1, 1, 0, -1, 0], [1, 1, 1, 0, 0, 3]]), 1e-4 * np.eye(6)[:3]]
)

ROUNDING = 1e-14
"""Relative rounding of a few products."""


def test_axis_figures_by_hand() -> None:
    """Row 0 is 0.02 (1, -2, 0, 0, 0, 1): 0.08 N per count of all."""
    assert axis_resolution(MATRIX)[0] == pytest.approx(0.08, rel=ROUNDING)


def test_rows_scale_with_their_unit() -> None:
    """Moments in N mm are a thousand times those in N m."""
    in_mm = MATRIX * np.array([1, 1, 1, 1e3, 1e3, 1e3])[:, None]
    np.testing.assert_allclose(axis_resolution(in_mm)[3:], 1e3 * axis_resolution(MATRIX)[3:], rtol=ROUNDING)


def test_matrices_of_another_shape_are_refused() -> None:
    """Six rows, any number of channels, finite."""
    assert axis_resolution(np.ones((6, 8))).shape == (6,)
    with pytest.raises(ShapeError, match=r"matrix: expected an array of shape \(6, n\)"):
        axis_resolution(np.ones((8, 6)))
    with pytest.raises(SensorError, match="finite"):
        axis_resolution(np.full((6, 6), np.nan))
