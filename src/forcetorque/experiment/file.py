# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file: what was recorded, with which robot and sensors, and which interval is for what."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import (
    Field,
    model_validator,
)
from pydantic_core import PydanticCustomError

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.toml_file import Finite, Positive, Table, Text, read_toml
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.calibration.section import CalibrationTable
from forcetorque.estimation.section import FusionTable, MotorTable
from forcetorque.evaluation.load_cases.section import LoadCaseTable
from forcetorque.experiment.processing_section import ClockTable, ProcessingTable, TransformTable
from forcetorque.experiment.sensor_section import Sensor, SixPositive
from forcetorque.formats.registry import AnyLog
from forcetorque.locomotion.section import SoleTable
from forcetorque.payload.section import (
    AnyLoad,
    LinkLoad,
    Load,
    OneOrSeveral,
    require_link_loads,
    require_loads_of,
    require_one_sensor,
)
from forcetorque.planning.section import PlanTable
from forcetorque.recording.recording import Use
from forcetorque.robot.contacts import ContactType


class Robot(Table):
    """The robot model."""

    urdf: Path
    """URDF file."""
    fixed: dict[Text, Finite] = {}
    """Joints that nobody logged and that stand still all along, by name: rad, or m where prismatic."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""


class Patch(Table):
    """A patch of artificial skin."""

    name: Text
    """Name of the patch."""
    counts: Text
    """Stream of the recording that holds its `taxel_counts`."""
    pressure: Text | None = None
    """Stream with the `pressure` of the chamber or bag that it was calibrated in."""
    serial: Text | None = None
    """Serial number, or another mark that tells it from patches of the same name."""
    layout: Path | None = None
    """File that says where its taxels are; every column of the counts is one if left out."""
    link: Text | None = None
    """Link that it is mounted on; that of the layout if left out."""
    table: Path | None = None
    """Calibration of its taxels, as `forcetorque skin calibrate` writes it; where it is stated, contacts are shown."""
    friction: Annotated[float, Field(ge=0.0)] | None = None
    """Coefficient that bounds the tangential force, which skin does not feel; without one nothing is known of it."""
    oldest_s: Positive | None = None
    """How much older than a pose the frame of pressures that belongs to it may be; s."""


class Trial(Table):
    """What the recording is to a comparison with others of the same sensor."""

    condition: Text | None = None
    """What was done to the sensor, in any words, such as the torque of its screws."""
    number: Annotated[int, Field(ge=1, strict=True)] | None = None
    """Which trial of its condition it is, from 1; by the order of the files if left out."""


class Support(Table):
    """The link that is the only one to touch the world: at rest there, or moving with a known motion."""

    frame: Text
    """Link of the URDF."""
    gravity_direction: Annotated[FloatArray, ArrayField((3,))] | None = None
    """At rest: direction in which things fall, in the axes of the frame; [0, 0, -1] for a level sole with z up."""
    imu: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """Moving: streams of an IMU at any link, with proper_acceleration and angular_velocity."""

    @model_validator(mode="after")
    def _at_rest_or_moving(self) -> Support:
        if (self.gravity_direction is None) == (self.imu is None):
            raise PydanticCustomError(
                "support_motion", "a support needs gravity_direction if it is at rest, or imu if the robot moves"
            )
        return self


class Contact(Table):
    """A place where the world may touch the robot beside the support."""

    frame: Text
    """Link of the URDF."""
    name: Text | None = None
    """Name, unique in the file; that of the frame if left out."""
    type: ContactType = ContactType.WRENCH
    """What is unknown."""
    position_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Contact point in the frame; its origin if left out."""
    direction: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Unit vector of a `force_along`, in the axes of the frame."""
    stream: Text | None = None
    """Stream with the wrench of a `known` contact, in this frame."""
    wrench_noise: SixPositive | None = None
    """Of a `known` contact, standard deviation by which the wrench differs from sample to sample; N, N m; for
    `estimate --fuse`."""
    wrench_deviation: SixPositive | None = None
    """Of a `known` contact, standard deviation of what the wrench is off all along; N, N m; for `estimate --fuse`."""
    intervals: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """Labels of the intervals in which it may touch; all if left out."""

    @model_validator(mode="after")
    def _fits_its_type(self) -> Contact:
        if (self.direction is not None) != (self.type is ContactType.FORCE_ALONG):
            raise PydanticCustomError("direction_rules", "direction is for type force_along, which needs it")
        if (self.stream is not None) != (self.type is ContactType.KNOWN):
            raise PydanticCustomError("stream_rules", "stream is for type known, which needs it")
        if self.type is ContactType.KNOWN and self.position_m is not None:
            raise PydanticCustomError("known_place", "the wrench of a known contact is about the origin of its frame")
        return self


class EstimationTable(Table):
    """How contacts are told apart."""

    length_scale_m: Positive | None = None
    """Moment that weighs as much as one newton; needed where a sub-model has more than six unknowns."""


class Interval(Table):
    """A span of the recording."""

    label: Text
    """Name of the interval."""
    start_s: Finite
    """Start; s from the earliest stamp over all streams."""
    end_s: Finite | None = None
    """End, itself excluded; s from the earliest stamp over all streams; the end of the log if left out."""
    use: Use
    """calibration, validation or ignore."""
    kind: Text | None = None
    """Kind of motion, such as grid or balancing; a study combines the data by kind; the label if left out."""
    session: Text | None = None
    """Stretch of time in which nothing was switched off, such as a day; a study chooses on some sessions and scores on
    others; a calibration has an offset for each; one for the whole recording if left out."""
    load: Text | None = None
    """Name of the load that hangs on the wrist sensor or on the robot; needed where there are several."""
    support: Text | None = None
    """Support frame; required unless the use is ignore, or the links that touch are named."""
    touched: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """In place of a support: links that the world touches, nobody knows how, while the IMU of the recording tells how
    the robot moves."""

    @model_validator(mode="after")
    def _support_or_touched(self) -> Interval:
        if self.support is not None and self.touched is not None:
            raise PydanticCustomError(
                "support_or_touched",
                "expected support or touched, got both; other links than the support are [[contact]]",
            )
        return self


class ExperimentFile(Table):
    """The whole file."""

    schema_name: Literal["forcetorque/experiment/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the experiment."""
    robot: Robot | None = None
    """The robot model; a wrist sensor may have `load` instead."""
    load: Annotated[tuple[AnyLoad, ...], OneOrSeveral()] | None = None
    """What hangs on a wrist sensor, in place of a robot, or on a link of the robot; of several `[[load]]` an interval
    says which."""
    recording: AnyLog
    """Where the recording is."""
    clock: tuple[ClockTable, ...] = ()
    """Streams whose clock differs from that of others."""
    transform: tuple[TransformTable, ...] = ()
    """Wrenches that the log gives in another frame than the sensor's."""
    sensor: Annotated[tuple[Sensor, ...], Field(min_length=1)] = ()
    """Sensors; may be left out where the file is about skin alone."""
    patch: Annotated[tuple[Patch, ...], Field(min_length=1)] = ()
    """Patches of artificial skin; without these and sensors a file is about contacts that a skinManager saw."""
    support: tuple[Support, ...] = ()
    """Support frames; none with `load` in place of a robot."""
    interval: Annotated[tuple[Interval, ...], Field(min_length=1)]
    """Intervals."""
    contact: tuple[Contact, ...] = ()
    """Contacts beside the support; without any, whatever touches a sub-model is given at its sensor."""
    sole: tuple[SoleTable, ...] = ()
    """Soles that the robot stands on, for `forcetorque balance`."""
    motor: tuple[MotorTable, ...] = ()
    """Motors whose current or PWM tells joint torques, for `estimate --fuse`."""
    fusion: FusionTable | None = None
    """How joint torques of several sources are made one; needed for `estimate --fuse`."""
    estimation: EstimationTable = EstimationTable()
    """How contacts are told apart."""
    processing: ProcessingTable = ProcessingTable()
    """How samples are processed."""
    calibration: CalibrationTable = CalibrationTable()
    """How the fit is regularised."""
    trial: Trial = Trial()
    """Condition and number, for `forcetorque compare`."""
    load_case: tuple[LoadCaseTable, ...] = ()
    """What the sensors are to be used for."""
    plan: PlanTable | None = None
    """What can be recorded next, for `forcetorque plan`."""

    @model_validator(mode="after")
    def _robot_or_load(self) -> ExperimentFile:
        if not self.sensor:
            return self
        if self.robot is None and self.load is None:
            raise PydanticCustomError("robot_or_load", "expected [robot] with a URDF, or [load] for a wrist sensor")
        if self.load is not None and self.robot is not None:
            require_link_loads(self.load)
        if self.robot is None and self.link_load:
            raise PydanticCustomError(
                "load_link", "[[load]] with link hangs on a link of a robot: expected [robot] with its URDF, got none"
            )
        if self.robot is not None and not self.support and not any(one.touched for one in self.interval):
            raise PydanticCustomError(
                "no_support", "expected [[support]]: the frame that the robot stands on, or touched in [[interval]]"
            )
        alone = self.load is not None and self.robot is None
        if alone and (self.support or len(self.sensor) > 1):
            raise PydanticCustomError("load_alone", "with [load] there is one [[sensor]] and no [[support]]")
        if alone and any(one.touched for one in self.interval):
            raise PydanticCustomError("load_touched", "with [load] nothing else is touched: leave out touched")
        if self.load is not None and any(one.touched and one.use is not Use.IGNORE for one in self.interval):
            raise PydanticCustomError(
                "load_touched",
                "with [[load]] on a link every interval names its support: leave out touched, or state the load in the "
                "URDF",
            )
        if self.load is None and any(one.load for one in self.interval):
            raise PydanticCustomError("load_of_none", "load of [[interval]] names a [[load]], of which there is none")
        return self

    @model_validator(mode="after")
    def _loads_of_one_sensor(self) -> ExperimentFile:
        if self.load is not None:
            if self.robot is None:
                require_one_sensor(self.wrist_load)
            require_loads_of(self.load, [one for one in self.interval if one.use is not Use.IGNORE])
        return self

    @property
    def wrist_load(self) -> tuple[Load, ...]:
        """Loads on a wrist sensor, in place of a robot."""
        return tuple(load for load in self.load or () if isinstance(load, Load))

    @property
    def link_load(self) -> tuple[LinkLoad, ...]:
        """Loads on links of the robot."""
        return tuple(load for load in self.load or () if isinstance(load, LinkLoad))


def parse_experiment(path: Path | str) -> ExperimentFile:
    """Read and check an experiment file, without opening what it points to.

    Args:
        path: TOML file.

    Returns:
        Its content.
    """
    return read_toml(path, ExperimentFile, what="an experiment file")
