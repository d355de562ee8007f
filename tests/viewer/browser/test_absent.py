# SPDX-License-Identifier: BSD-3-Clause
"""What is absent is said, and the rest of the page works."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from forcetorque.viewer.page import page_of
from forcetorque.viewer.scene_builder import BuiltScene
from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm, arm_scene

pytestmark = [pytest.mark.browser, pytest.mark.long]

NO_GRAPHICS = "This browser draws nothing in 3-D: it has no WebGL 2."


def test_missing_mesh(visit: Visit, tmp_path: Path) -> None:
    """The note names the file; the other shapes are drawn."""
    page = visit.open(arm_scene(tmp_path, meshes=False).built)
    assert page.get_by_role("region", name="Notes").get_by_text("hand.stl").is_visible()
    page.evaluate("window.ft.show(10)")
    assert page.get_by_role("img", name="Robot").is_visible()


def test_no_expected_wrenches(visit: Visit, tmp_path: Path) -> None:
    """The measured series are shown without."""
    page = visit.open(arm_scene(tmp_path, expected=False, notes=("no expected wrenches: no support",)).built)
    assert page.get_by_text("no expected wrenches").is_visible()
    assert page.get_by_role("checkbox", name="expected").count() == 0
    assert page.get_by_role("checkbox", name="logged").is_checked()


def test_nothing_at_all(visit: Visit, tmp_path: Path) -> None:
    """Without samples, or without sensors, contacts, shapes and intervals, every control still does what it can."""
    empty = arm_scene(tmp_path, samples=0).built
    page = visit.open(empty)
    assert page.get_by_text("The scene has no samples.").is_visible()
    for key in ("ArrowRight", " ", "s", "t", "End"):
        page.keyboard.press(key)
    assert page.evaluate("window.ft.sample()") == 0
    bare = arm_scene(tmp_path).built
    robot = replace(bare.scene.robot, shapes=(), meshes=())
    scene = replace(bare.scene, robot=robot, sensors=(), contacts=(), intervals=(), findings=())
    page = visit.open(BuiltScene(scene=scene, block=bare.block))
    assert page.get_by_role("region", name="Robot").is_visible()
    for absent in ("Series", "Force space", "Error in view"):
        assert not page.get_by_role("region", name=absent).is_visible()
    page.get_by_role("button", name="one sample on").click()
    assert page.evaluate("window.ft.sample()") == 1


def test_damaged_data_is_an_error_that_is_read(visit: Visit, arm: Arm) -> None:
    """A block that is too short is no page with wrong numbers."""
    file = visit.folder / "damaged.html"
    file.write_bytes(page_of(replace(arm.built, block=arm.built.block[:1000])))
    page = visit.blank()
    page.goto(file.as_uri())
    alert = page.get_by_role("alert")
    alert.wait_for()
    assert "the data are 1000 bytes long" in str(alert.text_content())
    assert any("1000 bytes" in error for error in visit.errors)
    visit.errors.clear()


def test_no_graphics(visit: Visit, arm: Arm) -> None:
    """Without WebGL the 3-D views say so, in place of a scale of what is not drawn; planes, plots and numbers work."""
    file = visit.folder / "flat.html"
    file.write_bytes(page_of(arm.built))
    page = visit.blank()
    page.add_init_script("""const get = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
            return kind.startsWith("webgl") ? null : get.call(this, kind, ...rest); };""")
    page.goto(file.as_uri())
    page.evaluate("window.ft.ready")
    assert page.locator(".overlay:visible").all_inner_texts() == [NO_GRAPHICS] * 2
    page.evaluate("window.ft.show(0)")
    at = page.evaluate("window.ft.planePoint(0, 1, 425)")
    page.mouse.click(at["x"], at["y"])
    assert page.evaluate("window.ft.sample()") != 0
    assert all("WebGL" in error for error in visit.errors)  # three.js reports it too
    visit.errors.clear()
