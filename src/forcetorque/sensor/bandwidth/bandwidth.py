# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor with its mounting does to fast forces: bandwidth, resonance, damping, and an inverse filter."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, known_names
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.additions import with_recording_notes
from forcetorque.experiment.calibrations_under_test import OneCalibration, one_named
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, optional_table, table_of
from forcetorque.sensor.bandwidth.decays import DecayCurve, Decays, EventRow, ResponseNumber, free_decays, numbers
from forcetorque.sensor.bandwidth.driven import (
    ChannelResponse,
    channel_responses,
    driven_response,
    gain_unit,
    response_curve,
)
from forcetorque.sensor.bandwidth.excited_records import ExcitationKind, component_index, excited_records
from forcetorque.sensor.bandwidth.frequency_response import FrequencyResponse, ResponseCurve
from forcetorque.sensor.bandwidth.second_order import MISFIT, InverseFilter, SecondOrder, inverse_filter
from forcetorque.sensor.transfer.static_curves import POINT_S, StaticCurve, static_curves

LEAST_VIBRATION = 0.02
"""Share of a vibration that may be left at the end of a segment."""

FOLDED_SHARE = 0.35
"""Part of the rate from which on a vibration may well be one from above half of it, folded back."""


class Response(DrawnResult):
    """What a sensor does to fast forces."""

    drawn_by: ClassVar[str] = "forcetorque.sensor.figures:response_figure"
    answered_by: ClassVar[str | None] = "forcetorque.sensor.answers:response_answer"

    schema_name: Literal["forcetorque/response/2"] = Field(default="forcetorque/response/2", alias="schema")
    """Form of the result."""
    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    wrench_source: str
    """What makes a wrench of its reading."""
    excitation: ExcitationKind
    """What was done to it."""
    signal: str
    """Component whose response it is, or the force along the step."""
    force: str | None
    """Stream of the measured force; null where none was."""
    rate_hz: float
    """Rate of the reading; Hz."""
    samples: int
    """Samples."""
    events: tuple[EventRow, ...]
    """Impacts or releases in the order of time."""
    numbers: tuple[ResponseNumber, ...]
    """Natural frequency, damping, gain, bandwidth, by source."""
    curve: ResponseCurve | None = Field(repr=False)
    """Frequency response; null where it is not determined."""
    channels: tuple[ChannelResponse, ...] = Field(default=(), repr=False)
    """Response of every component of the wrench whose force was measured and moved."""
    inverse: InverseFilter | None = Field(repr=False)
    """Filter that undoes the response; null where it is not determined well enough."""
    refused: tuple[str, ...]
    """What is not determined, and why."""
    static_curves: tuple[StaticCurve, ...] = ()
    """Static transfer curve of every channel; of known loads that change slowly."""
    decays: tuple[DecayCurve, ...] = Field(default=(), repr=False)
    """Decays and their fits, for the figure."""

    def blocks(self) -> Iterator[Table | str]:
        """Give events, numbers and filter.

        Yields:
            Tables and sentences.
        """
        if self.static_curves:
            yield table_of(
                self.static_curves, f"{self.sensor} ({self.serial}): every channel to the load that it answers to"
            )
            return
        what = f"{self.sensor} ({self.serial}), {self.wrench_source}: {self.excitation}, {self.signal}"
        yield from optional_table(self.events, f"{what}: {len(self.events)} events")
        yield from optional_table(self.numbers, f"{what}, sampled at {self.rate_hz:.5g} Hz")
        if self.curve is not None:
            yield (
                f"the measured force explains {100 * self.curve.explained_share:.1f} % of the power of the reading "
                f"({self.curve.averages:.3g} averages)"
            )
        if len(self.channels) > 1:
            yield table_of(self.channels, f"{self.sensor} ({self.serial}): every channel to its own measured force")
            yield from (channel.undetermined for channel in self.channels if channel.undetermined is not None)
        if self.inverse is not None:
            yield table_of([self.inverse], "filter that undoes it")
        yield from self.refused
        yield (
            "±: half a 95 % interval. It is the response of the sensor with all that is mounted on and under it; "
            f"vibrations above {0.5 * self.rate_hz:.5g} Hz, half of the rate, are not seen, or folded below it"
        )

    def records(self) -> list[dict[str, object]]:
        """Give the numbers, of static curves the channels, as flat lines.

        Returns:
            One line per number or channel.
        """
        rows = self.static_curves or self.numbers
        return [{"sensor": self.sensor, "serial": self.serial, **row.flat()} for row in rows]

    def corrected(self, reading: FloatArray) -> FloatArray:
        """Undo the response in a reading: `run.response("impact", force="hammer").corrected(stream)`.

        Args:
            reading: Samples of the component at `rate_hz`, without missing values; shape (n,) or (n, k).

        Returns:
            Force; the same shape.

        Raises:
            FitError: If the response is not determined well enough to be undone.
        """
        if self.inverse is None:
            raise FitError(f"{self.sensor}: expected a filter that undoes its response, got none: {self.refused[-1]}")
        return self.inverse.apply(reading)


@with_recording_notes
def response(
    runs: SensorRun | Sequence[SensorRun],
    excitation: ExcitationKind | str,
    calibration: OneCalibration | None = None,
    *,
    component: str | None = None,
    force: str | None = None,
    mass_kg: float | None = None,
    cut_off_hz: float | None = None,
    intervals: Collection[str] = (),
) -> Response:
    """Compute the response of a sensor to fast forces, or its static curves.

    Args:
        runs: The sensor, in one or several recordings.
        excitation: What was done to it: impact, release, pendulum, or static for known loads that change slowly.
        calibration: Reads the sensor, alone or by its name; its prior or the logged wrench if None.
        component: Component of the wrench; if None that in which most impacts stand out most, or the force
            along the step of a release.
        force: Stream with the force that was measured: an `applied_wrench`, or a `proper_acceleration`.
        mass_kg: Mass that was let go, or that moves with the acceleration; kg.
        cut_off_hz: Cut-off of the filter; Hz; the natural frequency if None.
        intervals: Labels of the intervals that are taken; all that are not to be ignored if none is named.

    Returns:
        Events with their decays, and where a force is known the response, its fit, and a filter that undoes it.

    Raises:
        ExperimentError: If something is requested that the experiment or the excitation does not have.
        FitError: If nothing is determined.
    """
    several = [runs] if isinstance(runs, SensorRun) else list(runs)
    run, kind = several[0], _excitation(excitation)
    place = None if component is None else component_index(component)
    _refuse_lacking(kind, place, component, force, mass_kg)
    correction = run.read_by(*one_named(calibration))
    if kind is ExcitationKind.STATIC:
        if calibration is not None or cut_off_hz is not None:
            raise ExperimentError("static: channels are taken as logged; leave out --calibration and --cut-off-hz")
        return _static(several, intervals)
    records = excited_records(several, correction, intervals=intervals, force=force)
    weight = None if mass_kg is None or kind is not ExcitationKind.RELEASE else mass_kg * STANDARD_GRAVITY
    decays = None if kind is ExcitationKind.PENDULUM else free_decays(records, kind, place, weight_N=weight)
    refused: list[str] = []
    transfer, fit = None, None if decays is None else decays.second_order
    if force is not None:
        try:
            transfer, fit = driven_response(records, decays, kind, place, mass_kg)
        except FitError as error:
            if decays is None:
                raise
            refused.append(str(error))
    elif fit is None:
        refused.append(
            "no transfer function: the force was not measured; name its stream by --force, from Python force"
        )
    rate = records[0].wrench.rate_hz
    inverse = None
    try:
        if fit is not None:
            quiet = None if decays is None else decays.quiet
            inverse = inverse_filter(fit, rate, cut_off_hz=cut_off_hz, name=run.sensor.name, quiet=quiet)
    except FitError as error:
        refused.append(str(error))
    result = Response(
        sensor=run.sensor.name,
        serial=run.sensor.serial,
        wrench_source=correction.source,
        excitation=kind,
        signal=component or _signal(kind, decays),
        force=force,
        rate_hz=rate,
        samples=sum(len(record.wrench) for record in records),
        events=() if decays is None else decays.rows,
        numbers=tuple(numbers(decays, fit if transfer is not None else None, gain_unit(records, mass_kg))),
        curve=None if transfer is None else response_curve(transfer, fit),
        channels=() if force is None else tuple(channel_responses(records, decays, kind, mass_kg)),
        inverse=inverse,
        refused=tuple(refused),
        decays=() if decays is None else decays.curves,
    )
    return result.model_copy(update={"warnings": tuple(_warnings(result, fit, transfer, decays))})


def _static(runs: Sequence[SensorRun], intervals: Collection[str]) -> Response:
    curves = static_curves(runs, intervals)
    run = runs[0]
    return Response(
        sensor=run.sensor.name,
        serial=run.sensor.serial,
        wrench_source="as logged",
        excitation=ExcitationKind.STATIC,
        signal=run.sensor.quantity,
        force=None,
        rate_hz=1.0 / POINT_S,
        samples=max(curve.points for curve in curves),
        events=(),
        numbers=(),
        curve=None,
        inverse=None,
        static_curves=curves,
        refused=(),
    )


def _excitation(name: ExcitationKind | str) -> ExcitationKind:
    if name not in tuple(ExcitationKind):
        raise ExperimentError(f"no excitation {name!r}; {known_names(str(name), ExcitationKind)}")
    return ExcitationKind(name)


def _refuse_lacking(
    kind: ExcitationKind, component: int | None, component_name: str | None, force: str | None, mass_kg: float | None
) -> None:
    if kind is ExcitationKind.STATIC and any(one is not None for one in (component, force, mass_kg)):
        raise ExperimentError(
            "static: the load is that which the experiment states, of every channel; leave out --component, --force "
            "and --mass-kg"
        )
    if mass_kg is not None and not mass_kg > 0.0:
        raise ExperimentError(f"mass: expected more than 0 kg, got {mass_kg:g}")
    if kind is ExcitationKind.PENDULUM and (force is None or component is None):
        raise ExperimentError(
            "pendulum: expected the stream of the measured force or acceleration, --force, and the component that it "
            f"excites, --component, from Python force and component, got {force!r} and {component_name!r}: an "
            "oscillation is no event that could determine them"
        )
    if kind is ExcitationKind.RELEASE and mass_kg is not None and component is not None and component > 2:
        raise ExperimentError(
            f"release: a weight of known mass is a force; expected fx, fy or fz, got {component_name!r}"
        )
    if kind is ExcitationKind.IMPACT and mass_kg is not None and force is None:
        raise ExperimentError(
            "impact: a mass says nothing of a tap without its acceleration; name its stream by --force, "
            "from Python force"
        )


def _signal(kind: ExcitationKind, decays: Decays | None) -> str:
    if decays is None or kind is ExcitationKind.RELEASE:
        return "force along the step"
    return WRENCH_COMPONENTS[int(decays.direction.argmax())]


def _warnings(
    result: Response, fit: SecondOrder | None, transfer: FrequencyResponse | None, decays: Decays | None
) -> Iterator[str]:
    if against := [f"{row.channel} at {row.lowest_hz:.3g} Hz" for row in result.channels if row.reversed]:
        yield (
            f"{result.sensor}: the reading goes against its measured force ({', '.join(against)}): the channel is "
            "reversed, the sign or frame of one of both streams is wrong, or the force drives it beyond its resonance "
            "alone"
        )
    yield from (row.undetermined for row in result.events if row.undetermined is not None)
    together = [f"{row.channel} with {row.moves_with}" for row in result.channels if row.moves_with is not None]
    if together:
        yield (
            f"{result.sensor}: measured forces move together ({', '.join(together)}): crosstalk between these channels "
            "is part of their gain; excite other places and directions too"
        )
    for row in result.events:
        if row.frequency_hz is not None and row.frequency_hz > FOLDED_SHARE * result.rate_hz:
            yield (
                f"{row.recording}: at {row.time_s:.3f} s it rings at {row.frequency_hz:.4g} Hz, near half of the rate, "
                f"{0.5 * result.rate_hz:.4g} Hz: it may be one from above, folded back; sample faster"
            )
    if decays is not None and decays.ring_downs:
        frequency = decays.frequency
        if frequency.scatter is not None and frequency.scatter > 0.1 * frequency.mean:
            frequencies = [ring_down.frequency_hz for ring_down in decays.ring_downs]
            yield (
                f"{result.sensor}: events ring at {min(frequencies):.3g} to {max(frequencies):.3g} Hz: they are not "
                "one vibration; strike one place in one posture, or choose another component"
            )
    if fit is None or transfer is None:
        return
    if fit.misfit is not None and fit.misfit > MISFIT:
        yield (
            f"{result.sensor}: one resonance leaves {fit.misfit:.2g} times the noise: there are more, or a delay; "
            "intervals are widened for it"
        )
    reached = float(transfer.frequency_hz[transfer.driven].max())
    if fit.natural_frequency_hz > reached:
        yield (
            f"{result.sensor}: its natural frequency, {fit.natural_frequency_hz:.4g} Hz, lies above what the force "
            f"drove, {reached:.4g} Hz: it is extrapolated by the form of the fit; confirm it by taps"
        )
    if decays is None:
        return
    remaining = remaining_vibration(fit, transfer)
    if remaining > LEAST_VIBRATION:
        yield (
            f"{result.sensor}: {100 * remaining:.0f} % of a vibration is left when its segment ends, "
            "which makes damping look larger; leave more time between events"
        )


def remaining_vibration(fit: SecondOrder, transfer: FrequencyResponse) -> float:
    """Compute the share of a vibration that is left at the end of a segment.

    Args:
        fit: The sensor.
        transfer: Its response, whose steps of frequency are one by the length of a segment.

    Returns:
        Share of its height.
    """
    length = 1.0 / float(np.diff(transfer.frequency_hz[:2])[0])
    return math.exp(-2.0 * math.pi * fit.damping * fit.natural_frequency_hz * length)
