# SPDX-License-Identifier: BSD-3-Clause
"""The Python of docs/estimation/estimation.md runs as it stands."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.robot.motion import RootMotion
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import icub, random_motion

DOCUMENT = Path(__file__).parents[3] / "docs" / "estimation" / "estimation.md"


def test_the_documented_question_is_answered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a robot, a motion and readings, the block gives a contact, a torque and a residual per sample."""
    shutil.copyfile(icub("iCubGazeboV2_7"), tmp_path / "robot.urdf")
    monkeypatch.chdir(tmp_path)
    (block,) = re.findall(r"```python\n(.*?)```", DOCUMENT.read_text(encoding="utf-8"), re.DOTALL)
    down = np.array([0.0, 0.0, -1.0])
    names: dict[str, Any] = {
        "joints": random_motion(read_urdf("robot.urdf"), samples=5, seed=1),
        "root": RootMotion.fixed(down),
        "readings": {"l_leg_ft": np.ones((5, 6)), "r_leg_ft": np.ones((5, 6))},
    }
    exec(compile(block, DOCUMENT.name, "exec"), names)
    answer = names["answer"]
    assert answer.contact("l_sole").shape == (5, 6)
    assert answer.torque("l_knee").shape == (5,)
    assert np.abs(answer.residual_of("l_leg_ft")).max() < 1e-9
