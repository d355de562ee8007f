# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `gains` in a few lines: how many gains to change, and which channel is nearest to its limit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.results.answer import Answer, Concern
from forcetorque.sensor.gains.amplifier_gains import ChannelGain, GainChange

if TYPE_CHECKING:
    from forcetorque.sensor.gains.gains import Gains
    from forcetorque.sensor.gains.result import SensorRow

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
