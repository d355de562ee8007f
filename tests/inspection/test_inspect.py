# SPDX-License-Identifier: BSD-3-Clause
"""Inspections answer in rows that are counted from the start of the recording, and show themselves."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.yarp.log_format import YarpFormat
from forcetorque.inspection import findings
from forcetorque.inspection.inspect import finding_rows, finding_table, inspect_log, inspected
from forcetorque.recording.recording import Finding, Use
from forcetorque.recording.storage import read_recording
from tests.results.showing import require_shown
from tests.scenes.experiments import FT_LOG, PARQUET, YARP, edit_lines
from tests.scenes.warm_experiments import put


def test_times_count_from_the_start_of_the_recording() -> None:
    """The earliest stamp is second 0; a finding without a time has none."""
    start = 1_700_000_000_000_000_000
    timed = Finding(
        stream="arm_ft", kind="gap", message="no sample", count=2, start_ns=start + 2 * 10**9, end_ns=start + 3 * 10**9
    )
    timeless = Finding(stream="arm_ft", kind="not_read", message="unknown", count=0)
    first, second = finding_rows(start, [timed, timeless])
    assert (first.start_s, first.end_s, first.count) == (2.0, 3.0, 2)
    assert (second.start_s, second.end_s) == (None, None)


def test_many_findings_alike_are_counted() -> None:
    """Eight of a kind and channel are shown, those of another channel beside them."""
    alike = [
        Finding(stream="arm_ft", kind="step", channel="fx", message="fx steps", count=1, start_ns=k) for k in range(11)
    ]
    other = Finding(stream="arm_ft", kind="step", channel="fy", message="fy steps", count=1, start_ns=20)
    table = finding_table(finding_rows(0, [*alike, other]), "a log")
    assert [row[2] for row in table.rows] == ["fx"] * 8 + ["fy"]


def test_an_inspection_shows_itself(arm: Path) -> None:
    """In a narrow terminal, on a page and in a cell; with the number of findings that the table leaves out."""
    edit_lines(arm / FT_LOG, lambda lines: [line for k, line in enumerate(lines) if k % 50 > 20])
    inspection = inspect_log(arm / YARP)
    require_shown(inspection)
    gaps = sum(row.kind == "gap" for row in inspection.findings)
    assert gaps > 8
    assert f"{gaps - 8} more of arm_ft: gap" in inspection.text(120)
    assert f"{len(inspection.findings)} finding(s) in" in inspection.text(120)


def test_a_dumper_folder_is_a_recording(arm: Path) -> None:
    """Every port is a stream; a port of words is a finding, and a folder of nothing else is refused."""
    port = arm / "log" / "talk"
    port.mkdir()
    (port / "data.log").write_text('0 1700000000.0 "hello"\n', encoding="utf-8")
    reading = YarpFormat().describe(arm / "log").reading
    assert {stream.name for stream in reading.streams} == {"arm/stateExt:o", "arm_ft/analog:o"}
    assert [finding.stream for finding in reading.findings if finding.kind == "not_read"] == ["talk"]
    with pytest.raises(FormatError, match=r"found 1 port\(s\) and none to read"):
        YarpFormat().describe(port)
    with pytest.raises(MissingFileError, match="expected an experiment file or the folder of a log"):
        inspect_log(arm / "nothing")


def test_jumps_of_joints_are_found_in_a_log_by_itself_and_hide_no_gap(arm: Path) -> None:
    """Nor by its experiment; what is left out for a jump is no gap."""
    joints = read_recording(arm / "recording").stream("joints")
    position = joints.signal("position")
    values = np.array(position.values)
    values[300:303, 1] += 1.5
    values[600:, 2] += 2.0 * np.pi
    values[200:205, 0] = values[301, 0] = np.nan
    put(arm, replace(joints, signals={**joints.signals, "position": replace(position, values=values)}))
    for source in (arm / "recording", arm / PARQUET):
        found = sorted((row.kind, row.count) for row in inspect_log(source).findings if row.stream == "joints")
        assert found == [("joint_spike", 1), ("joint_spike", 1), ("missing", 3), ("missing", 5)]
    values[301, 0] = position.values[301, 0]
    put(arm, replace(joints, signals={**joints.signals, "position": replace(position, values=values)}))
    kinds = [row.kind for row in inspect_log(arm / "recording").findings]
    assert kinds == ["joint_spike", "joint_spike", "missing"]


def test_a_sensor_is_compared_once_however_often_it_is_inspected(intact: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Inspection, warnings of a fit and report share what was found; negative control: another object is another."""
    compared: list[str] = []

    def counted(run: SensorRun, *given: Any) -> Any:
        compared.append(run.sensor.name)
        return against_model(run, *given)

    against_model = findings._against_model
    monkeypatch.setattr(findings, "_against_model", counted)
    experiment = load_experiment(intact / PARQUET)
    lines: list[str] = []
    first = inspected(experiment, sensors=["arm_ft"], progress=lines.append)
    found = findings.unreliable_intervals(experiment, Use.CALIBRATION, sensors=["arm_ft"])
    assert inspected(experiment).findings == first.findings
    assert compared == ["arm_ft"]
    assert lines == []  # it takes no time worth a line
    assert findings.unreliable_intervals(replace(experiment), Use.CALIBRATION) == found
    assert compared == ["arm_ft"] * 2
