# SPDX-License-Identifier: BSD-3-Clause
"""The polynomial transfer function."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial as PowerSeries

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError, SensorError
from forcetorque.sensor.transfer.points import calibration_points, least_squares
from forcetorque.sensor.transfer.transfer_function import TransferFunction


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Polynomial(TransferFunction):
    """`E = D_0 + D_1 s + ... + D_n s^n`, thesis (3.7).

    The direct fit of the inverse, thesis (3.8), is a fit with stimulus and output swapped.
    """

    coefficients: FloatArray
    """D_0 to D_n; shape (n + 1,); unit of the output per that of the stimulus to the power of the index."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        array = read_only(self.coefficients, name="coefficients", shape=(None,))
        object.__setattr__(self, "coefficients", array)
        if not len(array) or not np.isfinite(array).all():
            raise SensorError(f"Polynomial: expected at least one finite coefficient, got {array.tolist()}")

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return np.asarray(PowerSeries(self.coefficients)(stimulus), dtype=np.float64)

    def _turning_points(self) -> FloatArray:
        slope = PowerSeries(self.coefficients).deriv().trim()
        if slope.degree() == 0:
            return np.zeros(0)
        roots = slope.roots()
        real = np.unique(roots[np.isreal(roots)].real)
        inside = real[(real > self.lowest) & (real < self.highest)]
        # the slope may touch zero without changing its sign, as that of s^3 does: that is no turn
        edges = np.concatenate([[self.lowest], inside, [self.highest]])
        signs = np.sign(slope(0.5 * (edges[:-1] + edges[1:])))
        turns: FloatArray = inside[signs[:-1] != signs[1:]]
        return turns


def fit_polynomial(stimulus: Any, output: Any, *, degree: int = 3) -> Polynomial:
    """Fit a polynomial by least squares of the output.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).
        degree: Highest power.

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If the degree is below 1 or there are not more different stimuli than the degree.
    """
    if degree < 1:
        raise FitError(f"polynomial: expected a degree of at least 1, got {degree}")
    stimuli, outputs = calibration_points(stimulus, output, parameters=degree + 1)
    lowest, highest = float(stimuli.min()), float(stimuli.max())
    # solved with the stimuli brought to -1 to 1, where powers differ enough to be told apart
    scaled = (2.0 * stimuli - (lowest + highest)) / (highest - lowest)
    solution = least_squares(np.vander(scaled, degree + 1, increasing=True), outputs)
    series = PowerSeries(solution, domain=[lowest, highest]).convert(domain=[-1.0, 1.0])
    coefficients = np.zeros(degree + 1)
    coefficients[: len(series.coef)] = series.coef  # convert() drops high powers that are exactly zero
    return Polynomial(lowest=lowest, highest=highest, coefficients=coefficients)
