# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor does to fast forces, number by number and event by event."""

from __future__ import annotations

from typing import Annotated

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.results.table import FloatOrNull, Row, Shown, Values


class EventRow(Row):
    """One impact or release, and the free decay behind it; null where none was told."""

    recording: Annotated[str, Shown("recording")]
    """Experiment and interval."""
    time_s: Annotated[float, Shown("at", "s", digits=3)]
    """When it stands out most, from the start of the recording."""
    height: Annotated[float, Shown("stands out by", digits=0)]
    """Robust deviations of the fast part of the reading."""
    strongest: Annotated[str, Shown("most in")]
    """Component in which it stands out most."""
    frequency_hz: Annotated[float | None, Shown("rings at", "Hz", digits=2, error="frequency_half_width_95_hz")]
    """Natural frequency of the strongest mode of the decay."""
    frequency_half_width_95_hz: FloatOrNull | None
    """Half of its 95 % interval."""
    damping: Annotated[float | None, Shown("damping", digits=4, error="damping_half_width_95")]
    """Damping ratio of that mode."""
    damping_half_width_95: FloatOrNull | None
    """Half of its 95 % interval."""
    modes: Annotated[int | None, Shown("modes")]
    """Modes that the decay was told to have."""
    left_share: Annotated[float | None, Shown("left", digits=2)]
    """Share of the variance of the decay that these modes leave."""
    untold: str | None = None
    """Why no decay was told."""


class ResponseNumber(Row):
    """One number of the response with its 95 % interval."""

    quantity: Annotated[str, Shown("")]
    """What it is."""
    source: Annotated[str, Shown("of")]
    """What it was told by."""
    value: Annotated[float, Shown("value", digits=4)]
    """The number."""
    half_width_95: Annotated[FloatOrNull, Shown("±", digits=4)]
    """Half of its 95 % interval."""
    unit: Annotated[str, Shown("unit")]
    """Its unit."""
    scatter: Annotated[float | None, Shown("scatter", digits=4)]
    """Standard deviation from event to event; null of one event, or where it is not told by event."""


class ResponseCurve(Row):
    """Frequency response with coherence, for the figure and for whoever fits something else to it."""

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


class DecayCurve(Row):
    """One free decay and its fit, for the figure."""

    title: str
    """Which event."""
    time_s: Annotated[FloatArray, ArrayField((None,))]
    """Instants behind the event; shape (m,); s."""
    reading: Annotated[FloatArray, ArrayField((None,))]
    """Reading; shape (m,)."""
    fitted: Annotated[FloatArray, ArrayField((None,))]
    """Fit; shape (m,)."""
