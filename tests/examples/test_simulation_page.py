# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of docs/simulation.md on both feet, and on contact switching, run and give what their comments say."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

PAGE = Path(__file__).resolve().parents[2] / "docs" / "simulation.md"


def _names_after(heading: str) -> dict[str, Any]:
    """What the first script below a heading leaves."""
    pattern = rf"^## {heading}$.*?^```python\n(.*?)^```$"
    code = re.findall(pattern, PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)[0]
    names: dict[str, Any] = {}
    exec(code, names)
    return names


@pytest.mark.long
def test_the_script_on_contact_switching_runs() -> None:
    """Nothing is left of a reading but error and bias, and the share of the left foot goes from all to nothing."""
    names = _names_after("Contact switching")
    assert np.abs(names["left"]).max() < 1e-6
    assert np.abs(names["read"] - names["true"]).max() > 10.0  # negative control
    share = names["share"]
    assert share[0] == 1.0
    assert abs(share[-1]) < 1e-9
    assert 0.4 < np.median(share) < 0.6


def test_the_script_on_both_feet_runs() -> None:
    """Joints, loads, contacts and the IMU come at every instant, and a foot is in the air at times."""
    names = _names_after("Both feet on the ground")
    samples = len(names["seconds"])
    assert samples == 2000
    assert names["joints"].position.shape == (samples, 22)
    assert names["loads"].values.shape == (samples, 6, 6)
    assert names["imu"].proper_acceleration.shape == (samples, 3)
    bearing = np.abs(names["ground"].values).max(axis=2) > 0.0
    assert 0.2 < np.mean(~bearing[:, 0]) < 0.4
    assert bearing.any(axis=1).all()
