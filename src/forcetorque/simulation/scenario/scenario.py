# SPDX-License-Identifier: BSD-3-Clause
"""From a scenario file to recordings with their truth: the movements, and the sensors that are read in them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FormatError, RobotError, known_names
from forcetorque.base.toml_file import read_toml
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.validation_offset import OFFSET_S
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Recording, Use
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.installed_robots import urdf_file
from forcetorque.robot.model import RobotModel
from forcetorque.robot.modified_robot import RobotErrors, with_load
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.contact_switching import contact_switching_movement
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import (
    balancing_movement,
    grid_movement,
    random_movement,
    z_torque_movement,
)
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.on_both_feet import (
    squat_movement,
    standing_movement,
    stepping_movement,
    sway_movement,
)
from forcetorque.simulation.motions.stance import Stance, random_placement
from forcetorque.simulation.robots import named_robot
from forcetorque.simulation.scenario.scenario_file import Imu, Recorded, RobotErrorSizes, ScenarioFile
from forcetorque.simulation.sensor_family import Specimen, draw_specimen
from forcetorque.simulation.simulated_sensor import SimulatedSensor
from forcetorque.simulation.trace import EPOCH_NS, SimulatedImu, Trace, trace_movement

_MOVEMENTS, _STAMPS, _PLACEMENTS = 3, 5, 7
"""What a stream of random numbers is for: each has its own, so that one more recording changes no other."""

_ON_BOTH_FEET = {
    MovementKind.STANDING: standing_movement,
    MovementKind.SWAY: sway_movement,
    MovementKind.SQUAT: squat_movement,
    MovementKind.STEPPING: stepping_movement,
}

_DAY_NS = 86_400_000_000_000
_HOUR_NS = 3_600_000_000_000

INTERVAL_MARGIN_S = 0.5
"""What the interval of a recording leaves out at either end: derivatives of the joints are poor there; s."""

_JUDGED_HZ = 10.0
"""Rate at which loads are averaged: every tenth sample of a recording has the same mean within some tenths of a
percent, for a tenth of the time."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plan:
    """One recording that is to be made."""

    name: str
    """Name of the recording."""
    entry: Recorded
    """What the file says of it."""
    index: int
    """Place of its entry in the file."""
    start_ns: int
    """When it starts; ns."""
    movement: Movement
    """What the robot does."""

    def trace(self, sensors: Sequence[str], *, seed: int, imu_link: str | None = None) -> Trace:
        """Find the loads on sensors.

        Args:
            sensors: Their names.
            seed: Seed of the scenario.
            imu_link: Link that an IMU is on; none if None.

        Returns:
            Joints, loads and the IMU's motion at the instants at which they are read.
        """
        rng = np.random.default_rng([seed, _STAMPS, self.index, 0])
        return trace_movement(
            self.movement,
            sensors,
            rate_hz=self.entry.rate_hz,
            rng=rng,
            start_ns=self.start_ns,
            imu_link=imu_link,
            exact=self.entry.exact,
        )


def plan_recordings(content: ScenarioFile, model: RobotModel) -> Iterator[Plan]:
    """Plan the motions of a scenario.

    Args:
        content: The scenario.
        model: Its robot, with its added loads.

    Yields:
        Recordings to make.
    """
    for index, entry in enumerate(content.recording):
        rng = np.random.default_rng([content.seed, _MOVEMENTS, index])
        placement = _placement(content.seed, entry.motion.placement)
        movement = _movement(entry, model, gravity=content.robot.gravity, rng=rng, placement=placement)
        start_ns = EPOCH_NS + entry.power_up * _DAY_NS + index * _HOUR_NS
        yield Plan(name=entry.name, entry=entry, index=index, start_ns=start_ns, movement=movement)


@lru_cache(maxsize=1)  # one sensor after the other is drawn for the same motions
def validation_loads(plans: tuple[Plan, ...], sensor: str) -> tuple[FloatArray, ...]:
    """Compute how the true loads of a sensor change in the recordings that are for validation.

    Args:
        plans: All recordings.
        sensor: The sensor.

    Returns:
        Its wrenches in the interval of each of them, evenly in time, less their mean over the first second, from which
        a study takes the offset; shapes (n, 6); N, N m.
    """
    changes = []
    for plan in plans:
        if plan.entry.use is Use.VALIDATION:
            time_s = np.arange(INTERVAL_MARGIN_S, plan.movement.duration_s - INTERVAL_MARGIN_S, 1.0 / _JUDGED_HZ)
            load = plan.movement.readings(time_s, [sensor]).of_name(sensor)
            change = load - load[time_s < INTERVAL_MARGIN_S + OFFSET_S].mean(axis=0)
            changes.append(read_only(change, name="loads", shape=(None, 6)))
    return tuple(changes)


def _placement(seed: int, number: int) -> FloatArray:
    """Where the feet stand; number 0 has them below the hips."""
    if number == 0:
        return np.zeros((2, 3))
    return random_placement(np.random.default_rng([seed, _PLACEMENTS, number]))


def _movement(
    entry: Recorded, model: RobotModel, *, gravity: float, rng: np.random.Generator, placement: FloatArray
) -> Movement:
    motion = entry.motion
    stand = Stand(
        model=model,
        support=entry.support or model.root_link,
        gravity_direction=entry.gravity_direction,
        speed=motion.speed,
        gravity=gravity,
    )
    sensor, swing = motion.sensor or "", motion.swing or ""
    if motion.kind is MovementKind.GRID:
        return grid_movement(stand, sensor, steps=motion.postures or 7, hold_s=motion.hold_s, name=entry.name)
    if motion.kind is MovementKind.Z_TORQUE:
        postures = motion.postures or 12
        return z_torque_movement(stand, sensor, rng=rng, postures=postures, hold_s=motion.hold_s, name=entry.name)
    if motion.kind is MovementKind.BALANCING:
        postures = motion.postures or 12
        return balancing_movement(stand, swing, rng=rng, postures=postures, hold_s=motion.hold_s, name=entry.name)
    if motion.kind is MovementKind.CONTACT_SWITCHING:
        return contact_switching_movement(
            Stance(stand=stand, other=swing, placement=placement),
            rng=rng,
            hook=motion.hook,
            postures=motion.postures or 3,
            still_s=motion.still_s,
            internal_force_N=motion.internal_force_N,
            name=entry.name,
        )
    duration = motion.duration_s or 0.0
    if motion.kind in _ON_BOTH_FEET:
        stance = Stance(stand=stand, other=swing, placement=placement)
        force, move = motion.internal_force_N, _ON_BOTH_FEET[motion.kind]
        return move(stance, rng=rng, duration_s=duration, internal_force_N=force, name=entry.name)
    return random_movement(stand, rng=rng, duration_s=duration, slowest_hz=motion.slowest_hz, name=entry.name)


_SENSORS, _POWER_UPS, _NOISE, _IMU, _ROBOT = 1, 2, 6, 8, 9
"""What a stream of random numbers is for, beside those of plans: one more recording changes no other."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scenario:
    """A scenario file with its robot, what that does, and its sensors."""

    file: ScenarioFile
    """Content of the file."""
    urdf: Path
    """Model of the robot, without added loads."""
    model: RobotModel
    """The robot as it is, with its added loads."""
    robot_errors: RobotErrors | None
    """How it differs from the URDF beside these."""
    imu: SimulatedImu | None
    """Its IMU, if it has one."""
    plans: tuple[Plan, ...]
    """Recordings that are to be made."""
    specimens: dict[str, Specimen]
    """Sensors by name."""

    def with_sensors(self, **changes: Any) -> Scenario:
        """Let the same robot do the same with other sensors.

        Args:
            **changes: Keys of `[sensors]` that change, such as `seed`, `names`, or those of `LINEAR_ONLY`.

        Returns:
            The scenario with sensors drawn anew and the motions of this one, so that traces of this one fit it.
        """
        file = self.file.with_sensors(**changes)
        return replace(self, file=file, specimens=_specimens(file, self.model, self.plans), imu=_imu(file, self.model))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedRecording:
    """A recording and what is true of it."""

    name: str
    """Name of the recording."""
    recording: Recording
    """What was recorded."""
    movement: Movement
    """What the robot did."""
    start_ns: int
    """When it started to; ns."""
    sensors: dict[str, SimulatedSensor]
    """The sensors, with the offsets of this power-up."""
    use: Use
    """What it is for."""
    kind: str
    """Kind of data to a study."""
    session: str
    """Session to a study."""

    def contacts(self) -> Recording:
        """Give what the world truly did to the robot.

        Returns:
            A stream for every touch beside the support, by its name, at the stamps of the joints: the wrench in the
            frame of its link, zero where it does not touch; N, N m. None for a robot that only its support bears.
        """
        stamps = self.recording.stream("joints").stamp_ns
        wrenches = self.movement.external_wrenches(seconds_since(stamps, self.start_ns))
        streams = {}
        for touch in self.movement.external:
            name = touch.contact.name
            wrench = Signal(
                quantity="wrench",
                values=wrenches.of_name(name),
                columns=WRENCH_COMPONENTS,
                units=WRENCH_UNITS,
                frame=touch.contact.link,
            )
            streams[name] = Stream(name=name, clock="simulation", stamp_ns=stamps, signals={"wrench": wrench})
        return Recording(streams=streams, origin=dict(self.recording.origin))


def load_scenario(path: Path | str) -> Scenario:
    """Read a scenario file, plan its motions and draw its sensors.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The scenario.

    Raises:
        RobotError: If the robot has no force-torque sensor, or not those that the file names.
    """
    file = Path(path)
    return build_scenario(read_toml(file, ScenarioFile, what="a scenario file"), folder=file.parent)


def build_scenario(content: ScenarioFile, *, folder: Path | str = ".") -> Scenario:
    """Plan the motions and draw the sensors of a scenario that is in memory.

    Args:
        content: What a file would say.
        folder: Folder that the paths in it are relative to.

    Returns:
        The scenario.

    Raises:
        RobotError: If the robot has no force-torque sensor, or not those that are named.
    """
    robot = content.robot
    urdf = urdf_file(robot.urdf, folder) if robot.urdf is not None else named_robot(robot.model or ())
    model = read_urdf(urdf)
    if not model.sensors:
        raise RobotError(
            f"scenario {content.name!r}: robot {model.name!r} has no force-torque sensor; a scenario needs one"
        )
    errors = None if content.robot_errors is None else _errors(content.robot_errors, model, content.seed)
    if errors is not None:
        model = errors.applied_to(model)
    for load in content.load:
        model = with_load(model, load.link, mass_kg=load.mass_kg, centre_of_mass_m=load.centre_of_mass_m)
    plans = tuple(plan_recordings(content, model))
    specimens = _specimens(content, model, plans)
    return Scenario(
        file=content,
        urdf=urdf,
        model=model,
        robot_errors=errors,
        imu=_imu(content, model),
        plans=plans,
        specimens=specimens,
    )


def trace_recordings(scenario: Scenario) -> dict[str, Trace]:
    """Find the loads on all sensors in all recordings, to read any number of sensors under them.

    Returns:
        Traces by the names of the recordings; eight bytes per sample of every joint and component of a load.
    """
    return {plan.name: _trace(scenario, plan) for plan in scenario.plans}


def simulate(scenario: Scenario, traces: Mapping[str, Trace] | None = None) -> Iterator[SimulatedRecording]:
    """Make the recordings of a scenario, one after the other.

    Args:
        scenario: The scenario.
        traces: What `trace_recordings` gave for it, or for another with the same motions and sensors of the same
            names; computed one after the other if None.

    Yields:
        Recordings.

    Raises:
        RobotError: If a trace is one of other motions, or lacks a sensor.
    """
    for plan in scenario.plans:
        trace = _trace(scenario, plan) if traces is None else traces.get(plan.name)
        if trace is None or trace.movement is not plan.movement:
            raise RobotError(f"trace of {plan.name!r}: expected one of this scenario's own motions; trace it anew")
        sensors = _powered_up(scenario, plan.entry.power_up)
        recording = trace.recorded(
            sensors,
            rng=np.random.default_rng([scenario.file.sensor_seed, _NOISE, plan.index, 0]),
            temperature_degC=plan.entry.temperature_degC,
            imu=scenario.imu,
        )
        yield SimulatedRecording(
            name=plan.name,
            recording=recording,
            movement=plan.movement,
            start_ns=plan.start_ns,
            sensors=sensors,
            use=plan.entry.use,
            kind=plan.entry.kind or plan.movement.kind.value,
            session=plan.entry.session or f"power-up {plan.entry.power_up}",
        )


def _trace(scenario: Scenario, plan: Plan) -> Trace:
    link = None if scenario.imu is None else scenario.imu.link
    return plan.trace(tuple(scenario.specimens), seed=scenario.file.seed, imu_link=link)


def _errors(sizes: RobotErrorSizes, model: RobotModel, seed: int) -> RobotErrors:
    return RobotErrors.draw(
        model,
        mass=sizes.mass,
        centre_m=sizes.centre_m,
        joint_zero_rad=float(np.deg2rad(sizes.joint_zero_deg)),
        rng=np.random.default_rng([seed if sizes.seed is None else sizes.seed, _ROBOT]),
    )


def draw_imu(described: Imu, model: RobotModel, rng: np.random.Generator, *, where: str) -> SimulatedImu:
    """Draw an IMU.

    Args:
        described: What is said of it.
        model: The robot that it is on.
        rng: Source of its biases.
        where: What the message says in front.

    Returns:
        The IMU, on the first of the links that the robot has.

    Raises:
        RobotError: If the robot has none of the links.
    """
    for link in described.link:
        if link in model.links:
            return SimulatedImu(
                link=link,
                accelerometer_bias=described.accelerometer_bias * rng.standard_normal(3),
                gyroscope_bias=described.gyroscope_bias * rng.standard_normal(3),
                accelerometer_noise=described.accelerometer_noise,
                gyroscope_noise=described.gyroscope_noise,
            )
    raise RobotError(
        f"{where}: imu: robot {model.name!r} has none of the links {', '.join(described.link)}; "
        f"{known_names(described.link[0], model.links)}"
    )


def _imu(content: ScenarioFile, model: RobotModel) -> SimulatedImu | None:
    if content.imu is None:
        return None
    rng = np.random.default_rng([content.sensor_seed, _IMU])
    return draw_imu(content.imu, model, rng, where=f"scenario {content.name!r}")


def _powered_up(scenario: Scenario, power_up: int) -> dict[str, SimulatedSensor]:
    seed = scenario.file.sensor_seed
    return {
        name: specimen.powered_up(np.random.default_rng([seed, _POWER_UPS, specimen.number, power_up]))
        for name, specimen in scenario.specimens.items()
    }


def _specimens(content: ScenarioFile, model: RobotModel, plans: tuple[Plan, ...]) -> dict[str, Specimen]:
    described = content.sensors
    names = [model.sensor(name).name for name in described.names or model.sensors]
    loads = {}
    if described.workbench_error is not None:
        judged = model.sensor(described.workbench_error.sensor).name
        if judged not in names:
            raise FormatError(
                f"sensors.workbench_error: sensor {judged!r} is not among those that are simulated; "
                f"{known_names(judged, names)}"
            )
        loads[judged] = validation_loads(plans, judged)
    every = list(model.sensors)
    return {
        name: draw_specimen(
            described,
            every.index(name),
            np.random.default_rng([content.sensor_seed, _SENSORS, every.index(name)]),
            loads=loads.get(name),
        )
        for name in names
    }
