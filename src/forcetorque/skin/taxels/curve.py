# SPDX-License-Identifier: BSD-3-Clause
"""How the fall of a taxel below rest becomes a pressure: the forms that a curve may have."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays
from forcetorque.base.errors import FitError
from forcetorque.skin.taxels import capacitor, monotone, polynomial


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


_FITS = {
    CurveKind.MONOTONE: monotone.fit,
    CurveKind.LINE: polynomial.fit_line,
    CurveKind.POLYNOMIAL: polynomial.fit_fifth_order,
    CurveKind.CAPACITOR: capacitor.fit,
}
_PRESSURES = {
    CurveKind.MONOTONE: monotone.pressure,
    CurveKind.LINE: polynomial.pressure,
    CurveKind.POLYNOMIAL: polynomial.pressure,
    CurveKind.CAPACITOR: capacitor.pressure,
}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaxelCurve(ArrayRecord):
    """Pressure of one taxel as a function of its fall below rest, which is scaled by the range."""

    kind: CurveKind
    """Form."""
    coefficients: FloatArray = field(metadata=array(None))
    """Numbers of the form; shape (k,), as many as it has; Pa for each of them, but the second of
    `capacitor`, which has no unit."""
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
