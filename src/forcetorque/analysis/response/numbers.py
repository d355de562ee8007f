# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the numbers of a response."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.analysis.response.decays import Decays
from forcetorque.analysis.response.rows import ResponseNumber
from forcetorque.evaluation.response import Pooled, SecondOrder

DECAYS, WEIGHT, RESPONSE = "free decays", "the released weight", "frequency response"


def numbers(decays: Decays | None, fit: SecondOrder | None, gain_unit: str) -> Iterator[ResponseNumber]:
    """Write natural frequency, damping, gain and bandwidth by what tells them.

    Args:
        decays: Free decays; None without events.
        fit: Fit to the response to a measured force; None without one.
        gain_unit: Unit of its gain.

    Yields:
        The rows.
    """
    if decays is not None and decays.ring_downs:
        yield _pooled("natural frequency", decays.frequency, DECAYS, "Hz")
        yield _pooled("damping ratio", decays.damping, DECAYS, "1")
        if decays.gain is not None:
            yield _pooled("gain", decays.gain, WEIGHT, "1")
        if (released := decays.second_order) is not None and released.determined:
            yield _number("bandwidth, -3 dB", *released.bandwidth(), f"{DECAYS}, one resonance", "Hz")
    if fit is not None:
        half = fit.half_width
        if fit.determined:
            yield _number("natural frequency", fit.natural_frequency_hz, float(half[0]), RESPONSE, "Hz")
            yield _number("damping ratio", fit.damping, float(half[1]), RESPONSE, "1")
        yield _number("gain", fit.gain, float(half[2]), RESPONSE, gain_unit)
        if fit.determined:
            yield _number("bandwidth, -3 dB", *fit.bandwidth(), RESPONSE, "Hz")


def _pooled(quantity: str, pooled: Pooled, source: str, unit: str) -> ResponseNumber:
    return ResponseNumber(
        quantity=quantity,
        source=source,
        value=pooled.mean,
        half_width_95=pooled.half_width,
        unit=unit,
        scatter=pooled.scatter,
    )


def _number(quantity: str, value: float, half_width: float, source: str, unit: str) -> ResponseNumber:
    return ResponseNumber(
        quantity=quantity, source=source, value=value, half_width_95=half_width, unit=unit, scatter=None
    )
