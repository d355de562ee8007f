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
    from scipy.optimize import least_squares  # here because importing it takes longer than most commands

    n = len(values)
    place = (np.arange(n) - 0.5 * (n - 1)) / n  # in records
    carrier = candidate.family.tapers(n) * np.exp(-2j * np.pi * candidate.cycles * place)

    def seen(signals: FloatArray) -> FloatArray:
        """What the tapers see of signals, real parts over imaginary ones; shape (2 k, ...)."""
        numbers = carrier @ signals
        both: FloatArray = np.concatenate([numbers.real, numbers.imag])
        return both

    def swings(shape: Any) -> FloatArray:
        cycles, growth = shape
        envelope, angle = np.exp(growth * place), 2.0 * np.pi * cycles * place
        # the signal lost its mean and trend, and the swing with it
        return _detrended(np.column_stack([envelope * np.cos(angle), envelope * np.sin(angle)]))

    data = seen(values)

    def left(shape: Any) -> FloatArray:
        columns = seen(swings(shape))
        residual: FloatArray = data - columns @ np.linalg.lstsq(columns, data, rcond=None)[0]
        return residual

    reach = float(candidate.family.half_bandwidth)
    solved = least_squares(
        left,
        [candidate.cycles, candidate.growth],
        bounds=([candidate.cycles - reach, -_MOST_GROWTH], [candidate.cycles + reach, _MOST_GROWTH]),
        diff_step=[_STEP / candidate.cycles, _STEP],
    )
    shape = solved.x
    columns = seen(swings(shape))
    cosine, sine = np.linalg.lstsq(columns, data, rcond=None)[0]
    parameters = np.array([cosine, sine, *shape])
    degrees = len(data) - len(parameters)
    noise = 2.0 * float(solved.cost) / degrees
    moved = [
        (seen(swings(shape + step)) - seen(swings(shape - step))) @ [cosine, sine] / (2.0 * _STEP)
        for step in _STEP * np.eye(2)
    ]
    jacobian = np.column_stack([columns, *moved])
    covariance = noise * np.linalg.pinv(jacobian.T @ jacobian, hermitian=True)
    stated = _told(parameters, n / rate_hz)
    gradient = _gradient(parameters, n / rate_hz)
    return Oscillation(
        frequency_hz=float(stated[0]),
        amplitude=float(stated[1]),
        damping=float(stated[2]),
        standard_error=np.sqrt(np.einsum("ip,pq,iq->i", gradient, covariance, gradient)),
        degrees_of_freedom=degrees,
        coherence_s=n / rate_hz,
        chance=candidate.chance,
        fitted=swings(shape) @ np.array([cosine, sine]),
    )


def _told(parameters: FloatArray, duration_s: float) -> FloatArray:
    """Frequency, amplitude and damping of cosine, sine, cycles and growth."""
    cosine, sine, cycles, growth = parameters
    # mean square of exp(growth u) over u from -1/2 to 1/2
    square = math.sinh(growth) / growth if abs(growth) > _STEP else 1.0
    return np.array(
        [cycles / duration_s, math.hypot(cosine, sine) * math.sqrt(square), -growth / (2.0 * math.pi * cycles)]
    )


def _gradient(parameters: FloatArray, duration_s: float) -> FloatArray:
    """Of what is told by the parameters; shape (3, 4)."""
    steps = 1e-4 * np.array([*[math.hypot(*parameters[:2])] * 2, 1.0, 1.0])
    columns = [
        (_told(parameters + step, duration_s) - _told(parameters - step, duration_s)) / (2.0 * step.sum())
        for step in np.diag(steps)
    ]
    return np.column_stack(columns)


def _detrended(values: FloatArray) -> FloatArray:
    from scipy.signal import detrend

    flat: FloatArray = detrend(values, axis=0)
    return flat
