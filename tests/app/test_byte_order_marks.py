# SPDX-License-Identifier: BSD-3-Clause
"""TOML files of editors that put a byte-order mark in front."""

from __future__ import annotations

import codecs
from collections.abc import Callable
from pathlib import Path

import pytest

import forcetorque
from forcetorque.base.errors import ForceTorqueError, FormatError
from forcetorque.contests.contest_file import read_entries
from forcetorque.device.device_file import DEFAULT_DEVICE, read_device
from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.locomotion.torque_control.torque_loop_file import read_torque_loop
from forcetorque.report.sorted_input_files import sort_sources
from forcetorque.simulation.scenario.scenario import load_scenario
from forcetorque.simulation.scenario.scenario_file import bundled_scenario
from forcetorque.workbench.bench_recording import read_bench
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET

ROOT = Path(forcetorque.__file__).parent


@pytest.mark.long
def test_an_experiment_file_with_a_mark_is_the_same_experiment(arm: Path, run: Run) -> None:
    """Also to `plan`, which looks at its tables first, and to `report`, which looks at its schema."""
    plain = run("evaluate", PARQUET, "-c", "fitted.json", "--format", "json").result()
    Path(PARQUET).write_bytes(codecs.BOM_UTF8 + Path(PARQUET).read_bytes())
    assert run("evaluate", PARQUET, "-c", "fitted.json", "--format", "json").result() == plain
    assert load_experiment(Path(PARQUET), Purpose.PLANNING).sensors[0].name == "arm_ft"
    assert sort_sources([Path(PARQUET)])[0] == [Path(PARQUET)]


@pytest.mark.parametrize(
    ("read", "source"),
    [(read_device, DEFAULT_DEVICE), (load_scenario, bundled_scenario("wrist"))],
    ids=["device", "scene"],
)
def test_a_mark_changes_no_other_file(tmp_path: Path, read: Callable[[Path], object], source: Path) -> None:
    """The bundled files read as they do without one."""
    contents = []
    for head in (b"", codecs.BOM_UTF8):
        (tmp_path / "file.toml").write_bytes(head + source.read_bytes())
        contents.append(repr(read(tmp_path / "file.toml")))
    assert contents[0] == contents[1]


@pytest.mark.parametrize("read", [read_acceptance, read_bench, read_entries, read_torque_loop])
def test_a_mark_is_not_what_is_wrong(tmp_path: Path, read: Callable[[Path], object]) -> None:
    """The message names the key, not a statement in column 1."""
    file = tmp_path / "file.toml"
    file.write_bytes(codecs.BOM_UTF8 + b"no_such_key = 1\n")
    with pytest.raises(ForceTorqueError, match="no_such_key"):
        read(file)


def test_another_encoding_is_still_refused(tmp_path: Path) -> None:
    """Control: UTF-16 has a mark too, and is no TOML."""
    file = tmp_path / "file.toml"
    file.write_bytes('schema = "forcetorque/acceptance/1"\n'.encode("utf-16"))
    with pytest.raises(FormatError, match=r"file\.toml: expected TOML, got"):
        read_acceptance(file)


def test_one_function_reads_toml_files() -> None:
    """`tomllib` is elsewhere only given texts of our own or of an option."""
    users = {path.relative_to(ROOT).as_posix() for path in ROOT.rglob("*.py") if "tomllib" in path.read_text()}
    drafts = {
        f"inspection/draft/{name}.py" for name in ("draft", "proposals", "questions", "recording_table", "toml_edits")
    }
    options = {"formats/specified_keys.py", "payload/log_without_experiment.py"}
    assert users == {"base/toml_file.py"} | drafts | options
