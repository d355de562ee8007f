# SPDX-License-Identifier: BSD-3-Clause
"""What docs/skin/layout.md shows can be typed: its script, its table, its file of frames."""

from __future__ import annotations

import re
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import SkinError
from forcetorque.skin.layout.check import shape_findings
from forcetorque.skin.layout.defects import FACETED_DEG, NEAREST_CENTRES_M, OBLIQUE_DEG
from forcetorque.skin.layout.finding import Defect, shape_of
from forcetorque.skin.layout.formats.registry import describe_patch, read_layout
from forcetorque.skin.layout.formats.urdf_frames import ModuleFrames
from tests.page_scripts import marked, printed, unmarked
from tests.scenes.patches import cylinder_patch, position_text

PAGE = (Path(__file__).resolve().parents[3] / "docs" / "skin" / "layout.md").read_text(encoding="utf-8")


def _block(first: str) -> str:
    """The indented block that begins with a line."""
    lines = PAGE.partition(f"    {first}")
    kept = re.match(r"(?:    .*\n)+", f"    {first}{lines[2]}")
    assert kept is not None
    return re.sub(r"^    ", "", kept[0], flags=re.MULTILINE)


def test_the_script_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file with zero normals becomes a table that is sound."""
    monkeypatch.chdir(tmp_path)
    patch = cylinder_patch()
    text = position_text(replace(patch, normals=np.zeros((len(patch), 3))))
    Path("right_leg_lower.txt").write_text(text, encoding="utf-8")
    (code,) = unmarked(PAGE)
    exec(compile(code, "skin_layout.md", "exec"), {})
    assert len(read_layout("right_leg_lower.csv")) == 210


def test_a_cover_becomes_a_layout_without_findings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """From centres and a plan, as far off the cover as the page says; a module with another's number is found."""
    monkeypatch.chdir(tmp_path)
    (code,) = marked(PAGE)
    assert printed(code, "skin_layout.md").strip() in PAGE
    cover = tmp_path / "build" / "cover"
    assert shape_findings(shape_of(describe_patch(cover / "shank.csv"))) == ()
    text = (cover / "cover.urdf").read_text(encoding="utf-8")
    for one, other in (("shank_skin_3", "x"), ("shank_skin_20", "shank_skin_3"), ("x", "shank_skin_20")):
        text = text.replace(f'"{one}"', f'"{other}"')
    (cover / "cover.urdf").write_text(text, encoding="utf-8")
    with pytest.raises(SkinError, match="module 3: .*does a frame have the number of another module"):
        describe_patch(cover / "cover.toml")


def test_the_table_is_read(tmp_path: Path) -> None:
    """As it stands on the page."""
    (tmp_path / "palm.csv").write_text(_block("# patch: palm"), encoding="utf-8")
    patch = describe_patch(tmp_path / "palm.csv")
    assert (patch.columns, patch.taxels.tolist(), patch.thermal_pads.tolist()) == (4, [0, 1, 3], [2])


def test_the_file_of_frames_has_its_form() -> None:
    """Every key of it is known."""
    stated = ModuleFrames.model_validate(tomllib.loads(_block('schema = "forcetorque/module_frames/1"')))
    assert (stated.patch, stated.columns) == ("right_leg_lower", 768)


def test_every_finding_is_on_the_page() -> None:
    """By the name that the table of the command has, with the limits of the code."""
    assert [defect for defect in Defect if f"{defect}" not in PAGE] == []
    assert f"more than 90, and more than {OBLIQUE_DEG:g} degrees" in PAGE
    assert f"by more than {FACETED_DEG:g} degrees in the mean" in PAGE
    assert f"nearer than {1e3 * NEAREST_CENTRES_M:.1f} mm" in PAGE
