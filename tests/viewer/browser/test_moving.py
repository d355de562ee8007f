# SPDX-License-Identifier: BSD-3-Clause
"""Every way to another sample leads there, and all views follow."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
import pytest

from tests.browser import Visit
from tests.viewer.browser.arm_scene import SAMPLES, Arm
from tests.viewer.browser.press import wait_for_drawing, wait_until

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.browser

PIXEL_S = 12.0 / 310
"""Width of a pixel of the time plots at this size of the window."""


def test_slider_and_number_jump(page: Page, sample: Callable[[], int], arm: Arm) -> None:
    """The slider, the box and the shown time name one sample."""
    number, slider = page.get_by_label("Sample number"), page.get_by_label("Sample slider")
    number.fill("123")
    number.press("Enter")
    assert sample() == 123
    assert slider.input_value() == "123"
    assert page.get_by_role("time").text_content() == f"{arm.time_s[123]:.3f} s"
    slider.fill("321")
    assert sample() == 321
    assert number.input_value() == "321"
    number.fill("99999")
    number.press("Enter")
    assert sample() == SAMPLES - 1, "a number beyond the last sample is the last sample"
    number.fill("")
    number.press("Enter")
    assert sample() == SAMPLES - 1, "nothing is no number"
    assert number.input_value() == str(SAMPLES - 1)


@pytest.mark.long
def test_click_on_a_plot_jumps_to_that_time(page: Page, sample: Callable[[], int], arm: Arm) -> None:
    """The clicked place along the time axis is the instant that is shown, and the cursor is drawn there."""
    for plot, share in enumerate((0.2, 0.45, 0.7)):
        box = page.locator(".u-over").nth(plot).bounding_box()
        assert box is not None
        page.mouse.click(box["x"] + share * box["width"], box["y"] + box["height"] / 2)
        wanted = arm.time_s[0] + share * (arm.time_s[-1] - arm.time_s[0])
        assert abs(arm.time_s[sample()] - wanted) < 2 * PIXEL_S, plot
        cursor = page.locator(".plot-cursor").nth(plot).bounding_box()
        assert cursor is not None
        assert abs(cursor["x"] + 1 - (box["x"] + share * box["width"])) <= 2.0, plot


def test_drag_with_shift_on_a_plot_shows_a_part_of_the_time(page: Page, sample: Callable[[], int], arm: Arm) -> None:
    """A dragged span fills the plots until the whole recording is asked for; the sample stays."""
    over = page.locator(".u-over").first
    box = over.bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.5 * box["width"], y)
    page.keyboard.down("Shift")
    page.mouse.down()
    page.mouse.move(box["x"] + 0.6 * box["width"], y, steps=3)
    page.mouse.up()
    page.keyboard.up("Shift")
    assert sample() == 0
    wait_for_drawing(page)
    page.mouse.click(box["x"] + 0.5 * box["width"], y)  # now the middle of what was dragged
    wanted = arm.time_s[0] + 0.55 * (arm.time_s[-1] - arm.time_s[0])
    assert abs(arm.time_s[sample()] - wanted) < 2 * PIXEL_S
    page.get_by_role("button", name="Whole recording").click()
    wait_for_drawing(page)
    page.mouse.click(box["x"] + 0.25 * box["width"], y)
    wanted = arm.time_s[0] + 0.25 * (arm.time_s[-1] - arm.time_s[0])
    assert abs(arm.time_s[sample()] - wanted) < 2 * PIXEL_S


def _cursor_errors(page: Page, time_s: float, window: tuple[float, float]) -> list[float]:
    """How far the cursor of every plot is from a time; pixels."""
    errors = []
    for plot in range(3):
        box, cursor = (page.locator(name).nth(plot).bounding_box() for name in (".u-over", ".plot-cursor"))
        assert box is not None
        assert cursor is not None
        share = (time_s - window[0]) / (window[1] - window[0])
        errors.append(abs(cursor["x"] + cursor["width"] / 2 - (box["x"] + share * box["width"])))
    return errors


@pytest.mark.long
def test_the_cursor_stays_at_its_time_when_the_plots_are_zoomed(page: Page, arm: Arm) -> None:
    """It is where the sample is in the part that was dragged, and again in the whole, without another sample."""
    page.evaluate("window.ft.show(350)")
    whole = (float(arm.time_s[0]), float(arm.time_s[-1]))
    box = page.locator(".u-over").first.bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.5 * box["width"], y)
    page.keyboard.down("Shift")
    page.mouse.down()
    page.mouse.move(box["x"] + 0.6 * box["width"], y, steps=3)
    page.mouse.up()
    page.keyboard.up("Shift")
    wait_for_drawing(page)
    start, end = (whole[0] + share * (whole[1] - whole[0]) for share in (0.5, 0.6))
    assert start < arm.time_s[350] < end
    # the dragged pixels are whole ones, and ten times as wide here
    assert max(_cursor_errors(page, float(arm.time_s[350]), (start, end))) < 11.0
    page.get_by_role("button", name="Whole recording").click()
    wait_for_drawing(page)
    assert max(_cursor_errors(page, float(arm.time_s[350]), whole)) < 1.0


@pytest.mark.long
def test_the_cursor_stays_at_its_time_when_the_window_is_resized(visit: Visit, arm: Arm) -> None:
    """In a wider and in a narrower window, without another sample."""
    page = visit.open(arm.built)
    page.evaluate("window.ft.show(350)")
    time_s = float(arm.time_s[350])
    whole = (float(arm.time_s[0]), float(arm.time_s[-1]))
    wait_for_drawing(page)
    assert max(_cursor_errors(page, time_s, whole)) < 1.0
    for size in (1400, 1000, 900):
        page.set_viewport_size({"width": size, "height": 650})
        wait_for_drawing(page)
        assert max(_cursor_errors(page, time_s, whole)) < 1.0, size


@pytest.mark.long
def test_click_on_a_point_jumps_to_a_sample_there(page: Page, sample: Callable[[], int], arm: Arm) -> None:
    """What is shown after a click in the force space or a plane lies under the pointer, in some series."""
    views = ("window.ft.spacePoint(", *(f"window.ft.planePoint({k}, " for k in range(3)))
    for place, wanted in product(views, (37, 425)):
        page.evaluate("window.ft.show(0)")
        at = page.evaluate(f"{place}1, {wanted})")
        page.mouse.click(at["x"], at["y"])
        assert sample() != 0
        names = range(len(arm.built.scene.sensors[0].wrenches))
        places = [page.evaluate(f"{place}{k}, {sample()})") for k in names]
        assert min(np.hypot(p["x"] - at["x"], p["y"] - at["y"]) for p in places) < 2.0


@pytest.mark.long
def test_play_moves_on_and_pause_stops(page: Page, sample: Callable[[], int]) -> None:
    """Playing shows later and later samples, and stops when told or at the end."""
    page.get_by_label("Speed", exact=True).select_option("2")
    page.get_by_role("button", name="Play").click()
    wait_until(page, lambda: sample() > 10)
    page.get_by_role("button", name="Pause").click()
    stopped = sample()
    page.wait_for_timeout(300)
    assert sample() == stopped
    page.evaluate(f"window.ft.show({SAMPLES - 5})")
    page.get_by_role("button", name="Play").click()
    page.get_by_role("button", name="Play").wait_for()
    assert sample() == SAMPLES - 1


def test_finding_and_interval_lead_to_their_start(page: Page, sample: Callable[[], int]) -> None:
    """What the lists name is one press away."""
    page.get_by_text("Findings (3)").click()
    page.get_by_role("button", name="contact at").click()
    assert sample() == 400
    page.get_by_text("Intervals (3)").click()
    page.get_by_role("button", name="moving").click()
    assert sample() == 30


@pytest.mark.long
def test_everything_without_a_mouse(page: Page, sample: Callable[[], int]) -> None:
    """Steps, ends, playing, quantity and saving have keys; every control is reached by Tab."""
    for key, wanted in (
        ("ArrowRight", 1),
        ("Shift+ArrowRight", 11),
        ("ArrowLeft", 10),
        ("End", SAMPLES - 1),
        ("Home", 0),
    ):
        page.keyboard.press(key)
        assert sample() == wanted, key
    page.keyboard.press("t")
    assert page.get_by_label("Torque", exact=True).is_checked()
    page.keyboard.press("b")
    page.keyboard.press("s")
    assert page.get_by_role("list", name="Saved samples").get_by_role("listitem").count() == 1
    page.keyboard.press(" ")
    wait_until(page, lambda: sample() > 0)
    page.keyboard.press(" ")
    reached = set()
    for _ in range(80):  # the page has some 65 stops
        page.keyboard.press("Tab")
        reached.add(
            page.evaluate("""() => { const e = document.activeElement;
            return e.getAttribute('aria-label') || e.closest('label')?.textContent || e.textContent; }""")
        )
    wanted_names = {
        "Sensor",
        "Sample slider",
        "Sample number",
        "Speed",
        "Play",
        "Save sample",
        "Samples as CSV",
        "expected",
    }
    assert wanted_names <= reached
    slider = page.get_by_label("Sample slider")
    slider.focus()
    page.keyboard.press("Home")
    page.keyboard.press("Shift+ArrowRight")
    assert sample() == 10, "the slider takes the same steps"
    number = page.get_by_label("Sample number")
    number.focus()
    page.keyboard.press("Control+A")
    page.keyboard.type("77")
    page.keyboard.press("Enter")
    assert sample() == 77
    number.press("s")
    assert page.get_by_role("list", name="Saved samples").get_by_role("listitem").count() == 1, "a box keeps its keys"


@pytest.mark.long
def test_arrows_step_after_a_choice_by_mouse(page: Page, sample: Callable[[], int]) -> None:
    """A clicked radio button does not keep the arrows; one that was reached by keyboard does."""
    page.get_by_role("radiogroup", name="Quantity").get_by_text("Torque").click()
    page.keyboard.press("ArrowRight")
    assert sample() == 1
    assert page.get_by_label("Torque", exact=True).is_checked()
    page.get_by_label("Sensor", exact=True).focus()
    page.keyboard.press("Tab")
    page.keyboard.press("ArrowLeft")
    assert sample() == 1
    assert page.get_by_label("Force", exact=True).is_checked()
