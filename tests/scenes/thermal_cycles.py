# SPDX-License-Identifier: BSD-3-Clause
"""A sensor at rest in a chamber that is heated and cooled, with a known drift and noise that is white and slow."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import numpy as np

from forcetorque.base.arrays import FloatArray

PER_DEGREE = np.array([0.5, -0.3, 2.0, 0.02, 0.01, -0.01])
"""N/degC, N m/degC."""
HYSTERESIS = np.array([0.4, 0.0, 1.0, 0.01, 0.0, 0.005])
"""Heating minus cooling; N, N m."""
PER_HOUR = np.array([0.5, -0.2, 1.0, 0.01, 0.0, 0.01])
"""N/h, N m/h."""
UNIT = np.array([1.0, 1.0, 1.0, 0.05, 0.05, 0.05])
WHITE, SLOW, FORGETS_S = 0.1, 0.05, 600.0
"""Deviations of the noise, in `UNIT`, and how long its slow part lasts."""
MIDDLE_DEGC, RATE_HZ = 30.0, 1.0

TEXT = """\
schema = "forcetorque/experiment/1"
name = "chamber"

[load]
frame = "ft"
motion = ["log"]
measure_direction = "child_to_parent"
mass_kg = 0.5
centre_of_mass_m = [0.0, 0.0, 0.05]

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "log"
file = "log.csv"
stamp = { column = "t", unit = "s" }

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "ft"

[[recording.stream.signal]]
quantity = "temperature"
columns = ["T"]
units = ["degC"]

[[sensor]]
name = "wrist"
stream = "log"
serial = "FT1"
prior = "identity"
full_scale = [100.0, 100.0, 200.0, 10.0, 10.0, 10.0]

[[sensor.variable]]
name = "temperature"

[[interval]]
label = "chamber"
start_s = 0.0
use = "calibration"
"""


def record(
    rng: np.random.Generator,
    *,
    cycles: float = 2.0,
    hours: float = 2.0,
    swing_degC: float = 20.0,
    late_s: float = 0.0,
    form: Literal["even", "wave", "exponential"] = "even",
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Instants, temperatures by a thermometer that is late, and readings of cycles; half a cycle is a rise."""
    n = int(hours * 3600.0 * RATE_HZ)
    time = np.arange(n) / RATE_HZ
    whole = time / (time[-1] + 1.0 / RATE_HZ) * cycles
    phase = whole % 1.0
    warmth = swing_degC * _warmth(whole, form)
    late = swing_degC * _warmth(np.maximum(whole - late_s * cycles / (3600.0 * hours), 0.0), form)
    reading = np.outer(warmth, PER_DEGREE) + np.outer(np.where(phase < 0.5, 0.5, -0.5), HYSTERESIS)
    reading += np.outer((time - time.mean()) / 3600.0, PER_HOUR) + np.array([10.0, 5.0, 20.0, 1.0, 1.0, 1.0])
    reading += UNIT * (SLOW * slow(rng, n) + WHITE * rng.normal(size=(n, 6)))
    return time, MIDDLE_DEGC + late + 0.05 * rng.normal(size=n), reading


def _warmth(whole: FloatArray, form: str) -> FloatArray:
    """Warmth over its range, about its middle, by cycles; exponential ones last two thirds of a branch."""
    phase = whole % 1.0
    if form == "wave":
        return np.asarray(-0.5 * np.cos(2.0 * np.pi * phase))
    if form == "even":
        return np.asarray(np.where(phase < 0.5, 2.0 * phase, 2.0 - 2.0 * phase) - 0.5)
    reached, branch = 1.0 / (1.0 + np.exp(-1.5)), 3.0 * (phase % 0.5)
    start = 1.0 - reached  # of a cycle that repeats itself
    heated = 1.0 - (1.0 - start) * np.exp(-branch)
    return np.asarray(np.where(phase < 0.5, heated, reached * np.exp(-branch)) - 0.5)


def slow(rng: np.random.Generator, n: int) -> FloatArray:
    """An offset of deviation 1 that forgets itself."""
    from scipy.signal import lfilter

    keep = np.exp(-1.0 / (RATE_HZ * FORGETS_S))
    drive = np.sqrt(1.0 - keep**2) * rng.normal(size=(n, 6))
    drive[0] /= np.sqrt(1.0 - keep**2)
    wandering: FloatArray = lfilter([1.0], [1.0, -keep], drive, axis=0)
    return wandering


def write_cycles(folder: Path, time: FloatArray, degrees: FloatArray, reading: FloatArray) -> Path:
    """Write the log and its experiment file."""
    rows = np.column_stack([time, reading, degrees])
    np.savetxt(folder / "log.csv", rows, delimiter=",", header="t,fx,fy,fz,tx,ty,tz,T", comments="", fmt="%.9g")
    path = folder / "chamber.toml"
    path.write_text(TEXT)
    return path
