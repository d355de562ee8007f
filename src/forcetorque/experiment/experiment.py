# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file points to, read and checked."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Protocol, TypeVar, cast

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.experiment.calibration.estimation_type import EstimationType, OffsetStrategy
from forcetorque.experiment.calibration.expected_sensor_errors import REPEATABILITY
from forcetorque.experiment.calibration.robot_model_error import EXACT, ModelTolerance
from forcetorque.experiment.calibration.sensor_model import LinearVariable, component_names, measured_part
from forcetorque.experiment.named_files import path_endings, recording_name
from forcetorque.experiment.section import Section
from forcetorque.experiment.sensor_mount import SensorMount, with_mount
from forcetorque.recording.frozen_and_saturated_samples import SampleQuality
from forcetorque.recording.named_columns import ScalarSource
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support, Use
from forcetorque.recording.shared_filters import SharedFilters
from forcetorque.recording.stream import Stream
from forcetorque.robot.contacts import Contact
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, robot_motion_at
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion

Content = TypeVar("Content")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorVariable:
    """A linear variable of a sensor and where its values come from."""

    linear: LinearVariable
    """Name, unit, reference value and prior coefficients."""
    source: ScalarSource
    """Its column in the recording."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FitOptions:
    """Estimator as the file specifies it; what it leaves open depends on the sensor."""

    generative: bool = True
    """Whether the generative model is fitted, and not a type of the thesis."""
    accuracy: FloatArray | None = None
    """Accuracy of the reference; shape (6,); N, N m; None for 1e-3 of full scale."""
    repeatability: float = REPEATABILITY
    """Share of its response by which a sensor differs from one motion to the next."""
    drift: bool = False
    """Whether the offset of a session may move evenly in time."""
    nonlinear: bool = False
    """Whether quadratic terms may correct readings, where they win on recordings that were not fitted."""
    tolerance: ModelTolerance = EXACT
    """How far the robot model may be from the robot."""

    offset: OffsetStrategy = OffsetStrategy.ONE_SHOT
    """How the offset is found."""
    with_variables: bool | None = None
    """Whether variables are fitted; None for where the sensor has any."""
    from_reference: bool | None = None
    """Whether they count from their reference value; None for yes."""
    regularisation: float | None = None
    """Lambda; counts2; None to choose it on held-out blocks."""
    sphere_intervals: tuple[str, ...] | None = None
    """Labels of the intervals that give the offset of the sphere types."""

    def kind(self, *, has_variables: bool) -> EstimationType:
        """Settle the estimation type for a sensor.

        Args:
            has_variables: Whether the sensor has linear variables.

        Returns:
            The type.
        """
        used = has_variables if self.with_variables is None else self.with_variables
        counted = used if self.from_reference is None else self.from_reference and used
        return EstimationType(offset=self.offset, with_variables=used, from_reference=counted)


@dataclass(frozen=True, slots=True, kw_only=True)
class Role:
    """What an interval is to a study."""

    kind: str
    """Kind of motion."""
    session: str | None
    """Stretch of time in which nothing was switched off; None where the file names none: the recording is one."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExperimentSensor:
    """A sensor of the experiment, matched to the robot and to a stream."""

    name: str
    """Name in the robot model."""
    serial: str
    """Serial number."""
    stream: str
    """Stream that holds its reading."""
    quantity: str
    """`raw` or `wrench`."""
    prior: FloatArray | None
    """Prior matrix; shape (6, c); N/count, N m/count."""
    prior_source: str | None
    """Its file, as the experiment names it; `identity` where the reading itself takes the place of counts."""
    limit_counts: float
    """Largest magnitude of a raw reading; counts."""
    full_scale: FloatArray | None = None
    """Full scale per component, as the file specifies it; shape (6,); N, N m."""
    prior_deviation: FloatArray | None = None
    """Standard deviation of readings of full scale by the prior matrix, as the file states it; shape (6,); N, N m."""
    measurement_noise: FloatArray | None = None
    """Standard deviation of a reading from sample to sample, as the file specifies it; shape (6,); N, N m."""
    measurement_offset_sd: FloatArray | None = None
    """Standard deviation of what a reading is off all along, as the file specifies it; shape (6,); N, N m."""
    amplifier_gain: tuple[float, ...] | None = None
    """Gain of each channel's amplifier while it was recorded; None if it is not known."""
    allowed_gains: tuple[float, ...] | None = None
    """Gains that its amplifiers can be set to; None if they are not known."""
    variables: tuple[SensorVariable, ...] = ()
    """Linear variables that may be fitted with the matrix."""
    mount_is_unknown: bool = False
    """Whether its mount is to be estimated."""
    measured: BoolArray = field(default_factory=lambda: np.ones(6, dtype=np.bool_))
    """Which components of a wrench it measures; shape (6,)."""

    def require_six_components(self, what: str) -> None:
        """Refuse a sensor that measures fewer components than something needs.

        Args:
            what: What needs all six, as the subject of a message.

        Raises:
            ExperimentError: If it measures fewer.
        """
        if not self.measured.all():
            raise ExperimentError(
                f"sensor {self.name!r}: {what} expects a sensor of six components, this one measures "
                f"{component_names(self.measured)}"
            )

    def expected_reading(self, load: FloatArray) -> FloatArray:
        """Give what a sensor without error reads.

        Args:
            load: Wrenches; shape (..., 6); N, N m.

        Returns:
            The same, with zeros for components that it does not measure.
        """
        return measured_part(load, self.measured)

    def variable(self, name: str) -> SensorVariable:
        """Find a linear variable of the sensor.

        Returns:
            The variable.

        Raises:
            ExperimentError: If the experiment specifies none of that name for the sensor.
        """
        for variable in self.variables:
            if variable.linear.name == name:
                return variable
        known = ", ".join(variable.linear.name for variable in self.variables) or "none"
        raise ExperimentError(
            f"sensor {self.name!r}: expected the variable {name!r}, the experiment specifies {known}; "
            "add it as [[sensor.variable]]"
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExperimentContact:
    """A place where the world may touch the robot beside the support."""

    contact: Contact
    """The contact."""
    stream: str | None = None
    """Stream with the wrench of a known contact."""
    intervals: tuple[str, ...] | None = None
    """Labels of the intervals in which it may touch; None for all."""
    noise: FloatArray | None = None
    """Standard deviation of a known wrench from sample to sample, as the file specifies it; shape (6,); N, N m."""
    deviation: FloatArray | None = None
    """Standard deviation of what a known wrench is off all along, as the file specifies it; shape (6,); N, N m."""


class AttachedLoads(Protocol):
    """What hangs on a wrist sensor or on links of a robot, as the section `load` of the file says."""

    @property
    def in_place_of_robot(self) -> bool:
        """Whether the load stands in for a robot."""

    @property
    def applied(self) -> str | None:
        """Stream of the wrench that the sensor must read; None where that follows from motion and mass."""

    @property
    def are_stated(self) -> bool:
        """Whether nothing of any load is to be estimated."""

    def circular(self, serial: str) -> Iterator[str]:
        """Name loads that a sensor identified before by itself, as if its matrix were right.

        Args:
            serial: Serial number of the sensor.

        Yields:
            A sentence for every load beside which nothing was stated then that would have told the scale of the matrix.
        """

    def nominal_model(self, stated: RobotModel) -> RobotModel:
        """Give the robot with a load that moves the reading as the specified one does, or as any load would.

        Args:
            stated: The robot with the load as the file specifies it.

        Returns:
            The robot.
        """

    def model_on(self, support: Support | MovingSupport, experiment: Experiment) -> RobotModel:
        """Give the robot with the load of an interval.

        Args:
            support: Support of the interval.
            experiment: The experiment.

        Returns:
            The robot.

        Raises:
            ExperimentError: If the recording does not determine the load.
        """

    def pooled(self, experiments: Mapping[str, Experiment]) -> Mapping[str, Experiment]:
        """Let recordings of one sensor identify their loads together.

        Args:
            experiments: Experiments by the names of their recordings.

        Returns:
            The same; those whose loads are to be estimated share what is estimated.

        Raises:
            ExperimentError: If files say different things of a load.
        """


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Experiment:
    """Everything that an experiment file points to."""

    name: str
    """Name of the experiment."""
    file: Path
    """Its file."""
    model: RobotModel
    """The robot."""
    recording: Recording
    """What was measured, with the file's intervals."""
    sensors: tuple[ExperimentSensor, ...]
    """Sensors in the order of the file."""
    contacts: tuple[ExperimentContact, ...]
    """Contacts beside the support."""
    processing: Processing
    """Filters and gravity."""
    fit_options: FitOptions
    """How sensors are fitted."""
    roles: Mapping[str, Role]
    """What each interval is to a study, by label."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment names it."""
    log_sha256: frozenset[str] = frozenset()
    """SHA-256 of the files of the recording, by which it is known under another experiment's name."""
    supports: tuple[Support, ...] = ()
    """Supports at rest that the file states, used or not."""
    sections: Mapping[str, Any] = field(default_factory=dict)
    """Contents of the sections that capabilities register, by key; `section` gives one."""
    mounts: Mapping[str, SensorMount] = field(default_factory=dict)
    """Mounts of sensors that sit otherwise than the robot model states, stated or estimated, by name."""
    qualities: dict[str, SampleQuality] = field(default_factory=dict, init=False)
    """What is wrong with the samples of every sensor that was read, by its name; filled by `sample_quality`."""
    inspections: dict[Hashable, Any] = field(default_factory=dict, init=False)
    """Findings on streams and sensors, by what was compared; filled by `inspect_experiment`."""

    def __repr__(self) -> str:
        sensors = ", ".join(f"{sensor.name} ({sensor.serial})" for sensor in self.sensors)
        intervals = ", ".join(f"{one.label!r} {one.use}" for one in self.recording.intervals)
        what = f"{self.model.name}; sensors {sensors}; {intervals or 'no intervals'}"
        return f"<Experiment {self.name!r}: {what}>"

    def section(self, section: Section[Any, Content]) -> Content:
        """Give the content of a section of the file.

        Returns:
            What was read of it; what stands for none where the file does not have it.
        """
        return cast(Content, self.sections.get(section.key, section.empty))

    def with_loads(self, loads: AttachedLoads) -> Experiment:
        """Give the experiment with other loads.

        Args:
            loads: What hangs on the sensor or on links.

        Returns:
            The experiment; nothing else of it changes.
        """
        return replace(self, sections={**self.sections, "load": loads})

    @property
    def loads(self) -> AttachedLoads | None:
        """What hangs on the sensor or on links, by the section `load`."""
        return self.sections.get("load")

    @property
    def stands(self) -> bool:
        """Whether a robot stands on a support at rest, so that its joints can be moved as planned."""
        return bool(self.supports) and not (self.loads is not None and self.loads.in_place_of_robot)

    def model_on(self, support: Support | MovingSupport) -> RobotModel:
        """Give the robot as it stands on a support, with the payloads of a wrist sensor or of its links.

        A load that the file does not specify is estimated when it is first needed, and once.

        Args:
            support: Support of an interval.

        Returns:
            The robot.

        Raises:
            ExperimentError: If the recording does not determine a load that is to be estimated.
        """
        return self.mounted(self.model if self.loads is None else self.loads.model_on(support, self))

    def motion_at(
        self,
        support: Support | MovingSupport,
        joints: Sequence[str],
        source: Stream,
        at_ns: IntArray,
        *,
        filters: SharedFilters | None = None,
        overlap_checked: bool = False,
    ) -> tuple[JointMotion, RootMotion]:
        """Give the motion of joints and support at instants of a stream, as of `LoggedRobot`.

        Args:
            support: The support.
            joints: Joints whose motion is wanted.
            source: Stream that the instants are of.
            at_ns: Instants; shape (n,); ns.
            filters: As of `LoggedJoints`.
            overlap_checked: As of `LoggedRobot`.

        Returns:
            Motion of the joints, and of those between an IMU and the support; motion of the support frame.
        """
        return robot_motion_at(
            self.recording,
            self.model,
            support,
            joints,
            source,
            at_ns,
            processing=self.processing,
            filters=filters,
            overlap_checked=overlap_checked,
        )

    def mounted(self, model: RobotModel) -> RobotModel:
        """Put the sensors of a robot where they are mounted.

        Args:
            model: The robot, with loads or without.

        Returns:
            The robot; the same where the file states no mount and none was estimated.
        """
        for name, mount in self.mounts.items():
            model = with_mount(model, name, mount)
        return model

    def sensor(self, name: str) -> ExperimentSensor:
        """Find a sensor of the experiment.

        Args:
            name: Its name, or another one that the robot model has for it.

        Returns:
            The sensor.

        Raises:
            ExperimentError: If the experiment has none of that name.
        """
        for sensor in self.sensors:
            if name in (sensor.name, *self.model.sensor(sensor.name).aliases):
                return sensor
        raise ExperimentError(
            f"experiment {self.name!r} has no sensor {name!r}; {known_names(name, (s.name for s in self.sensors))}"
        )

    def session_names(self, label: str | None) -> tuple[str, ...]:
        """Give the names under which a calibration may know the session of an interval.

        Args:
            label: Label of the interval; None for what lies in none.

        Returns:
            The session that the file specifies; else the name of the recording, with as much of the path of its file as
            told several recordings of that name apart, longest first, and by itself.
        """
        role = None if label is None else self.roles.get(label)
        if role is not None and role.session is not None:
            return (role.session,)
        return (*(recording_name(self.name, path) for path in reversed(path_endings(self.file))), self.name)

    def intervals(self, use: Use) -> tuple[Interval, ...]:
        """Give the intervals of one use.

        Returns:
            Intervals in the order of the file.

        Raises:
            ExperimentError: If there is none.
        """
        chosen = tuple(interval for interval in self.recording.intervals if interval.use is use)
        if not chosen:
            raise ExperimentError(f'experiment {self.name!r}: expected an interval with use = "{use}", it has none')
        return chosen
