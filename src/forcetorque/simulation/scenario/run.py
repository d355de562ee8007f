# SPDX-License-Identifier: BSD-3-Clause
"""From a scenario file to recordings with their truth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.errors import RobotError
from forcetorque.recording import Recording, Use
from forcetorque.robot import RobotModel, read_urdf
from forcetorque.simulation.load import with_load
from forcetorque.simulation.motions import (
    Movement,
    MovementKind,
    Stand,
    balancing_movement,
    contact_switching_movements,
    grid_movement,
    random_movement,
    z_torque_movement,
)
from forcetorque.simulation.recording import EPOCH_NS, record
from forcetorque.simulation.robots import named_robot
from forcetorque.simulation.scenario.schema import Recorded, ScenarioFile
from forcetorque.simulation.scenario.specimen import Specimen, draw_specimen
from forcetorque.simulation.sensor import SimulatedSensor
from forcetorque.toml_table import read_toml

_SENSORS, _POWER_UPS, _RECORDINGS = 1, 2, 3
"""What a stream of random numbers is for: each has its own, so that one more recording changes no other."""

_DAY_NS = 86_400_000_000_000


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scenario:
    """A scenario file with its robot and its sensors."""

    file: ScenarioFile
    """Content of the file."""
    urdf: Path
    """Model of the robot, without added loads."""
    model: RobotModel
    """The robot with its added loads."""
    specimens: dict[str, Specimen]
    """Sensors by name."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedRecording:
    """A recording and what is true of it."""

    name: str
    """Name of the recording."""
    recording: Recording
    """What was recorded."""
    movement: Movement
    """What the robot did."""
    sensors: dict[str, SimulatedSensor]
    """The sensors, with the offsets of this power-up."""
    use: Use
    """What it is for."""


def load_scenario(path: Path | str) -> Scenario:
    """Read a scenario file and draw its sensors.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The scenario.

    Raises:
        RobotError: If the robot has no force-torque sensor, or not those that the file names.
    """
    file = Path(path)
    content = read_toml(file, ScenarioFile, what="a scenario file")
    robot = content.robot
    urdf = file.parent / robot.urdf if robot.urdf is not None else named_robot(robot.model or ())
    model = read_urdf(urdf)
    names = list(model.sensors) if content.sensors.names is None else list(content.sensors.names)
    if not names:
        raise RobotError(f"{file}: robot {model.name!r} has no force-torque sensor; a scenario needs one")
    specimens = {}
    for index, name in enumerate(names):
        rng = np.random.default_rng([content.seed, _SENSORS, index])
        specimens[model.sensor(name).name] = draw_specimen(content.sensors, f"SIM{index + 1:03d}", rng)
    for load in content.load:
        model = with_load(model, load.link, mass_kg=load.mass_kg, centre_of_mass_m=load.centre_of_mass_m)
    return Scenario(file=content, urdf=urdf, model=model, specimens=specimens)


def simulate(scenario: Scenario) -> Iterator[SimulatedRecording]:
    """Make the recordings of a scenario, one after the other.

    Args:
        scenario: The scenario.

    Yields:
        Recordings; a motion of several phases gives one for each, named with its number.
    """
    for index, entry in enumerate(scenario.file.recording):
        rng = np.random.default_rng([scenario.file.seed, _RECORDINGS, index])
        sensors = _sensors(scenario, entry.power_up)
        movements = _movements(scenario, entry, rng)
        start_ns = EPOCH_NS + entry.power_up * _DAY_NS + index * 3_600_000_000_000
        for phase, movement in enumerate(movements):
            recording = record(
                movement,
                sensors,
                rate_hz=entry.rate_hz,
                rng=rng,
                temperature_degC=entry.temperature_degC,
                start_ns=start_ns,
            )
            start_ns += round(movement.duration_s * 1e9)
            name = entry.name if len(movements) == 1 else f"{entry.name}_{phase}"
            yield SimulatedRecording(name=name, recording=recording, movement=movement, sensors=sensors, use=entry.use)


def _sensors(scenario: Scenario, power_up: int) -> dict[str, SimulatedSensor]:
    return {
        name: specimen.powered_up(np.random.default_rng([scenario.file.seed, _POWER_UPS, index, power_up]))
        for index, (name, specimen) in enumerate(scenario.specimens.items())
    }


def _movements(scenario: Scenario, entry: Recorded, rng: np.random.Generator) -> tuple[Movement, ...]:
    motion, model = entry.motion, scenario.model
    support = entry.support or model.root_link
    stand = Stand(
        model=model,
        support=support,
        gravity_direction=entry.gravity_direction,
        speed=motion.speed,
        gravity=scenario.file.robot.gravity,
    )
    sensor, swing = motion.sensor or "", motion.swing or ""
    if motion.kind is MovementKind.GRID:
        return (grid_movement(stand, sensor, steps=motion.postures or 7, hold_s=motion.hold_s, name=entry.name),)
    if motion.kind is MovementKind.Z_TORQUE:
        postures = motion.postures or 12
        return (z_torque_movement(stand, sensor, rng=rng, postures=postures, hold_s=motion.hold_s, name=entry.name),)
    if motion.kind is MovementKind.BALANCING:
        postures = motion.postures or 12
        return (balancing_movement(stand, swing, rng=rng, postures=postures, hold_s=motion.hold_s, name=entry.name),)
    if motion.kind is MovementKind.CONTACT_SWITCHING:
        return contact_switching_movements(stand, swing, rng=rng)
    duration = motion.duration_s or 0.0
    return (random_movement(stand, rng=rng, duration_s=duration, slowest_hz=motion.slowest_hz, name=entry.name),)
