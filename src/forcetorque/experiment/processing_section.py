# SPDX-License-Identifier: BSD-3-Clause
"""Sections of the experiment file on filters, derivatives, and what the log lacks: clocks, frames, fixed joints."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import (
    Discriminator,
    Field,
    Tag,
    model_validator,
)
from pydantic_core import PydanticCustomError

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.toml_file import Finite, Positive, Table, Text, word_or_table
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.robot.mechanics.samples import Processing


class Smoothing(Table):
    """A Savitzky-Golay filter."""

    window_s: Positive
    """Length of the window; s."""
    order: Annotated[int, Field(ge=0, strict=True)]
    """Order of the polynomial."""


class ProcessingTable(Table):
    """How logged samples become reading and reference."""

    derivatives: Annotated[
        Annotated[Smoothing, Tag("table")] | Annotated[Literal["logged"], Tag("word")],
        Discriminator(word_or_table),
    ] = Smoothing(window_s=0.3, order=3)
    """Filter that differentiates joint positions, or `logged` to take velocity and acceleration from the log."""
    smoothing: Smoothing | None = None
    """Filter of reading and reference alike inside each interval, against vibration; none if left out."""


class PoseTable(Table):
    """Where a frame is in another, as `<origin>` of a URDF states it."""

    rpy_rad: Annotated[FloatArray, ArrayField((3,))]
    """Roll, pitch, yaw about fixed axes; rad."""
    position_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Its origin; left out where the moment is about the sensor's origin already."""


class TransformTable(Table):
    """A wrench that the log gives along the axes of another frame, moved into the sensor's."""

    stream: Text
    """Stream with the wrench; its signal's `frame` is the one along whose axes it is given."""
    to: Text
    """Frame of the sensor."""
    moment_about: Literal["sensor", "own_frame", "point"]
    """About which point the log gives moments: the origin of the sensor's frame, that of the wrench's own frame, or a
    point that moves with the sensor, such as that of a tool."""
    point_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """That point, along the axes of the sensor's frame from its origin; m."""
    orientation: Text | None = None
    """Stream with the orientation of the sensor's frame; the wrench is along the axes of its world. With moments about
    the origin of that world it has the translation of the sensor's frame too."""
    pose: PoseTable | None = None
    """In place of an orientation: pose of the wrench's frame in the sensor's, where that does not change."""

    @model_validator(mode="after")
    def _moment_has_a_place(self) -> TransformTable:
        if (self.orientation is None) == (self.pose is None):
            raise PydanticCustomError(
                "transform_pose", "expected orientation, a stream, or pose, where it does not change: one of them"
            )
        if self.pose is not None and (self.moment_about == "own_frame") != (self.pose.position_m is not None):
            raise PydanticCustomError(
                "transform_point",
                'position_m of pose is needed where moment_about = "own_frame", and moves nothing elsewhere',
            )
        if (self.moment_about == "point") != (self.point_m is not None):
            raise PydanticCustomError(
                "transform_point", 'point_m is needed where moment_about = "point", and moves nothing elsewhere'
            )
        return self


class ClockTable(Table):
    """Streams of a clock that differs from that of another stream, to which they are brought."""

    stream: Text | Annotated[tuple[Text, ...], Field(min_length=1)]
    """Stream that is brought to the clock; of several, which have one clock, the first is compared."""
    to: Text
    """Stream whose clock stays."""
    delay_s: Finite | Literal["estimate"]
    """By how much its stamps are later than those of the other for what happens at once, in the middle of the stream;
    `estimate` to find that in what both show."""
    drift: Finite | Literal["estimate"] = 0.0
    """Seconds by which the delay grows in a second; to be estimated with the delay only."""
    around_s: Finite | None = None
    """Delay around which it is looked for; 0 if left out."""
    within_s: Positive | None = None
    """How far from there it is looked for; s; 0.5 if left out."""

    @model_validator(mode="after")
    def _estimated_or_stated(self) -> ClockTable:
        if self.to in self.streams:
            raise PydanticCustomError("clock_itself", "expected to, another stream, got the same one")
        estimated = self.delay_s == "estimate"
        if self.drift == "estimate" and not estimated:
            raise PydanticCustomError("clock_drift", 'drift = "estimate" needs delay_s = "estimate"')
        if estimated and self.drift not in ("estimate", 0.0):
            raise PydanticCustomError(
                "clock_drift",
                'with delay_s = "estimate" drift is left out, or "estimate": a stated one needs a stated delay',
            )
        if not estimated and (self.around_s is not None or self.within_s is not None):
            raise PydanticCustomError("clock_search", 'around_s and within_s are for delay_s = "estimate"')
        return self

    @property
    def streams(self) -> tuple[str, ...]:
        """Streams that are brought to the clock."""
        return (self.stream,) if isinstance(self.stream, str) else self.stream

    @property
    def near_s(self) -> float:
        """The stated delay, or the one around which it is looked for; s."""
        return (self.around_s or 0.0) if isinstance(self.delay_s, str) else self.delay_s


def processing_of(table: ProcessingTable, *, gravity: float) -> Processing:
    """Settle how samples are processed.

    Args:
        table: What the file says.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        Filters and gravity.
    """
    derivatives, smoothing = table.derivatives, table.smoothing
    default = Processing()
    return Processing(
        derivative_window=default.derivative_window
        if derivatives == "logged"
        else SavitzkyGolay(window_s=derivatives.window_s, order=derivatives.order),
        logged_derivatives=derivatives == "logged",
        smoothing=None if smoothing is None else SavitzkyGolay(window_s=smoothing.window_s, order=smoothing.order),
        gravity=gravity,
    )
