# SPDX-License-Identifier: BSD-3-Clause
"""How far readings lie outside what a calibration was fitted on, as loads, and what error is predicted there.

Readings are compared by the loads that the linear part of the calibration gives, with the offset of their session. A
sensor that was switched on anew, or is warmer, reads other counts under the same load; with that offset the load is the
same again, so a power-up by itself is no extrapolation.

Along each principal direction of the fitted loads there is a smallest and a largest one. What lies beyond by more than
a tenth of their distance, and by more than noise, is outside; the distance from the range is how far.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.calibration.artefact import Calibration

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
        return np.asarray(np.isfinite(self.load).all(axis=1))

    @property
    def outside(self) -> BoolArray:
        """Whether reading or variable lies outside what was fitted; shape (n,)."""
        return np.asarray(self.beyond.any(axis=1) | self.variables_outside.any(axis=1))


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
    load = model.linear.wrench(counts, values)
    box = _box(calibration)
    # channels keep what no load does to more than six of them, as their ranges do
    along = (counts + (load - counts @ model.matrix.T) @ box.to_along.T) if box.of_channels else load @ box.to_along.T
    noise = np.sqrt(box.to_along**2 @ calibration.residual_rms**2)
    margin = np.maximum(MARGIN * (box.high - box.low), _NOISE_DEVIATIONS * noise)
    left = (along < box.low - margin) | (along > box.high + margin)
    beyond = np.where(left, along - np.clip(along, box.low, box.high), 0.0) @ box.to_load.T
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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Box:
    """What was fitted, along some directions."""

    to_along: FloatArray
    """From loads to what they are along each direction; shape (k, 6)."""
    to_load: FloatArray
    """And back; shape (6, k)."""
    low: FloatArray
    """Smallest fitted along each; shape (k,)."""
    high: FloatArray
    """Largest; shape (k,)."""
    of_channels: bool
    """Whether the directions are channels."""


def _box(calibration: Calibration) -> _Box:
    validity, loads = calibration.validity, calibration.validity.loads
    if loads is not None:
        back = np.asarray(np.linalg.inv(loads.directions), dtype=np.float64)
        low, high = loads.direction_minimum, loads.direction_maximum
        return _Box(to_along=loads.directions, to_load=back, low=low, high=high, of_channels=False)
    to_counts = np.asarray(np.linalg.pinv(calibration.matrix), dtype=np.float64)
    low, high = (
        counts + to_counts @ calibration.offset for counts in (validity.raw_minimum_counts, validity.raw_maximum_counts)
    )
    return _Box(to_along=to_counts, to_load=calibration.matrix, low=low, high=high, of_channels=True)


def _variables_outside(calibration: Calibration, values: FloatArray) -> BoolArray:
    low = np.array([variable.minimum for variable in calibration.variables])
    high = np.array([variable.maximum for variable in calibration.variables])
    margin = MARGIN * (high - low)
    outside: BoolArray = (values < low - margin) | (values > high + margin)
    return outside
