# SPDX-License-Identifier: BSD-3-Clause
"""Write what a bench records of a simulated sensor: known weights, cycles of temperature, and taps of a hammer.

Usage: python examples/29_bench.py [FOLDER]

Writes weights.toml (24 positions of thesis Table 6.1, two of them swapped by mistake), recorded_again.toml (without the
mistake), warm.toml (two cycles of heating and cooling under a constant load) and taps.toml (five taps, their force
measured), each with its table. docs/guides/bench.md reads them.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from scipy.signal import cont2discrete, lfilter

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.workbench.known_loads import THESIS_TABLE, read_loads
from forcetorque.workbench.position_means import Placement
from forcetorque.workbench.simulated_benches import BenchFaults, simulate_bench

WEIGHTS = """schema = "forcetorque/bench/1"

[sensor]
name = "l_leg_ft"
serial = "SIM001"
measure_direction = "child_to_parent"   # the load acts on the sensor
full_scale = 32767.0                    # counts
prior = "nominal.txt"

[loads]
table = "thesis-6.1"

[placement]
angle_deg = 0.1
position_mm = 0.5
nonlinearity = 0.001

[measurements]
format = "rows"
file = "{name}.csv"
channels = ["ch0", "ch1", "ch2", "ch3", "ch4", "ch5"]
"""

LOG = """schema = "forcetorque/experiment/1"
name = "{name}"

[load]
frame = "ft"
{load}
measure_direction = "child_to_parent"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "log"
file = "{name}.csv"
stamp = {{ column = "t", unit = "s" }}

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "ft"

{other}
[[sensor]]
name = "wrist"
stream = "log"
serial = "FT1"
prior = "identity"
full_scale = [100.0, 100.0, 200.0, 10.0, 10.0, 10.0]

{variable}[[interval]]
label = "{name}"
start_s = 0.0
use = "calibration"
"""

TEMPERATURE = """[[recording.stream.signal]]
quantity = "temperature"
columns = ["T"]
units = ["degC"]
"""

APPLIED = """[[recording.stream.signal]]
quantity = "applied_wrench"
columns = ["hx", "hy", "hz", "htx", "hty", "htz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "ft"
"""

PER_DEGREE = np.array([0.5, -0.3, 2.0, 0.02, 0.01, -0.01])
"""Drift of the sensor in the chamber; N/degC, N m/degC."""
NATURAL_HZ, DAMPING, GAIN, RATE_HZ, FINER = 32.0, 0.04, 0.95, 500.0, 16
"""The tapped sensor, its rate, and steps of the simulation per sample."""


def write_weights(folder: Path, name: str, faults: BenchFaults) -> None:
    """Write a workbench file with a table of means."""
    loads = read_loads(THESIS_TABLE, measure_direction=MeasureDirection.CHILD_TO_PARENT)
    placement = Placement(angle_rad=np.deg2rad(0.1), position_m=0.5e-3, nonlinearity=1e-3)
    bench = simulate_bench(loads, placement, np.random.default_rng(1), faults=faults, with_prior=True).bench
    if bench.prior is not None:
        write_matrix_file(folder / "nominal.txt", encode_matrix(bench.prior))
    write_table(folder / f"{name}.csv", [f"ch{k}" for k in range(6)], bench.raw)
    (folder / f"{name}.toml").write_text(WEIGHTS.format(name=name), encoding="utf-8")


def write_warm(folder: Path) -> None:
    """Write two hours in a chamber: two even cycles of 20 degC, a sample every 5 s."""
    rng = np.random.default_rng(2)
    time = np.arange(0.0, 7200.0, 5.0)
    phase = time / 3600.0 % 1.0
    degrees = 20.0 + 20.0 * np.where(phase < 0.5, 2.0 * phase, 2.0 - 2.0 * phase)
    noise = 0.1 * np.array([1.0, 1.0, 1.0, 0.05, 0.05, 0.05]) * rng.normal(size=(len(time), 6))
    reading = [10.0, 5.0, 20.0, 1.0, 1.0, 1.0] + np.outer(degrees, PER_DEGREE) + noise
    write_table(
        folder / "warm.csv", ["t", "fx", "fy", "fz", "tx", "ty", "tz", "T"], np.column_stack([time, reading, degrees])
    )
    load = 'motion = ["log"]\nmass_kg = 0.5\ncentre_of_mass_m = [0.0, 0.0, 0.05]'
    variable = '[[sensor.variable]]\nname = "temperature"\n\n'
    text = LOG.format(name="warm", load=load, other=TEMPERATURE, variable=variable)
    (folder / "warm.toml").write_text(text, encoding="utf-8")


def write_taps(folder: Path) -> None:
    """Write five taps along z on a sensor that rings, with the force of the hammer."""
    rng = np.random.default_rng(3)
    time = np.arange(round(8.1 * RATE_HZ * FINER)) / (RATE_HZ * FINER)
    force = np.zeros(len(time))
    for k in range(5):
        phase = (time - 0.5 - 1.5 * k) / 0.006
        force += np.where((phase > 0.0) & (phase < 1.0), rng.uniform(20.0, 50.0) * np.sin(np.pi * phase) ** 2, 0.0)
    w = 2.0 * np.pi * NATURAL_HZ
    system = ([GAIN * w**2], [1.0, 2.0 * DAMPING * w, w**2])
    (numerator,), denominator, _ = cont2discrete(system, 1.0 / (RATE_HZ * FINER), method="foh")
    reading = lfilter(numerator, denominator, force)[::FINER]
    wrench, applied = (np.zeros((len(reading), 6)) for _ in range(2))
    wrench[:, 2], applied[:, 2] = reading, force[::FINER]
    wrench += 0.05 * np.array([1.0, 1.0, 1.0, 0.05, 0.05, 0.05]) * rng.normal(size=wrench.shape)
    applied[:, 2] += 0.02 * rng.normal(size=len(reading))
    names = ["t", "fx", "fy", "fz", "tx", "ty", "tz", "hx", "hy", "hz", "htx", "hty", "htz"]
    write_table(folder / "taps.csv", names, np.column_stack([time[::FINER], wrench, applied]))
    text = LOG.format(name="taps", load='applied = "log"', other=APPLIED, variable="")
    (folder / "taps.toml").write_text(text, encoding="utf-8")


def write_table(file: Path, names: list[str], rows: FloatArray) -> None:
    """Write a table as CSV with its headings."""
    np.savetxt(file, rows, delimiter=",", header=",".join(names), comments="", fmt="%.9g")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Write what a bench records of a simulated sensor.")
    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path("bench"), help="folder for the files; made if it does not exist"
    )
    target = parser.parse_args().folder
    target.mkdir(parents=True, exist_ok=True)
    write_weights(target, "weights", BenchFaults(swapped=(3, 8)))  # positions 4 and 9
    write_weights(target, "recorded_again", BenchFaults())
    write_warm(target)
    write_taps(target)
