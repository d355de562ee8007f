# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file states of a signal whatever the format of its log: quantity, frame, form of orientations."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.constants import STANDARD_GRAVITY
from forcetorque.errors import FormatError
from forcetorque.recording import ROLL_PITCH_YAW, EulerAxes, OrientationForm, OrientationLayout, OrientationSense
from forcetorque.toml_table import Positive, Table, Text

STATE_SENSE = 'orientation = { sense = "sensor_to_world" } or "world_to_sensor"'
"""What to state of orientations of which a log does not say what they turn into what."""


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
            raise PydanticCustomError("orientation_rules", "{message}", {"message": str(error)}) from error
        return self

    def _form(self) -> OrientationLayout:
        return ROLL_PITCH_YAW  # of the forms that a format may fix one is as good as another to check the rest

    def applied_to(self, written: OrientationLayout) -> OrientationLayout:
        """Put what is stated into what the format of a log fixes.

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
    """`sensor_to_world` where it turns vectors along the frame's axes to the world's, else `world_to_sensor`."""

    def applied_to(self, written: OrientationLayout) -> OrientationLayout:
        """Put what is stated into what the format of a log fixes.

        Args:
            written: How the log writes orientations, in whatever sense.

        Returns:
            What its numbers mean.
        """
        return super().applied_to(replace(written, sense=self.sense))


class OrientationTable(SenseTable):
    """How a log writes the orientation of a frame; nothing of it is guessed."""

    form: OrientationForm
    """quat_xyzw, quat_wxyz, matrix_rows, matrix_columns or euler."""
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


class StatedSignal(Table):
    """Columns that make up one quantity."""

    quantity: Text
    """Name of the quantity; `forcetorque schema recording` lists them."""
    frame: Text | None = None
    """Frame along whose axes the values are given, or whose orientation it is."""
    orientation: OrientationTable | None = None
    """Of the quantity `orientation`, which needs it, how it is written; the stream then has `gravity` too."""

    @model_validator(mode="after")
    def _orientation_is_stated(self) -> StatedSignal:
        if (self.quantity == "orientation") != (self.orientation is not None):
            raise PydanticCustomError(
                "orientation_rules", "orientation, with form and sense, is for the quantity orientation, which needs it"
            )
        if self.orientation is not None and self.frame is None:
            raise PydanticCustomError("orientation_frame", "an orientation needs frame, the frame that it is of")
        return self
