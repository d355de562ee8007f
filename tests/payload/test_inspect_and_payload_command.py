# SPDX-License-Identifier: BSD-3-Clause
"""`inspect` finds the faults that were put into a log and those of a real one; `payload` weighs a wrist's load."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.payload.identify import weigh_load
from forcetorque.recording.storage import read_recording, write_recording
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.results.showing import require_shown
from tests.scenes.experiments import FT_LOG, MOUNTED, PARQUET, RATE_HZ, YARP, edit_lines
from tests.scenes.wrist_postures import write_postures

POSTURES = Rotation.random(8, random_state=4)
EXAMPLES = Path(__file__).parents[2] / "examples"


def _kinds(result: dict[str, Any]) -> set[str]:
    return {finding["kind"] for finding in result["findings"]}


def _of(result: dict[str, Any], kind: str, channel: str | None = None) -> list[dict[str, Any]]:
    found = result["findings"]
    return [f for f in found if f["kind"] == kind and (channel is None or f["channel"] == channel)]


@pytest.mark.parametrize("what", [PARQUET, "recording"])
def test_a_clean_recording_has_no_findings(arm: Path, run: Run, what: str) -> None:
    """The simulated arm has nothing to report, by its experiment and by its folder."""
    result = run("inspect", arm / what, "--format", "json").result()
    assert result["findings"] == []
    assert result["schema"] == "forcetorque/inspect/3"
    joints = result["streams"]["joints"]
    assert joints["samples"] > 1000
    assert joints["rate_hz"] == pytest.approx(RATE_HZ, rel=0.01)
    assert joints["holds"][0].startswith("position x ")


def test_faults_of_a_stream_are_found_with_time_and_size(arm: Path, run: Run) -> None:
    """Lost messages with the gap they leave, and a frozen reading."""

    def damage(lines: list[str]) -> list[str]:
        lost = lines[:200] + lines[230:]
        words = lost[500].split()
        frozen = [" ".join([*line.split()[:2], *words[2:]]) + "\n" for line in lost[500:600]]
        return [*lost[:500], *frozen, *lost[600:]]

    edit_lines(arm / FT_LOG, damage)
    result = run("inspect", arm / YARP, "--format", "json").result()
    (gap,), (lost,), (frozen,) = (_of(result, kind) for kind in ("gap", "lost_messages", "frozen"))
    assert gap["size"] == pytest.approx(0.62, abs=0.03)
    assert (lost["size"], lost["unit"]) == (30.0, "messages")
    assert frozen["size"] == pytest.approx(2.0, abs=0.1)
    assert frozen["start_s"] == pytest.approx(530 / RATE_HZ, abs=0.1)


def test_steps_and_saturation_are_found_with_time_and_size(arm: Path, run: Run) -> None:
    """A reading that steps by 15 N at 16.6 s, and a channel at its limit, where the prior is right."""
    write_matrix_file(arm / "matrix_SIM001.txt", encode_matrix(MOUNTED))
    recording = read_recording(arm / "recording")
    stream = recording.stream("arm_ft")
    raw = np.array(stream.signal("raw").values)
    raw[830:] += np.linalg.solve(MOUNTED, [15.0, 0, 0, 0, 0, 0])
    raw[100:103, 4] = -32767
    damaged = replace(stream, signals={"raw": replace(stream.signal("raw"), values=np.rint(raw))})
    write_recording(arm / "recording", replace(recording, streams={**recording.streams, "arm_ft": damaged}))
    result = run("inspect", arm / PARQUET, "--format", "json").result()
    (step,) = _of(result, "step")
    assert (step["channel"], step["size"]) == ("fx", pytest.approx(15.0, abs=2.0))
    assert step["start_s"] == pytest.approx(830 / RATE_HZ, abs=0.4)
    (saturation,) = _of(result, "saturation")
    assert (saturation["channel"], saturation["count"], saturation["size"]) == ("ch4", 3, 32767.0)
    assert "recovered" not in saturation["message"]


def test_a_folder_of_a_dumper_needs_no_experiment(arm: Path, run: Run) -> None:
    """Every port is found and read by what it holds."""
    result = run("inspect", arm / "log", "--format", "json").result()
    assert set(result["streams"]) == {"arm/stateExt:o", "arm_ft/analog:o"}
    assert _kinds(result) == {"not_estimated"}


def test_rows_and_table_say_the_same(arm: Path, run: Run) -> None:
    """CSV has one row per finding, the table ends with their number."""
    rows = run("inspect", arm / "log", "--format", "csv").rows()
    assert [row["kind"] for row in rows] == ["not_estimated"] * 2
    shown = run("inspect", arm / "log", "--details")
    assert shown.code == 0
    assert "2 finding(s)" in shown.out


def test_nothing_to_inspect_is_an_error(arm: Path, run: Run) -> None:
    """A missing path and a folder without a log."""
    assert "expected an experiment file or the folder of a log" in run("inspect", arm / "nothing").error()
    (arm / "empty").mkdir()
    assert "expected ports with data.log" in run("inspect", arm / "empty").error()


@pytest.mark.real_data
@some_cases("example", ["02_icub_yoga_forward.toml", "04_icub_yoga_quiet.toml"])
def test_the_yoga_log_tells_its_story(run: Run, data_dir: Path, tmp_path: Path, example: str) -> None:
    """Contact before 17 s and after 62 s, steps of fx at 22.5 and 58.5 s, fy off at 24-30 s, nothing in 32-58 s."""
    path = tmp_path / example
    text = (EXAMPLES / example).read_text(encoding="utf-8")
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    result = run("inspect", path, "--format", "json").result()
    first, last = _of(result, "contact")
    assert first["start_s"] < 1.0
    assert first["end_s"] == pytest.approx(17.0, abs=0.7)
    assert last["start_s"] == pytest.approx(62.0, abs=0.7)
    assert last["end_s"] > 70.0
    steps = [(f["start_s"], f["size"]) for f in _of(result, "step", "fx") if abs(f["size"]) > 15.0]
    assert len(steps) == 2
    np.testing.assert_allclose([time for time, _ in steps], [22.5, 58.5], atol=0.6)
    assert steps[0][1] < 0.0 < steps[1][1]
    (fy,) = [f for f in _of(result, "off_level", "fy") if f["start_s"] < 40.0]
    assert fy["start_s"] < 24.0
    assert fy["end_s"] > 29.0
    assert fy["size"] == pytest.approx(8.5, abs=1.0)
    timed = [f for f in result["findings"] if f["kind"] != "not_estimated"]
    assert not [f for f in timed if f["start_s"] < 58.0 and f["end_s"] > 32.0]


@pytest.mark.long
@pytest.mark.real_data
def test_calibrate_warns_of_doubtful_samples(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """What inspect finds inside a fitted interval is a warning; the quiet part has none."""
    warned = {}
    for example in ("02_icub_yoga_forward.toml", "04_icub_yoga_quiet.toml"):
        path = tmp_path / example
        text = (EXAMPLES / example).read_text(encoding="utf-8")
        path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
        ended = run("calibrate", path, "-o", tmp_path / "out.json", "--details")
        assert ended.code == 0
        warned[example] = [line for line in ended.log if "WARNING: interval" in line]
    assert any("light_contact" in line for line in warned["02_icub_yoga_forward.toml"])
    assert any("off_level" in line for line in warned["02_icub_yoga_forward.toml"])
    assert warned["04_icub_yoga_quiet.toml"] == []


@pytest.mark.real_data
def test_an_estimated_load_cannot_judge_a_gain(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """Calibrating with a load that the sensor weighed itself warns, and is not exported as a matrix of counts."""
    path = tmp_path / "wrist.toml"
    text = (EXAMPLES / "07_wrist_payload.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    ended = run("calibrate", path, "-o", tmp_path / "wrist.json", "--details")
    assert any("a wrong gain cannot be seen" in line for line in ended.log)
    refused = run("export", tmp_path / "wrist.json", "--to", "icub-matrix", "-o", tmp_path / "m.txt")
    assert "not per count" in refused.error()


@pytest.mark.real_data
def test_a_frozen_sensor_of_the_standing_leg_is_found(run: Run, data_dir: Path) -> None:
    """The sensor of the leg that carries the robot repeats one reading for 0.6, 2.4 and 9.4 s."""
    log = data_dir / "icub_genova02_yoga" / "dumperLeftLegNoIMU"
    result = run("inspect", log, "--format", "json").result()
    frozen = _of(result, "frozen")
    assert {f["stream"] for f in frozen} == {"icub/left_leg/analog:o"}
    np.testing.assert_allclose([f["size"] for f in frozen], [0.6, 2.4, 9.4], atol=0.1)


@pytest.mark.real_data
def test_the_wrist_payload(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """JSON, CSV and table of the real wrist sensor's load."""
    path = tmp_path / "wrist.toml"
    text = (EXAMPLES / "07_wrist_payload.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    result = run("payload", path, "--format", "json").result()
    (load,), (session,) = result["loads"], result["sessions"]
    assert load["mass_kg"] == pytest.approx(0.932, abs=0.003)
    assert load["centre_of_mass_m"][2] == pytest.approx(0.0439, abs=0.0005)
    (row,) = run("payload", path, "--format", "csv").rows()
    assert float(row["mass_kg"]) == load["mass_kg"]
    assert float(row["bias_tz_Nm"]) == session["bias"][5]
    assert float(row["centre_of_mass_z_m"]) == load["centre_of_mass_m"][2]
    assert "kg at (" in run("payload", path, "--details").out
    assert faults(result, run("schema", "payload").result()) == []
    experiment = load_experiment(path)
    weighed = weigh_load(SensorRun(experiment, experiment.sensors[0]))
    require_shown(weighed)
    assert json.loads(weighed.json_text()) == result


def test_a_robot_has_no_payload_to_estimate(arm: Path, run: Run) -> None:
    """The command says which table it needs."""
    assert "expected [[load]], what hangs on the sensor" in run("payload", arm / PARQUET).error()


def test_what_is_no_log_that_speaks_is_shown_in_every_form(arm: Path, run: Run) -> None:
    """A calibration and a table: table, JSON that fits its schema, and CSV with a line for each component or column."""
    (arm / "table.csv").write_text("t,fx_N,note\n0,1,a\n1,2,b\n", encoding="utf-8")
    counts = {"matrix_SIM001.txt": 6, "table.csv": 3}
    for name, count in counts.items():
        result = run("inspect", arm / name, "--format", "json").result()
        assert faults(result, run("schema", "inspect").result()) == []
        rows = run("inspect", arm / name, "--format", "csv").rows()
        assert len(rows) == count
    shown = " ".join(run("inspect", arm / "matrix_SIM001.txt").out.split())
    assert "matrix file of iCub, serial number not stated" in shown
    calibration = run("inspect", arm / "matrix_SIM001.txt", "--format", "csv").rows()
    assert set(calibration[0]) == {"component", "unit", "full_scale", *(f"channel_{k}" for k in range(6))}
    seen = {
        row["column"]: (row["unit"], row["looks_like"])
        for row in run("inspect", arm / "table.csv", "--format", "csv").rows()
    }
    assert seen == {"t": ("", "time"), "fx_N": ("N", ""), "note": ("", "a text")}
    shown = " ".join(run("inspect", arm / "table.csv").out.split())
    assert "by their names, time: t the log is read with" in shown
    assert "because units are missing in 1 of 2 columns of numbers" in shown
    (arm / "table.csv").write_text("t_s,fx_N\n0,1\n1,2\n", encoding="utf-8")
    shown = " ".join(run("inspect", arm / "table.csv").out.split())
    assert "because its headings have units, but state neither frames nor signs" in shown


def test_a_log_of_a_stated_format_is_described(arm: Path, run: Run) -> None:
    """`--log-format` rules over what is recognised; what a format does not know is an error of that format."""
    by_content = run("inspect", arm / "recording", "--format", "json").result()
    stated = run("inspect", arm / "recording", "--log-format", "parquet", "--format", "json").result()
    assert stated == by_content
    (arm / "table.csv").write_text("t,fx,fy\n0,1,2\n", encoding="utf-8")
    seen = run("inspect", arm / "table.csv", "--log-format", "tabular", "--format", "json").result()
    assert [row["column"] for row in seen["unread"]] == ["t", "fx", "fy"]
    assert "the log is read with an experiment file that describes it" in run("inspect", arm / "table.csv").out
    assert "no format of logs is called 'ros1'" in run("inspect", arm / "recording", "--log-format", "ros1").error()
    assert "expected a bag of ROS" in run("inspect", arm / "table.csv", "--log-format", "ros").error()


@pytest.mark.long
def test_a_mass_below_zero_is_refused(run: Run, tmp_path: Path) -> None:
    """With what the measurements say is wrong; the same file without the fault has an answer and exit code 0."""
    path = write_postures(tmp_path, seed=6, postures=POSTURES, known=False)
    text = path.read_text(encoding="utf-8")
    shown = run("payload", path)
    assert (shown.code, "kg (95 %: ±" in shown.out) == (0, True)
    path.write_text(text.replace("child_to_parent", "parent_to_child"), encoding="utf-8")
    error = run("payload", path).error()
    assert "expected a mass above 0 kg, got -" in error
    assert "reversed direction: " in error
