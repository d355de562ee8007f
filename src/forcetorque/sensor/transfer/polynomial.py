# SPDX-License-Identifier: BSD-3-Clause
"""Transfer functions that are linear in their parameters: line, polynomial, logarithm."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial as PowerSeries

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FitError, SensorError
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
        return inside[signs[:-1] != signs[1:]]


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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Linear(TransferFunction):
    """`E = C s + O`, thesis (3.2)."""

    slope: float
    """Sensitivity C; unit of the output per that of the stimulus."""
    offset: float
    """Output O without stimulus."""

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return self.slope * stimulus + self.offset

    def _stimulus(self, output: FloatArray) -> FloatArray:
        return (output - self.offset) / self.slope

    def _turning_points(self) -> FloatArray:
        return np.zeros(0)


def fit_linear(stimulus: Any, output: Any) -> Linear:
    """Fit a line by least squares of the output.

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer than two different stimuli.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=2)
    middle = stimuli.mean()  # a range far from zero would lose digits otherwise
    slope, level = least_squares(np.column_stack([stimuli - middle, np.ones_like(stimuli)]), outputs)
    return Linear(
        lowest=float(stimuli.min()),
        highest=float(stimuli.max()),
        slope=float(slope),
        offset=float(level - slope * middle),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Logarithmic(TransferFunction):
    """`E = C ln s + O` for stimuli above zero [1].

    References:
        [1] Thesis Table 3.1, which prints `C ln + O s`; its inverse, exp((E - O) / C), is right.
    """

    slope: float
    """C: rise of the output where the stimulus grows e-fold."""
    offset: float
    """O: output at a stimulus of 1 in the unit of the stimulus."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        if not self.lowest > 0.0:
            raise SensorError(f"Logarithmic: expected a range above 0, got one from {self.lowest:g}")

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return self.slope * np.log(stimulus) + self.offset

    def _stimulus(self, output: FloatArray) -> FloatArray:
        return np.exp((output - self.offset) / self.slope)

    def _turning_points(self) -> FloatArray:
        return np.zeros(0)


def fit_logarithmic(stimulus: Any, output: Any) -> Logarithmic:
    """Fit a logarithm by least squares of the output, in which it is linear.

    Args:
        stimulus: Known stimuli, above zero; shape (n,).
        output: Outputs of the sensor; shape (n,).

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer than two different stimuli, or one is not above zero.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=2)
    if not stimuli.min() > 0.0:
        raise FitError(f"logarithmic: expected stimuli above 0, got {stimuli.min():g}; leave them out, or fit a power")
    logarithms = np.log(stimuli)
    middle = logarithms.mean()
    slope, level = least_squares(np.column_stack([logarithms - middle, np.ones_like(stimuli)]), outputs)
    return Logarithmic(
        lowest=float(stimuli.min()),
        highest=float(stimuli.max()),
        slope=float(slope),
        offset=float(level - slope * middle),
    )
