# SPDX-License-Identifier: BSD-3-Clause
"""A causal filter that undoes the response of a sensor up to a cut-off, and what it does to noise.

Its zeros are the poles of the sensor, `exp(s T)`, so that they take the ringing off; its poles are those of a
Butterworth low-pass of second order at the cut-off, which is what the corrected sensor responds like.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError
from forcetorque.evaluation.response.second_order import SecondOrder

HIGHEST_CUT_OFF = 0.25
"""Part of the rate that the cut-off may have: beyond, neither filter nor sensor is known well from samples."""
MOST_DOUBT = 0.3
"""Share by which the corrected response may be off, 95 %, below the cut-off."""

_DRAWS = 400
_ORDER = 2


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InverseFilter:
    """`corrected = filter(reading)`, sample by sample."""

    rate_hz: float
    """Rate for which it is made; Hz."""
    cut_off_hz: float
    """Cut-off; Hz."""
    numerator: FloatArray
    """Coefficients b; shape (3,)."""
    denominator: FloatArray
    """Coefficients a, the first 1; shape (3,)."""

    def __post_init__(self) -> None:
        for field in ("numerator", "denominator"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(_ORDER + 1,)))
        if not (np.abs(np.roots(self.denominator)) < 1.0).all():
            raise FitError(f"inverse filter: expected one that is stable, got the denominator {self.denominator}")

    def apply(self, reading: FloatArray) -> FloatArray:
        """Correct a reading; it starts as if the first sample had always been there.

        Args:
            reading: Samples at its rate, without missing values; shape (n,) or (n, k).

        Returns:
            Force; the same shape.
        """
        from scipy.signal import lfilter, lfilter_zi

        values = np.asarray(reading, dtype=np.float64)
        settled = lfilter_zi(self.numerator, self.denominator)
        state = np.multiply.outer(settled, values[0]) if len(values) else np.zeros((_ORDER, *values.shape[1:]))
        corrected: FloatArray = lfilter(self.numerator, self.denominator, values, axis=0, zi=state)[0]
        return corrected

    @property
    def noise_gain(self) -> float:
        """Standard deviation of white noise behind the filter over that before it."""
        from scipy.signal import freqz

        _, response = freqz(self.numerator, self.denominator, worN=8192)
        return math.sqrt(float((np.abs(response) ** 2).mean()))


def inverse_filter(sensor: SecondOrder, rate_hz: float, *, cut_off_hz: float | None, name: str) -> InverseFilter:
    """Make the filter that undoes a sensor.

    Args:
        sensor: Response of the sensor.
        rate_hz: Rate of its samples; Hz.
        cut_off_hz: Up to which frequency it is undone; Hz; its natural frequency if None.
        name: Name of the sensor, for messages.

    Returns:
        The filter.

    Raises:
        FitError: If the cut-off is beyond what samples tell, or the response is not known well enough below it.
    """
    from scipy.signal import butter

    cut_off = sensor.natural_frequency_hz if cut_off_hz is None else cut_off_hz
    if not 0.0 < cut_off <= HIGHEST_CUT_OFF * rate_hz:
        raise FitError(
            f"{name}: inverse filter: expected a cut-off above 0 and up to {HIGHEST_CUT_OFF * rate_hz:.4g} Hz, a "
            f"quarter of the rate, got {cut_off:.4g} Hz; choose a lower cut-off, or sample faster"
        )
    doubt = _doubt(sensor, cut_off)
    if not (sensor.determined and doubt <= MOST_DOUBT):
        raise FitError(
            f"{name}: inverse filter: the response is known to {100 * doubt:.0f} % below {cut_off:.4g} Hz (95 %), "
            f"expected {100 * MOST_DOUBT:.0f} % or better; record more events, or choose a lower cut-off"
        )
    turn = 2.0 * math.pi * sensor.natural_frequency_hz / rate_hz
    decay = math.exp(-sensor.damping * turn)
    angle = turn * np.emath.sqrt(1.0 - sensor.damping**2)  # imaginary, and its cosine real, where it is overdamped
    zeros = np.array([1.0, -2.0 * decay * float(np.cos(angle).real), decay**2])
    _, poles = butter(_ORDER, cut_off, fs=rate_hz)
    return InverseFilter(
        rate_hz=rate_hz,
        cut_off_hz=cut_off,
        numerator=zeros * poles.sum() / zeros.sum() / sensor.gain,
        denominator=poles,
    )


def _doubt(sensor: SecondOrder, cut_off_hz: float) -> float:
    """Largest share below the cut-off by which the corrected response is off, held by 95 % of what may be so."""
    rng = np.random.default_rng(0)  # a fixed sample: the same data give the same answer
    mean = np.array([sensor.natural_frequency_hz, sensor.damping, sensor.gain])
    root = np.linalg.svd(sensor.covariance)
    draws = mean + rng.normal(size=(_DRAWS, 3)) @ (np.sqrt(root.S)[:, None] * root.Vh)
    ratio = np.linspace(0.0, cut_off_hz, 100) / draws[:, :1]
    inverse = (1.0 + 2j * draws[:, 1:2] * ratio - ratio**2) / draws[:, 2:]
    true = sensor.response(np.linspace(0.0, cut_off_hz, 100))
    return float(np.quantile(np.abs(1.0 / (true * inverse) - 1.0).max(axis=1), 0.95))
