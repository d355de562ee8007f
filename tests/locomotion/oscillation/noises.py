# SPDX-License-Identifier: BSD-3-Clause
"""Noise of many colours without any swing in it, and swings to plant."""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

from forcetorque.base.arrays import FloatArray

COLOURS = ("white", "ar 0.9", "ar 0.99", "walk", "walk and white", "two real poles", "pink", "blue", "heavy tails")


def noise(colour: str, n: int, rng: np.random.Generator) -> FloatArray:
    """Draw noise of about unit size.

    Args:
        colour: One of `COLOURS`; `ar a` has correlation a from sample to sample, a walk drifts without end.
        n: Samples.
        rng: Source.

    Returns:
        Shape (n,).
    """
    fresh = rng.standard_normal(n)
    if colour == "white":
        return fresh
    if colour.startswith("ar "):
        kept = float(colour[3:])
        return np.asarray(lfilter([np.sqrt(1.0 - kept**2)], [1.0, -kept], fresh))
    if colour == "walk":
        return np.cumsum(fresh) / np.sqrt(n)
    if colour == "walk and white":
        return np.cumsum(fresh) * 0.05 + rng.standard_normal(n)
    if colour == "two real poles":
        slow = lfilter([1.0], np.polymul([1.0, -0.98], [1.0, -0.9]), fresh)
        return np.asarray(slow / slow.std())
    if colour == "blue":
        return np.diff(rng.standard_normal(n + 1))
    if colour == "heavy tails":
        return rng.standard_t(3.0, size=n)
    assert colour == "pink"
    spectrum = np.fft.rfft(fresh)
    spectrum[1:] /= np.sqrt(np.arange(1, len(spectrum)))
    return np.fft.irfft(spectrum, n) * np.sqrt(n / 20.0)


def swing(time_s: FloatArray, frequency_hz: float, amplitude: float, phase: float, damping: float = 0.0) -> FloatArray:
    """Give a swing whose amplitude is that in the middle of the record."""
    middle = 0.5 * (time_s[0] + time_s[-1])
    turn = 2.0 * np.pi * frequency_hz
    return np.asarray(amplitude * np.exp(-damping * turn * (time_s - middle)) * np.cos(turn * time_s + phase))
