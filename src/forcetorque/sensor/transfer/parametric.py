# SPDX-License-Identifier: BSD-3-Clause
"""Transfer functions of one formula: line, polynomial, logarithm, power and exponential."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial as PowerSeries

from forcetorque.base.arrays import FloatArray, array
from forcetorque.base.errors import FitError, SensorError
from forcetorque.sensor.transfer.transfer_function import TransferFunction, calibration_points, least_squares


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Polynomial(TransferFunction):
    """`E = D_0 + D_1 s + ... + D_n s^n`, thesis (3.7).

    The direct fit of the inverse, thesis (3.8), is a fit with stimulus and output swapped.
    """

    coefficients: FloatArray = field(metadata=array(None))
    """D_0 to D_n; shape (n + 1,); unit of the output per that of the stimulus to the power of the index."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        if not len(self.coefficients) or not np.isfinite(self.coefficients).all():
            raise SensorError(f"Polynomial: expected at least one finite coefficient, got {self.coefficients.tolist()}")

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
    # solved with the stimuli brought to -1 to 1, where powers differ enough to be separated
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
    slope, offset = _line(stimuli, outputs)
    return Linear(lowest=float(stimuli.min()), highest=float(stimuli.max()), slope=slope, offset=offset)


def _line(places: FloatArray, outputs: FloatArray) -> tuple[float, float]:
    """Slope and offset of the best line."""
    middle = places.mean()  # a range far from zero would lose digits otherwise
    slope, level = least_squares(np.column_stack([places - middle, np.ones_like(places)]), outputs)
    return float(slope), float(level - slope * middle)


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
    slope, offset = _line(np.log(stimuli), outputs)
    return Logarithmic(lowest=float(stimuli.min()), highest=float(stimuli.max()), slope=slope, offset=offset)


_TOLERANCE = 1e-14
"""Relative change of a parameter, or of the squared error, below which the refinement stops: rounding."""


def fit_exponent(
    shape: Callable[[float], FloatArray], output: FloatArray, *, candidates: FloatArray, name: str
) -> tuple[float, FloatArray]:
    """Find the exponent, and the parameters that go with it, by least squares of the output.

    For each exponent the other parameters are linear least squares (separable least squares), so the
    candidates show where the best exponent lies without a start for the others. From the best one
    all parameters are refined together, the exponent between the two neighbours.

    Args:
        shape: Output per linear parameter, for an exponent; gives shape (n, parameters).
        output: Outputs; shape (n,).
        candidates: Exponents to start from, ascending; shape (k,).
        name: Kind of function, for the message.

    Returns:
        Exponent and linear parameters.

    Raises:
        FitError: If the best candidate is the first or the last: the points then look like a limit of the
            function, which has no such exponent.
    """
    from scipy import optimize  # here because importing it takes longer than most fits

    def best_linear(exponent: float) -> FloatArray:
        return np.asarray(np.linalg.lstsq(shape(exponent), output, rcond=None)[0], dtype=np.float64)

    def residual(parameters: FloatArray) -> FloatArray:
        return np.asarray(shape(float(parameters[0])) @ parameters[1:] - output, dtype=np.float64)

    starts = [np.array([exponent, *best_linear(exponent)]) for exponent in candidates]
    errors = [float((residual(start) ** 2).sum()) for start in starts]
    best = int(np.argmin(errors))
    if best in {0, len(starts) - 1}:
        raise FitError(
            f"{name}: no exponent between {candidates[0]:g} and {candidates[-1]:g} (of scaled points) fits best; "
            "the points do not bend as this function does, fit another kind"
        )
    free = np.full(len(starts[best]) - 1, np.inf)
    optimum = optimize.least_squares(
        residual,
        starts[best],
        bounds=([candidates[best - 1], *-free], [candidates[best + 1], *free]),
        x_scale="jac",
        ftol=_TOLERANCE,
        xtol=_TOLERANCE,
        gtol=_TOLERANCE,
    )
    return float(optimum.x[0]), np.asarray(optimum.x[1:], dtype=np.float64)


_POSITIVE = np.geomspace(0.02, 20.0, 40)
_EXPONENTS = np.concatenate([-_POSITIVE[::-1], _POSITIVE])
"""Exponents to start from; smaller ones are not separable from a logarithm."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Power(TransferFunction):
    """`E = C s^k + O` for stimuli of at least zero, thesis Table 3.1."""

    slope: float
    """C; unit of the output per that of the stimulus to the power of k."""
    exponent: float
    """k, dimensionless."""
    offset: float
    """O, in the unit of the output."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        if self.exponent == 0.0 or not (self.lowest > 0.0 or (self.lowest == 0.0 and self.exponent > 0.0)):
            raise SensorError(
                "Power: expected an exponent other than 0 and a range above 0 (from 0 if the exponent is positive), "
                f"got exponent {self.exponent:g} and a range from {self.lowest:g}"
            )

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return self.slope * stimulus**self.exponent + self.offset

    def _stimulus(self, output: FloatArray) -> FloatArray:
        return ((output - self.offset) / self.slope) ** (1.0 / self.exponent)


def fit_power(stimulus: Any, output: Any) -> Power:
    """Fit a power with an offset by least squares of the output.

    Args:
        stimulus: Known stimuli of at least zero; shape (n,).
        output: Outputs of the sensor; shape (n,).

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer than three different stimuli, one is negative, or no exponent fits best.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=3)
    if stimuli.min() < 0.0:
        raise FitError(f"power: expected stimuli of at least 0, got {stimuli.min():g}")
    highest = stimuli.max()
    scaled = stimuli / highest  # the same search in every unit
    exponent, (slope, offset) = fit_exponent(
        lambda exponent: np.column_stack([scaled**exponent, np.ones_like(scaled)]),
        outputs,
        candidates=_POSITIVE if stimuli.min() == 0.0 else _EXPONENTS,
        name="power",
    )
    if abs(exponent) < _POSITIVE[0]:
        raise FitError(
            f"power: the best exponent, {exponent:.2g}, is not separable from a logarithm; fit a logarithmic function"
        )
    return Power(
        lowest=float(stimuli.min()),
        highest=float(highest),
        slope=float(slope / highest**exponent),
        exponent=exponent,
        offset=float(offset),
    )


_RATES = np.concatenate([-np.geomspace(100.0, 1e-3, 40), np.geomspace(1e-3, 100.0, 40)])
"""Rates to start from, per span of the stimuli: from a factor of 1.001 to one of e^100 over the range."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Exponential(TransferFunction):
    """`E = O exp(k s)`, thesis Table 3.1."""

    scale: float
    """O: output without stimulus."""
    rate: float
    """k: one over the unit of the stimulus."""

    def __post_init__(self) -> None:
        TransferFunction.__post_init__(self)
        if self.scale == 0.0 or self.rate == 0.0:
            raise SensorError(f"Exponential: expected scale and rate other than 0, got {self.scale:g}, {self.rate:g}")

    def _output(self, stimulus: FloatArray) -> FloatArray:
        return self.scale * np.exp(self.rate * stimulus)

    def _stimulus(self, output: FloatArray) -> FloatArray:
        return np.log(output / self.scale) / self.rate


def fit_exponential(stimulus: Any, output: Any) -> Exponential:
    """Fit an exponential by least squares of the output (not of its logarithm, which would weigh small ones more).

    Args:
        stimulus: Known stimuli; shape (n,).
        output: Outputs of the sensor; shape (n,).

    Returns:
        The function, valid from the least to the greatest stimulus.

    Raises:
        ShapeError: If the points are not two series of one length.
        FitError: If there are fewer than two different stimuli, or no rate fits best.
    """
    stimuli, outputs = calibration_points(stimulus, output, parameters=2)
    middle, span = 0.5 * (stimuli.min() + stimuli.max()), np.ptp(stimuli)
    scaled = (stimuli - middle) / span  # the same search in every unit, and no overflow
    rate, (scale,) = fit_exponent(
        lambda rate: np.exp(rate * scaled)[:, None], outputs, candidates=_RATES, name="exponential"
    )
    if rate == 0.0 or scale == 0.0:
        raise FitError("exponential: the output is the same for every stimulus, so no rate is determined")
    return Exponential(
        lowest=float(stimuli.min()),
        highest=float(stimuli.max()),
        scale=float(scale * np.exp(-rate * middle / span)),
        rate=float(rate / span),
    )
