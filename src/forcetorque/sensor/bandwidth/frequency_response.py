# SPDX-License-Identifier: BSD-3-Clause
"""Frequency response of a sensor to a force that was measured, with coherence and 95 % intervals."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.base.noise.slow_noise import CONFIDENCE
from forcetorque.results.table import Row, Values

LEAST_AVERAGES = 4
"""Averages of a spectrum; of one the coherence is 1, for any measurement."""
LEAST_EXPLAINED = 0.8
"""Share of the power of the reading that the measured force must explain, of all and of the middle frequency up to
where its slope is largest: slow motion of an arm may be all of the power, and explained, where taps are not."""
DRIVEN = 1e-4
"""Part of the largest power of the force from which on a frequency is driven."""
HIGHEST_SHARE = 0.4
"""Part of the rate up to which spectra are read: above, what lies beyond half of the rate may be folded back."""

_HANN_OVERLAP = 1.0 / 36.0
"""Squared correlation of the spectra of Hann windows that overlap by half."""
_ONE_SIDED = 1.645
"""Deviations that 95 % of normal numbers do not fall short of."""
_BINS = 3
"""Frequencies on either side over which the noise is averaged."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FrequencyResponse(ArrayRecord):
    """Response at m frequencies, `reading = response force`."""

    frequency_hz: FloatArray = field(metadata=array("m"))
    """Shape (m,); Hz."""
    real: FloatArray = field(metadata=array("m"))
    """Real part of H1; shape (m,); unit of the reading by unit of the force."""
    imaginary: FloatArray = field(metadata=array("m"))
    """Imaginary part; shape (m,)."""
    radius: FloatArray = field(metadata=array("m"))
    """Radius of the circle about H1 that holds the response with 95 %; shape (m,)."""
    coherence: FloatArray = field(metadata=array("m"))
    """Shape (m,)."""
    chance: float
    """Coherence that nothing but chance exceeds in 5 % of the frequencies."""
    force_power: FloatArray = field(metadata=array("m"))
    """Power density of the force; shape (m,)."""
    reading_power: FloatArray = field(metadata=array("m"))
    """The same of the reading; shape (m,)."""
    averages: float
    """Independent averages."""

    @property
    def value(self) -> np.ndarray[tuple[int], np.dtype[np.complex128]]:
        """H1; shape (m,)."""
        return self.real + 1j * self.imaginary

    @property
    def driven(self) -> BoolArray:
        """Which frequencies the force drives; shape (m,)."""
        return self.force_power >= DRIVEN * self.force_power.max()

    @property
    def liveliest_hz(self) -> float:
        """Driven frequency at which the slope of the reading has most power; Hz: the resonance, where there is one."""
        slope = np.where(self.driven, self.frequency_hz**2 * self.reading_power, 0.0)
        return float(self.frequency_hz[int(slope.argmax())])

    @property
    def lively_coherence(self) -> FloatArray:
        """Coherence of the driven frequencies up to the liveliest."""
        return self.coherence[self.driven & (self.frequency_hz <= self.liveliest_hz)]

    @property
    def explained(self) -> float:
        """Share of the power of the reading that the force explains, chance taken off; 0 of a reading that stays."""
        power = self.reading_power[self.driven]
        if not power.any():
            return 0.0
        shared = (self.coherence[self.driven] * power).sum() / power.sum()
        return float((shared - 1.0 / self.averages) / (1.0 - 1.0 / self.averages))

    @property
    def noise_power(self) -> FloatArray:
        """Power density of what the force does not explain of the reading; shape (m,)."""
        return _noise(self.coherence, self.reading_power, self.averages)

    @property
    def smooth_noise(self) -> FloatArray:
        """Noise averaged over neighbouring frequencies; shape (m,)."""
        from scipy.ndimage import uniform_filter1d

        return uniform_filter1d(self.noise_power, 2 * _BINS + 1, mode="nearest")


class ResponseCurve(Row):
    """Frequency response with coherence, for the figure and for other fits."""

    frequency_hz: Values
    """Frequencies; shape (m,); Hz."""
    real: Values
    """Real part of the response; shape (m,)."""
    imaginary: Values
    """Imaginary part; shape (m,)."""
    fitted_real: Values | None = None
    """Real part of the second order that is fitted to it; shape (m,); null without a fit."""
    fitted_imaginary: Values | None = None
    """Imaginary part of that; shape (m,)."""
    radius_95: Values
    """Radius of the circle that holds it with 95 %; shape (m,)."""
    coherence: Values
    """Shape (m,)."""
    chance: float
    """Coherence that chance alone exceeds in 5 % of the frequencies."""
    driven: Values
    """1 where the force drives the sensor; only these are fitted; shape (m,)."""
    explained_share: float
    """Share of the power of the reading that the force explains."""
    averages: float
    """Independent averages."""


def overlapping(series: FloatArray, segment: int) -> FloatArray:
    """Cut a series into segments that overlap by half.

    Args:
        series: Shape (n,).
        segment: Samples of a segment.

    Returns:
        Shape (k, segment).
    """
    step = segment - segment // 2
    return np.lib.stride_tricks.sliding_window_view(series, segment)[::step]


def frequency_response(
    force: FloatArray, reading: FloatArray, rate_hz: float, *, events: bool, highest_hz: float
) -> FrequencyResponse:
    """Estimate the response to a measured force (H1).

    Args:
        force: Force in each of k segments; shape (k, n).
        reading: Reading at the same instants; shape (k, n).
        rate_hz: Rate; Hz.
        events: Whether each segment holds an event from quiet to quiet, and is taken as it is; else the force goes on,
            segments are those of `overlapping`, and under a Hann window.
        highest_hz: Highest frequency that is read; Hz; `HIGHEST_SHARE` of the rate or less.

    Returns:
        Response, coherence and intervals [1].

    Raises:
        FitError: If there are fewer than `LEAST_AVERAGES - 1` segments, or nothing drives the sensor.
        ShapeError: If force and reading do not have one shape.

    References:
        [1] J. S. Bendat, A. G. Piersol, Random data, 4th ed. (2010), chapter 9.
    """
    from scipy.signal import csd, welch
    from scipy.special import fdtri

    if force.shape != reading.shape:
        raise ShapeError(f"expected force and reading of one shape, got {force.shape} and {reading.shape}")
    count, segment = force.shape
    if count < LEAST_AVERAGES - 1:  # one may be left out, to see what it shows
        raise FitError(f"expected at least {LEAST_AVERAGES - 1} segments for a coherence, got {count}")
    if not np.ptp(force) > 0.0:
        raise FitError("expected a force that changes, got one that stays: nothing drives the sensor")
    reading = reading - reading[:, :1]  # one that stays has no power, not that of rounding
    averages = float(count) if events else count / (1.0 + 2.0 * (count - 1) / count * _HANN_OVERLAP)
    options = {
        "fs": rate_hz,
        "window": "boxcar" if events else "hann",
        "nperseg": segment,
        "noverlap": 0,
        "detrend": "constant",
    }
    frequency, force_power = welch(force.ravel(), **options)
    reading_power, cross = welch(reading.ravel(), **options)[1], csd(force.ravel(), reading.ravel(), **options)[1]
    kept = (frequency > (0.0 if events else 2.5 * rate_hz / segment)) & (frequency <= highest_hz)
    kept &= force_power > 0.0
    force_power, reading_power, cross = force_power[kept], reading_power[kept], cross[kept]
    shared = np.abs(cross) ** 2 / force_power
    coherence = np.clip(shared / np.maximum(reading_power, np.finfo(np.float64).tiny), 0.0, 1.0)
    noise = _noise(coherence, reading_power, averages)
    circle = fdtri(2.0, 2.0 * averages - 2.0, CONFIDENCE) / averages * noise / force_power
    return FrequencyResponse(
        frequency_hz=frequency[kept],
        real=(cross / force_power).real,
        imaginary=(cross / force_power).imag,
        radius=np.sqrt(circle),
        coherence=coherence,
        chance=1.0 - (1.0 - CONFIDENCE) ** (1.0 / (averages - 1.0)),
        force_power=force_power,
        reading_power=reading_power,
        averages=averages,
    )


def _noise(coherence: FloatArray, reading_power: FloatArray, averages: float) -> FloatArray:
    """What the force does not explain, for the response has taken some of the noise; shape (m,)."""
    return (1.0 - coherence) * reading_power * averages / (averages - 1.0)


def require_coherence(response: FrequencyResponse, *, name: str) -> None:
    """Refuse a response that the measured force does not explain.

    Args:
        response: The response.
        name: What was recorded, for messages.

    Raises:
        FitError: If the reading does not move, the force explains less than `LEAST_EXPLAINED` of its power, or the
            coherence of the middle frequency up to the liveliest is not surely as much.
    """
    if not response.reading_power.any():
        raise FitError(f"{name}: no transfer function: the reading does not move; check the channel and its cable")
    top, coherence = response.liveliest_hz, response.lively_coherence
    sure = _sure(float(np.median(coherence)), response.averages)
    if response.explained >= LEAST_EXPLAINED and sure >= LEAST_EXPLAINED:
        return
    low, high = np.quantile(coherence, [0.25, 0.75])
    raise FitError(
        f"{name}: no transfer function: the measured force explains {100 * max(response.explained, 0.0):.0f} % of "
        f"the power of the reading, and the coherence is {low:.2f} to {high:.2f} (middle half of the frequencies up to "
        f"{top:.3g} Hz, {response.averages:.3g} averages, of which chance alone gives {1.0 / response.averages:.2f}), "
        f"surely {sure:.2f}; expected {100 * LEAST_EXPLAINED:.0f} % and {LEAST_EXPLAINED:g} at least: measure the "
        "force itself, at the place and in the direction in which it acts, or record more events"
    )


def _sure(coherence: float, averages: float) -> float:
    """The coherence that is exceeded with 95 %, by Fisher's transform of its root without its bias."""
    root = float(np.arctanh(min(np.sqrt(coherence), 1.0 - 1e-12)))
    lower = root - 1.0 / (2.0 * averages - 2.0) - _ONE_SIDED / np.sqrt(2.0 * averages)
    return float(np.tanh(max(lower, 0.0)) ** 2)
