# SPDX-License-Identifier: BSD-3-Clause
"""The scenario file: a robot, its sensors and their errors, what is recorded; and the files of the library."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import ForceTorqueError, known_names
from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.recording.recording import Use
from forcetorque.simulation.motions.contact_switching import STILL_S
from forcetorque.simulation.motions.movement import MovementKind
from forcetorque.simulation.motions.on_both_feet import INTERNAL_FORCE_N


class WorkbenchError(Table):
    """How much the workbench matrix of one mounted sensor errs; the other sensors stay as they are drawn.

    Means of the absolute error over all recordings with `use = "validation"`, on the true loads, with an offset
    for each recording that leaves no mean error. What mounting does to the sensor is scaled to that.
    """

    sensor: Text
    """The sensor."""
    mean_force_N: Annotated[tuple[NotNegative, ...], Field(min_length=3, max_length=3)]
    """Of f_x, f_y and f_z; N."""
    mean_moment_Nm: Annotated[tuple[NotNegative, ...], Field(min_length=3, max_length=3)]
    """Of tau_x, tau_y and tau_z; N m."""

    @property
    def mean_absolute(self) -> tuple[float, ...]:
        """All six; N, N m."""
        return self.mean_force_N + self.mean_moment_Nm


class MatrixErrorSize(Table):
    """How wrong the workbench matrix of every mounted sensor is, in place of all that mounting does.

    It reads a true wrench w as `(1 + E) w`; E is drawn for each sensor, and has this size for each.
    """

    share: Annotated[float, Field(ge=0.0, lt=1.0, strict=True)]
    """Root mean square of the coefficients of E, moments over the lever taken for forces."""
    lever_m: Positive = 0.07
    """Moment over force, about that of the mean errors in thesis Table 5.7; m."""


class Sensors(Table):
    """What every sensor is made of; figures of the spread between sensors are standard deviations."""

    seed: Annotated[int, Field(ge=0, strict=True)] | None = None
    """Seed of the sensors, of their offsets and noise; that of the scenario, which also moves the robot, if left
    out."""
    names: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """Sensors of the robot; all if left out."""
    family: Text = "standard"
    """Family that sensors are drawn from."""
    noise_counts: NotNegative = 3.0
    """White noise; counts."""
    noise_corner_hz: NotNegative = 0.0
    """Frequency below which 1/f noise prevails."""
    offset_counts: NotNegative = 3000.0
    """Spread of the offset of a channel between sensors."""
    power_up_counts: NotNegative = 100.0
    """Spread of its change from one power-up to the next."""
    drift_counts_per_degC: NotNegative = 0.0
    """Spread of the linear drift with temperature."""
    gradient_counts_per_degC: NotNegative = 0.0
    """Spread of the part with the difference between gauges."""
    hysteresis_counts_per_degC: NotNegative = 0.0
    """Spread of the part with hysteresis."""
    reference_degC: Finite = 25.0
    """Temperature without drift."""
    creep_share: Finite = 0.0
    """What creep adds in the end, relative to the load."""
    creep_time_s: Positive = 30.0
    """Time constant of creep."""
    crosstalk_counts: NotNegative = 0.0
    """Spread of the quadratic response at full scale."""
    screw_torque_Nm: Annotated[tuple[NotNegative, ...], Field(min_length=3)] = (2.0,) * 6
    """Torques of the screws around the rim, evenly spaced from the x axis on."""
    mounting_strength: NotNegative = 0.0
    """Relative change of an in-plane channel where the rim is tighter by 2 N m; even screws change nothing."""
    mounting_sd: NotNegative = 0.0
    """Random change of each coefficient that mounting adds, relative to its row."""
    step_counts: NotNegative = 1.0
    """Step of the converter; 0 for none."""
    limit_counts: Annotated[int, Field(gt=0, strict=True)] = 32767
    """Magnitude at which a channel is saturated."""
    workbench_error: WorkbenchError | None = None
    """How much the workbench matrix of one sensor errs; as it is drawn if left out."""
    matrix_error: MatrixErrorSize | None = None
    """Size of the error of every workbench matrix; what mounting makes of it if left out."""

    @model_validator(mode="after")
    def _one_error_of_the_matrix(self) -> Sensors:
        if self.matrix_error is not None and (
            self.mounting_sd or self.mounting_strength or self.workbench_error is not None
        ):
            raise ValueError(
                "matrix_error stands for all that mounting does; leave it out, or mounting_sd, mounting_strength "
                "and workbench_error"
            )
        return self


LINEAR_ONLY: Mapping[str, Any] = MappingProxyType(
    {
        "limit_counts": 10_000_000,
        "gradient_counts_per_degC": 0.0,
        "hysteresis_counts_per_degC": 0.0,
        "creep_share": 0.0,
        "crosstalk_counts": 0.0,
    }
)
"""Changes of `Sensors` after which a matrix, an offset per power-up and a coefficient of the temperature describe all
but
noise: nothing saturates, lags, creeps or is quadratic. Matrices, offsets and linear drift are drawn as without them."""


UNDISTURBED: Mapping[str, Any] = MappingProxyType(
    {**LINEAR_ONLY, "noise_counts": 0.0, "step_counts": 0.0, "drift_counts_per_degC": 0.0}
)
"""Changes of `Sensors` after which a matrix and an offset per power-up describe all."""


_Count = Annotated[int, Field(ge=0, strict=True)]


def _downwards() -> FloatArray:
    return np.array([0.0, 0.0, -1.0])


class Robot(Table):
    """The robot."""

    urdf: Path | None = None
    """URDF file, or the name of an installed robot."""
    model: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """`arm`, `biped`, or names of installed robots (extras `icub`, `robots`); the first that is installed."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""

    @model_validator(mode="after")
    def _one_of_two(self) -> Robot:
        if (self.urdf is None) == (self.model is None):
            raise ValueError("expected urdf, or model with a list of names")
        return self


class Load(Table):
    """A known mass that is added to a link."""

    link: Text
    """The link."""
    mass_kg: Positive
    """Mass."""
    centre_of_mass_m: Annotated[FloatArray, ArrayField((3,))]
    """Centre of mass in the link's frame."""


class RobotErrorSizes(Table):
    """How much the robot differs from its URDF, to which the experiment files point; standard deviations."""

    mass: NotNegative = 0.02
    """Relative difference of the mass of a link."""
    centre_m: NotNegative = 0.002
    """Every coordinate of the centre of mass of a link."""
    joint_zero_deg: NotNegative = 0.5
    """Zero of a rotary joint."""
    seed: _Count | None = None
    """Seed of the errors; that of the scenario, which also moves the robot, if left out."""


class Imu(Table):
    """An IMU, recorded as the stream `imu`; its biases are drawn once and hold in all recordings."""

    link: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Link in whose frame it reads; the first of these that the robot has."""
    accelerometer_bias: NotNegative = 0.0
    """Spread of the bias of each axis; m/s2."""
    accelerometer_noise: NotNegative = 0.0
    """White noise; m/s2."""
    gyroscope_bias: NotNegative = 0.0
    """Spread of the bias of each axis; rad/s."""
    gyroscope_noise: NotNegative = 0.0
    """White noise; rad/s."""


_NEEDS_IMU = (MovementKind.STEPPING, MovementKind.CONTACT_SWITCHING)
"""Motions in which the load of each foot is unknown at times."""


class Motion(Table):
    """What the robot does."""

    kind: MovementKind
    """Kind of movement."""
    sensor: Text | None = None
    """grid, z_torque: sensor whose limb moves."""
    swing: Text | None = None
    """balancing: link at the end of the leg that moves; contact_switching, standing, sway, squat, stepping: the other
    foot."""
    hook: Text | None = None
    """contact_switching: link that the robot hangs from before it stands; it does not hang if left out."""
    duration_s: Positive | None = None
    """random, standing, sway, squat, stepping: how long it takes."""
    speed: Positive = 0.5
    """Largest speed of any joint; rad/s or m/s."""
    postures: Annotated[int, Field(gt=1, strict=True)] | None = None
    """grid: steps of each joint; z_torque, balancing: number of postures; contact_switching: while it hangs, and each
    time that it stands on one foot."""
    hold_s: NotNegative = 0.0
    """grid, z_torque, balancing: rest at every posture."""
    still_s: Positive = STILL_S
    """contact_switching: rest before and after it moves, and on both feet each time."""
    slowest_hz: Positive = 0.1
    """random: about the frequency of the slowest sine."""
    placement: _Count = 0
    """contact_switching, standing, sway, squat, stepping: recordings of one number have their feet in the same places;
    0 has them below the hips."""
    internal_force_N: NotNegative = INTERNAL_FORCE_N
    """contact_switching, standing, sway, squat, stepping: how much the feet push against each other along each axis at
    most."""

    @model_validator(mode="after")
    def _has_what_it_needs(self) -> Motion:
        needed = {
            MovementKind.GRID: ("sensor",),
            MovementKind.Z_TORQUE: ("sensor",),
            MovementKind.BALANCING: ("swing",),
            MovementKind.CONTACT_SWITCHING: ("swing",),
            MovementKind.RANDOM: ("duration_s",),
        }.get(self.kind, ("swing", "duration_s"))
        for key in needed:
            if getattr(self, key) is None:
                raise ValueError(f"a {self.kind} motion needs {key}")
        return self


class Recorded(Table):
    """One recording."""

    name: Text
    """Name of its folder."""
    motion: Motion
    """What the robot does."""
    support: Text | None = None
    """Link that stands still; the root link if left out."""
    gravity_direction: Annotated[FloatArray, ArrayField((3,))] = Field(default_factory=_downwards)
    """Direction in which things fall, in the axes of the support."""
    use: Use = Use.CALIBRATION
    """What it is for, in the experiment file that is written beside it."""
    kind: Text | None = None
    """Kind of data to a study, in the experiment file that is written beside it; that of the motion if left out."""
    session: Text | None = None
    """Session to a study, in the same file; named after the power-up if left out."""
    power_up: _Count = 0
    """Recordings of one number share their offsets: the board was not switched off in between."""
    rate_hz: Positive = 100.0
    """Rate of every stream."""
    exact: bool = False
    """Whether all streams have the same even stamps, joints no steps of encoders, and joints and IMU all their
    derivatives; noise of sensors is theirs."""
    temperature_degC: tuple[Finite, Finite] | None = None
    """Temperature at the start and at the end."""


class Network(Table):
    """What happens on the way to a yarpdatadumper folder, which is written if this table is there."""

    jitter_s: NotNegative = 0.001
    """Largest change of a stamp."""
    clock_offset_s: NotNegative = 0.0
    """Largest time by which the clock of a port is ahead or behind."""
    lost_messages: _Count = 0
    """Messages of every port that do not arrive."""
    failed_groups: _Count = 0
    """Messages in which the control board marks its positions `[fail]`."""


class ScenarioFile(Table):
    """The whole file."""

    schema_name: Literal["forcetorque/scenario/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the scenario."""
    seed: _Count
    """Seed of everything that is random."""
    robot: Robot
    """The robot."""
    sensors: Sensors = Sensors()
    """What its sensors are made of."""
    load: tuple[Load, ...] = ()
    """Masses that are added."""
    robot_errors: RobotErrorSizes | None = None
    """How much the robot differs from its URDF; not at all if left out."""
    imu: Imu | None = None
    """An IMU; none if left out."""
    recording: Annotated[tuple[Recorded, ...], Field(min_length=1)]
    """Recordings."""
    network: Network | None = None
    """Faults of the network; without it no YARP folder is written."""

    @property
    def sensor_seed(self) -> int:
        """Seed of the sensors."""
        return self.seed if self.sensors.seed is None else self.sensors.seed

    def with_sensors(self, **changes: Any) -> ScenarioFile:
        """Describe other sensors; all is checked again, as when a file is read.

        Args:
            **changes: Keys of `[sensors]` that change, such as those of `LINEAR_ONLY`.

        Returns:
            The file with these changes; pydantic's `ValidationError` is raised if one is unknown or out of range.
        """
        content = self.model_dump(by_alias=True)
        content["sensors"] |= changes
        return ScenarioFile.model_validate(content)

    def exact(self) -> ScenarioFile:
        """Describe the same motions and sensors without anything that disturbs them.

        Returns:
            The file without noise, steps and limits of converters and encoders, drift, creep, cross-talk, errors of
            the robot, and bias of the IMU. Matrices, their errors and offsets stay: a true wrench w is read as
            `(1 + E) w + bias`.
        """
        content = self.with_sensors(**UNDISTURBED).model_dump(by_alias=True)
        content["robot_errors"] = None
        content["imu"] = None if self.imu is None else {"link": self.imu.link}
        for entry in content["recording"]:
            entry["exact"] = True
        return ScenarioFile.model_validate(content)

    @model_validator(mode="after")
    def _has_what_the_error_is_taken_over(self) -> ScenarioFile:
        if self.sensors.workbench_error is not None and all(r.use is not Use.VALIDATION for r in self.recording):
            raise ValueError('sensors.workbench_error is taken over recordings with use = "validation", there is none')
        return self

    @model_validator(mode="after")
    def _has_the_imu_that_it_needs(self) -> ScenarioFile:
        for entry in self.recording:
            if entry.motion.kind in _NEEDS_IMU and self.imu is None:
                message = (
                    f"recording {entry.name!r}: no foot stands all the time in a {entry.motion.kind} motion; it "
                    "needs [imu]"
                )
                raise ValueError(message)
        if self.imu is not None and self.network is not None:
            raise ValueError("no port of a [network] carries an [imu] yet; leave out one of them")
        return self

    @model_validator(mode="after")
    def _names_are_folders(self) -> ScenarioFile:
        names = [entry.name for entry in self.recording]
        for name in names:
            if names.count(name) > 1 or not name.replace("-", "_").isidentifier():
                raise ValueError(f"recording {name!r}: expected a name of letters, digits, - and _, each once")
        return self


_FOLDER = Path(__file__).parents[1] / "scenarios"


def bundled_scenario(name: str) -> Path:
    """Find a scenario file that comes with the library.

    Args:
        name: Its name, such as `icub-insitu`.

    Returns:
        The file.

    Raises:
        ForceTorqueError: If there is none of that name.
    """
    known = [file.stem for file in _FOLDER.glob("*.toml")]
    if name not in known:
        raise ForceTorqueError(f"no scenario is called {name!r}; {known_names(name, known)}; or give a .toml file")
    return _FOLDER / f"{name}.toml"
