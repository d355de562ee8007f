# SPDX-License-Identifier: BSD-3-Clause
"""The script of docs/simulation.md on both feet runs, and gives what its comments say."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

PAGE = Path(__file__).resolve().parents[2] / "docs" / "simulation.md"


def test_the_script_on_both_feet_runs() -> None:
    """Joints, loads, contacts and the IMU come at every instant, and a foot is in the air at times."""
    (code,) = re.findall(
        r"^## Both feet on the ground$.*?^```python\n(.*?)^```$",
        PAGE.read_text(encoding="utf-8"),
        re.DOTALL | re.MULTILINE,
    )
    names: dict[str, Any] = {}
    exec(code, names)
    samples = len(names["seconds"])
    assert samples == 2000
    assert names["joints"].position.shape == (samples, 22)
    assert names["loads"].values.shape == (samples, 6, 6)
    assert names["imu"].proper_acceleration.shape == (samples, 3)
    bearing = np.abs(names["ground"].values).max(axis=2) > 0.0
    assert 0.2 < np.mean(~bearing[:, 0]) < 0.4
    assert bearing.any(axis=1).all()
