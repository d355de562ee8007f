# SPDX-License-Identifier: BSD-3-Clause
"""What is logged while a device moves: its encoders, its sensors, and an IMU if it has one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.device.description import HungLoad, device_load
from forcetorque.device.file import DeviceFile
from forcetorque.device.model import BASE, device_model
from forcetorque.device.trajectory import DeviceTrajectory
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Recording, Use
from forcetorque.robot.model import RobotModel
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.scenario.run import draw_imu
from forcetorque.simulation.scenario.sensor_instance import Specimen, draw_specimen
from forcetorque.simulation.sensor import SimulatedSensor
from forcetorque.simulation.trace import EPOCH_NS, record

_SENSORS, _POWER_UP, _NOISE, _IMU = 1, 2, 6, 8
"""What a stream of random numbers is for: one more load changes no other."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stretch:
    """A span of a recording in which the position of the hinge is known."""

    name: str
    """What it is called, such as `hinge 90`."""
    start_s: float
    """Start; s."""
    end_s: float
    """End; s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeviceRecording:
    """A recording of one load."""

    load: HungLoad
    """What hangs on the device."""
    model: RobotModel
    """The device with it."""
    trajectory: DeviceTrajectory
    """What it does."""
    recording: Recording
    """What was logged."""
    use: Use
    """What it is for."""

    @property
    def stretches(self) -> tuple[Stretch, ...]:
        """Spans in which the position of the hinge is known: all of it with an encoder, else while it is locked."""
        return known_stretches(self.trajectory)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeviceSpecimens:
    """The sensors in the stack, with their truth."""

    specimens: dict[str, Specimen]
    """Sensors by name."""
    mounted: dict[str, SimulatedSensor]
    """The sensors with their offsets; the device is not switched off between loads."""

    @classmethod
    def draw(cls, file: DeviceFile) -> DeviceSpecimens:
        """Draw the sensors of a device.

        Args:
            file: The device, with what its sensors are made of.

        Returns:
            The sensors.
        """
        seed, described = file.simulation.seed, file.simulation.sensors
        specimens = {
            sensor.name: replace(
                draw_specimen(described, k, np.random.default_rng([seed, _SENSORS, k])), serial=sensor.serial
            )
            for k, sensor in enumerate(file.sensor)
        }
        mounted = {
            name: specimen.powered_up(np.random.default_rng([seed, _POWER_UP, specimen.number]))
            for name, specimen in specimens.items()
        }
        return cls(specimens=specimens, mounted=mounted)


def simulate_device(file: DeviceFile, specimens: DeviceSpecimens) -> Iterator[DeviceRecording]:
    """Record the motion of a device with every load that its file names.

    Args:
        file: The device, its motion and loads.
        specimens: Its sensors.

    Yields:
        A recording per load.
    """
    simulation = file.simulation
    uses = {Use.CALIBRATION: simulation.loads_kg, Use.VALIDATION: simulation.validation_kg}
    loads = [(load, use) for use, loads in uses.items() for load in loads]
    for number, (load_kg, use) in enumerate(loads):
        load = device_load(file, load_kg)
        trajectory = DeviceTrajectory(device=file, load=load, sequence=file.sequence, hold_s=file.motion.hold_s)
        model = device_model(file, load)
        imu = None
        if simulation.imu is not None:
            imu = draw_imu(simulation.imu, model, np.random.default_rng([simulation.seed, _IMU]), where=file.name)
        recording = record(
            _movement(trajectory, model),
            specimens.mounted,
            rate_hz=simulation.rate_hz,
            rng=np.random.default_rng([simulation.seed, _NOISE, number]),
            imu=imu,
        )
        known = _as_known(recording, trajectory)
        yield DeviceRecording(load=load, model=model, trajectory=trajectory, recording=known, use=use)


def known_stretches(trajectory: DeviceTrajectory) -> tuple[Stretch, ...]:
    """Tell when the position of the hinge is known.

    Args:
        trajectory: What the device does.

    Returns:
        Spans of the whole trajectory with an encoder, else those in which the hinge stays locked.
    """
    sequence, ways = trajectory.sequence, trajectory.ways
    if trajectory.device.hinge.encoder:
        return (Stretch(name="all", start_s=0.0, end_s=trajectory.duration_s),)
    swings = np.flatnonzero(sequence.unlocked)
    starts = [0.0, *(ways.departures_s + ways.durations_s)[swings].tolist()]
    ends = [*ways.departures_s[swings].tolist(), trajectory.duration_s]
    locks = np.rint(np.rad2deg(sequence.postures[[0, *(swings + 1)], -1])).astype(int)
    return tuple(
        Stretch(name=f"hinge {lock}, {number}", start_s=start, end_s=end)
        for number, (lock, start, end) in enumerate(zip(locks, starts, ends, strict=True), start=1)
    )


def _as_known(recording: Recording, trajectory: DeviceTrajectory) -> Recording:
    """Without an encoder the hinge is logged at the lock where it was last, and known there only."""
    if trajectory.device.hinge.encoder:
        return recording
    sequence, ways = trajectory.sequence, trajectory.ways
    joints = recording.stream("joints")
    time_s = seconds_since(joints.stamp_ns, EPOCH_NS)
    arrived = np.searchsorted(ways.departures_s + ways.durations_s, time_s, side="right")
    position = np.array(joints.signals["position"].values)
    position[:, -1] = sequence.postures[arrived, -1]
    signal = replace(joints.signals["position"], values=position)
    return replace(recording, streams={**recording.streams, "joints": replace(joints, signals={"position": signal})})


def _movement(trajectory: DeviceTrajectory, model: RobotModel) -> Movement:
    return Movement(
        name=trajectory.sequence.name,
        kind=MovementKind.GRID,
        model=model,
        support=BASE,
        world_H_support=np.eye(4),
        duration_s=trajectory.duration_s,
        trajectory=trajectory,
    )
