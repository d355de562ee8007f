# SPDX-License-Identifier: BSD-3-Clause
"""A sensor with its load as one mass on one spring.

response(f) = gain / (1 + 2 damping (j f / f0) - (f / f0)^2)
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.constants import NORMAL_95
from forcetorque.errors import FitError
from forcetorque.evaluation.response.frequency_response import FrequencyResponse

MISFIT = 2.0
"""Noise that a fit leaves, over that which coherence knows, from which on one resonance is too few."""
_LEAST_FREQUENCIES = 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SecondOrder:
    """Natural frequency, damping and gain."""

    natural_frequency_hz: float
    """Natural frequency f0; Hz."""
    damping: float
    """Damping ratio."""
    gain: float
    """Reading by force at rest."""
    covariance: FloatArray
    """Of the three, in this order; shape (3, 3); half of a 95 % interval is 1.96 deviations."""
    misfit: float | None = None
    """Mean square of what the fit leaves over the noise; None where no response was fitted."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "covariance", read_only(self.covariance, name="covariance", shape=(3, 3)))

    @property
    def half_width(self) -> FloatArray:
        """Half-widths of the 95 % intervals of natural frequency, damping and gain; shape (3,)."""
        half: FloatArray = NORMAL_95 * np.sqrt(np.diag(self.covariance))
        return half

    @property
    def determined(self) -> bool:
        """Whether natural frequency and damping are told from none, and not the gain alone."""
        half = self.half_width
        return bool(half[0] < 0.5 * self.natural_frequency_hz and half[1] < self.damping)

    def response(self, frequency_hz: FloatArray) -> Any:
        """Give the response.

        Args:
            frequency_hz: Frequencies; shape (m,); Hz.

        Returns:
            Complex; shape (m,).
        """
        ratio = np.asarray(frequency_hz) / self.natural_frequency_hz
        return self.gain / (1.0 + 2j * self.damping * ratio - ratio**2)

    def bandwidth(self) -> tuple[float, float]:
        """Tell up to which frequency the response is within 3 dB, a factor of `sqrt(0.5)`, of that at rest, or above.

        Returns:
            Frequency, Hz, and half of its 95 % interval, by its gradient.
        """
        return _bandwidth(self.natural_frequency_hz, self.damping), NORMAL_95 * math.sqrt(self._bandwidth_variance())

    def _bandwidth_variance(self) -> float:
        step = 1e-6 * self.damping
        by_damping = (
            _bandwidth(self.natural_frequency_hz, self.damping + step)
            - _bandwidth(self.natural_frequency_hz, self.damping - step)
        ) / (2.0 * step)
        gradient = np.array([_bandwidth(1.0, self.damping), by_damping, 0.0])
        return float(gradient @ self.covariance @ gradient)


def _bandwidth(natural_frequency_hz: float, damping: float) -> float:
    square = 1.0 - 2.0 * damping**2
    return natural_frequency_hz * math.sqrt(square + math.sqrt(square**2 + 1.0))


def fit_second_order(response: FrequencyResponse, *, name: str) -> SecondOrder:
    """Fit one mass on one spring to a frequency response.

    Frequencies that the force drives weigh by its power over the noise.

    Args:
        response: The response.
        name: What was recorded, for messages.

    Returns:
        Natural frequency, damping and gain; their covariance is `jackknifed`'s to tell.

    Raises:
        FitError: If too few frequencies are driven, or nothing swings.
    """
    from scipy.optimize import least_squares

    use = response.driven
    if use.sum() < _LEAST_FREQUENCIES:
        raise FitError(
            f"{name}: expected a force that drives at least {_LEAST_FREQUENCIES} frequencies, got {int(use.sum())}"
        )
    frequency, value = response.frequency_hz[use], response.value[use]
    variance = response.smooth_noise[use] / response.force_power[use] / response.averages
    weight = 1.0 / np.sqrt(np.maximum(variance, np.finfo(np.float64).tiny))
    unit = float(np.average(frequency, weights=(weight * np.abs(value)) ** 2))
    ratio = 1j * frequency / unit

    def model(at: FloatArray) -> Any:
        return at[0] / (1.0 + at[1] * ratio + at[2] * ratio**2)

    def left(at: FloatArray) -> FloatArray:
        error = weight * (model(at) - value)
        return np.concatenate([error.real, error.imag])

    peak = response.liveliest_hz / unit
    resonance = np.array([abs(value[0]), 0.1 / peak, 1.0 / peak**2])
    tries = [
        least_squares(left, start, x_scale="jac", xtol=1e-12, ftol=1e-12)
        for start in (_start(ratio, value, weight), resonance)
    ]
    solved = min(tries, key=lambda one: float(one.cost))
    misfit = 2.0 * float(solved.cost) / max(int(use.sum()) - 1.5, 1.0)
    return _named(solved.x, unit, misfit, name)


def _start(ratio: Any, value: Any, weight: FloatArray) -> FloatArray:
    """Linear least squares of `gain - value (b s + a s^2) = value`, its weights corrected by what came before."""
    at, own = np.zeros(3), weight
    for _ in range(10):
        design = own[:, None] * np.column_stack([np.ones_like(ratio), -value * ratio, -value * ratio**2])
        target = own * value
        rows, values = np.vstack([design.real, design.imag]), np.concatenate([target.real, target.imag])
        at = np.linalg.lstsq(rows, values, rcond=None)[0]
        own = weight / np.abs(1.0 + at[1] * ratio + at[2] * ratio**2)
    return np.asarray(at, dtype=np.float64)


def _named(at: FloatArray, unit: float, misfit: float, name: str) -> SecondOrder:
    gain, b, a = (float(number) for number in at)
    if not (a > 0.0 and b > 0.0):
        raise FitError(
            f"{name}: no resonance with damping explains the response: what was driven, around {unit:.3g} Hz, is "
            "flat within its noise, or rises otherwise; drive the sensor faster, by taps"
        )
    return SecondOrder(
        natural_frequency_hz=unit / math.sqrt(a),
        damping=b / (2.0 * math.sqrt(a)),
        gain=gain,
        covariance=np.zeros((3, 3)),
        misfit=misfit,
    )
