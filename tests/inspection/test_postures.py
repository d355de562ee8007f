# SPDX-License-Identifier: BSD-3-Clause
"""Postures in which a sensor begins to disagree with the model are those of the log, by joints that matter to it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.experiment.loading import load_experiment
from forcetorque.inspection.unexplained_postures import posture_tables, unexplained_postures
from forcetorque.recording.recording import Finding
from forcetorque.results.table import Table
from tests.scenes.experiments import PARQUET, write_experiments


def test_a_posture_is_that_of_the_log_when_the_finding_begins(tmp_path: Path) -> None:
    """In degrees in the table; a fault of the stream, or one of another sensor, has none."""
    write_experiments(tmp_path)
    experiment = load_experiment(tmp_path / PARQUET)
    recording = experiment.recording
    row = len(recording.stream("joints")) // 2
    start_ns = int(recording.stream("joints").stamp_ns[row])
    step = Finding(
        stream="arm_ft", kind="step", message="", count=1, start_ns=start_ns, size=5.0, unit="N", sensor="arm_ft"
    )
    gap = Finding(stream="arm_ft", kind="gap", message="", count=1, start_ns=start_ns, sensor="arm_ft")
    other = Finding(stream="arm_ft", kind="step", message="", count=1, start_ns=start_ns, sensor="other_ft")
    (posture,) = unexplained_postures(experiment, [gap, step, other])
    assert (posture.sensor, posture.kind, posture.size) == ("arm_ft", "step", 5.0)
    assert posture.time_s == 1e-9 * (start_ns - recording.start_ns)
    logged = {
        joint: float(signal.column(joint)[row]) for joint, (_, signal) in recording.joint_signals("position").items()
    }
    assert posture.joints
    assert {joint.joint: joint.position for joint in posture.joints}.items() <= logged.items()
    (table,) = posture_tables([posture])
    assert isinstance(table, Table)
    assert table.headings[3] == f"{posture.joints[0].joint}, deg"
    assert table.rows[0][3] == f"{np.degrees(logged[posture.joints[0].joint]):.1f}"
