# SPDX-License-Identifier: BSD-3-Clause
"""The page fits windows from a telephone to a large screen, by day, by night and on paper."""

from __future__ import annotations

from dataclasses import replace

import pytest

from forcetorque.results.visual_roles import SURFACES, rgb
from forcetorque.viewer.page import page_of
from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm

pytestmark = [pytest.mark.browser, pytest.mark.long]

SMALL = """() => [...document.querySelectorAll("button, select, summary, label.check, .segments span, input")]
    .filter(e => e.offsetParent !== null && e.type !== "radio")
    .filter(e => e.matches("label") || !e.closest("label.check, .keys dl"))
    .filter(e => { const b = e.getBoundingClientRect(); return b.width && (b.width < 24 || b.height < 24 - 1e-3); })
    .map(e => `${e.tagName} ${e.textContent || e.getAttribute("aria-label")} ${e.getBoundingClientRect().height}`)"""
"""Targets below 24 pixels, success criterion 2.5.8 of WCAG 2.2."""


def _ground(dark: bool, name: str) -> str:
    return "rgb({}, {}, {})".format(*rgb(SURFACES[name][dark]))


@pytest.mark.parametrize("size", [(360, 740), (820, 1180), (1000, 650), (3840, 2160)])
def test_nothing_is_cut_off(visit: Visit, arm: Arm, size: tuple[int, int]) -> None:
    """The page is not wider than its window, the error comes first on a telephone, and targets can be hit."""
    file = visit.folder / "view.html"
    file.write_bytes(page_of(arm.built))
    page = visit.blank()
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.goto(file.as_uri())
    page.evaluate("window.ft.ready")
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    assert page.evaluate(SMALL) == []
    plots = page.evaluate("window.ft.plots()")
    assert [(plot["kind"], plot["component"]) for plot in plots if plot["kind"] == "error"] == [
        ("error", component) for component in range(4)
    ]
    if size[0] == 360:
        tops = [page.locator(name).first.bounding_box() for name in (".times", ".views")]
        assert tops[0] is not None
        assert tops[1] is not None
        assert tops[0]["y"] < tops[1]["y"]


@pytest.mark.parametrize("dark", [False, True])
def test_the_ground_is_that_of_the_system_and_light_on_paper(visit: Visit, arm: Arm, dark: bool) -> None:
    """Panels, and the canvases that are drawn on them, have one colour."""
    file = visit.folder / "view.html"
    file.write_bytes(page_of(arm.built))
    page = visit.blank()
    page.emulate_media(color_scheme="dark" if dark else "light")
    page.goto(file.as_uri())
    page.evaluate("window.ft.ready")
    ground = "getComputedStyle(document.querySelector('.panel')).backgroundColor"
    assert page.evaluate(ground) == _ground(dark, "panel")
    corner = """canvas => { const copy = document.createElement("canvas").getContext("2d");
        copy.drawImage(canvas, 0, 0);
        return `rgb(${[...copy.getImageData(1, 1, 1, 1).data].slice(0, 3).join(", ")})`; }"""
    for name in ("Robot", "Plane x-y"):
        assert page.get_by_role("img", name=name).first.evaluate(corner) == _ground(dark, "panel")
    page.emulate_media(media="print")
    assert page.evaluate(ground) == _ground(False, "panel")
    assert page.get_by_role("button", name="Save sample").is_hidden()


@pytest.mark.parametrize("size", [(360, 740), (1280, 800), (3840, 2160)])
def test_names_and_letters_do_not_lie_on_each_other(visit: Visit, arm: Arm, size: tuple[int, int]) -> None:
    """Those at the robot, in several postures of all sensors; the rectangles are as wide as what is drawn."""
    file = visit.folder / "view.html"
    file.write_bytes(page_of(arm.built))
    page = visit.blank()
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.goto(file.as_uri())
    page.evaluate("window.ft.ready")
    rectangles = []
    for sample in (0, 150, 300, 420, 599):
        rectangles = page.evaluate(f"(window.ft.show({sample}), window.ft.labels())")
        assert len(rectangles) >= 4  # a name and three letters
        for k, one in enumerate(rectangles):
            assert one["right"] - one["left"] > 2.0
            for other in rectangles[:k]:
                assert not _meet(one, other), (sample, one, other)
    assert _meet(rectangles[0], rectangles[0])


@pytest.mark.parametrize("size", [(360, 740), (1280, 800)])
def test_numbers_of_the_space_do_not_touch_its_letters(visit: Visit, arm: Arm, size: tuple[int, int]) -> None:
    """However the view is turned; names of the axes are drawn before numbers."""
    page = visit.blank()
    page.set_viewport_size({"width": size[0], "height": size[1]})
    file = visit.folder / "view.html"
    file.write_bytes(page_of(arm.built))
    page.goto(file.as_uri())
    page.evaluate("window.ft.ready")
    canvas = page.get_by_role("img", name="Force space of shoulder_ft")
    counts = []
    for _ in range(24):  # half of a turn
        canvas.press("Alt+ArrowRight")
        page.evaluate("window.ft.show(0)")
        rectangles = page.evaluate("window.ft.spaceLabels()")
        counts.append(len(rectangles))
        for k, one in enumerate(rectangles):
            for other in rectangles[:k]:
                assert not _meet(one, other), (one, other)
    assert min(counts) >= 6
    assert len(set(counts)) > 1  # where some would touch others they are left out


def test_what_nothing_is_expected_of_has_no_empty_plots(visit: Visit, arm: Arm) -> None:
    """Forces and moments are beside each other in place of errors; the control has an expected wrench."""
    sensors = tuple(
        replace(sensor, wrenches=tuple(series for series in sensor.wrenches if series.role != "expected"))
        for sensor in arm.built.scene.sensors
    )
    bare = replace(arm.built, scene=replace(arm.built.scene, sensors=sensors))
    for built, kinds in ((bare, {"measured"}), (arm.built, {"error", "measured"})):
        page = visit.open(built)
        assert {plot["kind"] for plot in page.evaluate("window.ft.plots()")} == kinds
        assert page.get_by_role("button", name="Worst sample").count() == len(kinds) - 1


def _meet(one: dict[str, float], other: dict[str, float]) -> bool:
    """Whether two rectangles have more than rounding in common."""
    width = min(one["right"], other["right"]) - max(one["left"], other["left"])
    height = min(one["bottom"], other["bottom"]) - max(one["top"], other["top"])
    return min(width, height) > 1e-6
