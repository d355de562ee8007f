# SPDX-License-Identifier: BSD-3-Clause
"""The error is at its own scale beside the wrenches, summed up over the time in view, and the worst is one key away."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.viewer.scene_arrays import read_array
from tests.browser import Visit
from tests.viewer.browser.arm_scene import DEVIATION, WALL, Arm
from tests.viewer.browser.press import picture, wait_for_drawing, wait_until

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.browser

BOTH = "logged", "calibration March", "calibration May"
VALIDATION = slice(300, 560)


def _values(arm: Arm, name: str) -> FloatArray:
    (series,) = (one for one in arm.built.scene.sensors[0].wrenches if one.name == name)
    return np.asarray(read_array(arm.built.block, series.values), dtype=np.float64)


def _error(arm: Arm, name: str) -> FloatArray:
    return _values(arm, name) - _values(arm, "expected")


def _plots(page: Page, kind: str) -> list[dict[str, Any]]:
    wait_for_drawing(page)
    return [plot for plot in page.evaluate("window.ft.plots()") if plot["kind"] == kind]


def _over(page: Page, place: int = 0) -> dict[str, float]:
    box = page.locator(".u-over").nth(place).bounding_box()
    assert box is not None
    return {"x": box["x"], "y": box["y"], "width": box["width"], "height": box["height"]}


def _window(page: Page) -> tuple[float, float]:
    start, end = _plots(page, "error")[0]["x"]
    return start, end


def test_the_scale_of_an_error_is_that_of_the_errors_in_view(page: Page, arm: Arm) -> None:
    """Rows of fx, fy, fz and |f| hold what is in the window, and not much more; the band counts."""
    errors = np.array([_error(arm, name)[:, :3] for name in BOTH])
    errors[:, WALL] = 0.0  # ignored
    band = 1.96 * DEVIATION * np.abs(_values(arm, "expected")[:, :3])
    for window in ((0, 600), (480, 500)):
        rows = slice(*window)
        start, end = arm.time_s[window[0]], arm.time_s[window[1] - 1]
        page.evaluate(f"location.hash = 'window={start:.4f},{end:.4f}'")
        wait_until(page, lambda start=start: abs(_window(page)[0] - start) < 1e-3)  # type: ignore[misc]
        for component, plot in enumerate(_plots(page, "error")[:3]):
            low = min(errors[:, rows, component].min(), -band[rows, component].max(), 0.0)
            high = max(errors[:, rows, component].max(), band[rows, component].max(), 0.0)
            room = 0.1 * (high - low)
            assert low - room < plot["y"][0] < low
            assert high < plot["y"][1] < high + room
        norm = np.linalg.norm(errors[:, rows], axis=2).max()
        assert norm < _plots(page, "error")[3]["y"][1] < 1.25 * norm


def test_errors_by_calibrations_alone_have_a_smaller_scale(page: Page, arm: Arm) -> None:
    """The box takes what was logged out of the scale of errors, and leaves that of wrenches as it is."""
    before = _plots(page, "error"), _plots(page, "measured")
    page.get_by_label("Scale of errors by calibrations alone").check()
    after = _plots(page, "error"), _plots(page, "measured")
    assert after[0][1]["y"][1] < 0.9 * before[0][1]["y"][1]
    assert after[1] == before[1]


def test_statistics_are_those_of_the_window(page: Page, arm: Arm, sample: Callable[[], int]) -> None:
    """Root mean square, mean, largest and their number, of each series and component; the largest is one press away.

    Ignored samples do not count.
    """
    start, end = arm.time_s[310], arm.time_s[470]
    page.evaluate(f"location.hash = 'window={start:.4f},{end:.4f}'")
    wait_until(page, lambda: abs(_window(page)[0] - start) < 1e-3)
    tables = page.get_by_role("region", name="Error in view").get_by_role("table").all()
    assert len(tables) == len(BOTH)
    for name, table in zip(BOTH, tables, strict=True):
        error = np.delete(_error(arm, name), WALL, axis=0)[310:421, :3]
        assert f"{name} [N], n = 111" in str(table.get_by_role("caption").text_content())
        error = np.column_stack([error, np.linalg.norm(error, axis=1)])
        largest = error[np.abs(error).argmax(axis=0), range(4)]
        wanted = np.column_stack([np.sqrt(np.mean(error**2, axis=0)), error.mean(axis=0), largest])
        cells = np.array(table.get_by_role("cell").all_text_contents(), dtype=float).reshape(4, 3)
        np.testing.assert_allclose(cells, wanted, atol=0.0051)
    tables[1].get_by_role("button").nth(3).click()
    norms = np.linalg.norm(_error(arm, BOTH[1])[:471, :3], axis=1)
    norms[WALL] = 0.0
    assert sample() == 310 + int(norms[310:].argmax())


def test_the_norm_is_summed_up_by_use_where_both_are_in_view(page: Page, arm: Arm) -> None:
    """What a calibration was fitted to has a row, and so has what it has not seen."""
    table = page.get_by_role("region", name="Error in view").get_by_role("table").nth(1)
    norms = np.linalg.norm(_error(arm, BOTH[1])[:, :3], axis=1)
    norms[WALL] = np.nan
    for use, rows in (("calibration", slice(30, 290)), ("validation", VALIDATION)):
        row = table.get_by_role("row").filter(has_text=f"|f| {use}")
        cells = np.array(row.get_by_role("cell").all_text_contents(), dtype=float)
        part = norms[rows]
        wanted = [np.sqrt(np.nanmean(part**2)), np.nanmean(part), np.nanmax(part)]
        np.testing.assert_allclose(cells, wanted, atol=0.0051)


def test_worst_sample_and_next_event_have_keys(page: Page, arm: Arm, sample: Callable[[], int]) -> None:
    """The worst one is that of the first calibration in the validation data; events come in the order of time.

    The largest of all, at the wall, lies in an interval that is ignored.
    """
    norms = np.linalg.norm(_error(arm, "calibration March")[:, :3], axis=1)
    assert WALL.start <= norms.argmax() < WALL.stop
    norms[WALL] = 0.0
    page.keyboard.press("w")
    worst = VALIDATION.start + int(norms[VALIDATION].argmax())
    assert sample() == worst
    page.evaluate("window.ft.show(0)")
    reached = []
    for _ in range(5):
        page.keyboard.press("n")
        reached.append(sample())
    assert reached == [30, 199, 300, 400, 400], "intervals and findings with an instant, and no further"
    page.keyboard.press("Shift+N")
    assert sample() == 300
    page.get_by_role("button", name="Worst sample").click()
    assert sample() == worst


@pytest.mark.long
def test_the_wheel_stretches_and_a_drag_moves_the_time_in_view(page: Page, arm: Arm, sample: Callable[[], int]) -> None:
    """What is under the pointer stays there; all plots show the same time, and never more than there is."""
    box, whole = _over(page), (arm.time_s[0], arm.time_s[-1])
    x, y = box["x"] + 0.25 * box["width"], box["y"] + box["height"] / 2
    under = whole[0] + 0.25 * (whole[1] - whole[0])
    page.mouse.move(x, y)
    page.mouse.wheel(0, -600)
    start, end = _window(page)
    assert end - start == pytest.approx(np.exp(-0.9) * (whole[1] - whole[0]), rel=0.01)
    assert start + 0.25 * (end - start) == pytest.approx(under, abs=0.1)
    assert {tuple(plot["x"]) for plot in page.evaluate("window.ft.plots()")} == {(start, end)}
    page.mouse.down()
    page.mouse.move(x - 0.2 * box["width"], y, steps=3)
    page.mouse.up()
    moved = _window(page)
    assert moved[0] - start == pytest.approx(0.2 * (end - start), abs=0.05)
    assert moved[1] - moved[0] == pytest.approx(end - start)
    assert sample() == 0, "a drag is no click"
    page.mouse.wheel(0, 6000)
    assert _window(page) == pytest.approx(whole)


def test_the_pointer_shows_values_in_every_row(page: Page, arm: Arm) -> None:
    """Numbers over the plots are those at the pointer, and at the sample once it has left."""
    box = _over(page)
    wanted = 0.4
    time_s = arm.time_s[0] + wanted * (arm.time_s[-1] - arm.time_s[0])
    page.mouse.move(box["x"] + wanted * box["width"], box["y"] + 5)
    shown = page.locator(".readout").all_text_contents()
    near = np.flatnonzero(np.abs(arm.time_s - time_s) < 0.1)
    for component in range(3):
        text = str(shown[2 * component])
        candidates = {
            "".join(f"{_error(arm, name)[k, component]:.2f}" for name in BOTH).replace("-0.00", "0.00") for k in near
        }
        assert text.replace("-0.00", "0.00") in candidates
    page.mouse.move(5, 5)
    first = "".join(f"{_error(arm, name)[0, 0]:.2f}" for name in BOTH)
    assert page.locator(".readout").first.text_content() == first


@pytest.mark.long
def test_an_address_shows_the_same_again(page: Page, visit: Visit, arm: Arm, sample: Callable[[], int]) -> None:
    """Sample, sensor, quantity, time in view and hidden series are in the address, and are taken from it."""
    page.get_by_label("Sensor", exact=True).select_option(index=1)
    page.keyboard.press("t")
    page.get_by_role("checkbox", name="logged", exact=True).uncheck()
    page.evaluate("window.ft.show(321)")
    page.keyboard.press("+")
    wait_until(page, lambda: "window=" in page.url and "sample=321" in page.url)
    window = _window(page)
    other = visit.blank()
    other.goto(page.url)
    other.evaluate("window.ft.ready")
    assert other.evaluate("window.ft.sample()") == 321
    assert other.get_by_label("Sensor", exact=True).input_value() == "1"
    assert other.get_by_label("Torque", exact=True).is_checked()
    assert not other.get_by_role("checkbox", name="logged", exact=True).is_checked()
    assert _window(other) == pytest.approx(window, abs=1e-3)
    other.goto(page.url.split("#")[0] + "#sample=99999999&sensor=none&quantity=colour&window=5,1&large=x")
    wait_until(other, lambda: other.evaluate("window.ft.sample()") == len(arm.time_s) - 1)
    assert other.get_by_label("Torque", exact=True).is_checked(), "what is not known changes nothing"


def test_an_address_shows_the_same_in_a_page_that_shows_something_else(page: Page, arm: Arm) -> None:
    """Time in view, hidden series and the enlarged panel that an address does not name are those of a new page."""
    window = f"{arm.time_s[310]:.4f},{arm.time_s[470]:.4f}"
    page.evaluate(f"location.hash = 'sample=400&window={window}&hide=logged&large=times'")
    box = page.get_by_role("checkbox", name="logged", exact=True)
    wait_until(page, lambda: _window(page) == pytest.approx((arm.time_s[310], arm.time_s[470]), abs=1e-3))
    assert not box.is_checked()
    larger = page.get_by_role("button", name="Enlarge time plots")
    assert larger.get_attribute("aria-pressed") == "true"
    page.evaluate("location.hash = 'sample=321'")
    wait_until(page, lambda: page.evaluate("window.ft.sample()") == 321)
    assert _window(page) == pytest.approx((arm.time_s[0], arm.time_s[-1]))
    assert box.is_checked()
    assert larger.get_attribute("aria-pressed") == "false"


def test_the_time_in_view_filters_the_cloud(page: Page, arm: Arm) -> None:
    """Points of other samples are gone, those that are left stay where they were."""
    before = page.evaluate("window.ft.planePoint(0, 1, 425)")
    assert page.evaluate("window.ft.cloudSamples().length") == 600
    start, end = arm.time_s[400], arm.time_s[450]
    page.evaluate(f"location.hash = 'window={start:.4f},{end:.4f}'")
    wait_until(page, lambda: page.evaluate("window.ft.cloudSamples()") == list(range(400, 451)))
    assert page.evaluate("window.ft.planePoint(0, 1, 425)") == before


def test_what_is_encircled_becomes_intervals(page: Page, arm: Arm) -> None:
    """A drag around points of a plane marks their time, which is then saved as begins and ends."""
    points = page.evaluate("[425, 426, 427].map(k => window.ft.planePoint(0, 0, k))")
    left, right = min(p["x"] for p in points) - 3, max(p["x"] for p in points) + 3
    top, bottom = min(p["y"] for p in points) - 3, max(p["y"] for p in points) + 3
    page.mouse.move(left, top)
    page.mouse.down()
    for x, y in ((right, top), (right, bottom), (left, bottom), (left, top)):
        page.mouse.move(x, y, steps=2)
    page.mouse.up()
    page.get_by_text("Selected: ").wait_for()
    page.get_by_role("button", name="Save as intervals").click()
    names = page.get_by_role("list", name="Marked intervals").get_by_role("listitem").all_text_contents()
    spans = [tuple(map(float, str(text).split(": ")[1].split(" s")[0].split("–"))) for text in names]
    assert spans
    assert any(start <= arm.time_s[426] <= end for start, end in spans)
    assert sum(end - start for start, end in spans) < 0.5 * (arm.time_s[-1] - arm.time_s[0])
    assert page.get_by_text("Selected: ").is_hidden()


def test_the_robot_shows_the_error(page: Page) -> None:
    """An arrow and the colour of the limb go with the box, and where nothing is wrong they are not seen."""
    page.keyboard.press("w")
    page.evaluate("window.ft.show(window.ft.sample())")
    with_error = picture(page, "Robot")
    page.get_by_label("Error as an arrow").uncheck()
    page.evaluate("window.ft.show(window.ft.sample())")
    assert picture(page, "Robot") != with_error
    assert "of error" not in str(page.locator(".robot .overlay").text_content())
