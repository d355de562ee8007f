# SPDX-License-Identifier: BSD-3-Clause
"""What a screen reader finds on the page."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

CONTROLS = (
    "button",
    "slider",
    "spinbutton",
    "checkbox",
    "radio",
    "combobox",
    "textbox",
    "img",
    "region",
    "progressbar",
)


def test_every_control_and_picture_has_a_name(page: Page) -> None:
    """Also in the parts that are folded, and for saved samples."""
    page.evaluate("document.querySelectorAll('details').forEach(part => { part.open = true; })")
    for kind in ("begin", "end"):
        page.get_by_role("radiogroup", name="Saved sample is").get_by_text(kind, exact=True).click()
        page.get_by_role("button", name="Save sample").click()
    tree = page.locator("body").aria_snapshot()
    lines = [line.strip().removeprefix("- ").removeprefix("'") for line in tree.splitlines()]
    found = {role: [line for line in lines if re.match(rf"{role}\b", line)] for role in CONTROLS}
    for role, controls in found.items():
        assert role == "progressbar" or controls, f"no {role}"  # a progress bar is there while something goes on
        for control in controls:
            assert re.match(rf'{role} ("[^"]|/)', control), f"{control!r} has no name"
    pictures = " ".join(found["img"])
    for text in (
        "Robot arm in its posture at sample 0",
        "Force space of shoulder_ft",
        "Plane x-y",
        "4 intervals and 3 findings",
    ):
        assert text in pictures
    assert "Label of sample 0" in tree
    assert "Use of marked" in tree


def test_states_are_told(page: Page) -> None:
    """The slider says the time, a pressed button that it is pressed, and saving is announced."""
    page.evaluate("window.ft.show(50)")
    assert page.get_by_label("Sample slider").get_attribute("aria-valuetext") == "sample 50, 1.250 s"
    larger = page.get_by_role("button", name="Enlarge force space")
    larger.click()
    assert larger.get_attribute("aria-pressed") == "true"
    assert not page.get_by_role("img", name="Robot").is_visible()
    larger.click()
    assert page.get_by_role("img", name="Robot").is_visible()
    page.get_by_role("button", name="Save sample").click()
    assert page.get_by_role("status").text_content() == "Saved sample 50 at 1.250 s as point."


def test_names_in_the_scene_are_texts(visit: Visit, arm: Arm) -> None:
    """A label that looks like HTML is shown as it is written."""
    from dataclasses import replace

    odd = "<img src=x onerror=alert(1)></script>"
    page = visit.open(replace(arm.built, scene=replace(arm.built.scene, title=odd, notes=(odd,))))
    assert page.get_by_role("heading", level=1).text_content() == odd
    assert page.get_by_role("region", name="Notes").get_by_text(odd).is_visible()
    assert page.locator("img[src=x]").count() == 0
