# SPDX-License-Identifier: BSD-3-Clause
"""`skin check` as it is typed: what it shows, its exit code, its figure."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.skin.layout.formats.registry import read_layout
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.patches import collapsed, cylinder_patch, position_text


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Working folder with a sound layout and one that is not."""
    (tmp_path / "sound.txt").write_text(position_text(cylinder_patch()), encoding="utf-8")
    (tmp_path / "collapsed.txt").write_text(position_text(collapsed(cylinder_patch(), 4)), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_sound_layout_ends_well(run: Run, folder: Path) -> None:
    """Exit code 0, and no line of CSV but the header."""
    assert run("skin", "check", "sound.txt").code == 0
    assert run("skin", "check", "sound.txt", "--format", "csv").out == "defect,taxels,lines,modules,message,remedy\n"


def test_findings_are_exit_code_1(run: Run, folder: Path) -> None:
    """The result is shown all the same, in every form, and fits its schema."""
    table = run("skin", "check", "collapsed.txt")
    assert (table.code, table.log) == (1, ["INFO: reading collapsed.txt"])
    assert "10 taxels share 1 place: 201 distinct places of 210" in table.out
    ended = run("skin", "check", "collapsed.txt", "--format", "json")
    assert ended.code == 1
    content = json.loads(ended.out)
    assert content["findings"][0]["taxels"][:3] == [48, 49, 50]
    schema = run("schema", "skin_check").result()
    assert faults(content, schema) == []
    assert faults({**content, "findings": [{"defect": 1}]}, schema) != []


@pytest.mark.long
def test_a_figure_is_drawn(run: Run, folder: Path) -> None:
    """And refused before the layout is read."""
    ended = run("skin", "check", "sound.txt", "--figure", "patch.png", "--details")
    assert "drawn to patch.png" in ended.out
    assert (folder / "patch.png").read_bytes()[:4] == b"\x89PNG"
    refused = run("skin", "check", "none.txt", "--figure", "patch.jpg").error()
    assert refused == "error: --figure patch.jpg: expected a name that ends in .png or .svg or .pdf"


def test_a_repaired_layout_is_written(run: Run, folder: Path) -> None:
    """Placeholder normals are found, the table with rebuilt ones has no finding; taxels stay where they were."""
    layout = cylinder_patch()
    wrong = replace(layout, normals=np.tile([1.0, 0.0, 0.0], (len(layout), 1)))
    (folder / "wrong.txt").write_text(position_text(wrong), encoding="utf-8")
    found = run("skin", "check", "wrong.txt", "--repaired", "repaired.csv")
    assert found.code == 1
    assert run("skin", "check", "repaired.csv").code == 0
    repaired = read_layout(folder / "repaired.csv")
    np.testing.assert_allclose(repaired.positions, read_layout(folder / "sound.txt").positions, atol=1e-9)
    # a cylinder of 60 mm, whose normals follow from modules to 0.007 degrees
    assert np.degrees(np.arccos(np.clip((repaired.normals * layout.normals).sum(axis=1), -1.0, 1.0))).max() < 0.1


def test_what_needs_moving_is_not_repaired(run: Run, folder: Path) -> None:
    """Taxels at one place have no normals of their own: no file is written."""
    error = run("skin", "check", "collapsed.txt", "--repaired", "repaired.csv").error()
    assert "collapsed.txt" in error
    assert "positions: expected distinct taxels" in error
    assert not (folder / "repaired.csv").exists()


def test_what_is_no_layout_is_one_line(run: Run, folder: Path) -> None:
    """With the file, its line and what was expected."""
    assert run("skin", "check", "none.txt").error() == (
        "error: none.txt: expected a file with a layout of skin, there is none"
    )
    text = (folder / "sound.txt").read_text(encoding="utf-8").split("\n")
    text[6] = "0.06 0.0 0.0 1 0"
    (folder / "short.txt").write_text("\n".join(text), encoding="utf-8")
    assert "short.txt:7: expected six finite numbers" in run("skin", "check", "short.txt").error()
