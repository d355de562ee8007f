# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque live` as it is typed: lines on standard output, the account on standard error."""

from __future__ import annotations

import csv
import io
import json
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from forcetorque.calibration.export.wholebodydynamics import from_calibration, write_groups
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.formats.ros.bag import opened_bag
from forcetorque.formats.ros.single_messages import read_wrench
from forcetorque.live.figures import live_figure
from forcetorque.results.terminal.command_output import drawn_to
from tests.app.outcome import Run, heed_interrupts
from tests.formats.ur_rtde.recordings import Tool, recorded, write_text
from tests.live.drawn_figures import kept_samples, run_of
from tests.scenes.calibrations import make_calibration
from tests.scenes.experiments import PARQUET, edit


@pytest.fixture
def fitted(arm: Path) -> Path:
    """A calibration of the sensor of the small arm."""
    make_calibration(name="arm_ft", serial="SIM001").save(arm / "arm.json")
    return arm


def test_a_recording_is_replayed(fitted: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every sample is a line and a row of the file; the account is the answer first, within twelve lines."""
    monkeypatch.chdir(fitted)
    write_groups("arm.xml", [from_calibration(read_calibration("arm.json"))])
    replay = ("--replay", PARQUET, "--speed", 0, "--check", "wholebodydynamics=arm.xml")
    outcome = run("live", "arm.json", *replay, "-o", "live.parquet", "--watch", columns=80)
    assert outcome.code == 0
    rows = list(csv.DictReader(io.StringIO(outcome.out)))
    raw = load_experiment(PARQUET).recording.stream("arm_ft").signal("raw").values
    expected = read_calibration("arm.json").apply(raw, serial="SIM001")
    assert np.allclose([float(row["fx_N"]) for row in rows], expected[:, 0], rtol=1e-7)
    assert pq.read_table("live.parquet").num_rows == len(rows) == len(raw)
    watched, account = outcome.err.split("arm_ft (SIM001)")
    assert "fx " in watched
    assert "\x1b" not in watched  # no terminal
    assert account.startswith(" ")
    assert "1200 samples, losses not countable, 0 with faults" in account
    (number,) = re.findall(r"wholebodydynamics differs by at most (\S+) N", account)
    assert float(number) < 1e-6
    assert "no interval to judge by" in " ".join(account.split())
    assert "written: live.parquet" in account
    assert account.count("\n") <= 12
    assert max(map(len, account.splitlines())) <= 80


def test_lines_and_account_may_be_json(fitted: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a rate, losses are countable."""
    monkeypatch.chdir(fitted)
    outcome = run(
        "live", "arm.json", "--replay", PARQUET, "--speed", 0, "--lines", "json", "--format", "json", "--rate", 50,
        "--figure", "live.png",
    )  # fmt: skip
    assert json.loads(outcome.out.splitlines()[0])["sensor"] == "arm_ft"
    account = json.loads(outcome.err)
    assert (account["packets"]["lost"], account["figure"]) == (0, "live.png")
    assert Path("live.png").read_bytes().startswith(b"\x89PNG")
    assert "kept" not in account


def test_a_run_without_a_sample_has_its_account_and_no_figure(tmp_path: Path) -> None:
    """The reason is a warning, and no file is there; the run with samples has its figure."""
    whole = run_of(np.random.default_rng(1))
    account = drawn_to(whole.model_copy(update={"kept": None}), tmp_path / "live.png")
    assert account.figure_file is None
    assert "live.png: live run: expected samples" in account.warnings[0]
    assert not (tmp_path / "live.png").exists()
    assert drawn_to(whole, tmp_path / "live.png").warnings == ()
    assert (tmp_path / "live.png").exists()


def test_lines_of_streams_that_come_in_turn_are_whole() -> None:
    """Three streams of 100 Hz, the samples of one just behind those of another; the fourth sensor has none."""
    time = (0.01 * np.arange(300)[:, None] + [0.0, 2e-4, 5e-4]).ravel()
    wrench = np.broadcast_to(np.sin(time)[:, None, None], (900, 4, 6)).copy()
    wrench[:, 3] = np.nan
    came = np.tile(np.eye(3, 4, dtype=np.bool_), (300, 1))
    kept = kept_samples(time, came, wrench, 0.1 * np.ones_like(wrench))
    figure = live_figure(run_of(np.random.default_rng(1)).model_copy(update={"kept": kept}))
    breaks = [int(np.isnan(panel.lines[0].get_ydata()).sum()) for panel in figure.axes[:6]]
    assert breaks == [1] * 6  # behind the last


def test_a_recording_becomes_a_bag(fitted: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a wrench for every sample, in the frame that is called as the sensor."""
    pytest.importorskip("rosbags")
    monkeypatch.chdir(fitted)
    assert run("live", "arm.json", "--replay", PARQUET, "--speed", 0, "-o", "live.mcap", "--lines", "none").code == 0
    with opened_bag(Path("live.mcap")) as bag:
        messages = [bytes(data) for _, part in bag.messages("/arm_ft/wrench") for data in part]
    assert len(messages) == 1200
    assert read_wrench(messages[0])[1] == "arm_ft"


def test_what_cannot_be_done_is_refused(fitted: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before anything is read: another sensor, another name of a file, a number that is none."""
    monkeypatch.chdir(fitted)
    make_calibration(name="arm_ft", serial="SN9").save(fitted / "other.json")
    replay = ("--replay", PARQUET, "--speed", 0)
    assert "SN9" in run("live", "other.json", *replay).error()
    assert ".parquet" in run("live", "arm.json", *replay, "-o", "live.csv").error()
    assert "finite" in run("live", "arm.json", "--replay", PARQUET, "--speed", "nan").error()
    assert "--quantity" in run("live", "arm.json", *replay, "--quantity", "wrench").error()
    assert "one calibration per sensor" in run("live", "arm.json", "other.json", *replay).error()


@pytest.mark.long
@pytest.mark.parametrize("ending", ["pipe", "interrupt", "terminate"])
def test_a_process_ends_cleanly(fitted: Path, ending: str) -> None:
    """When nobody reads its lines any more, by Ctrl-C and SIGTERM: exit code 0, account and file, no traceback."""
    words = ("live", "arm.json", "--input", "yarp", "--quantity", "raw", "-o", "live.parquet")
    with subprocess.Popen(
        [sys.executable, "-m", "forcetorque", *words],
        cwd=fitted, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        preexec_fn=heed_interrupts,
    ) as process:  # fmt: skip
        assert process.stdin is not None
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdin.write("1 2 3 4 5 6\n" * 3)
        process.stdin.flush()
        assert process.stdout.readline().startswith("stamp_ns")
        for _ in range(2):
            assert process.stdout.readline().endswith("ok\n")
        if ending != "pipe":
            process.send_signal(signal.SIGINT if ending == "interrupt" else signal.SIGTERM)
        else:
            process.stdout.close()
            process.stdin.write("1 2 3 4 5 7\n" * 3)
            process.stdin.flush()
        err = process.stderr.read()
        assert process.wait(30) == 0
    assert "arm_ft (SIM001)" in err
    assert pq.read_table(fitted / "live.parquet").num_rows >= 1
    assert "Traceback" not in err
    assert "BrokenPipe" not in err


def test_a_tool_of_a_replayed_arm_is_weighed_by_the_gravity_of_its_log(tmp_path: Path, run: Run) -> None:
    """From the load of a log to its calibration and a live run, in which the weight is off in every posture."""
    tool, file, fitted = Tool(), tmp_path / "wrist.toml", tmp_path / "wrist.json"
    log = write_text(tmp_path / "log.txt", recorded(tool, poses=10, samples=4, raw=True))
    assert run("payload", log, "--save-experiment", file).code == 0
    assert "\n# full_scale = " in file.read_text(encoding="utf-8")
    assert run("calibrate", file, "-o", fitted).error().count("sensor 'wrist': ") == 1
    edit(file, "# full_scale = [fx, fy, fz, tx, ty, tz]", "full_scale = [150, 150, 150, 10, 10, 10]")
    assert 'next: add an [[interval]] with use = "validation"' in run("calibrate", file, "-o", fitted).out
    for other in (file, log):
        assert "expected JSON, got" in (refused := run("live", other).error())
        assert "a calibration is a JSON file, which `forcetorque calibrate` writes" in refused
    replay = ("live", fitted, "--replay", file, "--speed", 0, "--offset", "tare")
    centre = ",".join(map(str, tool.centre))
    weighed = run(*replay, "--tool-mass", tool.mass, "--tool-centre", centre, "--take-tool-off")
    assert "The load moved" not in weighed.err
    assert "next: state --rate, so that lost samples are seen" in weighed.err
    forces = [float(row["fx_N"]) for row in csv.DictReader(io.StringIO(weighed.out))]
    assert len(forces) == 40
    assert np.abs(forces[10:]).max() < 0.5
    assert np.abs([float(row["fx_N"]) for row in csv.DictReader(io.StringIO(run(*replay).out))][10:]).max() > 5.0
