# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of simulated sensors on a robot, with the true motion underneath."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.recording import Recording
from forcetorque.robot import JointMotion, RobotModel
from forcetorque.simulation.imu import SimulatedImu
from forcetorque.simulation.motions import Movement, MovementKind, Stand, random_smooth_motion
from forcetorque.simulation.sensor import SimulatedSensor
from forcetorque.simulation.trace import EPOCH_NS, trace_movement


def record(
    movement: Movement,
    sensors: Mapping[str, SimulatedSensor],
    *,
    rate_hz: float,
    rng: np.random.Generator,
    temperature_degC: tuple[float, float] | None = None,
    start_ns: int = EPOCH_NS,
    imu: SimulatedImu | None = None,
) -> Recording:
    """Record the joints and sensors of a robot during a movement.

    Joints and sensors have their own stamps, out of step and with jitter, as on a real network.
    Joints are read with encoders of 16 bits a turn.

    Args:
        movement: What the robot does.
        sensors: What each sensor is made of, by its name in the robot.
        rate_hz: Rate of every stream; Hz.
        rng: Source of stamps and noise.
        temperature_degC: Temperature of the sensors at the start and at the end, linear in between; None where
            nobody measures it.
        start_ns: When it starts; ns.
        imu: An IMU; none if None.

    Returns:
        A stream `joints` with positions, a stream per sensor, under its name, with raw counts, the board's
        status and, if given, the temperature, and a stream `imu`, if there is one.
    """
    link = None if imu is None else imu.link
    trace = trace_movement(movement, sensors, rate_hz=rate_hz, rng=rng, start_ns=start_ns, imu_link=link)
    return trace.recorded(sensors, rng=rng, temperature_degC=temperature_degC, imu=imu)


def simulate_recording(
    model: RobotModel,
    sensors: Mapping[str, SimulatedSensor],
    *,
    support: str,
    gravity_direction: Any,
    ranges: Mapping[str, tuple[float, float]],
    duration_s: float,
    rate_hz: float,
    slowest_hz: float,
    seed: int,
) -> Recording:
    """Record sensors and joints of a robot that moves smoothly and at random while one link stands still.

    Args:
        model: The robot.
        sensors: What each sensor is made of, by its name in the robot.
        support: Link that stands still.
        gravity_direction: Direction in which things fall, in the axes of that link; shape (3,).
        ranges: Lowest and highest position of every moving joint; rad or m.
        duration_s: Length of the recording; s.
        rate_hz: Rate of every stream; Hz.
        slowest_hz: About the frequency of the slowest motion; Hz.
        seed: Seed of everything that is random.

    Returns:
        What `record` gives.
    """
    rng = np.random.default_rng(seed)
    motion_seed = int(rng.integers(2**32))

    def trajectory(seconds: FloatArray) -> JointMotion:
        return random_smooth_motion(ranges, seconds, slowest_hz=slowest_hz, rng=np.random.default_rng(motion_seed))

    stand = Stand(model=model, support=support, gravity_direction=gravity_direction, ranges=ranges)
    movement = stand.movement("random", MovementKind.RANDOM, trajectory, duration_s)
    return record(movement, sensors, rate_hz=rate_hz, rng=rng)
