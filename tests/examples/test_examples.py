# SPDX-License-Identifier: BSD-3-Clause
"""Every example runs, and the README says what they print."""

from __future__ import annotations

import ast
import importlib
import json
import os
import re
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.formats.icub_matrix import read_matrix_file
from tests.app.outcome import typed
from tests.cases import some_cases
from tests.notebook import run_notebook, texts
from tests.page_scripts import marked, printed
from tests.scenes.device_designs import hardly_optimise

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = sorted((ROOT / "docs").rglob("*.md"))
MARKED = [page for page in PAGES if marked(page.read_text(encoding="utf-8"))]
SLOW = ("device.md", "demands.md", "python.md", "run.md", "span.md", "report.md")
"""Pages whose scripts take some seconds."""
NOTEBOOK = ROOT / "examples" / "14_from_arrays.ipynb"
SCRIPTS = sorted((ROOT / "examples").glob("*.py"))
NODE = ROOT / "examples" / "33_ros2_node.py"
"""It has topics to name, so it needs arguments."""
LARGEST_NOTEBOOK = 100_000
"""Bytes, its picture included."""
YOGA = sorted((ROOT / "examples").glob("0[2-5]_icub_yoga_*.toml"))


@pytest.mark.parametrize("script", [script for script in SCRIPTS if script != NODE], ids=lambda s: s.stem)
def test_a_script_needs_no_arguments(script: Path) -> None:
    """Every argument without dashes has a default; a node has topics to name."""
    calls = [node for node in ast.walk(ast.parse(script.read_text(encoding="utf-8"))) if isinstance(node, ast.Call)]
    added = [call for call in calls if isinstance(call.func, ast.Attribute) and call.func.attr == "add_argument"]
    assert added
    for call in added:
        name, options = ast.literal_eval(call.args[0]), {word.arg: word.value for word in call.keywords}
        required = options.get("required")
        assert required is None or not ast.literal_eval(required), name
        assert name.startswith("-") or ast.literal_eval(options.get("nargs", ast.Constant("1"))) in ("?", "*"), name


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda s: s.stem)
def test_what_a_script_imports_of_the_library_is_there(script: Path) -> None:
    """Also of a script that only the long tests run."""
    nodes = [
        node for node in ast.walk(ast.parse(script.read_text(encoding="utf-8"))) if isinstance(node, ast.ImportFrom)
    ]
    names = [(node.module, alias.name) for node in nodes for alias in node.names if node.module is not None]
    assert names
    for module, name in names:
        if module.split(".")[0] == "forcetorque":
            getattr(importlib.import_module(module), name)


def _is_slow(page: Path) -> bool:
    return page.name in SLOW


def _block(name: str, page: str = README) -> str:
    """Content of the fenced block between two markers of the README, or of another page."""
    found = re.search(rf"<!-- {name} -->\n```\w*\n(.*?)```\n<!-- /{name} -->", page, re.DOTALL)
    assert found is not None
    return found[1]


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Folder and output of `make demo`."""
    folder = tmp_path_factory.mktemp("run") / "build" / "demo"
    folder.parent.mkdir()
    done = subprocess.run(
        [sys.executable, "-m", "forcetorque", "demo", "-o", "build/demo"],
        cwd=folder.parents[1],
        env={**os.environ, "PYTHONPATH": str(ROOT / "src"), "COLUMNS": "100"},
        capture_output=True,
        text=True,
        check=True,
    )
    return folder, done.stdout


def test_the_demo_recovers_the_truth(demo: tuple[Path, str]) -> None:
    """The new matrix reads a push at least ten times better than the prior, and the verdict is to use it."""
    _, output = demo
    errors = {
        line.split()[0]: [float(value) for value in re.findall(r"([\d.]+) N(?: m)?\b", line.partition(":")[2])]
        for line in output.splitlines()
        if " matrix, push of " in line
    }
    assert {name: len(values) for name, values in errors.items()} == {"prior": 2, "new": 2}
    assert all(new < 0.1 * prior for new, prior in zip(errors["new"], errors["prior"], strict=True))
    assert output.splitlines()[0].split()[-1] == "USE"


def test_the_demo_leaves_its_files(demo: tuple[Path, str]) -> None:
    """What the demo names is there and reads."""
    folder, _ = demo
    assert load_experiment(folder / "experiment.toml").sensors[0].serial == "SIM001"
    assert read_calibration(folder / "calibration.json").sensor.serial == "SIM001"
    assert read_matrix_file(folder / "matrix_SIM001.txt").matrix.shape == (6, 6)


def test_the_readme_shows_what_the_demo_prints(demo: tuple[Path, str]) -> None:
    """The end of the demo's output stands in the README, character by character."""
    _, output = demo
    shown = [line.rstrip() for line in _block("demo").splitlines()]
    printed = [line.rstrip() for line in output.splitlines()]
    assert len(shown) >= 6
    assert printed[-len(shown) :] == shown
    text = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    before, after = (line.partition(": ")[2].partition(" N,")[0] for line in printed if " matrix, push of 50 N" in line)
    assert f"reads a push of 50 N wrong by {before} N with the matrix of its data sheet, and by {after} N after" in text


def test_the_readme_says_of_the_real_log_what_was_measured() -> None:
    """Force errors of example 02 before and after, rounded from the page of measured figures."""
    measured = (ROOT / "docs" / "measured.md").read_text(encoding="utf-8")
    row = re.search(r"^\| force error, offset as fitted \| yoga, 02 03 04 05 \| (.*?) N", measured, re.MULTILINE)
    assert row is not None
    before, after = (float(part.split()[0]) for part in row[1].split("->"))
    text = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    assert f"a leg sensor goes from {before:.1f} N to {after:.1f} N, and the tool says" in text


@pytest.mark.usefixtures("blank_pictures")
def test_the_readmes_script_runs(demo: tuple[Path, str], monkeypatch: pytest.MonkeyPatch) -> None:
    """The Python block of the README runs after the demo: short, and with the verdict of the command line."""
    folder, output = demo
    assert len(_block("example").splitlines()) <= 25
    monkeypatch.chdir(folder.parents[1])
    shown = printed(_block("example"), "README.md")
    assert "arm with known truth: arm_ft (SIM001), 5800 samples that were not fitted" in shown
    assert shown.splitlines()[0].split()[-1] == output.splitlines()[0].split()[-1]
    assert read_calibration(folder / "mine.json").sensor.serial == "SIM001"


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_the_notebook_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """In an empty folder, cell by cell: it comes to the outputs that are stored in it, which are small.

    `pytest --write-snapshots` stores what the cells show now.
    """
    monkeypatch.chdir(tmp_path)
    stored = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    come = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    shown = run_notebook(come, str(NOTEBOOK))
    if request.config.getoption("--write-snapshots"):
        NOTEBOOK.write_text(json.dumps(come, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        stored = come
    assert texts(stored) == texts(come)
    assert len(texts(stored)) >= 6
    assert NOTEBOOK.stat().st_size < LARGEST_NOTEBOOK
    assert read_calibration(shown["folder"] / "from_arrays.json").sensor.serial == "SIM001"
    assert (shown["folder"] / "from_arrays.html").stat().st_size > 10_000
    assert shown["expected"].shape == (len(shown["seconds"]), 6)
    assert len(shown["run"].figure(shown["calibration"]).axes) == 6
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("script", [NODE], ids=lambda path: path.name)
def test_a_script_without_arguments_says_what_it_takes(
    script: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """One usage line that names every argument, and exit code 2; its first lines say the same."""
    monkeypatch.setattr(sys, "argv", [script.name])
    with pytest.raises(SystemExit) as stop:
        runpy.run_path(str(script), run_name="__main__")
    assert stop.value.code == 2
    usage = capsys.readouterr().err
    assert usage.startswith(f"usage: {script.name} [-h] ")
    assert "the following arguments are required: " in usage
    assert f"Usage: python examples/{script.name} " in script.read_text(encoding="utf-8")


def test_the_script_of_the_page_on_uses_runs(demo: tuple[Path, str], monkeypatch: pytest.MonkeyPatch) -> None:
    """The verdict of Python is that of the command line."""
    folder, _ = demo
    script = _block("example", (ROOT / "docs" / "evaluation" / "use.md").read_text(encoding="utf-8"))
    monkeypatch.chdir(folder.parents[1])
    sentence, numbers = printed(script, "use.md").splitlines()
    shown = typed("evaluate", folder / "experiment.toml", "-c", folder / "calibration.json", "--details").out
    assert sentence in " ".join(shown.split())
    assert numbers.startswith("use 0.9") or numbers.startswith("use 1.0")


@pytest.mark.usefixtures("blank_pictures")
@some_cases("page", sorted(MARKED, key=_is_slow), quick=len(MARKED) - len(SLOW), ids=lambda page: page.name)
def test_marked_scripts_of_pages_run(page: Path, demo: tuple[Path, str], monkeypatch: pytest.MonkeyPatch) -> None:
    """As they stand: what they name is there after the demonstration."""
    folder, _ = demo
    hardly_optimise(monkeypatch)
    monkeypatch.chdir(folder.parents[1])
    for code in marked(page.read_text(encoding="utf-8")):
        printed(code, page.name)


def test_the_readme_is_short() -> None:
    """A README of at most 80 lines is read."""
    assert len(README.splitlines()) <= 80


def test_there_are_four_splits_of_the_yoga_log() -> None:
    """The parametrised tests below look at something."""
    assert len(YOGA) == 4


@pytest.mark.parametrize("path", YOGA, ids=lambda path: path.name)
def test_yoga_examples_parse(path: Path) -> None:
    """The experiment files are valid, also where the measured data are absent."""
    assert parse_experiment(path).sensor[0].serial == "SN026"
