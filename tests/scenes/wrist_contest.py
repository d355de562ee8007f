# SPDX-License-Identifier: BSD-3-Clause
"""Files of a contest of a wrist sensor: runs under stated masses, and runs in which another sensor says the load."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

CENTRE, GRAVITY, POSES = np.array([0.01, -0.02, 0.08]), 9.80665, 240
NOISE = np.array([0.02, 0.02, 0.02, 0.002, 0.002, 0.002])

EXPERIMENT = """\
schema = "forcetorque/experiment/1"
name = "{name}"

[load]
frame = "tool"
measure_direction = "child_to_parent"
{load}

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "poses"
file = "{name}.csv"
stamp = "row"

[[recording.stream.signal]]
quantity = "wrench"
columns = ["a", "b", "c", "d", "e", "f"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "tool"

[[recording.stream.signal]]
quantity = "{reference}"
columns = [{columns}]
units = [{units}]
frame = "tool"

[[sensor]]
name = "wrist"
stream = "poses"
serial = "FT1"
prior = "identity"
full_scale = [100.0, 100.0, 200.0, 10.0, 10.0, 10.0]

[[interval]]
label = "{name}"
start_s = 0
use = "{use}"
"""

CONTEST = """\
schema = "forcetorque/contestants/1"
name = "wrist"
phases = 60
{runs}
[[contestant]]
name = "as bought"
sensor = "wrist"
method = "maker"
full_scale = [100.0, 100.0, 200.0, 10.0, 10.0, 10.0]

[[contestant]]
name = "masses"
sensor = "wrist"
method = "known-masses"

[[contestant]]
name = "reference"
sensor = "wrist"
method = "reference-sensor"
"""


def _gravity() -> np.ndarray:
    """Still poses along a spiral up and down the sphere; m/s2."""
    height, angle = 0.95 * np.sin(np.linspace(0.0, 5.0, POSES)), np.linspace(0.0, 8.0 * np.pi, POSES)
    across = np.sqrt(1.0 - height**2)
    return GRAVITY * np.column_stack([across * np.cos(angle), across * np.sin(angle), height])


def write_run(folder: Path, name: str, mass: float, *, applied: bool, use: str, seed: int) -> None:
    """An experiment file and its table."""
    rng, gravity = np.random.default_rng(seed), _gravity()
    true = np.hstack([mass * gravity, np.cross(CENTRE, mass * gravity)])
    wrong = np.eye(6) + 0.05 * np.diag(np.random.default_rng(9).uniform(0.5, 1.5, 6))
    read = true @ wrong.T + rng.normal(size=6) + NOISE * rng.standard_normal(true.shape)
    known = true if applied else gravity
    names = [f"u{k}" for k in range(known.shape[1])]
    rows = [",".join(f"{value:.9g}" for value in row) for row in np.hstack([read, known])]
    (folder / f"{name}.csv").write_text("\n".join([",".join(["a,b,c,d,e,f", *names]), *rows]) + "\n")
    load = f'motion = ["poses"]\nmass_kg = {mass}\ncentre_of_mass_m = {CENTRE.tolist()}'
    units = ["N"] * 3 + ["N m"] * 3 if applied else ["m/s2"] * 3
    (folder / f"{name}.toml").write_text(
        EXPERIMENT.format(
            name=name,
            load='applied = "poses"' if applied else load,
            reference="applied_wrench" if applied else "gravity",
            columns=", ".join(f'"{column}"' for column in names),
            units=", ".join(f'"{unit}"' for unit in units),
            use=use,
        )
    )


def write_contest(folder: Path, runs: Mapping[str, float]) -> Path:
    """The file of the contest, with runs by name and load."""
    tables = "".join(f'\n[[run]]\nexperiment = "{name}.toml"\nload_kg = {kg}\n' for name, kg in runs.items())
    path = folder / "contest.toml"
    path.write_text(CONTEST.format(runs=tables))
    return path


def write_runs(folder: Path) -> None:
    """Runs to fit on by masses and by a reference sensor, and runs that judge by either."""
    write_run(folder, "masses", 1.0, applied=False, use="calibration", seed=1)
    write_run(folder, "applied", 4.0, applied=True, use="calibration", seed=2)
    write_run(folder, "judge", 2.0, applied=False, use="validation", seed=3)
    write_run(folder, "judge_applied", 3.0, applied=True, use="validation", seed=4)
