# SPDX-License-Identifier: BSD-3-Clause
"""How far readings lie outside what a calibration was fitted on, as loads, and what error is predicted there.

Readings are compared by what the load alone gives: `pinv(matrix) (matrix raw + offset + coefficients (v - v0))`. A
sensor that was switched on anew, or is warmer, reads other counts under the same load; with the offset of its session
these counts are those of the fit again, so a power-up by itself is no extrapolation.

Along each principal direction of the fitted readings there is a smallest and a largest one. What lies beyond by more
than a tenth of their distance, or more than noise, is outside; the rest of it, through the matrix, is how far.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.calibration.artefact import Calibration
from forcetorque.calibration.wrench_model import WrenchModel

MARGIN = 0.1
"""Share of a fitted range by which it may be left before that is worth a word."""

_NOISE_DEVIATIONS = 4.0
"""Standard deviations of what the fit left unexplained: along a direction that no load moved the range is of noise."""

_MOST_PREDICTED = 20_000
"""Readings of which the predicted error is computed; evenly picked from more, whose mean square they give."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Extrapolation:
    """How far n readings lie outside what was fitted."""

    load: FloatArray
    """Loads by the linear part of the calibration; shape (n, 6); N, N m; NaN in gaps."""
    beyond: FloatArray
    """What of them lies beyond the fitted range; shape (n, 6); N, N m; 0 of readings inside."""
    variables: FloatArray
    """Variables; shape (n, v)."""
    variables_outside: BoolArray
    """Which of them lie outside their fitted range; shape (n, v)."""
    at_limit: BoolArray
    """Whether quadratic terms are taken as at the limit of the loads that they were fitted to; shape (n,). They have no
    margin, so by itself that is not outside."""

    @property
    def known(self) -> BoolArray:
        """Whether a reading has no gap; shape (n,)."""
        known: BoolArray = np.isfinite(self.load).all(axis=1)
        return known

    @property
    def outside(self) -> BoolArray:
        """Whether reading or variable lies outside what was fitted; shape (n,)."""
        outside: BoolArray = self.beyond.any(axis=1) | self.variables_outside.any(axis=1)
        return outside


def load_readings(model: WrenchModel, raw: Any, variables: Any = None) -> tuple[FloatArray, FloatArray]:
    """Take from readings what offset and variables give.

    Args:
        model: What turns readings into wrenches, with the offset of their session.
        raw: Raw readings; shape (n, c); counts.
        variables: Values of the variables; shape (n, v); None where there is none.

    Returns:
        Loads by the linear part, shape (n, 6), N and N m; and the readings that these alone give, shape (n, c), counts.
    """
    load = replace(model, quadratic=None).wrench(raw, variables)
    return load, load @ np.linalg.pinv(model.matrix).T


def extrapolation(
    calibration: Calibration, raw: Any, variables: Any = None, *, offset: FloatArray | None = None
) -> Extrapolation:
    """Tell how far readings lie outside what a calibration was fitted on.

    Args:
        calibration: The calibration.
        raw: Raw readings; shape (n, c); counts; NaN in gaps.
        variables: Values of its variables in their order; shape (n, v); None where it has none.
        offset: Offset of the readings' session; shape (6,); N, N m; that of the calibration if None.

    Returns:
        The readings' loads, and what of them lies beyond.
    """
    counts, model = np.asarray(raw, dtype=np.float64), calibration.model
    values = np.empty((len(counts), 0)) if variables is None else np.asarray(variables, dtype=np.float64)
    model = model if offset is None else replace(model, offset=offset)
    load, alone = load_readings(model, counts, values)
    directions, low, high = _box(calibration)
    if calibration.validity.direction_minimum is None:
        # ranges of channels: what no load does to more than six of them is in the range too
        alone = counts + (load - counts @ model.matrix.T) @ np.linalg.pinv(model.matrix).T
    along = alone @ directions.T
    margin = np.maximum(MARGIN * (high - low), _NOISE_DEVIATIONS * _noise(calibration, directions))
    left = (along < low - margin) | (along > high + margin)
    beyond = np.where(left, along - np.clip(along, low, high), 0.0) @ directions @ model.matrix.T
    quadratic, shape = calibration.quadratic, load.shape[:1]
    return Extrapolation(
        load=load,
        beyond=beyond,
        variables=values,
        variables_outside=_variables_outside(calibration, values),
        at_limit=np.zeros(shape, dtype=np.bool_) if quadratic is None else quadratic.beyond(quadratic.corrected(load)),
    )


def predicted_error(calibration: Calibration, load: FloatArray, variables: FloatArray) -> tuple[float, float] | None:
    """Predict the error under loads, as changes from the mean fitted load, at which the offset is known.

    Args:
        calibration: The calibration.
        load: Loads, at least one; shape (n, 6); N, N m.
        variables: Variables beside them; shape (n, v).

    Returns:
        Root mean square errors of force, N, and moment, N m; None for a calibration without a posterior.
    """
    posterior = calibration.posterior
    if posterior is None:
        return None
    step = -(-len(load) // _MOST_PREDICTED)
    change = load[::step] - posterior.load_centre
    warmer = variables[::step] - calibration.model.reference_values if posterior.variables else None
    variance = np.einsum("nii->ni", posterior.error_covariance(change, variables=warmer)).mean(axis=0)
    return float(np.sqrt(variance[:3].sum())), float(np.sqrt(variance[3:].sum()))


def _box(calibration: Calibration) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Directions, and the smallest and largest reading of a load along each."""
    validity = calibration.validity
    if validity.direction_minimum is not None and validity.direction_maximum is not None:
        return validity.directions, validity.direction_minimum, validity.direction_maximum
    shift = np.linalg.pinv(calibration.matrix) @ calibration.offset
    low, high = validity.raw_minimum_counts + shift, validity.raw_maximum_counts + shift
    return np.eye(len(shift)), low, high


def _noise(calibration: Calibration, directions: FloatArray) -> FloatArray:
    """Deviation of readings along each direction that the fit left unexplained; counts."""
    noise: FloatArray = np.sqrt((directions @ np.linalg.pinv(calibration.matrix)) ** 2 @ calibration.residual_rms**2)
    return noise


def _variables_outside(calibration: Calibration, values: FloatArray) -> BoolArray:
    low = np.array([variable.minimum for variable in calibration.variables])
    high = np.array([variable.maximum for variable in calibration.variables])
    margin = MARGIN * (high - low)
    outside: BoolArray = (values < low - margin) | (values > high + margin)
    return outside
