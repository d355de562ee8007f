# SPDX-License-Identifier: BSD-3-Clause
"""Logs of a real insole, whose pressure has no clock but one rate in all of them, and of a walking robot."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.array_file.log_format import MatlabFormat
from forcetorque.formats.array_file.streams import MatlabLog
from forcetorque.formats.registry import recognised_format
from forcetorque.robot.urdf import read_urdf

pytestmark = pytest.mark.real_data

ROWS = {
    "calibration_dataset": (25435, 25339),
    "validation_dataset_1": (14542, 14658),
    "validation_dataset_2": (16883, 16883),
    "validation_dataset_3": (10572, 10916),
}
"""Messages of counts and rows of pressure."""
STATED = [
    {
        "name": "counts",
        "variable": "experiment.C",
        "time": {"column": 2, "unit": "s"},
        "sequence": 1,
        "signal": [{"quantity": "taxel_counts", "columns": [3, 282], "unit": "counts"}],
    },
    {
        "name": "chamber",
        "variable": "experiment.P",
        "rows_of": "counts",
        "shift_rows": "estimated",
        "signal": [{"quantity": "pressure", "columns": [1, 1], "unit": "bar"}],
    },
]


@pytest.mark.parametrize("name", ROWS)
def test_the_clock_of_the_pressure_is_found(data_dir: Path, name: str) -> None:
    """Rows are 20.4 ms apart, where messages are 20.5 ms and more; what has no counts is left out and counted."""
    folder = data_dir / "insole_skin_belli" / "left_insole"
    stated = MatlabLog.model_validate({"format": "matlab", "path": f"{name}.mat", "stream": STATED})
    context = ExperimentContext(experiment=folder / "x.toml", inputs=Inputs(folder), sensors={}, joint_units={})
    reading = MatlabFormat().read(stated, context)
    counts, chamber = reading.streams
    messages, rows = ROWS[name]
    assert len(counts) == messages
    assert counts.signal("taxel_counts").values.shape == (messages, 280)
    cropped = sum(finding.count for finding in reading.findings if finding.kind == "cropped")
    assert len(chamber) == rows - cropped
    period_s = (chamber.stamp_ns[-1] - chamber.stamp_ns[0]) * 1e-9 / (len(chamber) - 1)
    assert period_s == pytest.approx(0.0204, abs=5e-5)
    assert reading.findings[0].kind == "estimated_clock"
    assert chamber.signal("pressure").values.max() == pytest.approx(3.3e5, rel=0.3)


WALKING = {"com-sinusoid": 2004, "walking": 1188}
"""Rows of the logs of a walking robot."""
FEET = {
    "name": "feet",
    "variable": "lfForceZ",
    "time": {"variable": "estimatorJointsTime", "unit": "s"},
    "signal": [{"quantity": "scalar", "columns": [1, 1], "unit": "N", "names": ["left"]}],
}
JOINTS = {
    "name": "joints",
    "variable": "estimatorJointsPos",
    "time": {"variable": "estimatorJointsTime", "unit": "s"},
    "signal": [
        {"quantity": "position", "columns": [1, 26], "unit": "rad", "names": [f"joint_{k}" for k in range(26)]},
        {"quantity": "velocity", "variable": "estimatorJointsVel", "columns": [1, 26], "unit": "rad/s"},
    ],
}
SWAYING_N, WEIGHT_N = 334.9, 324.37
"""Mean of what both feet carry while the robot sways, and what its URDF weighs."""


@pytest.mark.parametrize("name", WALKING)
def test_a_walking_robot_is_read_from_hdf5(data_dir: Path, name: str) -> None:
    """MATLAB 7.3: rows are samples at 100 Hz, and both feet together carry about the weight of the URDF."""
    folder = data_dir / "icub_genova04_walking_ramadoss"
    right = FEET | {"name": "right", "variable": "rfForceZ"}
    stated = MatlabLog.model_validate({"format": "matlab", "path": f"{name}.mat", "stream": [FEET, right, JOINTS]})
    context = ExperimentContext(experiment=folder / "x.toml", inputs=Inputs(folder), sensors={}, joint_units={})
    assert isinstance(recognised_format(folder / f"{name}.mat"), MatlabFormat)
    left_foot, right_foot, joints = MatlabFormat().read(stated, context).streams
    assert len(joints) == WALKING[name]
    assert joints.signal("position").values.shape == (WALKING[name], 26)
    assert np.diff(joints.stamp_ns).mean() == pytest.approx(1e7, rel=0.02)
    feet = (left_foot.signal("scalar").values + right_foot.signal("scalar").values).mean()
    mass = sum(link.mass for link in read_urdf(folder / "model.urdf").links.values())
    assert STANDARD_GRAVITY * mass == pytest.approx(WEIGHT_N, abs=0.01)
    assert feet == pytest.approx(WEIGHT_N, rel=0.1)
    if name == "com-sinusoid":
        assert feet == pytest.approx(SWAYING_N, abs=0.05)
