# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file: what was recorded, with which robot and sensors, and which part is for what."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.constants import STANDARD_GRAVITY
from forcetorque.errors import known_names
from forcetorque.recording import Use
from forcetorque.robot import SensorFrame
from forcetorque.spatial import MeasureDirection


class _Table(BaseModel):
    """A table of the file; a key that it does not know is an error that lists the known ones."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True, populate_by_name=True)

    @model_validator(mode="before")
    @classmethod
    def _refuse_unknown_keys(cls, values: Any) -> Any:
        known = {field.alias or name for name, field in cls.model_fields.items()}
        for key in values if isinstance(values, dict) else ():
            if key not in known:
                raise PydanticCustomError(
                    "unknown_key", "{message}", {"message": f"unknown key {key!r}; {known_names(key, known)}"}
                )
        return values


Text = Annotated[str, Field(min_length=1)]
# strict: a text or a flag is no number
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False, strict=True)]
Finite = Annotated[float, Field(allow_inf_nan=False, strict=True)]


class Robot(_Table):
    """The robot model."""

    urdf: Path
    """URDF file."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""


class AnalogPort(_Table):
    """A YARP port of six calibrated numbers, N and N m."""

    kind: Literal["analog"]
    """Kind of the port."""
    name: Text
    """Name of the stream in the recording."""
    port: Text
    """Folder of the port below the log's folder."""


class StateExtPort(_Table):
    """A YARP port `stateExt:o` of a control board."""

    kind: Literal["state_ext"]
    """Kind of the port."""
    name: Text
    """Name of the stream in the recording."""
    port: Text
    """Folder of the port below the log's folder."""
    joints: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Joints of the board, in its order, named as in the URDF."""


class YarpLog(_Table):
    """A folder of yarpdatadumper."""

    format: Literal["yarp"]
    """Format of the recording."""
    path: Path
    """Folder that holds the ports."""
    stream: Annotated[
        tuple[Annotated[AnalogPort | StateExtPort, Field(discriminator="kind")], ...], Field(min_length=1)
    ]
    """Ports to read."""


class ParquetLog(_Table):
    """A folder in the project's own form."""

    format: Literal["parquet"]
    """Format of the recording."""
    path: Path
    """Folder with recording.json."""


class Sensor(_Table):
    """A force-torque sensor to calibrate or evaluate."""

    name: Text
    """Name of the URDF's sensor tag; with `joint`, the name to give a sensor that has no tag."""
    stream: Text
    """Stream of the recording that holds its reading."""
    serial: Text
    """Serial number."""
    prior: Path | None = None
    """Matrix file that the sensor was calibrated with before, and whose counts a calibrated stream recovers."""
    joint: Text | None = None
    """Fixed joint of a sensor without a tag."""
    measure_direction: MeasureDirection | None = None
    """Who acts on whom, for a sensor without a tag."""
    frame: SensorFrame | None = None
    """`child` or `parent`, for a sensor without a tag; child if left out."""

    @model_validator(mode="after")
    def _untagged_is_complete(self) -> Sensor:
        if self.joint is None and (self.measure_direction or self.frame):
            raise PydanticCustomError(
                "tag_rules", "measure_direction and frame are for a sensor without a URDF tag, which also needs joint"
            )
        if self.joint is not None and self.measure_direction is None:
            raise PydanticCustomError(
                "direction_missing",
                "a sensor without a URDF tag needs measure_direction, child_to_parent or parent_to_child; "
                "it is never guessed",
            )
        return self


class Support(_Table):
    """A link that stands still in the world."""

    frame: Text
    """Link of the URDF."""
    gravity_direction: Annotated[FloatArray, ArrayField((3,))]
    """Direction in which things fall, in the axes of the frame; [0, 0, -1] for a level sole with z up."""


class Interval(_Table):
    """A span of the recording."""

    label: Text
    """Name of the interval."""
    start_s: Finite
    """Start; s from the earliest stamp over all streams."""
    end_s: Finite
    """End; s from the earliest stamp over all streams."""
    use: Use
    """calibration, validation or ignore."""
    support: Text | None = None
    """Support frame; required unless the use is ignore."""


class Smoothing(_Table):
    """A Savitzky-Golay filter."""

    window_s: Positive
    """Length of the window; s."""
    order: Annotated[int, Field(ge=0, strict=True)]
    """Order of the polynomial."""


def _form_of_derivatives(value: Any) -> str:
    return "word" if isinstance(value, str) else "table"


class ProcessingTable(_Table):
    """How logged samples become reading and reference."""

    derivatives: Annotated[
        Annotated[Smoothing, Tag("table")] | Annotated[Literal["logged"], Tag("word")],
        Discriminator(_form_of_derivatives),
    ] = Smoothing(window_s=0.3, order=3)
    """Filter that differentiates joint positions, or `logged` to take velocity and acceleration from the log."""
    smoothing: Smoothing | None = None
    """Filter of reading and reference alike inside each interval, against vibration; none if left out."""


def _lambda(value: Any) -> Any:
    if isinstance(value, str) and value != "held-out":
        raise PydanticCustomError("lambda_word", "expected a number of at least 0 counts2 or `held-out`")
    return None if value == "held-out" else value


class CalibrationTable(_Table):
    """How the fit is regularised."""

    lambda_counts2: Annotated[
        Annotated[float, Field(ge=0.0, strict=True)] | None,
        BeforeValidator(_lambda),
        WithJsonSchema({"anyOf": [{"type": "number", "minimum": 0}, {"const": "held-out"}]}),
    ] = None
    """Lambda in the convention of thesis (5.4); `held-out` to choose it on held-out blocks."""


class ExperimentFile(_Table):
    """The whole file."""

    schema_name: Literal["forcetorque/experiment/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the experiment."""
    robot: Robot
    """The robot model."""
    recording: Annotated[YarpLog | ParquetLog, Field(discriminator="format")]
    """Where the recording is."""
    sensor: Annotated[tuple[Sensor, ...], Field(min_length=1)]
    """Sensors."""
    support: Annotated[tuple[Support, ...], Field(min_length=1)]
    """Support frames."""
    interval: Annotated[tuple[Interval, ...], Field(min_length=1)]
    """Intervals."""
    processing: ProcessingTable = ProcessingTable()
    """How samples are processed."""
    calibration: CalibrationTable = CalibrationTable()
    """How the fit is regularised."""
