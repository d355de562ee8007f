# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate a simulated sensor whose true matrix is known: the whole path in one script.

Usage: python examples/01_known_truth.py FOLDER

Makes a recording of a small arm that ships with the library, an experiment file and the sensor's
factory matrix, runs `forcetorque calibrate` and `forcetorque evaluate` on them, and compares the
factory matrix and the new one with the truth, also under pushes that were never recorded.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

from forcetorque.experiment.calibration.artefact import read_calibration
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.recording.storage import write_recording
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.simulation.sensor import SimulatedSensor, distorted_by_mounting, y_shaped_matrix
from forcetorque.simulation.trace import simulate_recording

EXPERIMENT = """\
schema = "forcetorque/experiment/1"
name = "arm with known truth"

[robot]
urdf = "arm.urdf"

[recording]
format = "parquet"
path = "recording"

[[sensor]]
name = "arm_ft"
stream = "arm_ft"
serial = "SIM001"
prior = "matrix_SIM001.txt"

[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]

[[interval]]
label = "fit"
start_s = 1.0
end_s = 59.0
use = "calibration"
support = "base"

[[interval]]
label = "judge"
start_s = 61.0
end_s = 119.0
use = "validation"
support = "base"
"""


def main(folder: Path) -> None:
    """Make the data, run the two commands, print what they found against the truth."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(7)
    factory = y_shaped_matrix(arm_m=0.02, counts_per_newton=60.0)
    mounted = distorted_by_mounting(factory, relative=0.05, rng=rng)
    offset = np.array([8.0, -5.0, 20.0, 0.3, -0.2, 0.1])
    sensor = SimulatedSensor(matrix=mounted, offset=offset, noise_counts=4.0)
    model = read_urdf(ARM_URDF)
    recording = simulate_recording(
        model,
        {"arm_ft": sensor},
        support="base",
        gravity_direction=[0.0, 0.0, -1.0],
        ranges={joint: (-2.2, 2.2) for joint in model.joints if model.joints[joint].type.moves},
        duration_s=120.0,
        rate_hz=100.0,
        slowest_hz=0.05,
        seed=11,
    )
    write_recording(folder / "recording", recording)
    write_matrix_file(folder / "matrix_SIM001.txt", encode_matrix(factory))
    shutil.copyfile(ARM_URDF, folder / "arm.urdf")
    (folder / "experiment.toml").write_text(EXPERIMENT, encoding="utf-8")

    command = [sys.executable, "-m", "forcetorque"]
    experiment, result = str(folder / "experiment.toml"), str(folder / "calibration.json")
    subprocess.run([*command, "calibrate", experiment, "-o", result], check=True)
    fitted = read_calibration(result)
    print("error against the true matrix, per row, relative to the row:")
    for name, matrix in (("prior", factory), ("new", fitted.matrix)):
        relative = np.linalg.norm(matrix - mounted, axis=1) / np.linalg.norm(mounted, axis=1)
        print(f"  {name:6s}" + "".join(f"{100 * value:8.2f} %" for value in relative), flush=True)
    subprocess.run([*command, "evaluate", experiment, "--calibration", result], check=True)

    rng = np.random.default_rng(3)
    force, point = rng.normal(size=(2, 1000, 3))
    force *= 50.0 / np.linalg.norm(force, axis=1, keepdims=True)
    point *= 0.3 * rng.uniform(size=(1000, 1)) / np.linalg.norm(point, axis=1, keepdims=True)
    push = np.hstack([force, np.cross(point, force)])
    print("a push of 50 N, up to 0.3 m from the sensor, that was not recorded reads wrong by, in the mean:")
    for name, matrix in (("prior", factory), ("new", fitted.matrix)):
        error = push @ (matrix @ np.linalg.inv(mounted) - np.eye(6)).T
        in_force, in_moment = (np.linalg.norm(error[:, part], axis=1).mean() for part in (slice(3), slice(3, 6)))
        print(f"  {name:6s}{in_force:8.3f} N{in_moment:10.4f} N m")
    print(f"files in {folder}: recording/, experiment.toml, matrix_SIM001.txt, calibration.json")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
