# SPDX-License-Identifier: BSD-3-Clause
"""Polynomials as curves: the fifth order of thesis (7.1), and a straight line to compare with."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray

ORDER = 5
"""Of thesis (7.1)."""


def fit_fifth_order(share: FloatArray, pressure: FloatArray, weight: FloatArray) -> FloatArray:
    """Fit thesis (7.1), in the fall below rest: in raw counts the powers would not be told apart.

    Args:
        share: Fall below rest as a share of the range; shape (n,).
        pressure: Pressure; shape (n,); Pa.
        weight: Root of the weight of every sample; shape (n,).

    Returns:
        Coefficients of the powers 0 to 5; shape (6,); Pa.
    """
    return _fit(share, pressure, weight, ORDER)


def fit_line(share: FloatArray, pressure: FloatArray, weight: FloatArray) -> FloatArray:
    """Fit a straight line.

    Args:
        share: As of `fit_fifth_order`.
        pressure: As of `fit_fifth_order`.
        weight: As of `fit_fifth_order`.

    Returns:
        Coefficients of the powers 0 and 1; shape (2,); Pa.
    """
    return _fit(share, pressure, weight, 1)


def pressure(share: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Evaluate a polynomial, as it is: neither held at 0 nor to its range.

    Args:
        share: Fall below rest as a share of the range; shape (...).
        coefficients: Of the powers from 0 on; shape (k,); Pa.

    Returns:
        Pressure; shape (...); Pa.
    """
    return np.asarray(np.polynomial.polynomial.polyval(share, coefficients), dtype=np.float64)


def _fit(share: FloatArray, pressure: FloatArray, weight: FloatArray, order: int) -> FloatArray:
    powers = np.vander(share, order + 1, increasing=True)
    coefficients = np.linalg.lstsq(powers * weight[:, None], pressure * weight, rcond=None)[0]
    return np.asarray(coefficients, dtype=np.float64)
