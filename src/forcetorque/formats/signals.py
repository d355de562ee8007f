# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file specifies of signals, rates and units, independent of the format of the log."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, Self

import numpy as np
from pydantic import Field, model_validator

from forcetorque.base.arrays import ArrayField, FloatArray, IntArray
from forcetorque.base.errors import FormatError, UnitError, known_names
from forcetorque.base.toml_file import Finite, Positive, Table, Text
from forcetorque.base.units import STANDARD_GRAVITY, si_factor
from forcetorque.recording.orientation import (
    ROLL_PITCH_YAW,
    EulerAxes,
    OrientationForm,
    OrientationLayout,
    OrientationSense,
)
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, Labels, Quantity

SPECIFY_SENSE = 'orientation = { sense = "sensor_to_world" } or "world_to_sensor"'
"""What to specify of orientations whose sense a log does not state."""


class WorldTable(Table):
    """The world in which an orientation is seen."""

    gravity_direction: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Direction in which things fall, along the world's axes; [0, 0, -1] if left out."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""

    @model_validator(mode="after")
    def _holds_together(self) -> Self:
        try:
            self.applied_to(self._form())
        except FormatError as error:
            raise ValueError(str(error)) from error
        return self

    def _form(self) -> OrientationLayout:
        return ROLL_PITCH_YAW  # of the forms that a format may fix one is as good as another to check the rest

    def applied_to(self, written: OrientationLayout) -> OrientationLayout:
        """Put what is specified into what the format of a log fixes.

        Args:
            written: How the log writes orientations.

        Returns:
            What its numbers mean.
        """
        down = written.gravity_direction if self.gravity_direction is None else self.gravity_direction
        return replace(written, gravity_direction=down, gravity=self.gravity)


class SenseTable(WorldTable):
    """What a log whose format fixes the form of its orientations leaves open."""

    sense: OrientationSense
    """`sensor_to_world` where it rotates vectors along the frame's axes to the world's, else `world_to_sensor`."""

    def applied_to(self, written: OrientationLayout) -> OrientationLayout:
        """Put what is specified into what the format of a log fixes.

        Args:
            written: How the log writes orientations, in either sense.

        Returns:
            What its numbers mean.
        """
        return super().applied_to(replace(written, sense=self.sense))


class OrientationTable(SenseTable):
    """How a log writes the orientation of a frame; nothing of it is inferred."""

    form: OrientationForm
    """quat_xyzw, quat_wxyz, matrix_rows, matrix_columns, rotation_vector or euler."""
    axes: Text | None = None
    """Of Euler angles the axes in the order of the columns, such as `zyx`."""
    about: EulerAxes | None = None
    """Of Euler angles `moving` (intrinsic) or `fixed` (extrinsic) axes."""

    def _form(self) -> OrientationLayout:
        return OrientationLayout(form=self.form, sense=self.sense, axes=self.axes, about=self.about)

    def layout(self) -> OrientationLayout:
        """Give it to a reader.

        Returns:
            What the numbers mean.
        """
        return self.applied_to(self._form())


class SpecifiedSignal(Table):
    """Columns that make up one quantity."""

    quantity: Text
    """Name of the quantity; `forcetorque schema recording` lists them."""
    frame: Text | None = None
    """Frame along whose axes the values are given, or whose orientation it is."""
    orientation: OrientationTable | None = None
    """Of the quantity `orientation`, which needs it, how it is written; the stream then has `gravity` too."""

    @model_validator(mode="after")
    def _orientation_is_specified(self) -> SpecifiedSignal:
        if (self.quantity == "orientation") != (self.orientation is not None):
            raise ValueError("orientation, with form and sense, is for the quantity orientation, which needs it")
        if self.orientation is not None and self.frame is None:
            raise ValueError("an orientation needs frame, the frame that it is of")
        return self


_LATEST_S = 9.2e9
"""Later instants do not fit into 64 bits of nanoseconds."""


class SpecifiedRate(Table):
    """Rows that were taken at even steps of time."""

    rate_hz: Positive | None = None
    """In place of a column with the time: rows per second."""
    start_s: Finite | Annotated[tuple[Finite, ...], Field(min_length=1)] | None = None
    """With `rate_hz`: time of the first row since the epoch of the clock; s; of several files one for each."""

    @model_validator(mode="after")
    def _rate_has_a_start(self) -> SpecifiedRate:
        if (self.rate_hz is None) != (self.start_s is None):
            raise ValueError(
                "rate_hz needs start_s, the time of the first row on its clock, such as 0.0; and start_s needs rate_hz"
            )
        return self

    @property
    def starts_s(self) -> tuple[float, ...]:
        """Time of the first row of every file; s."""
        if self.start_s is None:
            return ()
        return self.start_s if isinstance(self.start_s, tuple) else (self.start_s,)

    def rate_findings(self, stream: str, count: int) -> tuple[Finding, ...]:
        """Report that times of rows were not logged.

        Args:
            stream: Name of the stream.
            count: Number of its rows.

        Returns:
            One finding; none where times were logged.
        """
        if self.rate_hz is None:
            return ()
        starts = ", ".join(f"{start:g} s" for start in self.starts_s)
        text = f"no time is logged: rows are taken at {self.rate_hz:g} Hz from {starts} on, as specified"
        return (Finding(stream=stream, kind="stated_rate", message=text, count=count, size=self.rate_hz, unit="Hz"),)


def even_stamps(count: int, *, rate_hz: float, start_s: float) -> IntArray:
    """Give rows times at even steps, each rounded by itself so that steps do not add up rounding.

    Args:
        count: Number n of rows.
        rate_hz: Rows per second.
        start_s: Time of the first one; s.

    Returns:
        Stamps; shape (n,); ns.

    Raises:
        FormatError: If they lie beyond what 64 bits hold, or two of them in one nanosecond.
    """
    if rate_hz > 1e9 or not abs(start_s) + count / rate_hz < _LATEST_S:
        raise FormatError(
            f"rate_hz, start_s: expected rows at most 1e9 times a second and within {_LATEST_S:g} s of the epoch, got "
            f"{count} rows at {rate_hz:g} Hz from {start_s:g} s"
        )
    return round(start_s * 1e9) + np.rint(np.arange(count) * (1e9 / rate_hz)).astype(np.int64)


def specified_quantity(name: str, *, where: str, columns: int) -> Quantity:
    """Find a quantity that has as many columns as are specified.

    Args:
        name: What the file calls it.
        where: Where it is specified, for messages.
        columns: Number of columns.

    Returns:
        The quantity.

    Raises:
        FormatError: If recordings have none of that name, or it has another number of columns.
    """
    quantity = QUANTITIES.get(name)
    if quantity is None:
        raise FormatError(f"{where}: {known_names(name, QUANTITIES)}; got {name!r}")
    if quantity.labels is Labels.FIXED and columns != len(quantity.columns):
        raise FormatError(
            f"{where}: {name}: expected {len(quantity.columns)} columns ({', '.join(quantity.columns)}), got {columns}"
        )
    return quantity


def units_in_si(
    quantity: Quantity, units: Sequence[str], *, where: str, columns: Sequence[object]
) -> list[tuple[str, float]]:
    """Bring the units of columns to those that a recording keeps.

    Args:
        quantity: What the columns are of; a scalar of any unit is taken as it stands.
        units: Unit of every column, as specified.
        where: Where they are specified, for messages.
        columns: What every column is called there.

    Returns:
        SI unit of every column, and the factor from what is specified.

    Raises:
        UnitError: If a unit is not known, or none of the quantity.
    """
    fixed = quantity.labels is Labels.FIXED
    if not fixed and not quantity.units:
        return [(unit, 1.0) for unit in units]
    factors = [si_factor(unit) for unit in units]
    for k, (unit, _) in enumerate(factors):
        allowed = (quantity.units[k],) if fixed else quantity.units
        if unit not in allowed:
            raise UnitError(
                f"{where}: column {columns[k]!r}: expected a unit of {quantity.name} that converts to "
                f"{' or '.join(allowed)}, got {units[k]!r}"
            )
    return factors
