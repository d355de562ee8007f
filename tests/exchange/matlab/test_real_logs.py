# SPDX-License-Identifier: BSD-3-Clause
"""Logs of a real insole: the pressure, which has no clock and other numbers of rows, has one rate in all of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.exchange.matlab import MatlabFormat, MatlabLog
from forcetorque.experiment.inputs import Inputs
from forcetorque.experiment.log_context import ExperimentContext

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
