# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque gains`."""

from __future__ import annotations

import math
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.analysis import SensorGains
from forcetorque.evaluation import AxisResolution, GainChange
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


class ChannelRow(BaseModel):
    """One channel of a sensor."""

    channel: str
    """Name of the channel."""
    smallest_counts: float
    """Smallest reading."""
    largest_counts: float
    """Largest reading."""
    headroom_below: float
    """What is left towards the negative limit; share of the limit."""
    headroom_above: float
    """What is left towards the positive limit; share of the limit."""
    saturated_share: float
    """Share of samples at a limit."""
    present_gain: float | None
    """Gain with which it was recorded."""
    recommended_gain: float | None
    """Largest allowed gain that keeps the margin; where none does, the lowest below the present one."""
    largest_factor: float | None
    """Factor on the gain that would leave just the margin; an upper bound where the channel saturates."""
    change: GainChange
    """What to do."""
    keeps_margin: bool
    """Whether that leaves the margin, as far as the recording can tell."""
    expected_smallest_counts: float
    """Smallest reading with the recommended gain, else with the largest factor."""
    expected_largest_counts: float
    """Largest reading likewise."""
    expected_headroom_below: float
    """What would be left towards the negative limit; share of the limit."""
    expected_headroom_above: float
    """What would be left towards the positive limit; share of the limit."""


class ResolutionRow(BaseModel):
    """What one count is worth along an axis."""

    component: str
    """Component of the wrench."""
    unit: str
    """N/count or N m/count."""
    worst: float
    """Every channel off by one count with the worst signs: sum of the magnitudes of the matrix's row."""
    rms: float
    """Independent errors of one count standard deviation in every channel: Euclidean norm of the row."""
    expected_worst: float
    """The first with the recommended gains."""
    expected_rms: float
    """The second with the recommended gains."""


class JointRow(BaseModel):
    """Where a joint stood."""

    joint: str
    """Name of the joint."""
    position: float | None
    """Its position; nothing where its stream has a gap."""
    unit: str
    """rad or m."""


class StrongestRow(BaseModel):
    """A sample to repeat after a change of gains."""

    channel: str | None
    """Channel that is closest to its limit in it; nothing for the largest norm over all channels."""
    time_s: float
    """Time from the earliest stamp of the recording."""
    stamp_ns: int
    """Stamp."""
    counts: list[float]
    """What all channels read."""
    joints: list[JointRow]
    """Where the joints stood."""


class SensorRow(BaseModel):
    """One sensor."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    samples: int
    """Number of samples in all intervals that are not ignored."""
    missing: int
    """Samples without a reading."""
    frozen: int
    """Samples that a saturated board held, by its status; without one, samples in long stretches of one reading."""
    recovered: bool
    """Whether counts came through the inverse of the prior; an offset of the electronics is not in them."""
    limit_counts: float
    """Largest magnitude of a reading."""
    repeat: bool
    """Whether the motion is to be repeated because a channel saturated or the reading froze."""
    channels: list[ChannelRow]
    """Channels in the order of the electronics."""
    matrix: str | None
    """Where the matrix for the resolution comes from."""
    resolution: list[ResolutionRow]
    """One per component of the wrench; empty without a matrix."""
    strongest: list[StrongestRow]
    """One per channel, then the one of the largest norm."""


class GainsResult(BaseModel):
    """What `forcetorque gains` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/gains/1"] = Field(default="forcetorque/gains/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    margin: float
    """Share of the limit that is kept free."""
    figure: str | None
    """File of the figure."""
    sensors: list[SensorRow]
    """Sensors in the order of the file."""


def sensor_row(found: SensorGains) -> SensorRow:
    """Put what was found for a sensor into the form of the result.

    Args:
        found: What was found.

    Returns:
        Its row.
    """
    channels = [
        ChannelRow(
            channel=seen.channel,
            smallest_counts=seen.smallest_counts,
            largest_counts=seen.largest_counts,
            headroom_below=seen.headroom_below,
            headroom_above=seen.headroom_above,
            saturated_share=seen.saturated_share,
            present_gain=advice.present,
            recommended_gain=advice.recommended,
            largest_factor=advice.largest_factor,
            change=advice.change,
            keeps_margin=advice.keeps_margin,
            expected_smallest_counts=advice.expected.smallest_counts,
            expected_largest_counts=advice.expected.largest_counts,
            expected_headroom_below=advice.expected.headroom_below,
            expected_headroom_above=advice.expected.headroom_above,
        )
        for seen, advice in zip(found.ranges, found.advice, strict=True)
    ]
    return SensorRow(
        sensor=found.sensor,
        serial=found.serial,
        samples=len(found.time_s),
        missing=found.missing,
        frozen=found.frozen,
        recovered=found.recovered,
        limit_counts=found.limit_counts,
        repeat=found.must_repeat,
        channels=channels,
        matrix=found.matrix_source,
        resolution=_resolution_rows(found.resolution, found.expected_resolution),
        strongest=[
            StrongestRow(
                channel=sample.channel,
                time_s=sample.time_s,
                stamp_ns=sample.stamp_ns,
                counts=sample.counts.tolist(),
                joints=[
                    JointRow(
                        joint=joint.joint,
                        position=joint.position if math.isfinite(joint.position) else None,
                        unit=joint.unit,
                    )
                    for joint in sample.joints
                ],
            )
            for sample in found.strongest
        ],
    )


def _resolution_rows(present: AxisResolution | None, expected: AxisResolution | None) -> list[ResolutionRow]:
    if present is None or expected is None:
        return []
    return [
        ResolutionRow(
            component=component,
            unit=f"{unit}/count",
            worst=float(present.worst[k]),
            rms=float(present.rms[k]),
            expected_worst=float(expected.worst[k]),
            expected_rms=float(expected.rms[k]),
        )
        for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True))
    ]
