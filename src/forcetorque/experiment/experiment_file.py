# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file: what was recorded, with which robot and sensors, and which interval is for what."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, lru_cache
from pathlib import Path
from typing import Annotated, Any, Final, Literal, TypeVar, cast

import numpy as np
from pydantic import Field, create_model, model_validator

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import require_file
from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text, read_toml
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.experiment.calibration.robot_model_error import ModelTolerance, MountTolerance
from forcetorque.experiment.experiment_file_tables import (
    CalibrationTable,
    ClockTable,
    ProcessingTable,
    Sensor,
    SixPositive,
    TransformTable,
)
from forcetorque.experiment.section import Section, sections
from forcetorque.formats.registry import AnyLog, format_name, recognised_format
from forcetorque.recording.recording import Use
from forcetorque.robot.contacts import ContactType

_TOLERANCE: Final = ModelTolerance()


class MountToleranceTable(Table):
    """How far the frame of one sensor may be from that of the robot model, as standard deviations."""

    mount_deg: NotNegative | None = None
    """Of its rotation about each axis; deg."""
    mount_m: NotNegative | None = None
    """Of the shift of its origin along each axis; m."""

    def mount_tolerance(self) -> MountTolerance:
        """Give the same in SI units."""
        rotation = None if self.mount_deg is None else float(np.radians(self.mount_deg))
        return MountTolerance(rotation_rad=rotation, shift_m=self.mount_m)


class Tolerance(MountToleranceTable):
    """How far the robot model may be from the robot, as standard deviations; 0 for what is exact."""

    mass_relative: NotNegative = _TOLERANCE.mass
    """Of the mass of every link, relative."""
    centre_m: NotNegative = _TOLERANCE.centre_m
    """Of every coordinate of the centre of mass of every link; m."""
    joint_zero_deg: NotNegative = float(np.degrees(_TOLERANCE.joint_zero_rad))
    """Of the zero of every joint; deg; of a joint that slides 0.0175 m for each."""
    tilt_deg: NotNegative = float(np.degrees(_TOLERANCE.acceleration / STANDARD_GRAVITY))
    """Of gravity in the support frame, or of what an accelerometer reads, along each axis, as a tilt; deg."""
    delay_s: NotNegative = _TOLERANCE.delay_s
    """Of the time by which the readings come later than the joints; s."""
    cable_N_rad: NotNegative | None = None
    """Of what cables and covers add to the load per rad of each joint near the sensor, along each axis; N/rad; of their
    moment as much over 0.05 m. If left out 1, or 0 where the model is exact in all else."""
    links: dict[Text, NotNegative] = {}
    """Of the mass of single links, relative, by their names."""
    joints: dict[Text, NotNegative] = {}
    """Of the zero of single joints, by their names; deg."""
    sensors: dict[Text, MountToleranceTable] = {}
    """Of the mounts of single sensors, by their names."""
    found_by: Path | None = Field(default=None, alias="from")
    """A calibration, or joint.json of a joint one: the model is corrected by what it found of masses, centres and joint
    zeros, and the standard errors of these are their tolerances."""

    def model_tolerance(self, found: Mapping[str, float]) -> ModelTolerance:
        """Give the same in SI units.

        Args:
            found: Standard errors of what an earlier calibration found, by the names of the errors.

        Returns:
            The tolerance.
        """
        others = self.mass_relative, self.centre_m, self.joint_zero_deg, self.tilt_deg, self.delay_s
        usual = _TOLERANCE.cable_N_rad if any(others) else 0.0
        return ModelTolerance(
            mass=self.mass_relative,
            centre_m=self.centre_m,
            joint_zero_rad=float(np.radians(self.joint_zero_deg)),
            acceleration=STANDARD_GRAVITY * float(np.radians(self.tilt_deg)),
            delay_s=self.delay_s,
            cable_N_rad=usual if self.cable_N_rad is None else self.cable_N_rad,
            links=dict(self.links),
            joints={name: float(np.radians(value)) for name, value in self.joints.items()},
            mounts={name: one.mount_tolerance() for name, one in self.sensors.items()},
            mount=self.mount_tolerance(),
            found=found,
        )


class Robot(Table):
    """The robot model."""

    urdf: Path
    """URDF file, or the name of an installed robot (extras `robots`, `icub`), such as `ur5`; a file that exists comes
    first."""
    fixed: dict[Text, Finite] = {}
    """Joints that nobody logged and that stand still all along, by name: rad, or m where prismatic."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""
    tolerance: Tolerance | Literal["exact"] = Tolerance()
    """How far the model may be from the robot; "exact" for a simulated robot, or one that was measured part by part."""


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
            raise ValueError("a support needs gravity_direction if it is at rest, or imu if the robot moves")
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
            raise ValueError("direction is for type force_along, which needs it")
        if (self.stream is not None) != (self.type is ContactType.KNOWN):
            raise ValueError("stream is for type known, which needs it")
        if self.type is ContactType.KNOWN and self.position_m is not None:
            raise ValueError("the wrench of a known contact is about the origin of its frame")
        return self


EACH_FILE = "{file}"
"""What stands for the name of a file in the label of an interval."""


class Interval(Table):
    """A span of the recording."""

    label: Text
    """Name of the interval; with `files`, `{file}` in it stands for the name of each file without its ending."""
    files: Text | None = None
    """Stream of several files, such as `file = "raw/*.csv"`: the interval is made for each of them."""
    start_s: Finite
    """Start; s from the earliest stamp over all streams; with `files` from the first sample of each, 0 if left out."""
    end_s: Finite | None = None
    """End, itself excluded; s from the same; the end of the log, or of the file, if left out."""
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
    contact_links: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """In place of a support: links that the world touches, nobody knows how, while the IMU of the recording tells how
    the robot moves."""

    @model_validator(mode="before")
    @classmethod
    def _from_the_start_of_files(cls, value: Any) -> Any:
        return {"start_s": 0.0, **value} if isinstance(value, dict) and value.get("files") is not None else value

    @model_validator(mode="after")
    def _label_of_files(self) -> Interval:
        if self.files is not None and EACH_FILE not in self.label:
            raise ValueError(f'expected "{EACH_FILE}" in the label of an interval with files')
        return self

    @model_validator(mode="after")
    def _support_or_contact_links(self) -> Interval:
        if self.support is not None and self.contact_links is not None:
            raise ValueError(
                "expected support or contact_links, got both; other links than the support are [[contact]]"
            )
        return self


Content = TypeVar("Content")


class ExperimentFile(Table):
    """The whole file."""

    schema_name: Literal["forcetorque/experiment/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the experiment."""
    robot: Robot | None = None
    """The robot model; a wrist sensor may have `load` instead."""
    recording: AnyLog
    """Where the recording is."""
    clock: tuple[ClockTable, ...] = ()
    """Streams whose clock differs from that of others."""
    transform: tuple[TransformTable, ...] = ()
    """Wrenches that the log gives in another frame than the sensor's."""
    sensor: Annotated[tuple[Sensor, ...], Field(min_length=1)] = ()
    """Sensors; may be left out where the file is about skin alone."""
    support: tuple[Support, ...] = ()
    """Support frames; none with `load` in place of a robot."""
    interval: Annotated[tuple[Interval, ...], Field(min_length=1)]
    """Intervals."""
    contact: tuple[Contact, ...] = ()
    """Contacts beside the support; without any, whatever touches a sub-model is given at its sensor."""
    processing: ProcessingTable = ProcessingTable()
    """How samples are processed."""
    calibration: CalibrationTable = CalibrationTable()
    """How the fit is regularised."""

    @model_validator(mode="after")
    def _sections_fit(self) -> ExperimentFile:
        for section in sections():
            section.check(self.table(section), self)
        return self

    @property
    def loaded_links(self) -> frozenset[str]:
        """Links, or the frame of a sensor in place of a robot, that carry a load."""
        return frozenset(link for one in sections() for link in one.loaded_links(self.table(one)))

    def table(self, section: Section[Content, Any]) -> Content:
        """Give the table of a section.

        Returns:
            What the file says, or the default.
        """
        return cast(Content, getattr(self, section.key))


@cache
def experiment_file() -> type[ExperimentFile]:
    """Make the form of the file: its core tables, and the sections of all capabilities.

    Returns:
        The model.
    """
    return create_model("ExperimentFile", __base__=ExperimentFile, __doc__=ExperimentFile.__doc__, **section_fields())


def section_fields(*, of_plan: bool = False) -> dict[str, Any]:
    """Give the fields of sections, for `pydantic.create_model`.

    Args:
        of_plan: Whether only those are wanted that a file may have before anything is recorded.

    Returns:
        Annotation and default by key.
    """
    return {
        section.key: (section.type, Field(default=section.default, description=section.description))
        for section in sections()
        if section.of_plan or not of_plan
    }


def parse_experiment(path: Path | str) -> ExperimentFile:
    """Read and check an experiment file, without opening what it points to.

    A file that was parsed before is not parsed again as long as it has the same content.

    Args:
        path: TOML file.

    Returns:
        Its content.

    Raises:
        FormatError: If it is a log.
    """
    file = Path(path)
    is_other = file.suffix.lower() != ".toml" and file.exists()
    if is_other and (log := recognised_format(file)) is not None:
        raise FormatError(
            f"{file}: expected an experiment file, got a log of the format {format_name(log)}; `forcetorque init "
            f"{file}` begins an experiment file"
        )
    content = b""
    if file.is_file():
        require_file(file, "an experiment file")  # also of a file that was parsed before: it is an input of this run
        content = file.read_bytes()
    return _parsed(file, content)


@lru_cache(maxsize=256)  # commands that take many files check all of them before they read the first log
def _parsed(file: Path, _content: bytes) -> ExperimentFile:
    return read_toml(file, experiment_file(), what="an experiment file")
