# SPDX-License-Identifier: BSD-3-Clause
"""The page works in the cell of a notebook: a frame without origin and address."""

from __future__ import annotations

import pytest

from forcetorque.viewer.packing import packed
from forcetorque.viewer.page import page_of
from forcetorque.viewer.scene_builder import View
from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm

pytestmark = [pytest.mark.browser, pytest.mark.long]


def test_the_page_is_drawn_in_a_cell_and_can_be_used(visit: Visit, arm: Arm) -> None:
    """Under its own security policy; no error is told, also where it would keep its address."""
    file = visit.folder / "view.html"
    file.write_bytes(page_of(packed(arm.built)))
    shown = View.of(arm.built).model_copy(update={"file": str(file)})._repr_html_()
    notebook = visit.folder / "notebook.html"
    notebook.write_text(f"<!doctype html><title>notebook</title>{shown}", encoding="utf-8")
    page = visit.blank()
    page.goto(notebook.as_uri())
    frame = page.frames[1]
    assert frame.evaluate("window.ft.ready") is True
    before = frame.evaluate("window.ft.sample()")
    frame.evaluate("window.ft.show(7)")
    page.wait_for_timeout(800)  # it would have written its address
    frame.get_by_role("button", name="Worst sample").click()
    assert frame.evaluate("window.ft.sample()") == before != 7
