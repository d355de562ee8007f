# SPDX-License-Identifier: BSD-3-Clause
"""Core tables of the experiment file: sensors with their priors, filters, derivatives, clocks, frames, and the fit."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Discriminator, Field, Tag, WithJsonSchema, model_validator

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import known_names
from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text, one_for_each, word_or_table
from forcetorque.base.wrench import WRENCH_COMPONENTS, MeasureDirection
from forcetorque.experiment.calibration.calibration_file import GENERATIVE
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, OffsetStrategy
from forcetorque.experiment.calibration.expected_sensor_errors import REPEATABILITY
from forcetorque.experiment.experiment import FitOptions
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing
from forcetorque.robot.model import SensorFrame

_AXES = 6

Component = Literal["fx", "fy", "fz", "tx", "ty", "tz"]
"""A component of a wrench."""


def _of_six_axes(values: Any) -> Any:
    if isinstance(values, list | tuple) and len(values) != _AXES:
        raise ValueError("expected six numbers, of fx, fy, fz in N and of tx, ty, tz in N m")
    return values


SixPositive = Annotated[tuple[Positive, ...], Field(min_length=_AXES, max_length=_AXES), BeforeValidator(_of_six_axes)]
"""Of forces in N, then of moments in N m."""


def _one_of_all(value: Any) -> Any:
    return one_for_each(value, _AXES)


_ONE_OR_SIX = WithJsonSchema(
    {
        "anyOf": [
            {"type": "number", "exclusiveMinimum": 0},
            {
                "type": "array",
                "items": {"type": "number", "exclusiveMinimum": 0},
                "minItems": _AXES,
                "maxItems": _AXES,
            },
        ]
    }
)

FullScale = Annotated[SixPositive, BeforeValidator(_one_of_all), _ONE_OR_SIX]
"""Full scale of fx, fy, fz in N and of tx, ty, tz in N m; one number where all are the same."""


def _percent_of_six(value: Any) -> Any:
    values = _one_of_all(value)
    if isinstance(values, list | tuple) and len(values) != _AXES:
        raise ValueError("expected one number, or six of fx, fy, fz, tx, ty, tz, percent of the full scale")
    return values


SixPercent = Annotated[tuple[Positive, ...], BeforeValidator(_percent_of_six), _ONE_OR_SIX]
"""Percent of the full scale of each component; one number where all are the same."""


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


class MountTable(Table):
    """Pose of a sensor in the frame that the robot model states for it."""

    rotation_deg: Annotated[FloatArray, ArrayField((3,))]
    """Rotation vector that turns the stated axes into those of the sensor; deg."""
    shift_mm: Annotated[FloatArray, ArrayField((3,))]
    """Origin of the sensor in the stated frame; mm."""


def _mount_kind(value: Any) -> str:
    return "word" if isinstance(value, str) else "table"


def require_component_order(components: Sequence[str] | None) -> None:
    """Refuse components that are named twice, or in another order than fx to tz.

    Args:
        components: Their names; None for all six.

    Raises:
        ValueError: If so.
    """
    if components is not None and list(components) != [name for name in WRENCH_COMPONENTS if name in components]:
        raise ValueError("components: expected each once, in the order fx to tz")


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
            Discriminator(word_or_table),
        ]
        | None
    ) = None
    """File of the calibration that the sensor came with, and whose counts a calibrated stream recovers: a matrix file
    of iCub, .dat of FirmwareUpdater, .cal of ATI, or a plain table; `identity` if that matrix is not known: the
    calibrated reading then takes the place of counts."""
    components: Annotated[tuple[Component, ...], Field(min_length=1)] | None = None
    """Components that the sensor measures, such as `["fz"]` of a load cell; all six if left out."""
    limit_counts: Positive = 32767.0
    """Largest magnitude of a raw reading; counts."""
    full_scale: FullScale | None = None
    """Full scale of fx, fy, fz, tx, ty, tz, or one number for all; N, N m; needed with the prior `identity`, which says
    nothing of sizes, and with `components`: the largest loads, by which the cross-talk of those that are not measured
    is sized."""
    prior_uncertainty_percent: SixPercent | None = None
    """95 % uncertainty of a reading by the prior matrix, as a certificate states it: percent of the full scale of each
    component, or one number for all; needs `full_scale`. If left out coefficients are expected to be 6 % off."""
    measurement_noise: SixPositive | None = None
    """Standard deviation by which a reading differs from sample to sample; N, N m; for `estimate --fuse`."""
    measurement_offset_sd: SixPositive | None = None
    """Standard deviation of what a reading is off all along, such as by its offset; N, N m; for `estimate --fuse`."""
    amplifier_gain: Annotated[tuple[Positive, ...], Field(min_length=1)] | None = None
    """Gain of the amplifier of each channel while it was recorded, for `forcetorque bench gains`."""
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
    mount: (
        Annotated[
            Annotated[MountTable, Tag("table")] | Annotated[Literal["unknown"], Tag("word")],
            Discriminator(_mount_kind),
        ]
        | None
    ) = None
    """Where the sensor sits otherwise than the robot model states: its pose, or `unknown` to estimate it before the
    fit."""

    @model_validator(mode="after")
    def _untagged_is_complete(self) -> Sensor:
        if self.joint is None and (self.measure_direction or self.frame):
            raise ValueError("measure_direction and frame are for a sensor without a URDF tag, which also needs joint")
        if self.joint is not None and self.measure_direction is None:
            raise ValueError(
                "a sensor without a URDF tag needs measure_direction, child_to_parent or parent_to_child; "
                "it is never guessed"
            )
        return self

    @model_validator(mode="before")
    @classmethod
    def _one_full_scale_needs_six_components(cls, content: Any) -> Any:
        if isinstance(content, dict) and isinstance(content.get("full_scale"), int | float):
            components = content.get("components")
            if isinstance(components, list | tuple) and len(components) < _AXES:
                raise ValueError(
                    "full_scale: expected a number for each of fx, fy, fz, tx, ty, tz with fewer than six components, "
                    "got one for newtons and newton metres"
                )
        return content

    @model_validator(mode="after")
    def _fewer_components_are_complete(self) -> Sensor:
        require_component_order(self.components)
        if self.components is None:
            return self
        if len(self.components) < _AXES and (self.full_scale is None or self.prior is None):
            raise ValueError(
                "fewer than six components need prior, and full_scale of all six: loads that are not measured disturb "
                "those that are in proportion to it"
            )
        return self

    @model_validator(mode="after")
    def _uncertainty_is_of_a_prior(self) -> Sensor:
        if self.prior_uncertainty_percent is not None and (self.prior is None or self.components is not None):
            raise ValueError(
                "prior_uncertainty_percent needs prior, of which it states the uncertainty, and a sensor of all six "
                "components"
            )
        return self

    @model_validator(mode="after")
    def _allowed_gains_need_the_present_ones(self) -> Sensor:
        if self.allowed_gains is not None and self.amplifier_gain is None:
            raise ValueError("allowed_gains needs amplifier_gain, the gains with which the recording was made")
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
        Discriminator(word_or_table),
    ] = Smoothing(window_s=0.3, order=3)
    """Filter that differentiates joint positions and orientations, or `logged` to take velocity and acceleration from
    the log; if left out, it holds five samples of a stream below 10 Hz."""
    smoothing: Smoothing | None = None
    """Filter of reading and reference alike inside each interval, against vibration; none if left out."""
    keep: tuple[Literal["frozen", "saturated", "repeated", "joint_jumps", "glitches", "disagreeing"], ...] = ()
    """What is used although it is left out by default: samples of a reading that does not change for long, or at the
    limit of the converter; samples that repeat the reading before under a new stamp; turns and wrong rows of joints;
    single values of a variable that are nowhere near its others; seconds in which readings disagree with all others, as
    if the robot was touched."""


class PoseTable(Table):
    """Where a frame is in another, as `<origin>` of a URDF specifies it."""

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
            raise ValueError("expected orientation, a stream, or pose, where it does not change: one of them")
        if self.pose is not None and (self.moment_about == "own_frame") != (self.pose.position_m is not None):
            raise ValueError(
                'position_m of pose is needed where moment_about = "own_frame", and moves nothing elsewhere'
            )
        if (self.moment_about == "point") != (self.point_m is not None):
            raise ValueError('point_m is needed where moment_about = "point", and moves nothing elsewhere')
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
            raise ValueError(
                "expected to, another stream, got the same one; for columns of one table list two [[recording.stream]] "
                "with the same file"
            )
        estimated = self.delay_s == "estimate"
        if self.drift == "estimate" and not estimated:
            raise ValueError('drift = "estimate" needs delay_s = "estimate"')
        if estimated and self.drift not in ("estimate", 0.0):
            raise ValueError(
                'with delay_s = "estimate" drift is left out, or "estimate": a specified one needs a specified delay'
            )
        if not estimated and (self.around_s is not None or self.within_s is not None):
            raise ValueError('around_s and within_s are for delay_s = "estimate"')
        return self

    @property
    def streams(self) -> tuple[str, ...]:
        """Streams that are brought to the clock."""
        return (self.stream,) if isinstance(self.stream, str) else self.stream

    @property
    def near_s(self) -> float:
        """The specified delay, or the one around which it is looked for; s."""
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
        if derivatives == "logged" or "derivatives" not in table.model_fields_set
        else SavitzkyGolay(window_s=derivatives.window_s, order=derivatives.order),
        logged_derivatives=derivatives == "logged",
        smoothing=None if smoothing is None else SavitzkyGolay(window_s=smoothing.window_s, order=smoothing.order),
        gravity=gravity,
        keep=frozenset(table.keep),
    )


def _lambda(value: Any) -> Any:
    if isinstance(value, str) and value != "held-out":
        raise ValueError("expected a number of at least 0 counts2 or `held-out`")
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
            raise ValueError("type stands for offset, with_variables and from_reference; give the one or the others")
        types = (GENERATIVE, *ESTIMATION_TYPES)
        if self.type is not None and self.type not in types:
            raise ValueError(f"no estimation type is called {self.type!r}; {known_names(self.type, types)}")
        if self.with_variables is False and self.from_reference:
            raise ValueError("from_reference belongs to with_variables = true")
        if self.type == GENERATIVE and "lambda_counts2" in self.model_fields_set:
            raise ValueError("the generative model has no lambda; leave it out")
        if self.nonlinear and not self.generative:
            raise ValueError("nonlinear belongs to the generative model; leave it out, or type, offset and lambda")
        return self

    @property
    def generative(self) -> bool:
        """Whether the generative model is asked for: nothing of a thesis' type is."""
        of_thesis = {"lambda_counts2", "offset", "from_reference"} & self.model_fields_set
        return self.type == GENERATIVE or (self.type is None and not of_thesis)


def fit_options(table: CalibrationTable) -> FitOptions:
    """Settle the estimator.

    Args:
        table: What the file says.

    Returns:
        The estimator, as far as the file settles it.
    """
    if table.type in ESTIMATION_TYPES:
        kind = ESTIMATION_TYPES[table.type]
        return FitOptions(
            generative=False,
            offset=kind.offset,
            with_variables=kind.with_variables,
            from_reference=kind.from_reference,
            regularisation=table.lambda_counts2,
        )
    accuracy = table.accuracy
    return FitOptions(
        generative=table.generative,
        accuracy=None if accuracy is None else np.repeat([accuracy.force_N, accuracy.moment_Nm], 3),
        repeatability=table.repeatability,
        drift=table.drift,
        nonlinear=table.nonlinear,
        offset=table.offset or OffsetStrategy.ONE_SHOT,
        with_variables=table.with_variables,
        from_reference=table.from_reference,
        regularisation=table.lambda_counts2,
    )
