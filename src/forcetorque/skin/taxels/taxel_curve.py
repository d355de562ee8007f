# SPDX-License-Identifier: BSD-3-Clause
"""How the fall of a taxel below rest becomes a pressure: the forms that a curve may have."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import partial
from math import comb

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays
from forcetorque.base.errors import FitError


class CurveKind(StrEnum):
    """Form of a curve."""

    MONOTONE = "monotone"
    """Rises everywhere, goes on as a line beyond the range, and is 0 above rest: the default."""
    LINE = "line"
    """A straight line."""
    POLYNOMIAL = "polynomial"
    """Fifth order, thesis (7.1), as printed: it may fall, and beyond the range it says nothing."""
    CAPACITOR = "capacitor"
    """Inverse of a flat capacitor on a spring, thesis (3.26)."""
    LOGARITHMIC = "logarithmic"
    """Counts fall with the logarithm of the pressure, thesis Table 3.1, through rest: `fall = C ln(1 + p / p0)`."""


DEGREE = 5
"""Degree of the Bernstein polynomials: as many coefficients as thesis (7.1) has, but one, as rest is no pressure."""

_LEAST_RISE = 1e-3
"""Each coefficient rises by at least this share of the mean rise: a curve that is nowhere flat has an inverse."""


def _fit_monotone(share: FloatArray, pressure: FloatArray, weight: FloatArray) -> FloatArray:
    """Fit a curve that rises everywhere: Bernstein polynomials with rising coefficients, then a line.

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


def _monotone_pressure(share: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Evaluate the curve; it is 0 above rest.

    Args:
        share: Fall below rest as a share of the range; shape (...).
        coefficients: Of `_fit_monotone`; shape (6,); Pa.

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


_ORDER = 5
"""Order of the polynomial of thesis (7.1)."""


def _fit_fifth_order(share: FloatArray, pressure: FloatArray, weight: FloatArray) -> FloatArray:
    """Fit thesis (7.1), in the fall below rest: in raw counts the powers would not be separable.

    Args:
        share: Fall below rest as a share of the range; shape (n,).
        pressure: Pressure; shape (n,); Pa.
        weight: Root of the weight of every sample; shape (n,).

    Returns:
        Coefficients of the powers 0 to 5; shape (6,); Pa.
    """
    return _fit_powers(share, pressure, weight, _ORDER)


def _fit_line(share: FloatArray, pressure: FloatArray, weight: FloatArray) -> FloatArray:
    """Fit a straight line.

    Args:
        share: As of `_fit_fifth_order`.
        pressure: As of `_fit_fifth_order`.
        weight: As of `_fit_fifth_order`.

    Returns:
        Coefficients of the powers 0 and 1; shape (2,); Pa.
    """
    return _fit_powers(share, pressure, weight, 1)


def _polynomial_pressure(share: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Evaluate a polynomial, as it is: neither held at 0 nor to its range.

    Args:
        share: Fall below rest as a share of the range; shape (...).
        coefficients: Of the powers from 0 on; shape (k,); Pa.

    Returns:
        Pressure; shape (...); Pa.
    """
    return np.asarray(np.polynomial.polynomial.polyval(share, coefficients), dtype=np.float64)


def _fit_powers(share: FloatArray, pressure: FloatArray, weight: FloatArray, order: int) -> FloatArray:
    powers = np.vander(share, order + 1, increasing=True)
    coefficients = np.linalg.lstsq(powers * weight[:, None], pressure * weight, rcond=None)[0]
    return np.asarray(coefficients, dtype=np.float64)


_Form = Callable[[FloatArray, float], tuple[FloatArray, FloatArray]]
_ITERATIONS = 30
"""Steps of the fit; it settles in less than ten."""
_CONVERGED = 1e-10
"""Change of the curvature at which it has."""


_MOST_BENT = 20.0
"""Largest second number of a form."""


def _fit_bent(form: _Form, share: FloatArray, pressure: FloatArray, weight: FloatArray) -> FloatArray:
    """Fit `p = s g(u, q)` with q from 0, a line, to the largest one by Gauss and Newton.

    Args:
        form: g and its slope by q.
        share: Fall below rest as a share of the range; shape (n,).
        pressure: Pressure; shape (n,); Pa.
        weight: Root of the weight of every sample; shape (n,).

    Returns:
        `s` in Pa and `q`; shape (2,).
    """
    u = np.maximum(share, 0.0)
    q = 0.0

    def best_scale(g: FloatArray) -> float:
        """The best s of a given q is a ratio."""
        return float((weight * g) @ (weight * pressure) / ((weight * g) @ (weight * g)))

    for _ in range(_ITERATIONS):
        g, by_q = form(u, q)
        s = best_scale(g)
        slopes = np.column_stack([g, s * by_q])
        step = np.linalg.lstsq(slopes * weight[:, None], (pressure - s * g) * weight, rcond=None)[0]
        before, q = q, min(max(0.0, q + float(step[1])), _MOST_BENT)
        if abs(q - before) < _CONVERGED:
            break
    return np.array([best_scale(form(u, q)[0]), q])


def _capacitor(u: FloatArray, q: float) -> tuple[FloatArray, FloatArray]:
    """Flat capacitor on a spring, thesis (3.26) with the sign of its derivation, and its slope by q.

    Thesis (3.26) is printed with the sign reversed: with `d = d0 - f / k` and `Ca = kappa eps0 A / d` the pressure is
    `p = k (d0 - kappa eps0 A / Ca) / A`. Counts fall as the capacitance grows, so with `Ca` proportional to `1 + q u`,
    `u` the fall below rest as a share of the range, it becomes `p = s u / (1 + q u)`: two numbers, and none at rest.
    `q` is not below 0, as a capacitor cannot lose capacitance under pressure; at 0 the curve is a line.

    Args:
        u: Fall below rest as a share of the range; shape (n,).
        q: Second number of the curve.

    Returns:
        g and its slope by q; shape (n,) each.
    """
    g = u / (1.0 + q * u)
    return g, -(g**2)


_LEAST_BENT = 1e-4
"""Second number below which the exponential is written by its first terms; they leave out a part in 1e9."""


def _logarithmic(u: FloatArray, q: float) -> tuple[FloatArray, FloatArray]:
    """Inverse of thesis Table 3.1, `E = C ln s + O`, moved so that rest is no pressure, and its slope by q.

    `u = ln(1 + p / p0) / q` gives `p = s (exp(q u) - 1) / q` with `s = q p0`, the slope at rest.

    Args:
        u: As of `_capacitor`.
        q: As of `_capacitor`.

    Returns:
        As of `_capacitor`.
    """
    if q < _LEAST_BENT:
        return u + 0.5 * q * u**2 + q**2 * u**3 / 6.0, 0.5 * u**2 + q * u**3 / 3.0
    rise = np.expm1(q * u)
    return rise / q, (q * u * (rise + 1.0) - rise) / q**2


def _bent_pressure(form: _Form, share: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Evaluate a curve of two numbers; it is 0 above rest.

    Args:
        form: g and its slope by q.
        share: Fall below rest as a share of the range; shape (...).
        coefficients: `s` and `q`; shape (2,).

    Returns:
        Pressure; shape (...); Pa.
    """
    s, q = coefficients
    return np.asarray(s * form(np.maximum(share, 0.0), float(q))[0], dtype=np.float64)


_FITS: Mapping[CurveKind, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
    CurveKind.MONOTONE: _fit_monotone,
    CurveKind.LINE: _fit_line,
    CurveKind.POLYNOMIAL: _fit_fifth_order,
    CurveKind.CAPACITOR: partial(_fit_bent, _capacitor),
    CurveKind.LOGARITHMIC: partial(_fit_bent, _logarithmic),
}
_PRESSURES: Mapping[CurveKind, Callable[[FloatArray, FloatArray], FloatArray]] = {
    CurveKind.MONOTONE: _monotone_pressure,
    CurveKind.LINE: _polynomial_pressure,
    CurveKind.POLYNOMIAL: _polynomial_pressure,
    CurveKind.CAPACITOR: partial(_bent_pressure, _capacitor),
    CurveKind.LOGARITHMIC: partial(_bent_pressure, _logarithmic),
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaxelCurve(ArrayRecord):
    """Pressure of one taxel as a function of its fall below rest, which is scaled by the range."""

    kind: CurveKind
    """Form."""
    coefficients: FloatArray = field(metadata=array(None))
    """Numbers of the form; shape (k,), as many as it has; Pa for each of them, but the second of
    `capacitor` and `logarithmic`, which has no unit."""
    range_counts: float
    """Fall at the highest pressure that was fitted: beyond, the curve is extrapolated; counts."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if not self.range_counts > 0.0:
            raise FitError(f"range_counts: expected a fall above 0 counts, got {self.range_counts:g}")

    def pressure(self, fall: FloatArray) -> FloatArray:
        """Evaluate the curve.

        Args:
            fall: Counts below rest; shape (...).

        Returns:
            Pressure above that at rest; shape (...); Pa.
        """
        return _PRESSURES[self.kind](np.asarray(fall, dtype=np.float64) / self.range_counts, self.coefficients)


def fit_curve(kind: CurveKind, fall: FloatArray, pressure: FloatArray, *, range_counts: float) -> TaxelCurve:
    """Fit a curve by least squares on pressure.

    Counts are few whole numbers: samples of one fall are taken together, which gives the same curve in a hundredth
    of the time.

    Args:
        kind: Form.
        fall: Counts below rest; shape (n,).
        pressure: Pressure above that at rest; shape (n,); Pa.
        range_counts: Fall at the highest fitted pressure; counts.

    Returns:
        The curve.

    Raises:
        FitError: If there are fewer levels of counts than the fifth order has coefficients.
    """
    levels, place, number = np.unique(fall, return_inverse=True, return_counts=True)
    if len(levels) < 6:
        raise FitError(
            f"expected counts at 6 levels or more to fit a curve to, got {len(levels)}: the taxel hardly moves, or too "
            "little of the rise is left; let the interval hold all of it, at a pressure that is high and rises slowly"
        )
    mean = np.bincount(place.ravel(), weights=pressure) / number
    weight = np.sqrt(number / number.sum())
    return TaxelCurve(
        kind=kind, coefficients=_FITS[kind](levels / range_counts, mean, weight), range_counts=range_counts
    )
