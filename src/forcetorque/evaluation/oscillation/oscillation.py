# SPDX-License-Identifier: BSD-3-Clause
"""One oscillation of a signal: frequency, amplitude and damping with intervals, told from the band around it.

    signal = exp(-d (t - middle)) (c cos 2 pi f t + s sin 2 pi f t) + noise of any smooth spectrum

The numbers that the tapers make of the signal about f have noise of one size, whatever its colour elsewhere. So least
squares on them are as good as they get, and what they leave says how large that noise is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.evaluation.oscillation.candidate import Candidate
from forcetorque.evaluation.oscillation.tapered_swings import TaperedSwings
from forcetorque.noise import half_width

_MOST_GROWTH = 12.0
"""Bound of the logarithm of the amplitude at the end over the start: beyond, its line is broader than the tapers'."""
_STEP = 1e-4
"""Share of a cycle, and of the growth, by which derivatives are taken."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Oscillation:
    """A swing, over the whole record or in parts of it."""

    frequency_hz: float
    """Frequency; Hz."""
    amplitude: float
    """Amplitude of a steady swing with the same mean square; half of peak to peak; in the unit of the signal."""
    damping: float
    """Damping ratio, decay over angular frequency; 0 of a steady swing, below 0 of one that grows; NaN of one that does
    not keep its phase over the whole record."""
    standard_error: FloatArray
    """Of frequency, amplitude and damping; shape (3,)."""
    degrees_of_freedom: int
    """Of Student's t of their intervals."""
    coherence_s: float
    """Time over which it keeps its phase: that of the record, or of a part; s."""
    chance: float
    """Weighed p-value with which it was found."""
    fitted: FloatArray
    """What it is of the signal; shape (n,)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "standard_error", read_only(self.standard_error, name="standard_error", shape=(3,)))
        object.__setattr__(self, "fitted", read_only(self.fitted, name="fitted", shape=(None,)))

    @property
    def half_width(self) -> FloatArray:
        """Half-widths of the 95 % intervals of frequency, amplitude and damping; shape (3,)."""
        return half_width(self.standard_error, np.full(3, float(self.degrees_of_freedom)))


def fit_oscillation(values: FloatArray, rate_hz: float, candidate: Candidate) -> Oscillation:
    """Fit a swing about a candidate that keeps its phase over the whole record.

    Args:
        values: The signal without mean and trend; shape (n,).
        rate_hz: Its rate; Hz.
        candidate: Where.

    Returns:
        The oscillation.
    """
    swings = TaperedSwings.about(candidate, len(values))
    data = swings.seen(values)
    shape, squares = _closest_shape(swings, data, candidate)
    columns = swings.columns(shape)
    sizes = np.linalg.lstsq(columns, data, rcond=None)[0]
    parameters = np.array([*sizes, *shape])
    degrees = len(data) - len(parameters)
    moved = [
        (swings.columns(shape + step) - swings.columns(shape - step)) @ sizes / (2.0 * _STEP)
        for step in _STEP * np.eye(2)
    ]
    jacobian = np.column_stack([columns, *moved])
    covariance = squares / degrees * np.linalg.pinv(jacobian.T @ jacobian, hermitian=True)
    duration_s = len(values) / rate_hz
    frequency_hz, amplitude, damping = map(float, _frequency_amplitude_damping(parameters, duration_s))
    gradient = _gradient(parameters, duration_s)
    return Oscillation(
        frequency_hz=frequency_hz,
        amplitude=amplitude,
        damping=damping,
        standard_error=np.sqrt(np.einsum("ip,pq,iq->i", gradient, covariance, gradient)),
        degrees_of_freedom=degrees,
        coherence_s=duration_s,
        chance=candidate.chance,
        fitted=swings.cosine_and_sine(shape) @ sizes,
    )


def _closest_shape(swings: TaperedSwings, data: FloatArray, candidate: Candidate) -> tuple[FloatArray, float]:
    """Cycles and growth of the swing nearest to the data, and the sum of squares that it leaves."""
    from scipy.optimize import least_squares  # here because importing it takes longer than most commands

    def residual(shape: Any) -> FloatArray:
        columns = swings.columns(shape)
        left: FloatArray = data - columns @ np.linalg.lstsq(columns, data, rcond=None)[0]
        return left

    reach = float(candidate.family.half_bandwidth)
    solved = least_squares(
        residual,
        [candidate.cycles, candidate.growth],
        bounds=([candidate.cycles - reach, -_MOST_GROWTH], [candidate.cycles + reach, _MOST_GROWTH]),
        diff_step=[_STEP / candidate.cycles, _STEP],
    )
    return solved.x, 2.0 * float(solved.cost)


def _frequency_amplitude_damping(parameters: FloatArray, duration_s: float) -> FloatArray:
    """Frequency in Hz, amplitude and damping of cosine, sine, cycles and growth."""
    cosine, sine, cycles, growth = parameters
    # mean square of exp(growth u) over u from -1/2 to 1/2
    square = math.sinh(growth) / growth if abs(growth) > _STEP else 1.0
    return np.array(
        [cycles / duration_s, math.hypot(cosine, sine) * math.sqrt(square), -growth / (2.0 * math.pi * cycles)]
    )


def _gradient(parameters: FloatArray, duration_s: float) -> FloatArray:
    """Derivatives of frequency, amplitude and damping by the parameters; shape (3, 4)."""
    steps = 1e-4 * np.array([*[math.hypot(*parameters[:2])] * 2, 1.0, 1.0])
    ahead, behind = (
        [_frequency_amplitude_damping(parameters + sign * step, duration_s) for step in np.diag(steps)]
        for sign in (1.0, -1.0)
    )
    columns = [(more - less) / (2.0 * step) for more, less, step in zip(ahead, behind, steps, strict=True)]
    return np.column_stack(columns)
