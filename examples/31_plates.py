# SPDX-License-Identifier: BSD-3-Clause
"""Write C3D files of two simulated force plates: a person who stands on them, and a pole that is pressed on one.

Usage: python examples/31_plates.py [FOLDER]

Writes standing.c3d (71.5 kg, on plate 1, on plate 2, on both) and pole.c3d (plate 2, 40 pushes). Plate 2 has errors of
2 % in gains and cross-talk, and its corners are 3 mm off in the files. docs/guides/plates.md reads them.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.plates.simulated_plates import SimulatedPlate, write_pole_trial, write_standing

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Write C3D files of two simulated force plates.")
    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path("plates"), help="folder for the files; made if it does not exist"
    )
    target = parser.parse_args().folder
    target.mkdir(parents=True, exist_ok=True)
    first = SimulatedPlate.draw(np.random.default_rng(1), crosstalk=0.0, corner_error_m=0.0)
    second = SimulatedPlate.draw(np.random.default_rng(3), centre_m=(0.9, 0.4), crosstalk=0.02, corner_error_m=0.003)
    tared = [replace(plate, baseline=np.zeros(6)) for plate in (first, second)]
    write_standing(target / "standing.c3d", tared, np.random.default_rng(2), force=True)
    write_pole_trial(target / "pole.c3d", second, np.random.default_rng(4), force=True)
