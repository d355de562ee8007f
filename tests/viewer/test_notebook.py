# SPDX-License-Identifier: BSD-3-Clause
"""A notebook shows the page in its cell, where it is short enough to be kept."""

from __future__ import annotations

import html
import re
from pathlib import Path

import pytest

from forcetorque.viewer import scene_builder
from forcetorque.viewer.scene_builder import BuiltScene, View


def _view(built: BuiltScene, file: Path) -> View:
    return View.of(built).model_copy(update={"file": str(file)})


def test_a_page_is_shown_in_its_cell(built: BuiltScene, tmp_path: Path) -> None:
    """As it is, in a frame that may run its script and no more; quotes in it do not end the attribute."""
    file = tmp_path / "view.html"
    file.write_text('<p class="a">1 < 2 & "b"</p>', encoding="utf-8")
    shown = _view(built, file)._repr_html_()
    (page,) = re.findall(r'<iframe [^>]*srcdoc="([^"]*)"></iframe>', shown)
    assert html.unescape(page) == file.read_text(encoding="utf-8")
    assert 'sandbox="allow-scripts allow-downloads"' in shown


def test_other_files_are_named(built: BuiltScene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A long page, a recording of Rerun, and a page that is gone are not shown."""
    file = tmp_path / "view.html"
    file.write_text("12345", encoding="utf-8")
    (tmp_path / "view.rrd").write_text("1", encoding="utf-8")
    monkeypatch.setattr(scene_builder, "INLINE_BYTES", 4)
    for name in ("view.html", "view.rrd", "gone.html"):
        shown = _view(built, tmp_path / name)._repr_html_()
        assert "<iframe" not in shown
        assert ("is not shown here" in shown) == (name == "view.html")
