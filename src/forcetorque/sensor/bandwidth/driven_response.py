# SPDX-License-Identifier: BSD-3-Clause
"""Response of one component of the wrench, and of every component, to the force that was measured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.results.table import Row, Shown
from forcetorque.sensor.bandwidth.excited_records import ExcitationKind, ExcitedRecord
from forcetorque.sensor.bandwidth.frequency_response import (
    HIGHEST_SHARE,
    LEAST_AVERAGES,
    LEAST_EXPLAINED,
    FrequencyResponse,
    ResponseCurve,
    frequency_response,
    overlapping,
    require_coherence,
)
from forcetorque.sensor.bandwidth.pooled_decays import Decays
from forcetorque.sensor.bandwidth.second_order import MISFIT, SecondOrder, jackknifed

BEFORE_S = 0.05
"""Quiet before an event that belongs to its segment; s."""
SWING_SEGMENTS = 9
"""Segments of an oscillation, which overlap by half."""


def driven_response(
    records: Sequence[ExcitedRecord],
    decays: Decays | None,
    kind: ExcitationKind,
    component: int | None,
    mass_kg: float | None,
) -> tuple[FrequencyResponse, SecondOrder]:
    """Estimate the response to the measured force, and fit it.

    Args:
        records: Records with the measured force.
        decays: Events, where there were any.
        kind: What was done.
        component: Component of the wrench; None for that of the decays.
        mass_kg: Mass that moves with a measured acceleration; kg; None to leave the gain in N by m/s2.

    Returns:
        Response and fit.

    Raises:
        FitError: If the force does not explain the reading, or too little was recorded.
        ExperimentError: If the force has no such component, or an oscillation was recorded in several segments.
    """
    direction = np.eye(6)[component] if decays is None else decays.direction
    force, reading = _force_and_reading(records, decays, kind, direction, mass_kg)
    transfer = _transfer(records, force, reading, events=decays is not None)
    require_coherence(transfer, name=_name(records))
    return transfer, _fit(records, transfer, force, reading, events=decays is not None)


class ChannelResponse(Row):
    """What one component of the wrench makes of the same component of the measured force."""

    channel: Annotated[str, Shown("channel")]
    """Component of the wrench."""
    explained_share: Annotated[float, Shown("explained", digits=3)]
    """Share of the power of the reading that the force explains."""
    coherence: Annotated[float, Shown("coherence", digits=3)]
    """Median of the driven frequencies up to the one at which the reading moves most."""
    lowest_hz: Annotated[float | None, Shown("at", "Hz", digits=2)]
    """Lowest driven frequency whose coherence is `LEAST_EXPLAINED` or more; Hz; null where the force does not explain
    the reading."""
    lowest_gain: Annotated[float | None, Shown("gain there", digits=4, error="lowest_half_width_95")]
    """Real part of the response there: negative of a reversed channel, and of a sound one beyond its resonance."""
    lowest_half_width_95: float | None
    """Radius of the circle that holds the response there with 95 %."""
    natural_frequency_hz: Annotated[
        float | None, Shown("natural frequency", "Hz", digits=3, error="natural_frequency_half_width_95_hz")
    ]
    """Of one mass on one spring that is fitted; null where none is determined."""
    natural_frequency_half_width_95_hz: float | None
    """Half of its 95 % interval."""
    gain: Annotated[float | None, Shown("gain at rest", digits=4, error="gain_half_width_95")]
    """Reading by force at rest of that fit; null without one."""
    gain_half_width_95: float | None
    """Half of its 95 % interval."""
    unit: Annotated[str, Shown("unit of gains")]
    """1, or kg where the acceleration of a mass not given was measured."""
    moves_with: Annotated[str | None, Shown("moves with")]
    """Component of the measured force that explains this one best, from four fifths of its power on; null for none."""
    undetermined: str | None
    """Why there is no gain, or no fit."""
    curve: ResponseCurve = Field(repr=False)
    """Frequency response with coherence and interval."""

    @property
    def reversed(self) -> bool:
        """Whether the channel surely reads against its measured force, at rest or else at the lowest frequency."""
        at_rest = self.gain is not None
        gain = self.gain if at_rest else self.lowest_gain
        half = self.gain_half_width_95 if at_rest else self.lowest_half_width_95
        return gain is not None and gain < -(half or 0.0)

    @property
    def moves(self) -> bool:
        """Whether the reading of the channel changes at all."""
        return bool(self.curve.real.any() or self.curve.imaginary.any())


def channel_responses(
    records: Sequence[ExcitedRecord], decays: Decays | None, kind: ExcitationKind, mass_kg: float | None
) -> Iterator[ChannelResponse]:
    """Estimate the response of every component to the same component of the measured force.

    Args:
        records: As of `driven_response`.
        decays: As of `driven_response`.
        kind: As of `driven_response`.
        mass_kg: As of `driven_response`.

    Yields:
        One for each component whose force moves; what forces that move together do to each other is not separated.
    """
    if records[0].force is None:
        return
    count, events = records[0].force.signals.shape[1], decays is not None
    try:
        pairs = [_force_and_reading(records, decays, kind, np.eye(6)[k], mass_kg) for k in range(count)]
    except (ExperimentError, FitError):  # too few events: the response of one component is refused for it, and says so
        return
    moved = [k for k in range(count) if np.ptp(pairs[k][0]) > 0.0]
    for k in moved:
        force, reading = pairs[k]
        transfer = _transfer(records, force, reading, events=events)
        lowest = int((transfer.driven & (transfer.coherence >= LEAST_EXPLAINED)).argmax())
        name = f"{_name(records)}, {WRENCH_COMPONENTS[k]}"
        coherent, fit, undetermined = False, None, None
        try:
            require_coherence(transfer, name=name)
            coherent = True
            fit = _fit(records, transfer, force, reading, events=events)
            if fit.misfit is not None and fit.misfit > MISFIT:
                undetermined = (
                    f"{name}: one resonance leaves {fit.misfit:.2g} times the noise: there are more, or a delay; no "
                    "natural frequency and no gain at rest are given"
                )
                fit = None
        except FitError as error:
            undetermined = str(error)
        half = None if fit is None else fit.half_width
        resonance = None if fit is None or not fit.determined else fit.natural_frequency_hz
        yield ChannelResponse(
            channel=WRENCH_COMPONENTS[k],
            explained_share=max(transfer.explained, 0.0),
            coherence=float(np.median(transfer.lively_coherence)),
            lowest_hz=float(transfer.frequency_hz[lowest]) if coherent else None,
            lowest_gain=float(transfer.real[lowest]) if coherent else None,
            lowest_half_width_95=float(transfer.radius[lowest]) if coherent else None,
            natural_frequency_hz=resonance,
            natural_frequency_half_width_95_hz=None if half is None or resonance is None else float(half[0]),
            gain=None if fit is None else fit.gain,
            gain_half_width_95=None if half is None else float(half[2]),
            unit=gain_unit(records, mass_kg),
            moves_with=_moves_with(records, k, {j: pairs[j][0] for j in moved}, events=events),
            undetermined=undetermined,
            curve=response_curve(transfer, fit),
        )


def _moves_with(
    records: Sequence[ExcitedRecord], channel: int, forces: dict[int, FloatArray], *, events: bool
) -> str | None:
    shares = {
        other: _transfer(records, force, forces[channel], events=events).explained
        for other, force in forces.items()
        if other != channel
    }
    most = max(shares, key=lambda other: shares[other], default=None)
    return None if most is None or shares[most] < LEAST_EXPLAINED else WRENCH_COMPONENTS[most]


def gain_unit(records: Sequence[ExcitedRecord], mass_kg: float | None) -> str:
    """Give the unit of reading by force.

    Args:
        records: Records with the measured force.
        mass_kg: Mass that moves with a measured acceleration; None if it is not known.

    Returns:
        `kg` for an acceleration without its mass, else `1`.
    """
    force = records[0].force
    return "kg" if force is not None and force.signals.shape[1] == 3 and mass_kg is None else "1"


def response_curve(transfer: FrequencyResponse, fit: SecondOrder | None) -> ResponseCurve:
    """Write a response and its fit as a row of a result.

    Args:
        transfer: The response.
        fit: The fit to it; None without one.

    Returns:
        The row.
    """
    fitted = None if fit is None else fit.response(transfer.frequency_hz)
    return ResponseCurve(
        frequency_hz=transfer.frequency_hz,
        real=transfer.real,
        imaginary=transfer.imaginary,
        fitted_real=None if fitted is None else fitted.real,
        fitted_imaginary=None if fitted is None else fitted.imag,
        radius_95=transfer.radius,
        coherence=transfer.coherence,
        chance=transfer.chance,
        driven=transfer.driven.astype(np.float64),
        explained_share=transfer.explained,
        averages=transfer.averages,
    )


def _name(records: Sequence[ExcitedRecord]) -> str:
    return "; ".join(record.name for record in records)


def _highest(records: Sequence[ExcitedRecord]) -> float:
    return min(HIGHEST_SHARE * records[0].wrench.rate_hz, *(record.highest_hz for record in records))


def _transfer(
    records: Sequence[ExcitedRecord], force: FloatArray, reading: FloatArray, *, events: bool
) -> FrequencyResponse:
    return frequency_response(force, reading, records[0].wrench.rate_hz, events=events, highest_hz=_highest(records))


def _fit(
    records: Sequence[ExcitedRecord],
    transfer: FrequencyResponse,
    force: FloatArray,
    reading: FloatArray,
    *,
    events: bool,
) -> SecondOrder:
    rate, highest = records[0].wrench.rate_hz, _highest(records)
    return jackknifed(transfer, force, reading, rate, events=events, highest_hz=highest, name=_name(records))


def _force_and_reading(
    records: Sequence[ExcitedRecord],
    decays: Decays | None,
    kind: ExcitationKind,
    direction: FloatArray,
    mass_kg: float | None,
) -> tuple[FloatArray, FloatArray]:
    """Both along a direction of the wrench, in segments; shape (k, n) each."""
    name = _name(records)
    pairs = [(_force_along(record, direction, mass_kg), record.wrench.signals @ direction) for record in records]
    if decays is None:
        if len(pairs) > 1:
            raise ExperimentError(
                f"{name}: expected one segment with an oscillation, got {len(pairs)}; name one by --interval, from "
                "Python intervals"
            )
        segment = 2 * len(pairs[0][0]) // (SWING_SEGMENTS + 1)
        return overlapping(pairs[0][0], segment), overlapping(pairs[0][1], segment)
    force, reading = _segments(pairs, decays, records[0].wrench.rate_hz, name)
    if kind is ExcitationKind.RELEASE:  # a step does not come back: its slope does, of both
        return np.diff(force, axis=1), np.diff(reading, axis=1)
    return force, reading


def _force_along(record: ExcitedRecord, direction: FloatArray, mass_kg: float | None) -> FloatArray:
    if record.force is None:
        raise ExperimentError(f"{record.name}: expected a measured force, got none")
    values = record.force.signals
    if values.shape[1] == len(direction):
        return values @ direction
    if direction[3:].any():
        raise ExperimentError(
            f"{record.name}: an acceleration excites forces; choose fx, fy or fz by --component, from Python component"
        )
    return (1.0 if mass_kg is None else mass_kg) * (values @ direction[:3])


def _segments(
    pairs: Sequence[tuple[FloatArray, FloatArray]], decays: Decays, rate: float, name: str
) -> tuple[FloatArray, FloatArray]:
    """Force and reading from quiet to quiet, an event in each row."""
    before = round(BEFORE_S * rate)
    spans = [
        (k, event.onset - before, event.after - 2 * before if event.after < len(pairs[k][0]) else event.after)
        for k, one in enumerate(decays.struck)
        for event in one.events
        if event.onset >= before
    ]
    if len(spans) < LEAST_AVERAGES:
        raise FitError(
            f"{name}: no transfer function: expected at least {LEAST_AVERAGES} events with {BEFORE_S:g} s before them, "
            f"got {len(spans)}"
        )
    segment = min(end - start for _, start, end in spans)
    force, reading = (np.array([pairs[k][side][start : start + segment] for k, start, _ in spans]) for side in (0, 1))
    return force, reading
