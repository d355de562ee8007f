# SPDX-License-Identifier: BSD-3-Clause
"""Pressure between taxels: shares by a correlation of Matern, against its definition by Bessel functions."""

from __future__ import annotations

from math import gamma

import numpy as np
import pytest
from scipy.special import kv

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.wrench.pressure_to_wrench import LENGTH_M, kriging_shares

ROUNDING = 1e-9
"""Of a system of three equations whose condition is below 1e4."""
SMOOTHNESS = 2.5


def _correlation(distance_m: FloatArray) -> FloatArray:
    """Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, eq. 4.14."""
    argument = np.sqrt(2.0 * SMOOTHNESS) * distance_m / LENGTH_M
    return np.asarray(2.0 ** (1.0 - SMOOTHNESS) / gamma(SMOOTHNESS) * argument**SMOOTHNESS * kv(SMOOTHNESS, argument))


@pytest.mark.parametrize("apart", [0.3, 1.0, 2.5])
@pytest.mark.parametrize("aside", [0.2, 0.7, 3.0])
def test_two_taxels_share_a_point_by_their_correlation_with_it(apart: float, aside: float) -> None:
    """Half each, and half of the difference of correlations over what is left of that between the taxels."""
    taxels = LENGTH_M * np.array([[0.0, 0.0, 0.0], [apart, 0.0, 0.0]])
    point = LENGTH_M * np.array([0.25 * apart, aside, 0.0])
    first, second = _correlation(np.linalg.norm(taxels - point, axis=1))
    between = _correlation(np.array([apart * LENGTH_M]))[0]
    shares = kriging_shares(taxels[None], point[None, None])[0, 0]
    expected = 0.5 + 0.5 * (first - second) / (1.0 - between)
    np.testing.assert_allclose(shares, [expected, 1.0 - expected], atol=ROUNDING)


def test_a_point_on_a_taxel_has_its_pressure() -> None:
    """Its share is one, that of all others zero."""
    taxels = LENGTH_M * np.random.default_rng(1).uniform(-2.0, 2.0, size=(1, 6, 3))
    np.testing.assert_allclose(kriging_shares(taxels, taxels)[0], np.eye(6), atol=ROUNDING)
