# SPDX-License-Identifier: BSD-3-Clause
"""The sensor model `wrench = matrix raw + coefficients (variables - reference values) + offset`, and its inverse."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only, require_last_axis, require_shape
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.experiment.calibration.quadratic_correction import QuadraticCorrection


def _no_coefficients() -> FloatArray:
    return np.zeros((6, 0))


def _no_values() -> FloatArray:
    return np.zeros(0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WrenchModel:
    """What turns raw readings, and linear variables such as temperature, into a wrench (thesis 5.1, 5.9)."""

    matrix: FloatArray
    """Calibration matrix; shape (6, c); N/count, N m/count."""
    offset: FloatArray
    """Offset in wrench space, where every variable has its reference value; shape (6,); N, N m."""
    coefficients: FloatArray = field(default_factory=_no_coefficients)
    """Wrench per unit of every variable; shape (6, v); N, N m per unit."""
    reference_values: FloatArray = field(default_factory=_no_values)
    """Values at which the variables contribute nothing; shape (v,)."""
    quadratic: QuadraticCorrection | None = None
    """What is taken off the wrench that these give; None for a linear sensor."""

    def __post_init__(self) -> None:
        variables = len(np.asarray(self.reference_values))
        for name, shape in (
            ("matrix", (6, None)),
            ("offset", (6,)),
            ("coefficients", (6, variables)),
            ("reference_values", (variables,)),
        ):
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=shape))

    def wrench(self, raw: Any, variables: Any = None) -> FloatArray:
        """Turn readings into wrenches.

        Args:
            raw: Raw readings; shape (..., c); counts.
            variables: Values of the variables at the same instants; shape (..., v); may be None if there is none.

        Returns:
            Wrenches; shape (..., 6); N, N m.

        Raises:
            ShapeError: If the shapes are not these.
        """
        reading = self._linear(raw, variables)
        return reading if self.quadratic is None else self.quadratic.corrected(reading)

    @property
    def linear(self) -> WrenchModel:
        """The same without quadratic terms."""
        return replace(self, quadratic=None)

    def beyond(self, raw: Any, variables: Any = None) -> BoolArray:
        """Tell which readings are of loads outside those that the quadratic terms were fitted to.

        Args:
            raw: As of `wrench`.
            variables: As of `wrench`.

        Returns:
            Whether the correction is that of the limit; shape (...); none of a linear sensor.
        """
        wrench = self.wrench(raw, variables)
        return np.zeros(wrench.shape[:-1], dtype=np.bool_) if self.quadratic is None else self.quadratic.beyond(wrench)

    def _linear(self, raw: Any, variables: Any) -> FloatArray:
        counts = np.asarray(raw, dtype=np.float64)
        require_last_axis(counts, name="raw", length=self.matrix.shape[1])
        wrench: FloatArray = counts @ self.matrix.T + self.offset
        if not len(self.reference_values):
            return wrench
        values = np.empty((*counts.shape[:-1], 0)) if variables is None else np.asarray(variables, dtype=np.float64)
        require_shape(values, name="variables", shape=(*counts.shape[:-1], len(self.reference_values)))
        return wrench + (values - self.reference_values) @ self.coefficients.T

    def counted_from_zero(self, variables: int) -> WrenchModel:
        """State the same model with reference values of zero, so that models of one sensor can be stacked.

        Args:
            variables: Number of variables of the result; a model of none then gets coefficients of zero.

        Returns:
            The model; its offset is that where all variables are zero.

        Raises:
            ShapeError: If the model has another number of variables, and not none.
        """
        own = len(self.reference_values)
        if own not in (0, variables):
            raise ShapeError(f"model: expected {variables} variables or none, got {own}")
        coefficients = self.coefficients if own else np.zeros((6, variables))
        return replace(
            self,
            offset=self.offset - self.coefficients @ self.reference_values,
            coefficients=coefficients,
            reference_values=np.zeros(variables),
        )


_WORST_CONDITION = 1e12
"""Beyond this condition number of the row-scaled matrix, double precision loses the counts."""


def is_invertible(matrix: FloatArray) -> bool:
    """Tell whether a calibration matrix can be undone, whatever the units of its rows.

    Args:
        matrix: Calibration matrix; shape (6, 6); N/count, N m/count.

    Returns:
        Whether its inverse is more than rounding.
    """
    rows = np.linalg.norm(matrix, axis=1, keepdims=True)
    return bool((rows > 0.0).all() and np.linalg.cond(matrix / rows) < _WORST_CONDITION)


def recover_raw(wrench: Any, prior: Any) -> FloatArray:
    """Undo the matrix with which a sensor's electronics turned counts into a wrench.

    Counts come back up to a constant: an offset that the electronics added stays in them and ends
    in the fitted offset.

    Args:
        wrench: Calibrated readings; shape (n, 6); N, N m.
        prior: Matrix that the electronics used; shape (6, 6); N/count, N m/count.

    Returns:
        Raw readings; shape (n, 6); counts, not integers.

    Raises:
        ShapeError: If the shapes are not these.
        FitError: If the matrix cannot be inverted.
    """
    readings, matrix = np.asarray(wrench, dtype=np.float64), np.asarray(prior, dtype=np.float64)
    require_last_axis(readings, name="wrench", length=6)
    if matrix.shape != (6, 6):
        raise ShapeError(f"prior: expected shape (6, 6) to recover raw counts, got {matrix.shape}")
    if not is_invertible(matrix):
        raise FitError("the prior matrix is singular, so raw counts cannot be recovered from the calibrated stream")
    return np.asarray(np.linalg.solve(matrix, readings.T).T, dtype=np.float64)
