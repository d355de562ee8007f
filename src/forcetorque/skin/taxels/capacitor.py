# SPDX-License-Identifier: BSD-3-Clause
"""The curve of a flat capacitor on a spring, thesis (3.26) with the sign of its derivation."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray

_ROUNDS = 30
"""Steps of the fit; it settles in less than ten."""
_SETTLED = 1e-10
"""Change of the curvature at which it has."""


def fit(share: FloatArray, pressure: FloatArray, weight: FloatArray) -> FloatArray:
    """Fit the curve.

    Thesis (3.26) is printed with the sign reversed: with `d = d0 - f / k` and `Ca = kappa eps0 A / d` the pressure is
    `p = k (d0 - kappa eps0 A / Ca) / A`. Counts fall as the capacitance grows, so with `Ca` proportional to `1 + q u`,
    `u` the fall below rest as a share of the range, it becomes `p = s u / (1 + q u)`: two numbers, and none at rest.
    `q` is not below 0, as a capacitor cannot lose capacitance under pressure; at 0 the curve is a line.

    Args:
        share: Fall below rest as a share of the range; shape (n,).
        pressure: Pressure; shape (n,); Pa.
        weight: Root of the weight of every sample; shape (n,).

    Returns:
        `s` in Pa and `q`; shape (2,).
    """
    u = np.maximum(share, 0.0)
    q = 0.0
    for _ in range(_ROUNDS):
        # Gauss and Newton on p = s g(u, q); for a given q the best s is a ratio
        g = u / (1.0 + q * u)
        s = float((weight * g) @ (weight * pressure) / ((weight * g) @ (weight * g)))
        slopes = np.column_stack([g, -s * g**2])
        step = np.linalg.lstsq(slopes * weight[:, None], (pressure - s * g) * weight, rcond=None)[0]
        before, q = q, max(0.0, q + float(step[1]))
        if abs(q - before) < _SETTLED:
            break
    g = u / (1.0 + q * u)
    s = float((weight * g) @ (weight * pressure) / ((weight * g) @ (weight * g)))
    return np.array([s, q])


def pressure(share: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Evaluate the curve; it is 0 above rest.

    Args:
        share: Fall below rest as a share of the range; shape (...).
        coefficients: Of `fit`; shape (2,).

    Returns:
        Pressure; shape (...); Pa.
    """
    s, q = coefficients
    u = np.maximum(share, 0.0)
    return s * u / (1.0 + q * u)
