# SPDX-License-Identifier: BSD-3-Clause
"""A log of a robot that sways by 4 mm at 1.3 Hz while a joint steps and follows a torque; no FT sensor in it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.signal import lfilter

SWAY_HZ, SWAY_M = 1.3, 0.004
STEP_S, STEP_RAD = 10.0, 0.3
TORQUE_NM, OFFSET_NM = 0.5, 0.2
"""Standard deviation of the tracking error, and its mean; N m."""
RATE_HZ, DURATION_S = 100.0, 30.0

TEXT = """\
schema = "forcetorque/experiment/1"
name = "swaying"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "robot"
file = "log.csv"
stamp = { column = "t", unit = "s" }

[[recording.stream.signal]]
quantity = "scalar"
columns = ["com_x", "com_y", "still"]
units = ["m", "m", "m"]

[[recording.stream.signal]]
quantity = "position"
columns = ["q", "q_d"]
units = ["rad", "rad"]
names = ["knee", "knee_desired"]

[[recording.stream.signal]]
quantity = "torque"
columns = ["tau", "tau_d"]
units = ["N m", "N m"]
names = ["knee", "knee_desired"]

[[interval]]
label = "stand"
start_s = 0.0
use = "validation"
"""


def write_swaying(folder: Path) -> Path:
    """Write the log and its experiment file.

    Args:
        folder: Where.

    Returns:
        The experiment file.
    """
    rng = np.random.default_rng(11)
    time = np.arange(round(RATE_HZ * DURATION_S)) / RATE_HZ

    def slow(kept: float) -> np.ndarray:  # type: ignore[type-arg]
        return np.asarray(lfilter([np.sqrt(1.0 - kept**2)], [1.0, -kept], rng.standard_normal(len(time))))

    late = np.maximum(time - STEP_S, 0.0)
    position = STEP_RAD * (1.0 - np.exp(-3.0 * late) * (np.cos(6.0 * late) + 0.5 * np.sin(6.0 * late)))
    wanted = 3.0 * np.sin(1.7 * time)
    columns = {
        "t": time,
        "com_x": 0.001 * slow(0.99),
        "com_y": SWAY_M * np.cos(2.0 * np.pi * SWAY_HZ * time + 0.4) + 0.001 * slow(0.99),
        "still": np.full(len(time), 0.1),
        "q": position + 0.001 * slow(0.9),
        "q_d": np.where(time >= STEP_S, STEP_RAD, 0.0),
        "tau": wanted + OFFSET_NM + TORQUE_NM * slow(0.9),
        "tau_d": wanted,
    }
    rows = np.column_stack(list(columns.values()))
    text = "\n".join([",".join(columns), *(",".join(f"{value:.9g}" for value in row) for row in rows)])
    (folder / "log.csv").write_text(text + "\n", encoding="utf-8")
    file = folder / "swaying.toml"
    file.write_text(TEXT, encoding="utf-8")
    return file
