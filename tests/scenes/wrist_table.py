# SPDX-License-Identifier: BSD-3-Clause
"""The table of the guide to wrist sensors: 30 static poses with a gripper, and one more after a power-up.

`python -m tests.scenes.wrist_table` writes the file that the guide reads.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY

FILE = Path(__file__).resolve().parents[2] / "docs" / "tutorial" / "wrist_poses.csv"
MASS_KG, CENTRE_M = 0.95, np.array([0.004, -0.002, 0.058])
"""The gripper, in the frame of the sensor."""
POSES, ROWS_AT_REST = 30, 12
_NOISE = np.repeat([0.05, 0.003], 3)
_BIAS = np.array([4.1, -2.6, 7.3, 0.21, -0.13, 0.05])
_BIAS_LATER = np.array([4.9, -2.2, 6.1, 0.18, -0.10, 0.07])
"""After the power-up."""


def table() -> tuple[FloatArray, FloatArray]:
    """Orientations as quaternions x y z w, and measured wrenches; shapes (n, 4) and (n, 6); N, N m."""
    rng = np.random.default_rng(11)
    turned = Rotation.from_rotvec(rng.uniform(-2.0, 2.0, (POSES, 3))).as_quat()
    at_rest = np.repeat(turned[:1], ROWS_AT_REST, axis=0)
    poses = np.vstack([turned, at_rest])
    # axes of the base, z up; the sensor measures what the gripper applies
    weight = Rotation.from_quat(poses).inv().apply([0.0, 0.0, -MASS_KG * STANDARD_GRAVITY])
    wrench = np.hstack([weight, np.cross(CENTRE_M, weight)])
    wrench += np.where(np.arange(len(poses))[:, None] < POSES, _BIAS, _BIAS_LATER)
    return poses, wrench + _NOISE * rng.normal(size=wrench.shape)


def table_text() -> str:
    """The table as CSV, whose headings state units; a row per second."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["time_s", "qx", "qy", "qz", "qw", "fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"])
    for k, (pose, wrench) in enumerate(zip(*table(), strict=True)):
        numbers = [f"{v:.6f}" for v in pose] + [f"{v:.3f}" for v in wrench[:3]] + [f"{v:.4f}" for v in wrench[3:]]
        writer.writerow([str(k), *numbers])
    return text.getvalue()


if __name__ == "__main__":
    FILE.write_text(table_text(), encoding="utf-8")
