# SPDX-License-Identifier: BSD-3-Clause
"""Axe finds no violation of WCAG 2.2 AA, at any size, by day and by night, with everything open."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.viewer.page import page_of
from forcetorque.viewer.scene_builder import BuiltScene, scene_of
from tests.browser import Visit, needs_axe, violations
from tests.scenes.skin_alone import write_events
from tests.viewer.browser.arm_scene import Arm, arm_scene
from tests.viewer.browser.press import wait_for_drawing

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

OPEN = "document.querySelectorAll('details:not(.keys)').forEach(part => { part.open = true; })"
NAMELESS = "document.querySelector('header').append(document.createElement('button'))"
FEWEST_RULES = 40
"""Rules that find something to check on the page."""


def _violations(page: Page) -> list[tuple[str, list[str]]]:
    wait_for_drawing(page)
    return violations(page, FEWEST_RULES)


@needs_axe
@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("size", [(360, 740), (1280, 720)])
def test_no_violation(visit: Visit, arm: Arm, size: tuple[int, int], dark: bool) -> None:
    """As it opens, with all details open, with the keys, and with a panel enlarged; a nameless button is found."""
    file = visit.folder / "view.html"
    file.write_bytes(page_of(arm.built))
    page = visit.blank()
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.emulate_media(color_scheme="dark" if dark else "light")
    page.goto(file.as_uri())
    page.evaluate("window.ft.ready")
    assert _violations(page) == []
    page.evaluate(OPEN)
    assert _violations(page) == []
    page.get_by_role("button", name="Enlarge time plots").click()
    assert _violations(page) == []
    page.get_by_text("Keys", exact=True).click()
    assert _violations(page) == []
    page.evaluate(NAMELESS)
    assert [rule for rule, _ in _violations(page)] == ["button-name"]


def _skin_alone(folder: Path) -> BuiltScene:
    file = write_events(folder)
    return scene_of(file, load_experiment(file, Purpose.DISPLAY), {})


def _without_expected(folder: Path) -> BuiltScene:
    return arm_scene(folder, expected=False, notes=("no expected wrenches: no support",)).built


@needs_axe
@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("scene", [_skin_alone, _without_expected])
def test_no_violation_where_panels_are_absent(
    visit: Visit, tmp_path: Path, scene: Callable[[Path], BuiltScene], dark: bool
) -> None:
    """Of skin without a sensor, and of a sensor without an expected wrench; a nameless button is found."""
    page = visit.open(scene(tmp_path))
    page.emulate_media(color_scheme="dark" if dark else "light")
    assert _violations(page) == []
    page.evaluate(OPEN)
    assert _violations(page) == []
    page.evaluate(NAMELESS)
    assert [rule for rule, _ in _violations(page)] == ["button-name"]
