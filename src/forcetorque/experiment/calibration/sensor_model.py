# SPDX-License-Identifier: BSD-3-Clause
"""Sensor model `wrench = matrix raw + coefficients (variables - reference values) + offset`, and its inverse."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from forcetorque.base.arrays import (
    ArrayRecord,
    BoolArray,
    FloatArray,
    array,
    read_only,
    require_last_axis,
    require_shape,
)
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.calibration.quadratic_correction import QuadraticCorrection


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearVariable:
    """A variable that a fit may add to the raw readings (thesis 5.9)."""

    name: str
    """Name, such as `temperature`."""
    unit: str
    """Unit."""
    reference_value: float | None = None
    """Value at which it contributes nothing; None to take that of the first sample."""
    prior: FloatArray | None = None
    """Coefficients to stay close to; shape (6,); N, N m per unit; None for no penalty."""
    prior_deviation: FloatArray | None = None
    """How far the coefficients may be from them; shape (6,); N, N m per unit; None for 0.5 % of full scale per degree,
    and for any other unit one full scale over the range that was seen. Only the generative model asks."""

    def __post_init__(self) -> None:
        if self.prior_deviation is not None:
            deviation = read_only(self.prior_deviation, name=f"variable {self.name!r}: prior_deviation", shape=(6,))
            if not (np.isfinite(deviation).all() and (deviation > 0.0).all()):
                raise FitError(
                    f"variable {self.name!r}: expected six prior deviations above 0, got {deviation.tolist()}"
                )
            object.__setattr__(self, "prior_deviation", deviation)
        if self.prior is not None:
            prior = read_only(self.prior, name=f"variable {self.name!r}: prior", shape=(6,))
            if not np.isfinite(prior).all():
                raise FitError(f"variable {self.name!r}: expected six finite prior coefficients, got {prior.tolist()}")
            object.__setattr__(self, "prior", prior)
        if self.reference_value is not None and not np.isfinite(self.reference_value):
            raise FitError(f"variable {self.name!r}: expected a finite reference value, got {self.reference_value}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WrenchModel(ArrayRecord):
    """What turns raw readings, and linear variables such as temperature, into a wrench (thesis 5.1, 5.9)."""

    matrix: FloatArray = field(metadata=array(6, None))
    """Calibration matrix; shape (6, c); N/count, N m/count."""
    offset: FloatArray = field(metadata=array(6))
    """Offset in wrench space, where every variable has its reference value; shape (6,); N, N m."""
    coefficients: FloatArray = field(default_factory=partial(np.zeros, (6, 0)), metadata=array(6, "v"))
    """Wrench per unit of every variable; shape (6, v); N, N m per unit."""
    reference_values: FloatArray = field(default_factory=partial(np.zeros, 0), metadata=array("v"))
    """Values at which the variables contribute nothing; shape (v,)."""
    quadratic: QuadraticCorrection | None = None
    """What is taken off the wrench that these give; None for a linear sensor."""

    def expected_reading(self, load: FloatArray) -> FloatArray:
        """Give what the model would read without error.

        Args:
            load: Wrenches; shape (..., 6); N, N m.

        Returns:
            The same, with zeros for components that the sensor does not measure.
        """
        return measured_part(load, measured_components(self.matrix))

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


def measured_components(matrix: FloatArray) -> BoolArray:
    """Tell which components of a wrench a sensor measures: rows of its matrix that are not zero.

    Args:
        matrix: Calibration matrix; shape (6, c); N/count, N m/count.

    Returns:
        Whether it measures each; shape (6,).
    """
    return (matrix != 0.0).any(axis=1)


def measured_part(load: FloatArray, measured: BoolArray) -> FloatArray:
    """Give what a sensor without error reads of a load.

    Args:
        load: Wrenches; shape (..., 6); N, N m.
        measured: Components that it measures; shape (6,).

    Returns:
        The same, with zeros for the others.
    """
    return np.where(measured, load, 0.0)


def component_names(measured: BoolArray) -> str:
    """Name components of a wrench.

    Args:
        measured: Whether each is measured; shape (6,).

    Returns:
        Their names in order, such as `fx, fz`.
    """
    return ", ".join(name for name, own in zip(WRENCH_COMPONENTS, measured, strict=True) if own)


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


def secondary_matrix(matrix: Any, prior: Any) -> FloatArray:
    """Give the matrix that turns readings made with the prior into readings made with a new matrix.

    Args:
        matrix: New calibration matrix; shape (6, 6); N/count, N m/count.
        prior: Matrix that the electronics use; shape (6, 6); N/count, N m/count.

    Returns:
        `S = C C_prior^-1` (5.20); shape (6, 6).

    Raises:
        ShapeError: If a matrix is not 6 x 6.
        FitError: If the prior cannot be inverted.
    """
    new, old = np.asarray(matrix, dtype=np.float64), np.asarray(prior, dtype=np.float64)
    for name, values in (("matrix", new), ("prior", old)):
        if values.shape != (6, 6):
            raise ShapeError(f"{name}: expected shape (6, 6), got {values.shape}")
    if not is_invertible(old):
        raise FitError("the prior matrix is singular, so no matrix corrects what it made")
    return np.asarray(np.linalg.solve(old.T, new.T).T, dtype=np.float64)


def secondary_model(new: WrenchModel, stream: WrenchModel) -> WrenchModel:
    """Give what turns a stream that is already calibrated, temperature and offset included, into a new calibration.

    The stream is `f_in = C_w r + c_w (t - t_w) + o_w`, the new one `f = C r + c (t - t0) + o`. So
    `f = S f_in + c_s (t - t0) + o_s` with `S = C C_w^-1`, `c_s = c - S c_w`, `o_s = o - S [o_w + c_w (t0 - t_w)]`
    (thesis 5.20 carried on to variables and offset).

    Args:
        new: New model of the sensor, of six channels.
        stream: Model with which the stream is made, of the same variables in the same order, or of none.

    Returns:
        Model whose "raw readings" are the stream's wrenches: S, o_s, c_s and the new reference values.

    Raises:
        ShapeError: If a matrix is not 6 x 6, or the stream depends on variables that the new model does not have.
        FitError: If the matrix of the stream cannot be inverted, or a model has quadratic terms.
    """
    if new.quadratic is not None or stream.quadratic is not None:
        raise FitError("expected two linear models, got quadratic terms, which no matrix takes from one to the other")
    matrix = secondary_matrix(new.matrix, stream.matrix)
    if not len(stream.reference_values):
        return replace(new, matrix=matrix, offset=new.offset - matrix @ stream.offset)
    if len(stream.reference_values) != len(new.reference_values):
        raise ShapeError(
            f"stream: expected the {len(new.reference_values)} variables of the new model or none, "
            f"got {len(stream.reference_values)}"
        )
    stream_offset = stream.offset + stream.coefficients @ (new.reference_values - stream.reference_values)
    return replace(
        new,
        matrix=matrix,
        offset=new.offset - matrix @ stream_offset,
        coefficients=new.coefficients - matrix @ stream.coefficients,
    )
