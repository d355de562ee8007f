# SPDX-License-Identifier: BSD-3-Clause
"""The response of a sensor to a force that was measured, from all records of one excitation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.sensor.bandwidth.decays import Decays
from forcetorque.sensor.bandwidth.frequency_response import (
    HIGHEST_SHARE,
    LEAST_AVERAGES,
    FrequencyResponse,
    frequency_response,
    overlapping,
    require_coherence,
)
from forcetorque.sensor.bandwidth.records import ExcitationKind, ExcitedRecord
from forcetorque.sensor.bandwidth.second_order import SecondOrder, jackknifed

BEFORE_S = 0.05
"""Quiet before an event that belongs to its segment; s."""
SWING_SEGMENTS = 9
"""Segments of a swing, which overlap by half."""


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
        ExperimentError: If the force has no such component, or a swing was recorded in several stretches.
    """
    direction = np.eye(6)[component] if decays is None else decays.direction
    name = "; ".join(record.name for record in records)
    pairs = [(_force_along(record, direction, mass_kg), record.wrench.signals @ direction) for record in records]
    rate = records[0].wrench.rate_hz
    highest = min(HIGHEST_SHARE * rate, *(record.highest_hz for record in records))
    if decays is None:
        if len(pairs) > 1:
            raise ExperimentError(
                f"{name}: expected one stretch with a swing, got {len(pairs)}; name one by --interval, from Python "
                "intervals"
            )
        segment = 2 * len(pairs[0][0]) // (SWING_SEGMENTS + 1)
        force, reading = (overlapping(series, segment) for series in pairs[0])
    else:
        force, reading = _segments(pairs, decays, rate, name)
        if kind is ExcitationKind.RELEASE:  # a step does not come back: its slope does, of both
            force, reading = np.diff(force, axis=1), np.diff(reading, axis=1)
    events = decays is not None
    transfer = frequency_response(force, reading, rate, events=events, highest_hz=highest)
    require_coherence(transfer, name=name)
    return transfer, jackknifed(transfer, force, reading, rate, events=events, highest_hz=highest, name=name)


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
