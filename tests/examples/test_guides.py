# SPDX-License-Identifier: BSD-3-Clause
"""docs/guides: every command and script runs as it stands, and prints first what the page shows; pages are short."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.formats.ur_rtde.recordings import GUIDE, guide_text
from tests.page_commands import run_page
from tests.scenes.wrist_table import FILE, table_text

ROOT = Path(__file__).resolve().parents[2]
GUIDES = ROOT / "docs" / "guides"
LONGEST = 60
PAGES = (*sorted(GUIDES.glob("*.md")), ROOT / "docs" / "agents.md")
FAST = ("wrist.md", "plates.md", "agents.md")
"""Pages that run in a few seconds."""


@pytest.mark.parametrize(
    "page",
    [pytest.param(page, id=page.name, marks=() if page.name in FAST else pytest.mark.long) for page in PAGES],
)
def test_a_guide_prints_what_it_shows(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    """From the first command to the last, in one folder. `pytest --write-snapshots` renews what the page shows."""
    shutil.copytree(ROOT / "docs" / "tutorial", tmp_path / "docs" / "tutorial")
    shutil.copytree(ROOT / "examples", tmp_path / "examples", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.chdir(tmp_path)
    shown = page.read_text(encoding="utf-8")
    come = run_page(shown)
    if request.config.getoption("--write-snapshots"):
        page.write_text(come, encoding="utf-8")
    else:
        assert shown == come


def test_guides_are_short() -> None:
    """One screen or two; there is one for each kind of user."""
    lengths = {page.name: len(page.read_text(encoding="utf-8").splitlines()) for page in GUIDES.glob("*.md")}
    users = {"bench.md", "cells.md", "icub.md", "notebook.md", "plates.md", "ros2_bag.md", "skin.md", "wrist.md"}
    assert lengths.keys() == users
    assert max(lengths.values()) <= LONGEST, lengths


def test_the_table_of_the_wrist_is_what_its_script_writes() -> None:
    """So that the truth of the guide is known."""
    assert FILE.read_text(encoding="utf-8") == table_text()
    assert GUIDE.read_text(encoding="ascii") == guide_text()


def test_another_output_is_noticed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: a line that is not printed is put right, and a command that fails is an error."""
    monkeypatch.chdir(tmp_path)
    page = (
        "```console\n$ forcetorque --version\nforcetorque 0.0.0\n```\n\n```python\nprint(1)\n```\n\n```text\n2\n```\n"
    )
    come = run_page(page)
    assert "forcetorque 0.0.0" not in come
    assert come.endswith("```text\n1\n```\n")
    with pytest.raises(AssertionError, match="none.toml"):
        run_page("```console\n$ forcetorque inspect none.toml\n```\n")
