# SPDX-License-Identifier: BSD-3-Clause
"""Answers of temperature, sessions, fast forces and gains in a few lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.results.answer import EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import amount, plus_minus
from forcetorque.sensor.gains.amplifier_gains import ChannelGain, GainChange

if TYPE_CHECKING:
    from forcetorque.sensor.bandwidth.driven_response import ChannelResponse
    from forcetorque.sensor.bandwidth.pooled_decays import ResponseNumber
    from forcetorque.sensor.bandwidth.response import Response
    from forcetorque.sensor.gains.gains import Gains
    from forcetorque.sensor.gains.result import SensorRow
    from forcetorque.sensor.sessions.session_drift import Drift
    from forcetorque.sensor.temperature.temperature_drift import Thermal, ThermalDriftRow

_CURVES = 3
"""Curved channels that are named; the table has all."""


def thermal_answers(thermal: Thermal) -> Iterator[Answer]:
    """Give the answer for every sensor.

    Args:
        thermal: Drifts of sensors.

    Yields:
        One answer each.
    """
    for row in thermal.sensors:
        force, moment = (_largest(row.components[part]) for part in FORCE_AND_MOMENT)
        left = "left " if row.corrected else ""
        drift = f"{left}drift of {force.signal} {_drift(force)}"
        stated = row.variable_table() is not None
        yield Answer(
            subject=f"{row.sensor} ({row.serial})",
            verdict=drift if row.separable_from_time else "NOT SEPARABLE FROM DRIFT IN TIME",
            why=(
                f"{'largest' if row.separable_from_time else drift}; of the moments {left}drift of {moment.signal} "
                f"{_drift(moment)}",
                f"{row.samples} samples, {row.cycles:g} times heated and cooled, {row.lowest_degC:.1f} to "
                f"{row.highest_degC:.1f} degC",
            ),
            step="" if row.corrected else _STATE if stated else "record it heated and cooled several times",
            command=typed("bench", "thermal", EXPERIMENT, "--details") if stated else "",
            written=(thermal.figure_file,),
            concern=Concern.NONE if row.separable_from_time else Concern.UNCERTAIN,
        )


_STATE = "state prior_coefficients of the details as [[sensor.variable]], and calibrate"


def _largest(rows: Sequence[ThermalDriftRow]) -> ThermalDriftRow:
    return max(rows, key=lambda row: abs(row.drift_per_degC))


def _drift(row: ThermalDriftRow) -> str:
    return plus_minus(row.drift_per_degC, row.drift_half_width_95_per_degC, f"{row.unit}/degC")


def drift_answers(drift: Drift) -> Iterator[Answer]:
    """Give the answer for every sensor.

    Args:
        drift: Sessions of sensors.

    Yields:
        One answer each.
    """
    for row in drift.sensors:
        drifts = row.drifts
        largest = [
            max(alike, key=lambda change: abs(change.change))
            for unit in ("N", "N m", "1")
            if (alike := [change for change in drifts if change.unit == unit])
        ]
        more = f"; {len(drifts) - len(largest)} more in the details" if len(drifts) > len(largest) else ""
        shown = max(change.half_width_95 for change in row.changes if change.quantity == "offset")
        least = "" if drifts else f"; half-widths of offset changes up to {amount(shown, '')}"
        yield Answer(
            subject=f"{row.sensor} ({row.serial}), {row.wrench_source}",
            verdict="DRIFT BEYOND NOISE" if drifts else "NO DRIFT BEYOND NOISE",
            why=(
                *(change.text for change in largest),
                f"{len(row.sessions)} sessions, {len(row.changes)} comparisons{more}{least}",
            ),
            step="fit an offset per session" if drifts else "",
            command=typed("calibrate", EXPERIMENT, "-o", "calibrations") if drifts else "",
            written=(drift.figure_file,),
            concern=Concern.UNCERTAIN if drifts else Concern.NONE,
        )


def response_answer(response: Response) -> Answer:
    """Give the answer.

    Args:
        response: The response of a sensor.

    Returns:
        The answer.
    """
    if response.static_curves:
        return _static_answer(response)
    # of a quantity that comes from several sources the last is that of the measured force
    numbers = {row.quantity: row for row in response.numbers}
    shown = [f"{name} {_number(row)}" for name, row in numbers.items()]
    filtered = (
        (f"filter that undoes it: cut-off {amount(response.inverse.cut_off_hz, 'Hz')}",) if response.inverse else ()
    )
    doubtful = response.refused or any(row.reversed or not row.moves for row in response.channels)
    first = (f"{len(response.events)} events, sampled at {response.rate_hz:.5g} Hz",) if response.events else ()
    return Answer(
        subject=f"{response.sensor} ({response.serial}), {response.excitation}, {response.signal}",
        verdict=shown[0] if shown else "NOT DETERMINED",
        why=("; ".join((*shown[1:], *first, *filtered)), *_channels(response.channels), *response.refused[:1]),
        written=(response.figure_file,),
        concern=Concern.BAD if not shown else Concern.UNCERTAIN if doubtful else Concern.NONE,
    )


def _static_answer(response: Response) -> Answer:
    curved = [row for row in response.static_curves if row.curved]
    known = [row for row in response.static_curves if row.curved is not None]
    unknown = [row.channel for row in response.static_curves if row.curved is None]
    worst = max(known, key=lambda row: row.linear_rmse / row.span, default=None)
    undetermined = f"{', '.join(unknown)}: the load moves them too little" if unknown else ""
    line = worst and (
        f"largest error of a line, {worst.channel}: {amount(worst.linear_rmse, worst.unit)} of a span of "
        f"{amount(worst.span, worst.unit)}, on {worst.points} points that were held out"
    )
    return Answer(
        subject=f"{response.sensor} ({response.serial}), static",
        verdict=f"CURVED: {', '.join(row.channel for row in curved)}"
        if curved
        else f"NOT DETERMINED: {', '.join(unknown)}"
        if unknown
        else "STRAIGHT",
        why=(
            *(
                f"{row.channel}: {row.best}, {amount(row.nonlinearity_percent or 0.0, '%')} of its span from a line"
                for row in curved[:_CURVES]
            ),
            *((undetermined,) if undetermined else ()),
            *((line,) if line else ()),
        ),
        written=(response.figure_file,),
        concern=Concern.UNCERTAIN if curved or unknown else Concern.NONE,
    )


def _channels(channels: Sequence[ChannelResponse]) -> Iterator[str]:
    if len(channels) < 2:
        return
    gains = [f"{row.channel} {_gain(row, row.lowest_gain)}" for row in channels if row.lowest_gain is not None]
    lost = [row.channel for row in channels if row.lowest_gain is None and row.moves]
    unknown = [f"not explained by its measured force: {', '.join(lost)}"] if lost else []
    still = [f"{row.channel} does not move" for row in channels if not row.moves]
    yield f"gain by channel: {'; '.join((*gains, *unknown, *still))}"


def _gain(row: ChannelResponse, lowest: float) -> str:
    if row.gain is not None:
        return plus_minus(row.gain, row.gain_half_width_95, "")
    return f"{plus_minus(lowest, row.lowest_half_width_95, '')} at {row.lowest_hz:.3g} Hz"


def _number(row: ResponseNumber) -> str:
    return plus_minus(row.value, row.half_width_95, "" if row.unit == "1" else row.unit)


_VERBS = {GainChange.RAISE: "RAISE", GainChange.LOWER: "LOWER", GainChange.LOWER_AND_REPEAT: "LOWER"}


def gains_answers(gains: Gains) -> Iterator[Answer]:
    """Give the answer for every sensor.

    Args:
        gains: Ranges and advice.

    Yields:
        One answer each.
    """
    for row in gains.sensors:
        raised = any(channel.change is GainChange.RAISE for channel in row.channels)
        yield Answer(
            subject=f"{row.sensor} ({row.serial})",
            verdict=_verdict(row.channels),
            why=(_nearest(row, gains.margin), *(_UNKNOWN_CONTACT if raised and not row.contact_specified else ())),
            step=_step(row),
            written=(gains.figure_file,),
            concern=_concern(row, raised=raised),
        )


_UNKNOWN_CONTACT = (
    "no [[contact]] is specified distal to the sensor: raise a gain only if nothing will touch the limb, or record the "
    "contacts of operation",
)


def _verdict(channels: Sequence[ChannelGain]) -> str:
    counts: dict[str, int] = {}
    for channel in channels:
        if channel.change in _VERBS:
            verb = _VERBS[channel.change]
            counts[verb] = counts.get(verb, 0) + 1
    if counts:
        return f"{', '.join(f'{verb} {count}' for verb, count in counts.items())} OF {len(channels)} GAINS"
    if any(channel.change is GainChange.NONE_FITS for channel in channels):
        return "NO ALLOWED GAIN FITS"
    if any(channel.change is GainChange.UNKNOWN for channel in channels):
        return "UNKNOWN: THE LOAD DID NOT MOVE"
    return "KEEP ALL GAINS"


def _nearest(row: SensorRow, margin: float) -> str:
    channel = min(row.channels, key=_left)
    saturated = sum(channel.saturated_share > 0.0 for channel in row.channels)
    lost = f"; {saturated} of {len(row.channels)} channels saturate" if saturated else ""
    left, least = f"{100.0 * _left(channel):.1f} %", f"{100.0 * margin:g} %"
    return (
        f"nearest to its limit of {row.limit_counts:g} counts: {channel.channel}, {left} left where {least} are to "
        f"stay{lost}"
    )


def _left(channel: ChannelGain) -> float:
    """What is left towards the nearer limit; share of the limit."""
    return min(channel.headroom_below, channel.headroom_above)


def _step(row: SensorRow) -> str:
    if row.repeat:
        return "lower the gains, and repeat the motion"
    if any(channel.change in _VERBS for channel in row.channels):
        return "set the gains of --details in the electronics, and calibrate again"
    return ""


def _concern(row: SensorRow, *, raised: bool) -> Concern:
    if row.repeat or any(channel.change is GainChange.NONE_FITS for channel in row.channels):
        return Concern.BAD
    return Concern.UNCERTAIN if raised and not row.contact_specified else Concern.NONE
