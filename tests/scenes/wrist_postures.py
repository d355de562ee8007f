# SPDX-License-Identifier: BSD-3-Clause
"""A wrist sensor with a known tool that is held in one posture, then in another, with noise that is white and slow."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray

MASS, CENTRE = 1.4, np.array([0.02, -0.01, 0.06])
BIAS = np.array([12.0, -7.0, 25.0, 0.4, -0.3, 0.2])
WHITE = np.array([0.05, 0.05, 0.05, 0.002, 0.002, 0.002])
SLOW = 0.5 * WHITE
"""Standard deviation of the slow part, which forgets itself in 3 s."""
HELD_S, RATE_HZ = 60.0, 20.0
POSTURES = Rotation.from_euler("ZYX", [[20.0, 30.0, -40.0], [-80.0, 10.0, 130.0]], degrees=True)
"""Of the sensor in the world."""

TEXT = f"""\
schema = "forcetorque/experiment/1"
name = "two postures"

[load]
frame = "tool"
motion = ["log"]
measure_direction = "child_to_parent"
mass_kg = {MASS}
centre_of_mass_m = {CENTRE.tolist()}

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "log"
file = "log.csv"
stamp = {{ column = "t", unit = "s" }}

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "tool"

[[recording.stream.signal]]
quantity = "orientation"
columns = ["qw", "qx", "qy", "qz"]
units = ["1", "1", "1", "1"]
frame = "tool"
orientation = {{ form = "quat_wxyz", sense = "sensor_to_world" }}

[[sensor]]
name = "wrist"
stream = "log"
serial = "FT1"
prior = "identity"
full_scale = [100.0, 100.0, 200.0, 10.0, 10.0, 10.0]

[[interval]]
label = "first"
start_s = 0.0
end_s = {HELD_S}
use = "calibration"

[[interval]]
label = "second"
start_s = {HELD_S}
use = "validation"
"""


def weight(posture: Rotation) -> FloatArray:
    """What the sensor reads of the tool."""
    force = MASS * posture.inv().apply([0.0, 0.0, -9.80665])
    return np.concatenate([force, np.cross(CENTRE, force)])


def write_postures(folder: Path, *, seed: int, postures: Rotation = POSTURES, known: bool = True) -> Path:
    """Write the log and its experiment file, with a load that is stated, or left to be estimated on all of it."""
    rng = np.random.default_rng(seed)
    n = int(HELD_S * RATE_HZ)
    rows = []
    for k, posture in enumerate(postures):
        time = HELD_S * k + np.arange(n) / RATE_HZ
        reading = BIAS + weight(posture) + slow_noise(rng, n) + WHITE * rng.normal(size=(n, 6))
        quaternion = np.tile(np.roll(posture.as_quat(), 1), (n, 1))
        rows.append(np.column_stack([time, reading, quaternion]))
    header = "t,fx,fy,fz,tx,ty,tz,qw,qx,qy,qz"
    np.savetxt(folder / "log.csv", np.concatenate(rows), delimiter=",", header=header, comments="", fmt="%.9g")
    path = folder / "wrist.toml"
    path.write_text(TEXT if known else _unknown(TEXT))
    return path


def _unknown(text: str) -> str:
    """The same without the load, fitted on everything."""
    lines = [line for line in text.splitlines() if not line.startswith(("mass_kg", "centre_of_mass_m"))]
    head, *_ = "\n".join(lines).split("[[interval]]")
    return f'{head}[[interval]]\nlabel = "all"\nstart_s = 0.0\nuse = "calibration"\n'


def slow_noise(rng: np.random.Generator, n: int) -> FloatArray:
    """An offset that forgets itself in 3 s, from one sample to the next."""
    keep = np.exp(-1.0 / (3.0 * RATE_HZ))
    offset = np.zeros((n, 6))
    offset[0] = SLOW * rng.normal(size=6)
    for k in range(1, n):
        offset[k] = keep * offset[k - 1] + np.sqrt(1.0 - keep**2) * SLOW * rng.normal(size=6)
    return offset
