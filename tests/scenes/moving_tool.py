# SPDX-License-Identifier: BSD-3-Clause
"""A tool on a wrist sensor that an arm turns fast, with an inertial sensor beside it, as a table and its file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

MASS, CENTRE, GRAVITY = 2.5, np.array([0.02, -0.03, 0.1]), 9.80665
INERTIA = np.array([[8e-3, 5e-4, 0.0], [5e-4, 6e-3, -4e-4], [0.0, -4e-4, 4e-3]])
BIAS = np.array([5.0, -3.0, 12.0, 0.5, -0.2, 0.1])
_NOISE = np.array([0.15, 0.15, 0.25, 0.01, 0.01, 0.01])
_TURNING, _ACCELERATING = 0.002, 0.02
"""Noise of a sample of the gyroscope, rad/s, and of the accelerometer, m/s2."""
_FREQUENCIES = 2.0 * np.pi * np.array([0.63, 1.02, 1.65])
_STEP_S = 1e-4

_FILE = """\
schema = "forcetorque/experiment/1"
name = "moving"

[load]
frame = "wrist_ft"
motion = ["arm"]
measure_direction = "child_to_parent"
inertia_kgm2 = "unknown"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "arm"
file = "arm.csv"
stamp = { column = "t", unit = "s" }

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "wrist_ft"

[[recording.stream.signal]]
quantity = "proper_acceleration"
columns = ["ax", "ay", "az"]
units = ["m/s2", "m/s2", "m/s2"]
frame = "wrist_ft"

[[recording.stream.signal]]
quantity = "angular_velocity"
columns = ["wx", "wy", "wz"]
units = ["rad/s", "rad/s", "rad/s"]
frame = "wrist_ft"

[[sensor]]
name = "wrist"
stream = "arm"
serial = "FT1"
prior = "identity"

[[interval]]
label = "all"
start_s = 0.0
use = "calibration"
"""


def write_moving_tool(
    folder: Path, *, speed: float, seed: int, mass: float = MASS, seconds: float = 30.0, rate_hz: float = 200.0
) -> Path:
    """Write table and experiment file.

    Args:
        folder: Folder that takes both.
        speed: Angular velocity that is hardly exceeded; rad/s; 0 for a sensor that stays as it is.
        seed: Of motion and noise.
        mass: Of the tool; kg; 0 for nothing.
        seconds: Length of the record; s.
        rate_hz: Samples in a second.

    Returns:
        The experiment file.
    """
    rng = np.random.default_rng(seed)
    time = np.arange(round(seconds * rate_hz)) / rate_hz
    phase = rng.uniform(0.0, 2.0 * np.pi, 3)
    reach = speed / _FREQUENCIES * [0.8, 0.5, 0.3]

    def turned(at: np.ndarray) -> Rotation:
        return Rotation.from_euler("ZYX", reach * np.sin(np.outer(at, _FREQUENCIES) + phase))

    def velocity(at: np.ndarray) -> np.ndarray:
        change: np.ndarray = (turned(at - _STEP_S).inv() * turned(at + _STEP_S)).as_rotvec() / (2.0 * _STEP_S)
        return change

    omega = velocity(time)
    alpha = (velocity(time + _STEP_S) - velocity(time - _STEP_S)) / (2.0 * _STEP_S)
    proper = turned(time).inv().apply([0.0, 0.0, GRAVITY])
    share = mass / MASS
    force = mass * (proper + np.cross(alpha, CENTRE) + np.cross(omega, np.cross(omega, CENTRE)))
    moment = np.cross(CENTRE, force) + share * (alpha @ INERTIA + np.cross(omega, omega @ INERTIA))
    table = np.column_stack(
        [
            time,
            BIAS - np.hstack([force, moment]) + _NOISE * rng.normal(size=(len(time), 6)),
            proper + _ACCELERATING * rng.normal(size=proper.shape),
            omega + _TURNING * rng.normal(size=omega.shape),
        ]
    )
    header = "t,fx,fy,fz,tx,ty,tz,ax,ay,az,wx,wy,wz"
    np.savetxt(folder / "arm.csv", table, delimiter=",", header=header, comments="", fmt="%.6f")
    path = folder / "moving.toml"
    path.write_text(_FILE)
    return path
