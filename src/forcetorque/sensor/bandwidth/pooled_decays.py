# SPDX-License-Identifier: BSD-3-Clause
"""The free decays after all events of some records, each number pooled over the events."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import half_width
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.results.table import FloatOrNull, Row, Shown
from forcetorque.sensor.bandwidth.excited_records import EvenRecord, ExcitationKind, ExcitedRecord
from forcetorque.sensor.bandwidth.ring_down import Event, RingDown, find_events, gains, ring_downs, step_direction
from forcetorque.sensor.bandwidth.second_order import SecondOrder


class EventRow(Row):
    """One impact or release, and the free decay behind it; null where none was determined."""

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
    """Modes of the decay."""
    left_share: Annotated[float | None, Shown("left", digits=2)]
    """Share of the variance of the decay that these modes leave."""
    undetermined: str | None = None
    """Why no decay was determined."""


class ResponseNumber(Row):
    """One number of the response with its 95 % interval."""

    quantity: Annotated[str, Shown("")]
    """What it is."""
    source: Annotated[str, Shown("of")]
    """Its source."""
    value: Annotated[float, Shown("value", digits=4)]
    """The number."""
    half_width_95: Annotated[FloatOrNull, Shown("±", digits=4)]
    """Half of its 95 % interval."""
    unit: Annotated[str, Shown("unit")]
    """Its unit."""
    scatter: Annotated[float | None, Shown("scatter", digits=4)]
    """Standard deviation from event to event; null of one event, or where it is not determined by event."""


class DecayCurve(Row):
    """One free decay and its fit, for the figure."""

    title: str
    """Which event."""
    time_s: Annotated[FloatArray, ArrayField((None,))]
    """Instants behind the event; shape (m,); s."""
    measurement: Annotated[FloatArray, ArrayField((None,))]
    """Reading; shape (m,)."""
    fitted: Annotated[FloatArray, ArrayField((None,))]
    """Fit; shape (m,)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pooled:
    """Mean of events."""

    mean: float
    """Mean, events weighed by their own error and the scatter between them."""
    half_width: float
    """Half of its 95 % interval."""
    scatter: float | None
    """Standard deviation from event to event, as it is; None of one event."""


def pool(values: FloatArray, standard_errors: FloatArray) -> Pooled:
    """Pool events that may differ, by random effects.

    Args:
        values: One per event; shape (k,).
        standard_errors: Their errors; shape (k,).

    Returns:
        Mean [1] with an interval by Student's t of k - 1 degrees of freedom [2]; of one event its own.

    References:
        [1] R. DerSimonian, N. Laird, Meta-analysis in clinical trials, Controlled Clinical Trials 7 (1986), eq. 8.
        [2] G. Knapp, J. Hartung, Improved tests for a random effects meta-regression, Statistics in Medicine 22 (2003).
    """
    k = len(values)
    if k == 1:
        half = half_width(standard_errors, np.array([np.inf]))
        return Pooled(mean=float(values[0]), half_width=float(half[0]), scatter=None)
    weight = 1.0 / standard_errors**2
    mean = float(weight @ values / weight.sum())
    excess = float(weight @ (values - mean) ** 2) - (k - 1)
    between = max(0.0, excess / float(weight.sum() - (weight**2).sum() / weight.sum()))
    weight = 1.0 / (standard_errors**2 + between)
    mean = float(weight @ values / weight.sum())
    error = np.sqrt(float(weight @ (values - mean) ** 2) / (k - 1) / float(weight.sum()))
    half = half_width(np.array([error]), np.array([k - 1.0]))
    return Pooled(mean=mean, half_width=float(half[0]), scatter=float(values.std(ddof=1)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Struck:
    """One record with its events, and the decay behind each."""

    record: ExcitedRecord
    """The record."""
    signal: EvenRecord
    """The signal that is evaluated; shape (n, 1)."""
    events: tuple[Event, ...]
    """Events."""
    decays: tuple[RingDown | FitError, ...]
    """Decay behind each, or what stands against it."""

    @property
    def ring_downs(self) -> list[tuple[Event, RingDown]]:
        """Events with a decay."""
        pairs = zip(self.events, self.decays, strict=True)
        return [(event, decay) for event, decay in pairs if isinstance(decay, RingDown)]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Decays:
    """All records."""

    direction: FloatArray
    """Of the signal in the wrench; shape (6,)."""
    struck: tuple[Struck, ...]
    """Records that were struck."""
    gain: Pooled | None
    """What is read of a newton of a released weight; None where no weight was specified."""

    @property
    def ring_downs(self) -> list[RingDown]:
        """Decays that were determined."""
        return [decay for one in self.struck for _, decay in one.ring_downs]

    @property
    def frequency(self) -> Pooled:
        """Natural frequency; Hz."""
        ring_downs = self.ring_downs
        return pool(np.array([one.frequency_hz for one in ring_downs]), np.array([one.error[0] for one in ring_downs]))

    @property
    def damping(self) -> Pooled:
        """Damping ratio."""
        ring_downs = self.ring_downs
        return pool(np.array([one.damping for one in ring_downs]), np.array([one.error[1] for one in ring_downs]))

    @property
    def second_order(self) -> SecondOrder | None:
        """Response, where a released weight determines the gain."""
        if self.gain is None or not self.ring_downs:
            return None
        half = np.array([self.frequency.half_width, self.damping.half_width, self.gain.half_width])
        return SecondOrder(
            natural_frequency_hz=self.frequency.mean,
            damping=self.damping.mean,
            gain=self.gain.mean,
            covariance=np.diag((half / NORMAL_95) ** 2),
        )

    @property
    def quiet(self) -> FloatArray | None:
        """The longest quiet segment before an event; None without one of two samples."""
        stretches = [one.signal.signals[event.quiet, 0] for one in self.struck for event in one.events]
        longest = max(stretches, key=len)
        return longest if len(longest) > 1 else None

    @property
    def rows(self) -> tuple[EventRow, ...]:
        """A row per event."""
        return tuple(
            _row(one, event, decay) for one in self.struck for event, decay in zip(one.events, one.decays, strict=True)
        )

    @property
    def curves(self) -> tuple[DecayCurve, ...]:
        """Decays and fits, for the figure."""
        return tuple(_curve(one, event, decay) for one in self.struck for event, decay in one.ring_downs)


def free_decays(
    records: Sequence[ExcitedRecord], kind: ExcitationKind, component: int | None, *, weight_N: float | None
) -> Decays:
    """Find events and fit the decay behind each.

    Args:
        records: Records, each with at least one event.
        kind: Impacts or releases.
        component: Component of the wrench; None for the force along the step of releases, and of impacts for the
            component in which most of them stand out most.
        weight_N: Force that was let go; N; None if it is not known.

    Returns:
        Events and decays.
    """
    events = [find_events(record.wrench, name=record.name) for record in records]
    if component is not None:
        return _decays(records, events, np.eye(6)[component], weight_N)
    if kind is ExcitationKind.RELEASE:
        count = [len(own) for own in events]
        steps = [step_direction(record.wrench, own) for record, own in zip(records, events, strict=True)]
        mean = np.average(steps, axis=0, weights=count)
        return _decays(records, events, mean / np.linalg.norm(mean), weight_N)
    heights = np.zeros(6)
    for event in (event for own in events for event in own):
        heights[event.component] += 1.0 + 1e-9 * event.height  # between equals, the higher
    return _decays(records, events, np.eye(6)[int(heights.argmax())], weight_N)


def _decays(
    records: Sequence[ExcitedRecord],
    events: Sequence[tuple[Event, ...]],
    direction: FloatArray,
    weight_N: float | None,
) -> Decays:
    struck = []
    for record, own in zip(records, events, strict=True):
        values = (record.wrench.signals @ direction)[:, None]
        signal = EvenRecord(start_s=record.wrench.start_s, rate_hz=record.wrench.rate_hz, signals=values)
        decays = tuple(ring_downs(signal, own, name=record.name))
        struck.append(Struck(record=record, signal=signal, events=own, decays=decays))
    gain = None
    if weight_N is not None and any(one.ring_downs for one in struck):
        known = [
            gains(
                one.signal,
                tuple(event for event, _ in one.ring_downs),
                [decay for _, decay in one.ring_downs],
                weight_N,
            )
            for one in struck
        ]
        values, errors = (np.concatenate(numbers) for numbers in zip(*known, strict=True))
        gain = pool(values, errors)
    return Decays(direction=direction, struck=tuple(struck), gain=gain)


def _row(one: Struck, event: Event, decay: RingDown | FitError) -> EventRow:
    ring_down = decay if isinstance(decay, RingDown) else None
    half = None if ring_down is None else NORMAL_95 * ring_down.error
    return EventRow(
        recording=one.record.name,
        time_s=float(one.signal.time_s[event.peak]),
        height=event.height,
        strongest=WRENCH_COMPONENTS[event.component],
        frequency_hz=None if ring_down is None else ring_down.frequency_hz,
        frequency_half_width_95_hz=None if half is None else float(half[0]),
        damping=None if ring_down is None else ring_down.damping,
        damping_half_width_95=None if half is None else float(half[1]),
        modes=None if ring_down is None else ring_down.modes,
        left_share=None if ring_down is None else ring_down.left,
        undetermined=None if ring_down is not None else str(decay),
    )


def _curve(one: Struck, event: Event, decay: RingDown) -> DecayCurve:
    span = slice(decay.start, decay.start + len(decay.fitted))
    time = one.signal.time_s
    return DecayCurve(
        title=f"{one.record.name}, {time[event.peak]:.2f} s",
        time_s=time[span] - time[event.peak],
        measurement=one.signal.signals[span, 0],
        fitted=decay.fitted,
    )


DECAYS, WEIGHT, RESPONSE = "free decays", "the released weight", "frequency response"


def numbers(decays: Decays | None, fit: SecondOrder | None, gain_unit: str) -> Iterator[ResponseNumber]:
    """Write natural frequency, damping, gain and bandwidth by source.

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
