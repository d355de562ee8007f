# SPDX-License-Identifier: BSD-3-Clause
"""A sensor with its load as one mass on one spring, and a filter that inverts its response."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Annotated, Any

import numpy as np

from forcetorque.base.arrays import ArrayField, ArrayRecord, FloatArray, array
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import half_width
from forcetorque.base.units import NORMAL_95
from forcetorque.results.table import Row, Shown
from forcetorque.sensor.bandwidth.frequency_response import FrequencyResponse, frequency_response

MISFIT = 2.0
"""Noise that a fit leaves, over that which coherence knows, from which on one resonance is too few."""
_LEAST_FREQUENCIES = 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SecondOrder(ArrayRecord):
    """Natural frequency, damping and gain."""

    natural_frequency_hz: float
    """Natural frequency f0; Hz."""
    damping: float
    """Damping ratio."""
    gain: float
    """Reading by force at rest."""
    covariance: FloatArray = field(metadata=array(3, 3))
    """Of the three, in this order; shape (3, 3); half of a 95 % interval is 1.96 deviations."""
    misfit: float | None = None
    """Mean square of what the fit leaves over the noise; None where no response was fitted."""

    @property
    def half_width(self) -> FloatArray:
        """Half-widths of the 95 % intervals of natural frequency, damping and gain; shape (3,)."""
        return NORMAL_95 * np.sqrt(np.diag(self.covariance))

    @property
    def determined(self) -> bool:
        """Whether natural frequency and damping are separable from none, and not the gain alone."""
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
        """Compute the bandwidth: the response is within 3 dB, a factor of `sqrt(0.5)`, of that at rest, or above it.

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
        Natural frequency, damping and gain; the covariance is computed by `jackknifed`.

    Raises:
        FitError: If too few frequencies are driven, or nothing oscillates.
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


def jackknifed(
    response: FrequencyResponse,
    force: FloatArray,
    reading: FloatArray,
    rate_hz: float,
    *,
    events: bool,
    highest_hz: float,
    name: str,
) -> SecondOrder:
    """Fit one mass on one spring, with the covariance of the jackknife.

    Args:
        response: Response of all segments.
        force: As of `frequency_response`; shape (k, n).
        reading: As of `frequency_response`; shape (k, n).
        rate_hz: Rate; Hz.
        events: As of `frequency_response`.
        highest_hz: As of `frequency_response`.
        name: What was recorded, for messages.

    Returns:
        The fit to all; its intervals are by Student's t of k - 1 degrees of freedom.
    """
    whole, k = fit_second_order(response, name=name), len(force)
    values = np.array(
        [
            _values(
                fit_second_order(
                    frequency_response(
                        np.delete(force, one, axis=0),
                        np.delete(reading, one, axis=0),
                        rate_hz,
                        events=events,
                        highest_hz=highest_hz,
                    ),
                    name=name,
                )
            )
            for one in range(k)
        ]
    )
    left = values - values.mean(axis=0)
    # segments that overlap are not quite independent, which the averages count
    covariance = (k - 1.0) / response.averages * left.T @ left
    quantile = float(half_width(np.array([1.0]), np.array([k - 1.0]))[0])
    return replace(whole, covariance=covariance * (quantile / NORMAL_95) ** 2)


def _values(fit: SecondOrder) -> list[float]:
    return [fit.natural_frequency_hz, fit.damping, fit.gain]


HIGHEST_CUT_OFF = 0.25
"""Part of the rate that the cut-off may have: beyond, neither filter nor sensor is known well from samples."""
MOST_DOUBT = 0.3
"""Share by which the corrected response may be off, 95 %, below the cut-off."""

_DRAWS = 400
_ORDER = 2


class InverseFilter(Row):
    """Filter that undoes the response: `corrected[t] = b0 y[t] + b1 y[t-1] + b2 y[t-2] - a1 c[t-1] - a2 c[t-2]`."""

    rate_hz: Annotated[float, Shown("rate", "Hz", digits=2)]
    """Rate of the samples that it filters."""
    cut_off_hz: Annotated[float, Shown("cut-off", "Hz", digits=2)]
    """Cut-off of the Butterworth low-pass of second order that the corrected sensor is."""
    noise_gain: Annotated[float, Shown("white noise times", digits=3)]
    """Standard deviation of white noise behind the filter over that before it, over the static gain."""
    quiet_gain: Annotated[float | None, Shown("quiet reading times", digits=3)]
    """The same of the quiet samples before an event; null without an event."""
    numerator: Annotated[FloatArray, ArrayField((_ORDER + 1,))]
    """Coefficients b."""
    denominator: Annotated[FloatArray, ArrayField((_ORDER + 1,))]
    """Coefficients a, the first 1."""

    def apply(self, measurement: FloatArray) -> FloatArray:
        """Correct a measurement; it starts as if the first sample had always been there.

        Args:
            measurement: Samples at its rate, without missing values; shape (n,) or (n, k).

        Returns:
            Force; the same shape.

        Raises:
            FitError: If the filter is not stable.
        """
        return _filtered(self.numerator, self.denominator, measurement)


def _filtered(numerator: FloatArray, denominator: FloatArray, measurement: FloatArray) -> FloatArray:
    from scipy.signal import lfilter, lfilter_zi

    if not (np.abs(np.roots(denominator)) < 1.0).all():
        raise FitError(f"inverse filter: expected one that is stable, got the denominator {denominator}")
    values = np.asarray(measurement, dtype=np.float64)
    settled = lfilter_zi(numerator, denominator)
    state = np.multiply.outer(settled, values[0]) if len(values) else np.zeros((_ORDER, *values.shape[1:]))
    return lfilter(numerator, denominator, values, axis=0, zi=state)[0]


def _noise_gain(numerator: FloatArray, denominator: FloatArray) -> float:
    """Standard deviation of white noise behind a filter over that before it."""
    from scipy.signal import freqz

    _, response = freqz(numerator, denominator, worN=8192)
    return math.sqrt(float((np.abs(response) ** 2).mean()))


def inverse_filter(
    sensor: SecondOrder, rate_hz: float, *, cut_off_hz: float | None, name: str, quiet: FloatArray | None = None
) -> InverseFilter:
    """Make the filter that undoes a sensor.

    Args:
        sensor: Response of the sensor.
        rate_hz: Rate of its samples; Hz.
        cut_off_hz: Up to which frequency it is undone; Hz; its natural frequency if None.
        name: Name of the sensor, for messages.
        quiet: Samples before an event, whose noise the filter changes; shape (n,); None if there are none.

    Returns:
        The filter.

    Raises:
        FitError: If the cut-off is beyond what samples show, or the response is not known well enough below it.
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
    numerator = zeros * poles.sum() / zeros.sum() / sensor.gain
    static_gain = abs(float(numerator.sum() / poles.sum()))
    quiet_gain = None
    if quiet is not None and quiet.std() > 0.0:
        quiet_gain = float(_filtered(numerator, poles, quiet).std() / quiet.std() / static_gain)
    return InverseFilter(
        rate_hz=rate_hz,
        cut_off_hz=cut_off,
        noise_gain=_noise_gain(numerator, poles) / static_gain,
        quiet_gain=quiet_gain,
        numerator=numerator,
        denominator=poles,
    )


def _doubt(sensor: SecondOrder, cut_off_hz: float) -> float:
    """Largest share below the cut-off by which the corrected response is off, held by 95 % of what may be so."""
    rng = np.random.default_rng(0)  # a fixed sample: the same data give the same result
    mean = np.array([sensor.natural_frequency_hz, sensor.damping, sensor.gain])
    root = np.linalg.svd(sensor.covariance)
    draws = mean + rng.normal(size=(_DRAWS, 3)) @ (np.sqrt(root.S)[:, None] * root.Vh)
    ratio = np.linspace(0.0, cut_off_hz, 100) / draws[:, :1]
    inverse = (1.0 + 2j * draws[:, 1:2] * ratio - ratio**2) / draws[:, 2:]
    true = sensor.response(np.linspace(0.0, cut_off_hz, 100))
    return float(np.quantile(np.abs(1.0 / (true * inverse) - 1.0).max(axis=1), 0.95))
