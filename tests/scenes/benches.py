# SPDX-License-Identifier: BSD-3-Clause
"""Files of a simulated sensor on a workbench."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.workbench.known_loads import THESIS_TABLE, BenchLoads, read_loads
from forcetorque.workbench.position_means import Placement
from forcetorque.workbench.simulated_benches import BenchFaults, SimulatedBench, simulate_bench

PLACEMENT = Placement(angle_rad=np.deg2rad(0.1), position_m=0.5e-3, nonlinearity=1e-3)
"""How well weights hang: 0.1 degrees, 0.5 mm, 0.1 %."""
BLOCK_ROWS = 40

BENCH = """schema = "forcetorque/bench/1"

[sensor]
name = "l_leg_ft"
serial = "{serial}"
measure_direction = "child_to_parent"
full_scale = 32767.0
prior = "nominal.txt"

[loads]
table = "thesis-6.1"

[placement]
angle_deg = 0.1
position_mm = 0.5
nonlinearity = 0.001

[measurements]
format = "blocks"
files = "{serial}_output{{}}.dat"
delimiter = " "
columns = ["index", "ch0", "ch1", "ch2", "ch3", "ch4", "ch5"]
channels = ["ch0", "ch1", "ch2", "ch3", "ch4", "ch5"]
block_rows = 40
"""


def thesis_loads() -> BenchLoads:
    """The 24 positions."""
    return read_loads(THESIS_TABLE, measure_direction=MeasureDirection.CHILD_TO_PARENT)


def write_bench(
    folder: Path,
    *,
    serial: str = "SIM001",
    seed: int = 1,
    faults: BenchFaults | None = None,
    positions: int = 24,
) -> tuple[Path, SimulatedBench]:
    """Write a workbench file with a file of two blocks, bias and load, per position, as a board would count them."""
    rng = np.random.default_rng(seed)
    specimen = simulate_bench(thesis_loads(), PLACEMENT, rng, faults=faults, serial=serial, with_prior=True)
    bench = specimen.bench
    assert bench.prior is not None
    write_matrix_file(folder / "nominal.txt", encode_matrix(bench.prior))
    offset = rng.uniform(-4000.0, 4000.0, 6)
    for k in range(positions):
        offset = offset + rng.normal(0.0, 3.0, 6)  # it wanders from one position to the next
        blocks = np.repeat([offset, offset + bench.raw[k]], BLOCK_ROWS, axis=0)
        counts = np.rint(blocks + rng.standard_normal(blocks.shape)).astype(int)
        rows = np.column_stack([np.arange(len(counts)), counts])
        np.savetxt(folder / f"{serial}_output{k + 1}.dat", rows, fmt="%d")
    path = folder / f"{serial}.toml"
    path.write_text(BENCH.format(serial=serial), encoding="utf-8")
    return path, specimen
