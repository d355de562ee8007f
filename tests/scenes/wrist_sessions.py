# SPDX-License-Identifier: BSD-3-Clause
"""A wrist sensor that turns a known tool in two sessions, between which its offset changed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from tests.scenes.wrist_postures import BIAS, CENTRE, MASS, TEXT, WHITE

SECOND_OFFSET = np.array([0.0, 0.0, 2.0, 0.0, 0.0, 0.0])
"""What the second session reads more; N, N m."""
SESSION_S, RATE_HZ = 60.0, 5.0


def write_sessions(folder: Path) -> Path:
    """Write the log and its experiment file, whose two intervals are two sessions."""
    rng = np.random.default_rng(31)
    time = np.arange(int(2.0 * SESSION_S * RATE_HZ) + 1) / RATE_HZ
    turned = Rotation.from_rotvec(
        np.column_stack([np.sin(0.31 * time), 1.2 * np.sin(0.23 * time + 1.0), 0.5 * np.sin(0.17 * time)])
    )
    force = turned.inv().apply([0.0, 0.0, -9.80665 * MASS])
    wrench = np.hstack([force, np.cross(CENTRE, force)]) + BIAS + WHITE * rng.normal(size=(len(time), 6))
    wrench += np.where(time[:, None] >= SESSION_S, SECOND_OFFSET, 0.0)
    columns = np.column_stack([time, wrench, turned.as_quat()[:, [3, 0, 1, 2]]])
    header = "t,fx,fy,fz,tx,ty,tz,qw,qx,qy,qz"
    np.savetxt(folder / "log.csv", columns, delimiter=",", header=header, comments="", fmt="%.9g")
    head = TEXT[: TEXT.index("[[interval]]")].replace('name = "two postures"', 'name = "two sessions"')
    path = folder / "days.toml"
    path.write_text(head + _interval("monday", 0.0, SESSION_S) + _interval("friday", SESSION_S, 2.0 * SESSION_S))
    return path


def _interval(session: str, start_s: float, end_s: float) -> str:
    return (
        f'[[interval]]\nlabel = "{session}"\nstart_s = {start_s}\nend_s = {end_s}\nuse = "calibration"\n'
        f'session = "{session}"\n\n'
    )
