# SPDX-License-Identifier: BSD-3-Clause
"""docs/tutorial.md: every command on it runs on the log that is committed, and its figures are what they print."""

from __future__ import annotations

import re
import shlex
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.toml_file import unanswered_keys
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.inspection.draft.draft import Draft
from tests.app.outcome import Run
from tests.page_scripts import unmarked
from tests.scenes.tutorial_log import FOLDER, FULL_SCALE, PUSH_S, distortion, log_text, robot_text

ROOT = Path(__file__).resolve().parents[3]
PAGE = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
COMMANDS = [shlex.split(line.split("#")[0]) for line in re.findall(r"^    forcetorque (.*)$", PAGE, re.MULTILINE)]
LARGEST_LOG = 300_000


def _said(words: str) -> re.Pattern[str]:
    """Words with any space between them: tables and sentences are folded."""
    return re.compile(r"\s+".join(map(re.escape, words.split())))


def _answered(text: str) -> str:
    """The file with the answers of the page in it."""
    block = re.search(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    assert block is not None
    answers = [line for line in block[1].splitlines() if line]
    for answer in answers:
        key = answer.split(" = ")[0]
        text, count = re.subn(rf'^{key} = "\?".*$', answer, text, flags=re.MULTILINE)
        assert count == 1, key
    return text


def test_the_log_is_what_its_script_writes() -> None:
    """And small; the robot has no tag of a sensor, so that the page can ask for it."""
    assert (FOLDER / "log.csv").read_text(encoding="utf-8") == log_text()
    assert (FOLDER / "robot.urdf").read_text(encoding="utf-8") == robot_text()
    assert "<sensor" not in robot_text()
    assert (FOLDER / "log.csv").stat().st_size < LARGEST_LOG


def test_the_page_does_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Run) -> None:
    """From the log to the verdict with nothing but the answers on the page; the matrix is that of the sensor."""
    for file in ("log.csv", "robot.urdf"):
        shutil.copy(FOLDER / file, tmp_path)
    monkeypatch.chdir(tmp_path)
    (look, init, early, resume, inspect, calibrate, evaluate) = COMMANDS
    assert "looks like" in run(*look).out
    drafted = run(*init)
    assert drafted.code == 0, drafted.err
    experiment = tmp_path / "experiment.toml"
    text = experiment.read_text(encoding="utf-8")
    for words in (
        "arm_ft_joint (0.064 N of 25 N in 90 % of the time)",
        "a weight of 36.5 N along [+0.00, +0.00, -1.00]",
    ):
        assert words in PAGE.replace("\n             # ", " ").replace("\n                         # ", " ")
        assert words in text
    spans = [(one["start_s"], one["end_s"]) for one in tomllib.loads(text)["interval"]]
    assert len(spans) == 3
    assert all(end <= PUSH_S[0] or start >= PUSH_S[1] for start, end in spans)
    error = run(*early).error()
    shown = re.search(r"^error: (experiment.toml:.*), \.\.\.$", PAGE, re.MULTILINE)
    assert shown is not None
    assert shown[1] in error
    experiment.write_text(_answered(text), encoding="utf-8")
    resumed = run(*resume)
    assert resumed.code == 0, resumed.out
    assert "COMPLETE" in resumed.out.splitlines()[0]
    assert re.search(r"25\.3-29\.7 s, log: light contact up to 11 N", run(*inspect).out)
    fitted = run(*calibrate)
    assert fitted.code == 0, fitted.err
    judged = run(*evaluate, "--details").out
    for words in (
        "force error 0.23 N against 2.65 N with the prior",
        "force error 0.73 N (95 %:",
        "prior 2.4 N)",
    ):
        assert _said(words).search(judged), words
        for figure in re.findall(r"\d\.\d+ N", words):
            assert figure in PAGE
    matrix = read_calibration(tmp_path / "new.json").matrix
    scale = np.array(FULL_SCALE)
    before, after = (np.abs((m - distortion()) / scale[:, None] * scale).max() for m in (np.eye(6), matrix))
    assert after < 0.25 * before


def test_the_script_of_the_page_runs(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """The same draft from Python, which writes nothing."""
    monkeypatch.chdir(ROOT)
    (code,) = unmarked(PAGE)
    names: dict[str, object] = {}
    exec(compile(code, "tutorial.md", "exec"), names)
    draft = names["draft"]
    assert isinstance(draft, Draft)
    assert [question.key for question in draft.questions] == [one.key for one in unanswered_keys(draft.content)]
    assert len(draft.questions) == 5
    assert "questions, one a line" in capsys.readouterr().out


def test_the_file_itself_goes_to_standard_output(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Run) -> None:
    """`-o -` writes TOML and nothing else, with paths from here; a file that is there is never replaced."""
    for file in ("log.csv", "robot.urdf"):
        shutil.copy(FOLDER / file, tmp_path)
    monkeypatch.chdir(tmp_path)
    words = ("init", "log.csv", "--urdf", "robot.urdf")
    content = tomllib.loads(run(*words, "-o", "-").out)
    assert (content["robot"]["urdf"], content["recording"]["path"]) == ("robot.urdf", ".")
    assert run(*words, "--format", "json").result()["questions"][0]["key"] == "serial"
    assert "experiment.toml: expected a new file, or a result or figure to replace, got another" in run(*words).error()
