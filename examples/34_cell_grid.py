# SPDX-License-Identifier: BSD-3-Clause
"""Write a simulated grid of capacitive cells: its layout, a plate of weights on all cells twice, weights on some.

Usage: python examples/34_cell_grid.py [FOLDER]

Writes grid.csv (layout), plate.csv and again.csv (weights on a plate that covers the grid), weights.csv (four weights,
one after the other) and an experiment file for each log. docs/guides/cells.md reads them.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY

SIDE, PITCH_M, RATE_HZ = 10, 0.008, 50.0
AREA_M2 = (SIDE * PITCH_M) ** 2
PLATE_KG = (0.0, 2.0, 4.0, 8.0, 12.0, 8.0, 4.0, 2.0, 0.0)
HOLD_S = 4.0
DISCS = ((0.5, -0.012, 0.010), (1.0, 0.013, -0.008), (1.5, 0.0, 0.012), (2.0, 0.005, -0.003))
"""Mass of each weight, kg, and where its middle is put; m."""
DISC_RADIUS_M, COVER_M = 0.02, 0.002
"""Radius of the weights, and over how much the soft cover spreads their edge."""
EXPERIMENT = """schema = "forcetorque/experiment/1"
name = "{name}"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "cells"
file = "{name}.csv"
stamp = {{ column = "t", unit = "s" }}
signal = [
  {{ quantity = "taxel_counts", columns = [{columns}], units = [{units}] }},
{pressure}]

[[patch]]
name = "palm"
counts = "cells"
{patch}

[[interval]]
label = "{name}"
start_s = 0.0
use = "{use}"
"""


def as_counts(raw: FloatArray, rest: FloatArray) -> FloatArray:
    """Counts of 8 bits that fall from 240, of 12 bits that rise from rest: what the commands expect."""
    return 240.0 - (raw - rest) / 16.0


def raw_of(pressure_pa: FloatArray, rng: np.random.Generator, gain: FloatArray) -> FloatArray:
    """What the electronics send: 12 bits that rise with pressure, bent, noisy, from another level in each cell."""
    share = pressure_pa / 20e3
    level = 700.0 + 20.0 * np.arange(SIDE**2) / SIDE + 950.0 * gain * share * 1.3 / (1.0 + 0.3 * share)
    return np.rint(level + rng.normal(0.0, 3.0, level.shape))


def write_log(folder: Path, name: str, seconds: FloatArray, counts: FloatArray, pressure_pa: FloatArray | None) -> None:
    """Write time, cells and, where it is known, the pressure on all of them."""
    names = [f"c{k}" for k in range(SIDE**2)]
    with (folder / f"{name}.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["t", *names, *([] if pressure_pa is None else ["p"])])
        for row, values in enumerate(counts.tolist()):
            own = [] if pressure_pa is None else [f"{pressure_pa[row]:.1f}"]
            writer.writerow([f"{seconds[row]:.3f}", *(f"{value:.4f}" for value in values), *own])
    known = pressure_pa is not None
    text = EXPERIMENT.format(
        name=name,
        columns=", ".join(f'"{name}"' for name in names),
        units=", ".join(['"counts"'] * len(names)),
        pressure='  { quantity = "pressure", columns = ["p"], units = ["Pa"] },\n' if known else "",
        patch='pressure = "cells"' if known else 'layout = "grid.csv"',
        use="calibration" if name == "plate" else "validation",
    )
    (folder / f"{name}.toml").write_text(text, encoding="utf-8")


def main(folder: Path) -> None:
    """Write all files."""
    rng = np.random.default_rng(3)
    folder.mkdir(parents=True, exist_ok=True)
    row, column = np.divmod(np.arange(SIDE**2), SIDE)
    places = PITCH_M * (np.stack([column, row], axis=1) - 0.5 * (SIDE - 1))
    layout = ["# patch: palm", "# frame: gripper", f"# columns: {SIDE**2}", "column,module,x_mm,y_mm,z_mm,nx,ny,nz"]
    layout += [f"{k},0,{1e3 * x:g},{1e3 * y:g},0,0,0,1" for k, (x, y) in enumerate(places)]
    (folder / "grid.csv").write_text("\n".join(layout) + "\n", encoding="utf-8")
    gain = np.exp(rng.normal(0.0, 0.15, SIDE**2))
    for name in ("plate", "again"):
        seconds = np.arange(round(len(PLATE_KG) * HOLD_S * RATE_HZ)) / RATE_HZ
        mass = np.interp(seconds % HOLD_S, [0.0, 1.0], [0.0, 1.0])
        step = (seconds // HOLD_S).astype(int)
        before = np.array([0.0, *PLATE_KG])[step]
        mass = before + mass * (np.array(PLATE_KG)[step] - before)  # each is put on within a second
        pressure = mass * STANDARD_GRAVITY / AREA_M2
        raw = raw_of(pressure[:, None] * np.ones(SIDE**2), rng, gain)
        write_log(folder, name, seconds, as_counts(raw, raw[:50].mean(axis=0)), pressure)
    seconds = np.arange(round((3.0 + len(DISCS) * 4.0) * RATE_HZ)) / RATE_HZ
    pressure_on = np.zeros((len(seconds), SIDE**2))
    for k, (mass_kg, x, y) in enumerate(DISCS):
        inside = DISC_RADIUS_M - np.linalg.norm(places - [x, y], axis=1)
        spread = np.clip(0.5 + inside / (2.0 * COVER_M), 0.0, 1.0)
        held = (seconds > 3.0 + 4.0 * k) & (seconds < 5.0 + 4.0 * k)
        pressure_on[held] = mass_kg * STANDARD_GRAVITY / (np.pi * DISC_RADIUS_M**2) * spread
    raw = raw_of(pressure_on, rng, gain)
    write_log(folder, "weights", seconds, as_counts(raw, raw[:50].mean(axis=0)), None)
    loads = ", ".join(f"{mass * STANDARD_GRAVITY:.1f} N" for mass, _, _ in DISCS)
    print(f"written to {folder}; the weights press with {loads}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Write a simulated grid of capacitive cells with its logs.")
    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path("cells"), help="folder for the files; made if it does not exist"
    )
    main(parser.parse_args().folder)
