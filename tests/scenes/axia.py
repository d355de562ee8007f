# SPDX-License-Identifier: BSD-3-Clause
"""Experiment of a measured wrist sensor whose log needs other axes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

EXAMPLES = Path(__file__).parents[2] / "examples"


def write_axia(data_dir: Path, folder: Path, suffix: str) -> Path:
    """Poses and wrenches of the Axia, whose wrenches are in the axes of the base, as a table in those of the sensor."""
    source = data_dir / "ati_axia80_gravity_leledeyuan"
    pose = np.loadtxt(source / f"recorded_messages_pose{suffix}.txt", delimiter=",")
    wrench = np.loadtxt(source / f"recorded_messages_wrench{suffix}.txt", delimiter=",")
    base_R_sensor = Rotation.from_quat(pose[:, 3:])
    columns = [base_R_sensor.inv().apply(part) for part in (wrench[:, :3], wrench[:, 3:])]
    down = base_R_sensor.inv().apply([0.0, 0.0, -9.80665])
    rows = np.hstack([*columns, down])
    header = "fx,fy,fz,tx,ty,tz,gx,gy,gz"
    np.savetxt(folder / "poses.csv", rows, delimiter=",", header=header, comments="")
    text = (EXAMPLES / "07_wrist_payload.toml").read_text(encoding="utf-8")
    text = text.replace("../../shared/data/ati_gamma_kuka_med14_skrede", ".").replace(
        "0-calibration_fts-accel.csv", "poses.csv"
    )
    head, *_ = text.split("[[interval]]")
    path = folder / "axia.toml"
    path.write_text(f'{head}[[interval]]\nlabel = "all"\nstart_s = 0.0\nuse = "calibration"\n')
    return path
