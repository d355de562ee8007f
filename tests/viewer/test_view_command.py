# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque view`: a page as a file or served, what is saved from it, and what is refused."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
import urllib.request
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque import load_experiment
from forcetorque.base.errors import ForceTorqueError
from forcetorque.viewer.packing import unpack
from forcetorque.viewer.page import ASSETS, BUNDLE, ViewerServer
from tests.app.json_schema import faults
from tests.app.outcome import Run, heed_interrupts
from tests.scenes.experiments import PARQUET, edit, snapshot

SAMPLE = {"sample": 5, "time_s": 0.1, "mark": "point", "label": "here", "use": "ignore"}


@pytest.fixture(autouse=True)
def assets(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A bundle that does nothing, in place of that of the package."""
    folder = tmp_path / "assets"
    folder.mkdir()
    (folder / "page.html").write_bytes((ASSETS / "page.html").read_bytes())
    for name in BUNDLE:
        (folder / name).write_text("", encoding="utf-8")
    monkeypatch.setattr("forcetorque.viewer.page.ASSETS", folder)
    return folder


def _scene(file: Path) -> Any:
    (text,) = re.findall(r'id="scene">(.*?)</script>', file.read_text(encoding="utf-8"))
    return json.loads(text)


def _visit(monkeypatch: pytest.MonkeyPatch, visit: Callable[[str], None]) -> None:
    """Do this where a served page would wait for Ctrl-C, which then comes."""

    def wait(server: ViewerServer) -> None:
        visit(server.url)
        raise KeyboardInterrupt

    monkeypatch.setattr(ViewerServer, "wait", wait)


def _save(url: str, *samples: dict[str, Any]) -> None:
    request = urllib.request.Request(
        f"{url}annotations",
        data=json.dumps({"samples": samples, "intervals": []}).encode(),
        headers={"Content-Type": "application/json", "Origin": url.rsplit("/", 2)[0]},
    )
    with urllib.request.urlopen(request, timeout=10) as answer:
        assert json.load(answer) == {"files": ["parquet.samples.csv", "parquet.intervals.toml"]}


def test_a_file_is_written(run: Run, arm: Path) -> None:
    """The page holds the experiment with every calibration; the result says where it is and what is absent."""
    result = run("view", PARQUET, "-c", "fitted.json", "-o", "view.html", "--format", "json").result()
    scene = _scene(arm / "view.html")
    assert scene["title"] == result["experiment"] == "small arm"
    assert [series["name"] for series in scene["sensors"][0]["wrenches"]] == ["expected", "prior", "fitted.json"]
    assert result["schema"] == "forcetorque/view/1"
    assert (result["file"], result["file_bytes"]) == ("view.html", (arm / "view.html").stat().st_size)
    assert (result["url"], result["video"], result["samples"]) == (None, None, scene["samples"])
    assert result["notes"] == scene["notes"]
    assert any(line.startswith("fitted.json sha256 ") for line in scene["provenance"])


def test_the_table_says_what_was_written(run: Run, arm: Path) -> None:
    """The answer names the file; in the details one line for the experiment, one for the file. Notes go to the log."""
    ended = run("view", PARQUET, "-o", "view.html", "--details")
    assert ended.code == 0
    answer, details = ended.out.split("\n\n", maxsplit=1)
    assert answer.endswith("\nwritten: view.html\nnext: open view.html in a browser")
    lines = details.splitlines()
    assert re.fullmatch(r"small arm: \d+ samples of arm_ft", lines[0])
    assert re.fullmatch(r"page of \d\.\d MB written to view\.html", lines[1])
    assert "INFO: outside intervals the robot stands on the support of the nearest one" in ended.log
    (row,) = run("view", PARQUET, "-o", "view.html", "--format", "csv").rows()
    assert row["file"] == "view.html"


def test_only_the_named_sensors_are_shown(run: Run, arm: Path) -> None:
    """An unknown name leads to the known ones."""
    run("view", "two.toml", "--sensor", "tool_ft", "-o", "view.html")
    assert [sensor["name"] for sensor in _scene(arm / "view.html")["sensors"]] == ["tool_ft"]
    assert "has no sensor 'x'; known: arm_ft, tool_ft" in run("view", "two.toml", "--sensor", "x").error()


def test_a_page_is_served_until_interrupted(run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The address is printed and opened in the browser; page, data and saving work; then the server stops."""
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", lambda url: bool(opened.append(url)) or True)
    seen: dict[str, bytes] = {}

    def visit(url: str) -> None:
        for place in ("", "data.bin"):
            with urllib.request.urlopen(url + place, timeout=10) as answer:
                seen[place] = answer.read()
        _save(url, SAMPLE)

    _visit(monkeypatch, visit)
    result = run("view", PARQUET, "--format", "json").result()
    assert opened == [result["url"]]
    assert b'data-url="data.bin"' in seen[""]
    (text,) = re.findall(r'id="scene">(.*?)</script>', seen[""].decode(), re.DOTALL)
    place = json.loads(text)["positions"]
    data = seen["data.bin"][place["offset"] : place["offset"] + place["packed_bytes"]]
    assert np.isfinite(unpack(data, tuple(place["shape"]))).all()
    assert (arm / "parquet.samples.csv").read_text(encoding="utf-8").splitlines()[1].startswith("5,")
    assert (arm / "parquet.intervals.toml").is_file()
    with pytest.raises(OSError, match="refused"):
        urllib.request.urlopen(result["url"], timeout=10)


@pytest.mark.long
def test_no_browser_is_opened_unless_wanted(run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With --no-browser nothing is opened; where nothing can be opened, the log says so."""
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", lambda url: bool(opened.append(url)))
    _visit(monkeypatch, lambda url: None)
    assert run("view", PARQUET, "--no-browser").code == 0
    assert opened == []
    ended = run("view", PARQUET)
    assert len(opened) == 1
    assert "WARNING: no browser could be opened; open the address yourself" in ended.log


@pytest.mark.long
def test_samples_of_an_earlier_session_are_kept(run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was saved before goes to another name; saving again in one session replaces only its own."""
    _visit(monkeypatch, lambda url: _save(url, SAMPLE))
    run("view", PARQUET, "--no-browser")
    first = (arm / "parquet.samples.csv").read_bytes()

    def twice(url: str) -> None:
        _save(url)
        _save(url, SAMPLE, SAMPLE)

    _visit(monkeypatch, twice)
    ended = run("view", PARQUET, "--no-browser")
    assert (arm / "parquet.samples.previous.csv").read_bytes() == first
    assert len((arm / "parquet.samples.csv").read_text(encoding="utf-8").splitlines()) == 3
    assert any("of an earlier session is now" in line for line in ended.log)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["nowhere.toml"], "nowhere.toml: expected an experiment file, there is none"),
        (
            ["estimates.parquet"],
            "estimates.parquet: expected an experiment file or the numbers of a report, got a table",
        ),
        (["log.csv"], "if it is a log, begin an experiment file by `forcetorque init log.csv --urdf ROBOT.urdf`"),
        ([PARQUET, "-o", "nowhere/view.html"], "nowhere/view.html: expected an existing folder to write to"),
        ([PARQUET, "-o", "view.html", "--port", "8000"], "--port belongs to a page that is served"),
        ([PARQUET, "--port", "99999"], "port 99999 of 127.0.0.1"),
        ([PARQUET, "-c", "nowhere.json"], "nowhere.json: expected a calibration file, there is none"),
        ([PARQUET, "--mesh-dir", "nowhere"], "--mesh-dir nowhere: expected a folder, there is none"),
        ([PARQUET, "--video", "a.mp4", "--fps", "0"], "video: expected up to 240 frames per second"),
        ([PARQUET, "--video", "a.mp4", "--size", "321", "200"], "video: expected an even width and height"),
        ([PARQUET, "--video", "a.mp4", "--browser", "nowhere"], "--browser nowhere: expected a program"),
        ([PARQUET, "--video", "nowhere/a.mp4"], "nowhere/a.mp4: expected an existing folder"),
    ],
)
def test_what_cannot_be_shown_is_refused(run: Run, arm: Path, words: list[str], message: str) -> None:
    """The error is one line that says what to do, and no file is written."""
    pytest.importorskip("playwright")
    before = snapshot(arm)
    assert message in run("view", *words).error()
    assert snapshot(arm) == before


def test_too_many_samples_are_refused_before_they_are_computed(
    run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """For a page in one file; where they are served, the memory is stated."""
    reached: list[str] = []

    def computed(*_: object) -> None:
        reached.append("computed")
        raise ForceTorqueError("computed")

    monkeypatch.setattr("forcetorque.viewer.scene_builder.differentiated", computed)
    assert "computed" in run("view", PARQUET, "-o", "view.html").error()
    monkeypatch.setattr("forcetorque.viewer.page.MOST_SAMPLES", 10)
    assert "expected at most 10 samples in one page" in run("view", PARQUET, "-o", "view.html").error()
    experiment = load_experiment(arm / PARQUET)
    with pytest.raises(ForceTorqueError, match="expected at most 10 samples in one page"):
        experiment.view(arm / "view.html")
    assert reached == ["computed"]
    assert not (arm / "view.html").exists()
    assert "GB of memory" not in run("view", PARQUET, "--no-browser").err
    monkeypatch.setattr("forcetorque.viewer.commands._LARGE_BYTES", 1)
    assert re.search(
        r"\d+ samples are shown at once, in about 0\.3 GB of memory; where", run("view", PARQUET, "--no-browser").err
    )


@pytest.mark.parametrize(
    ("words", "option", "computes"),
    [
        (("report", "-o", "report.html"), ("--viewer",), "report.report.report"),
        (("evaluate", "-c", "fitted.json"), ("--view", "view.html"), "evaluation.evaluation.validation_errors"),
        (("estimate", "-o", "s.parquet"), ("--view", "view.html"), "estimation.estimate.estimate_experiment"),
    ],
)
def test_too_many_samples_beside_a_result_are_refused_before_it_is_computed(
    run: Run,
    arm: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: tuple[str, ...],
    option: tuple[str, ...],
    computes: str,
) -> None:
    """Without the option it is computed."""

    def computed(*_: object, **__: object) -> None:
        raise ForceTorqueError("computed")

    monkeypatch.setattr(f"forcetorque.{computes}", computed)
    monkeypatch.setattr("forcetorque.viewer.page.MOST_SAMPLES", 10)
    assert "computed" in run(words[0], PARQUET, *words[1:]).error()
    assert re.search(
        r"view.*: expected at most 10 samples in one page", run(words[0], PARQUET, *words[1:], *option).error()
    )


def test_a_span_without_samples_is_refused(run: Run, arm: Path) -> None:
    """A video needs a sample to show."""
    pytest.importorskip("playwright")
    words = ("view", PARQUET, "--video", "a.mp4", "--browser", sys.executable, "--start", "30")
    assert "--start 30 --end 23.9" in run(*words).error()


def test_a_video_that_is_too_long_is_refused(run: Run, arm: Path) -> None:
    """Before the browser starts, with the ways to a shorter one."""
    pytest.importorskip("playwright")
    words = ("view", PARQUET, "--video", "a.mp4", "--browser", sys.executable, "--speed", "0.03")
    assert re.search(r"at most 600 s, got 7\d\d s; raise --speed, or .* --start and --end", run(*words).error())
    assert not (arm / "a.mp4").exists()


def test_a_video_is_written(run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The page is filmed from the first to the last sample of the span; the number of frames follows from speed."""
    pytest.importorskip("playwright")
    filmed: list[Any] = []

    def film_page(url: str, film: Any, *, browser: Path) -> bytes:
        with urllib.request.urlopen(f"{url}data.bin", timeout=10) as answer:
            filmed.append((film, len(answer.read())))
        return b"film"

    monkeypatch.setattr("forcetorque.viewer.video.film_page", film_page)
    words = ("--start", "2", "--end", "12", "--speed", "2", "--fps", "10", "--size", "320", "200")
    browser = ("--browser", sys.executable)
    result = run("view", PARQUET, "--video", "a.mp4", *words, *browser, "--format", "json").result()
    assert (arm / "a.mp4").read_bytes() == b"film"
    assert result["video_frames"] == 50
    ((film, size),) = filmed
    assert (film.end - film.start, film.width, film.height) == (499, 320, 200)
    assert size > 100_000


def test_a_wrong_calibration_is_refused(run: Run, arm: Path) -> None:
    """A calibration of another serial number is not drawn."""
    edit(arm / PARQUET, 'serial = "SIM001"', 'serial = "SIM009"')
    edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"\n', "")
    assert "SIM009" in run("view", PARQUET, "-c", "fitted.json", "-o", "view.html").error()


@pytest.mark.long
def test_a_real_process_stops_at_the_first_interrupt(arm: Path) -> None:
    """Ctrl-C ends the command in good order: exit code 0, nothing on standard error but the log."""
    if not all((ASSETS / name).is_file() for name in BUNDLE):
        pytest.skip("the page's bundle has not been built; run make web")
    words = [sys.executable, "-m", "forcetorque", "view", PARQUET, "--no-browser", "--format", "csv"]
    process = subprocess.Popen(
        words,
        cwd=arm,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=heed_interrupts,
    )
    try:
        assert process.stdout is not None
        header, row = process.stdout.readline(), process.stdout.readline()
        url = dict(zip(header.strip().split(","), row.strip().split(","), strict=True))["url"]
        with urllib.request.urlopen(url, timeout=10) as answer:
            assert answer.status == 200
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    finally:
        process.kill()
        process.wait()
    assert (process.returncode, out) == (0, "")
    assert all(line.startswith("INFO: ") for line in err.splitlines())


def test_an_interrupt_before_the_command_waits_ends_it_in_good_order(
    run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The address is out before the command waits: Ctrl-C in between is no traceback, and nothing serves on."""

    def interrupt(url: str) -> bool:
        opened.append(url)
        raise KeyboardInterrupt

    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", interrupt)
    ended = run("view", PARQUET)
    assert ended.code == 0
    assert "INFO: stopped" in ended.log
    with pytest.raises(OSError, match="refused"):
        urllib.request.urlopen(opened[0], timeout=10)


def _report(run: Run, **changes: object) -> Path:
    """Numbers of a report as the command leaves them, without drawing one."""
    content = json.loads(Path("fitted.json").read_text(encoding="utf-8"))
    sensor = {
        key: []
        for key in ("verdict", "evaluation", "comparisons", "independence", "contact_forces", "best", "joint_torques")
    } | {"spheres": [], "static": [], "criteria": [], "warnings": [], "not_evaluated": {}}
    sensor |= {"sensor": "arm_ft", "serial": "SIM001", "calibrations": {"fitted.json": content}}
    experiment = {
        "experiment": "small arm", "file": PARQUET, "robot": "arm", "duration_s": 24.0, "streams": [], "intervals": [],
        "findings": [], "sensors": [sensor], "inputs_sha256": {},
    } | changes  # fmt: skip
    report = {
        "schema": "forcetorque/report/2", "title": "t", "created": "2020-01-01T00:00:00+00:00", "code_version": "1",
        "experiments": [experiment], "results": {},
    }  # fmt: skip
    path = Path("report.numbers.json")
    path.write_text(json.dumps(report), encoding="utf-8")
    assert faults(report, run("schema", "report").result()) == []
    return path


@pytest.mark.long
def test_a_report_shows_its_experiment_with_its_calibrations(arm: Path, run: Run) -> None:
    """The same page as with both named."""
    named = run("view", PARQUET, "-c", "fitted.json", "-o", "named.html", "--format", "json").result()
    shown = run("view", _report(run), "-o", "shown.html", "--format", "json").result()
    assert shown | {"file": ""} == named | {"file": ""}
    assert Path("shown.html").read_bytes() == Path("named.html").read_bytes()
    plain = run("view", PARQUET, "-o", "plain.html", "--format", "json").result()
    assert plain["file_bytes"] < shown["file_bytes"], "control: without the calibration the page holds less"


def test_a_report_that_cannot_be_shown_is_one_line(arm: Path, run: Run) -> None:
    """Files that are gone, and JSON that is no report."""
    gone = run("view", _report(run, file="gone.toml"), "-o", "page.html")
    assert (
        "report.numbers.json: gone.toml: expected the file that the report was made from, there is none" in gone.error()
    )
    other = run("view", "fitted.json", "-o", "page.html")
    assert "fitted.json: expected the numbers of a report: " in other.error()
    assert not Path("page.html").exists()


def test_the_ending_chooses_the_viewer(run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A bag of ROS 2, from which `init` begins again; a recording of Rerun; what is lacking is named first."""
    pytest.importorskip("rosbags")
    ended = run("view", PARQUET, "-c", "fitted.json", "-o", "view.mcap", "--details")
    assert (
        ended.out.splitlines()[-1]
        == f"bag of ROS 2 of {(arm / 'view.mcap').stat().st_size / 1e6:.1f} MB written to view.mcap"
    )
    drafted = run("init", "view.mcap", "-o", "again.toml")
    assert drafted.code == 0
    assert (arm / "again.urdf").read_bytes() == (arm / "arm.urdf").read_bytes()
    assert 'topic = "/arm_ft/fitted_json"' in (arm / "again.toml").read_text(encoding="utf-8")
    monkeypatch.setitem(sys.modules, "rerun", None)
    error = run("view", "gone.toml", "-o", "view.rrd").error()
    assert "view.rrd: recordings of Rerun are written by rerun-sdk: pip install 'forcetorque[rerun]'" in error
    assert not (arm / "view.rrd").exists()
