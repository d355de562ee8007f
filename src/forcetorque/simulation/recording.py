# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of a simulated sensor on a robot, with the true motion underneath."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.constants import STANDARD_GRAVITY
from forcetorque.recording import Recording, Signal, Stream
from forcetorque.recording.alignment import seconds_since
from forcetorque.robot import JointMotion, RobotModel, RootMotion, build_tree, expected_wrenches
from forcetorque.simulation.motions import random_smooth_motion
from forcetorque.simulation.sensor import SimulatedSensor

_EPOCH_NS = 1_700_000_000_000_000_000
_ENCODER_STEP = 2.0 * np.pi / 2**16


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

    Joints and sensors have their own stamps, out of step and with jitter, as on a real network.

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
        A stream `joints` with positions, and a stream of raw counts per sensor, under its name.
    """
    rng = np.random.default_rng(seed)
    motion_seed = int(rng.integers(2**32))

    def motion_at(stamps: IntArray) -> JointMotion:
        seconds = seconds_since(stamps, _EPOCH_NS)
        return random_smooth_motion(ranges, seconds, slowest_hz=slowest_hz, rng=np.random.default_rng(motion_seed))

    joint_stamps = _stamps(duration_s, rate_hz, rng)
    position = motion_at(joint_stamps).position
    units = tuple(model.joints[name].type.unit for name in ranges)
    measured = np.rint(position / _ENCODER_STEP) * _ENCODER_STEP
    streams = {
        "joints": _stream(
            "joints", joint_stamps, Signal(quantity="position", values=measured, columns=tuple(ranges), units=units)
        )
    }
    root = RootMotion.fixed(_unit(gravity_direction), gravity=STANDARD_GRAVITY)
    tree = build_tree(model, support)
    for name, sensor in sensors.items():
        stamps = _stamps(duration_s, rate_hz, rng)
        truth = expected_wrenches(tree, motion_at(stamps), root, [name])[name]
        raw = Signal(
            quantity="raw",
            values=sensor.read(truth, rng),
            columns=tuple(f"ch{k}" for k in range(6)),
            units=("counts",) * 6,
        )
        streams[name] = _stream(name, stamps, raw)
    return Recording(streams=streams, origin={"format": "simulation", "robot": model.name, "seed": str(seed)})


def _stamps(duration_s: float, rate_hz: float, rng: np.random.Generator) -> IntArray:
    period_ns = 1e9 / rate_hz
    count = int(duration_s * rate_hz)
    jitter = rng.uniform(-0.2, 0.2, count)
    ticks = np.rint((np.arange(count) + rng.uniform(0.2, 0.8) + jitter) * period_ns)
    return _EPOCH_NS + ticks.astype(np.int64)


def _stream(name: str, stamps: IntArray, signal: Signal) -> Stream:
    return Stream(name=name, clock="simulation", stamp_ns=stamps, signals={signal.quantity: signal})


def _unit(direction: Any) -> FloatArray:
    vector = np.asarray(direction, dtype=np.float64)
    unit: FloatArray = vector / np.linalg.norm(vector)
    return unit
