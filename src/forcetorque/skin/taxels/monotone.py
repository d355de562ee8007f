# SPDX-License-Identifier: BSD-3-Clause
"""A curve that rises everywhere: Bernstein polynomials of degree 5 with rising coefficients, then a line."""

from __future__ import annotations

from math import comb

import numpy as np

from forcetorque.base.arrays import FloatArray

DEGREE = 5
"""Of the polynomials: as many coefficients as thesis (7.1) has, but one, as rest is no pressure."""

_LEAST_RISE = 1e-3
"""Each coefficient rises by at least this share of the mean rise: a curve that is nowhere flat has an inverse."""


def fit(share: FloatArray, pressure: FloatArray, weight: FloatArray) -> FloatArray:
    """Fit the curve.

    Bernstein polynomials whose coefficients rise have a sum that rises [1]. The range ends where the mean reading at
    the highest pressure is, not at the largest count: beyond that, only samples are left whose noise took them there,
    which bend the curve down. The line beyond it has the slope of the straight line through all samples.

    Args:
        share: Fall below rest as a share of the range; shape (n,).
        pressure: Pressure; shape (n,); Pa.
        weight: Root of the weight of every sample; shape (n,).

    Returns:
        Five Bernstein coefficients, the first of the six being 0, and the slope per range of the line; shape (6,); Pa.

    References:
        [1] G. G. Lorentz, Bernstein polynomials (1953), section 1.4.
    """
    from scipy.optimize import nnls

    slope = _slope(share, pressure, weight)
    beyond = np.maximum(share - 1.0, 0.0)
    rises = _basis(share) @ np.tril(np.ones((DEGREE, DEGREE)))
    least = _LEAST_RISE * slope / DEGREE
    target = pressure - slope * beyond - least * rises.sum(axis=1)
    steps, _ = nnls(rises * weight[:, None], target * weight)
    return np.array([*np.cumsum(steps + least), slope])


def pressure(share: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Evaluate the curve; it is 0 above rest.

    Args:
        share: Fall below rest as a share of the range; shape (...).
        coefficients: Of `fit`; shape (6,); Pa.

    Returns:
        Pressure; shape (...); Pa.
    """
    return _basis(share) @ coefficients[:DEGREE] + coefficients[DEGREE] * np.maximum(share - 1.0, 0.0)


def _basis(share: FloatArray) -> FloatArray:
    """Bernstein polynomials but the first, which would be the pressure at rest; shape (..., 5)."""
    u = np.clip(share, 0.0, 1.0)
    powers = [comb(DEGREE, k) * u**k * (1.0 - u) ** (DEGREE - k) for k in range(1, DEGREE + 1)]
    return np.asarray(np.stack(powers, axis=-1), dtype=np.float64)


def _slope(share: FloatArray, pressure: FloatArray, weight: FloatArray) -> float:
    """Slope of the straight line through all samples; it rises, as the taxel falls by more than it may not move."""
    square = weight**2 / np.sum(weight**2)
    centred = share - square @ share
    slope = float(square @ (centred * pressure) / (square @ centred**2))
    return max(slope, float(np.finfo(np.float64).tiny))
