# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of simulated sensors on a robot, with the true motion underneath."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.recording import Recording, Signal, Stream
from forcetorque.recording.alignment import seconds_since
from forcetorque.robot import JointMotion, RobotModel
from forcetorque.simulation.motions import Movement, MovementKind, Stand, random_smooth_motion
from forcetorque.simulation.sensor import SimulatedSensor

EPOCH_NS = 1_700_000_000_000_000_000
"""When a simulated recording starts unless somebody says otherwise; ns."""

_ENCODER_STEP = 2.0 * np.pi / 2**16


def record(
    movement: Movement,
    sensors: Mapping[str, SimulatedSensor],
    *,
    rate_hz: float,
    rng: np.random.Generator,
    temperature_degC: tuple[float, float] | None = None,
    start_ns: int = EPOCH_NS,
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

    Returns:
        A stream `joints` with positions, and a stream per sensor, under its name, with raw counts, the board's
        status and, if given, the temperature.
    """

    def seconds(stamps: IntArray) -> FloatArray:
        return seconds_since(stamps, start_ns)

    joint_stamps = _stamps(movement.duration_s, rate_hz, rng) + start_ns
    motion = movement.joints(seconds(joint_stamps))
    measured = np.rint(motion.position / _ENCODER_STEP) * _ENCODER_STEP
    units = tuple(movement.model.joints[name].type.unit for name in motion.names)
    position = Signal(quantity="position", values=measured, columns=motion.names, units=units)
    streams = {"joints": _stream("joints", joint_stamps, position)}
    for name, sensor in sensors.items():
        stamps = _stamps(movement.duration_s, rate_hz, rng) + start_ns
        truth = movement.readings(seconds(stamps), [name]).of_name(name)
        temperature = _temperature(seconds(stamps) / movement.duration_s, temperature_degC)
        held = sensor.read(truth, rng, rate_hz=rate_hz, temperature_degC=temperature)
        signals = [
            Signal(
                quantity="raw",
                values=held.counts,
                columns=tuple(f"ch{k}" for k in range(6)),
                units=("counts",) * 6,
            ),
            Signal(
                quantity="saturated",
                values=held.saturated.astype(np.float64)[:, None],
                columns=("saturated",),
                units=("0 or 1",),
            ),
        ]
        if temperature is not None:
            signals.append(
                Signal(quantity="temperature", values=temperature[:, None], columns=("temperature",), units=("degC",))
            )
        streams[name] = _stream(name, stamps, *signals)
    return Recording(streams=streams, origin={"format": "simulation", "robot": movement.model.name})


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


def _stamps(duration_s: float, rate_hz: float, rng: np.random.Generator) -> IntArray:
    period_ns = 1e9 / rate_hz
    count = int(duration_s * rate_hz)
    jitter = rng.uniform(-0.2, 0.2, count)
    ticks = np.rint((np.arange(count) + rng.uniform(0.2, 0.8) + jitter) * period_ns)
    return ticks.astype(np.int64)


def _stream(name: str, stamps: IntArray, *signals: Signal) -> Stream:
    return Stream(
        name=name, clock="simulation", stamp_ns=stamps, signals={signal.quantity: signal for signal in signals}
    )


def _temperature(share: FloatArray, ends: tuple[float, float] | None) -> FloatArray | None:
    if ends is None:
        return None
    linear: FloatArray = ends[0] + (ends[1] - ends[0]) * share
    return linear
