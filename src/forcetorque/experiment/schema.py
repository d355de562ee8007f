# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file: what was recorded, with which robot and sensors, and which part is for what."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    Discriminator,
    Field,
    Tag,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.calibration import ESTIMATION_TYPES, GENERATIVE, OffsetStrategy
from forcetorque.calibration.generative import REPEATABILITY
from forcetorque.constants import STANDARD_GRAVITY
from forcetorque.errors import known_names
from forcetorque.estimation import ContactType
from forcetorque.exchange.formats import AnyLog
from forcetorque.experiment.tables.fusion import FusionTable, MotorTable
from forcetorque.experiment.tables.link_load import AnyLoad, LinkLoad, require_link_loads
from forcetorque.experiment.tables.load_case import LoadCaseTable
from forcetorque.experiment.tables.plan import PlanTable
from forcetorque.experiment.tables.recipes import ClockTable, TransformTable
from forcetorque.experiment.tables.six_axes import SixPositive
from forcetorque.experiment.tables.soles import SoleTable
from forcetorque.experiment.tables.wrist import Load, OneOrSeveral, require_loads_of, require_one_sensor
from forcetorque.recording import Use
from forcetorque.robot import SensorFrame
from forcetorque.spatial import MeasureDirection
from forcetorque.toml_table import Finite, NotNegative, Positive, Table, Text


class Robot(Table):
    """The robot model."""

    urdf: Path
    """URDF file."""
    fixed: dict[Text, Finite] = {}
    """Joints that nobody logged and that stand still all along, by name: rad, or m where prismatic."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""


class Variable(Table):
    """Something beside the load that moves the reading of a sensor, such as its temperature."""

    name: Text
    """Name, unique for the sensor."""
    stream: Text | None = None
    """Stream that holds it; that of the sensor if left out."""
    quantity: Text = "temperature"
    """Quantity of the stream."""
    column: Text | None = None
    """Column of the quantity; needed where it has several."""
    reference_value: Finite | None = None
    """Value at which it contributes nothing; that of the first fitted sample if left out."""
    prior_coefficients: Annotated[FloatArray, ArrayField((6,))] | None = None
    """Coefficients that are expected; N, N m per unit; about none if left out, and not penalised by a thesis' type."""
    prior_deviation: Annotated[tuple[Positive, ...], Field(min_length=6, max_length=6)] | None = None
    """How far they may be from these; N, N m per unit; if left out 0.5 % of full scale per degree, and for another unit
    one full scale over the range that was seen."""


def _word_or_table(value: Any) -> str:
    return "word" if isinstance(value, str | Path) else "table"


class PriorTable(Table):
    """A file with a calibration, and what it does not say itself."""

    path: Path
    """The file."""
    force_unit: Text | None = None
    """Unit of the forces of a plain table, such as N."""
    moment_unit: Text | None = None
    """Unit of the moments of a plain table, such as N m."""
    volts_per_count: Positive | None = None
    """Of a matrix per volt, what one count of the log is worth: span of the converter over its steps; 1 for a log in
    volts."""


class Sensor(Table):
    """A force-torque sensor to calibrate or evaluate."""

    name: Text
    """Name of the URDF's sensor tag; with `joint`, the name to give a sensor that has no tag."""
    stream: Text
    """Stream of the recording that holds its reading."""
    serial: Text
    """Serial number."""
    prior: (
        Annotated[
            Annotated[PriorTable, Tag("table")] | Annotated[Literal["identity"] | Path, Tag("word")],
            Discriminator(_word_or_table),
        ]
        | None
    ) = None
    """File of the calibration that the sensor came with, and whose counts a calibrated stream recovers: a matrix file
    of iCub, .dat of FirmwareUpdater, .cal of ATI, or a plain table; `identity` if that matrix is not known: the
    calibrated reading then takes the place of counts."""
    limit_counts: Positive = 32767.0
    """Largest magnitude of a raw reading; counts."""
    full_scale: SixPositive | None = None
    """Full scale of fx, fy, fz, tx, ty, tz; N, N m; needed with the prior `identity`, which says nothing of sizes."""
    reading_noise: SixPositive | None = None
    """Standard deviation by which a reading differs from sample to sample; N, N m; for `estimate --fuse`."""
    reading_deviation: SixPositive | None = None
    """Standard deviation of what a reading is off all along, such as by its offset; N, N m; for `estimate --fuse`."""
    amplifier_gain: Annotated[tuple[Positive, ...], Field(min_length=1)] | None = None
    """Gain of the amplifier of each channel while it was recorded, for `forcetorque gains`."""
    allowed_gains: Annotated[tuple[Positive, ...], Field(min_length=1)] | None = None
    """Gains that its amplifiers can be set to."""
    variable: tuple[Variable, ...] = ()
    """Linear variables that may be fitted with the matrix."""
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

    @model_validator(mode="after")
    def _allowed_gains_need_the_present_ones(self) -> Sensor:
        if self.allowed_gains is not None and self.amplifier_gain is None:
            raise PydanticCustomError(
                "gain_missing", "allowed_gains needs amplifier_gain, the gains with which the recording was made"
            )
        return self


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
        Discriminator(_word_or_table),
    ] = Smoothing(window_s=0.3, order=3)
    """Filter that differentiates joint positions, or `logged` to take velocity and acceleration from the log."""
    smoothing: Smoothing | None = None
    """Filter of reading and reference alike inside each interval, against vibration; none if left out."""


def _lambda(value: Any) -> Any:
    if isinstance(value, str) and value != "held-out":
        raise PydanticCustomError("lambda_word", "expected a number of at least 0 counts2 or `held-out`")
    return None if value == "held-out" else value


class Accuracy(Table):
    """Standard deviation of what neither model nor averaging takes away."""

    force_N: NotNegative
    """Of every force; N."""
    moment_Nm: NotNegative
    """Of every moment; N m."""


class CalibrationTable(Table):
    """How the sensor is fitted: by the generative model, or by a type of the thesis where one is asked for."""

    accuracy: Accuracy | None = None
    """Accuracy of the reference; 1e-3 of full scale if left out."""
    repeatability: Annotated[float, Field(ge=0.0, lt=1.0, strict=True)] = REPEATABILITY
    """Share of its response by which the sensor differs from one motion to the next (creep, hysteresis)."""
    drift: bool = False
    """Whether the offset of a session may move evenly in time."""
    nonlinear: bool = False
    """Whether quadratic terms may correct readings; they do where they win on recordings that were not fitted."""

    lambda_counts2: Annotated[
        Annotated[float, Field(ge=0.0, strict=True)] | None,
        BeforeValidator(_lambda),
        WithJsonSchema({"anyOf": [{"type": "number", "minimum": 0}, {"const": "held-out"}]}),
    ] = None
    """Lambda in the convention of thesis (5.4); `held-out` to choose it on held-out blocks."""
    type: Annotated[str, Field(json_schema_extra={"enum": [GENERATIVE, *ESTIMATION_TYPES]})] | None = None
    """`generative`, the default, or an estimation type by its name in the thesis, such as OwTrTO; in place of the next
    three, any of which stands for a thesis' type too, as does lambda."""
    offset: OffsetStrategy | None = None
    """How the offset is found: one-shot, the default, gives the same as centralised; sphere needs a grid motion."""
    with_variables: bool | None = None
    """Whether the variables of the sensors are fitted; by default where there are any."""
    from_reference: bool | None = None
    """Whether variables count from their reference value, the default, or from zero."""
    sphere_intervals: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """Labels of the grid motions that give the offset of the sphere types; may be left out if there is one interval."""

    @model_validator(mode="after")
    def _by_name_or_by_options(self) -> CalibrationTable:
        plain = (self.offset, self.with_variables, self.from_reference)
        if self.type is not None and any(option is not None for option in plain):
            raise PydanticCustomError(
                "type_twice", "type stands for offset, with_variables and from_reference; give the one or the others"
            )
        types = (GENERATIVE, *ESTIMATION_TYPES)
        if self.type is not None and self.type not in types:
            message = f"no estimation type is called {self.type!r}; {known_names(self.type, types)}"
            raise PydanticCustomError("type_name", "{message}", {"message": message})
        if self.with_variables is False and self.from_reference:
            raise PydanticCustomError("no_variables", "from_reference belongs to with_variables = true")
        if self.type == GENERATIVE and "lambda_counts2" in self.model_fields_set:
            raise PydanticCustomError("generative_lambda", "the generative model has no lambda; leave it out")
        if self.nonlinear and not self.generative:
            raise PydanticCustomError(
                "linear_type", "nonlinear belongs to the generative model; leave it out, or type, offset and lambda"
            )
        return self

    @property
    def generative(self) -> bool:
        """Whether the generative model is asked for: nothing of a thesis' type is."""
        of_thesis = {"lambda_counts2", "offset", "from_reference"} & self.model_fields_set
        return self.type == GENERATIVE or (self.type is None and not of_thesis)


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
