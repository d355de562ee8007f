# SPDX-License-Identifier: BSD-3-Clause
"""A table of the vertical forces of two feet: both down, the left alone, both again."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.simulation.robots import BIPED_URDF

FILE = "standing.toml"
WEIGHT_N, PERIOD_S = 303.0, 0.02
EXPERIMENT = """\
schema = "forcetorque/experiment/1"
name = "biped, vertical forces"

[robot]
urdf = "{urdf}"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "feet_l"
file = "forces.csv"
stamp = {{ column = "t", unit = "s" }}
signal = [{{ quantity = "vertical_force", columns = ["left"], units = ["N"] }}]

[[recording.stream]]
name = "feet_r"
file = "forces.csv"
stamp = {{ column = "t", unit = "s" }}
signal = [{{ quantity = "vertical_force", columns = ["right"], units = ["N"] }}]

[[sole]]
frame = "l_sole"
stream = "feet_l"

[[sole]]
frame = "r_sole"
stream = "feet_r"

[[interval]]
label = "standing"
start_s = 0.0
use = "validation"
"""


def write_foot_forces(folder: Path, *, seed: int = 1) -> Path:
    """Write table and experiment file.

    Args:
        folder: Where to; it is there.
        seed: Of the noise.

    Returns:
        The experiment file.
    """
    rng = np.random.default_rng(seed)
    time_s = PERIOD_S * np.arange(600)
    left = np.clip(0.5 + 0.5 * np.minimum(time_s - 3.0, 9.0 - time_s), 0.5, 1.0)  # from half to all of it and back
    forces = WEIGHT_N * np.column_stack([left, 1.0 - left]) + rng.normal(0.0, 1.0, (600, 2))
    rows = "".join(f"{t:.2f},{one:.4f},{other:.4f}\n" for t, (one, other) in zip(time_s, forces, strict=True))
    (folder / "forces.csv").write_text("t,left,right\n" + rows, encoding="utf-8")
    file = folder / FILE
    file.write_text(EXPERIMENT.format(urdf=BIPED_URDF.as_posix()), encoding="utf-8")
    return file
