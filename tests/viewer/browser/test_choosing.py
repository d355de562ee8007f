# SPDX-License-Identifier: BSD-3-Clause
"""What is shown: sensor, force or torque, and the series of several calibrations."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest

from forcetorque.viewer.scene_arrays import read_array
from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm
from tests.viewer.browser.press import picture

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

SERIES = ["expected", "logged", "calibration March", "calibration May"]


def table(page: Page) -> dict[str, list[float]]:
    """Numbers of the current sample by series."""
    rows = page.get_by_role("region", name="Series").get_by_role("row").filter(has=page.get_by_role("cell")).all()
    return {
        str(row.get_by_role("rowheader").text_content()): [
            float(cell) for cell in row.get_by_role("cell").all_text_contents()
        ]
        for row in rows
    }


def test_numbers_are_those_of_the_sensor_and_the_sample(page: Page, arm: Arm) -> None:
    """Forces of one sensor, torques of the other: each series with its values and their norm."""
    for sensor, quantity, first, digits in ((0, "Force", 0, 2), (1, "Torque", 3, 3)):
        page.get_by_label("Sensor", exact=True).select_option(index=sensor)
        page.get_by_role("radiogroup", name="Quantity").get_by_text(quantity).click()
        page.evaluate("window.ft.show(123)")
        found = table(page)
        assert list(found) == SERIES
        for series in arm.built.scene.sensors[sensor].wrenches:
            value = read_array(arm.built.block, series.values)[123, first : first + 3].astype(float)
            wanted = [*value, np.linalg.norm(value)]
            np.testing.assert_allclose(found[series.name], wanted, atol=0.51 * 10.0**-digits)
        acts = f"of {('fore_base', 'hand')[sensor]} on {('upper', 'fore')[sensor]}"
        assert acts in str(page.get_by_role("caption").first.text_content()), "the sign of the reading"


def test_torque_names_every_view(page: Page) -> None:
    """Headings, axes and descriptions change with the quantity; the pictures too."""
    before = picture(page, "Plane x-y")
    page.get_by_role("radiogroup", name="Quantity").get_by_text("Torque").click()
    page.evaluate("window.ft.show(0)")
    assert page.get_by_role("heading", name="Torque space").is_visible()
    assert page.get_by_role("img", name="Torque space of shoulder_ft").is_visible()
    assert picture(page, "Plane x-y") != before
    page.get_by_role("radiogroup", name="Quantity").get_by_text("Force").click()
    page.evaluate("window.ft.show(0)")
    assert picture(page, "Plane x-y") == before


def test_each_series_is_switched_by_itself(page: Page) -> None:
    """Without a series it leaves the table and every view; with it again all is as before."""
    views = ("Robot", "Force space", "Plane x-y", "Plane y-z", "Plane x-z")
    page.evaluate("window.ft.show(425)")
    before = {view: picture(page, view) for view in views}
    for name in SERIES[:2]:
        box = page.get_by_role("checkbox", name=name, exact=True)
        box.uncheck()
        page.evaluate("window.ft.show(425)")
        assert list(table(page)) == [other for other in SERIES if other != name]
        assert all(picture(page, view) != before[view] for view in views), name
        box.check()
    page.evaluate("window.ft.show(425)")
    assert {view: picture(page, view) for view in views} == before


def test_arrows_and_wireframes_are_switched(page: Page) -> None:
    """Each box takes something from the picture and gives it back."""
    page.evaluate("window.ft.show(425)")
    boxes = {
        "Force arrows": "Robot",
        "Moment arrows": "Robot",
        "Arrows of all sensors": "Robot",
        "Contact wrenches": "Robot",
        "Ellipsoids and reference sphere": "Force space",
    }
    for label, view in boxes.items():
        before = picture(page, view)
        page.get_by_label(label).uncheck()
        page.evaluate("window.ft.show(425)")
        assert picture(page, view) != before, label
        page.get_by_label(label).check()
        page.evaluate("window.ft.show(425)")
        assert picture(page, view) == before, label


def test_a_contact_is_not_hidden_with_a_series_of_its_name(visit: Visit, arm: Arm) -> None:
    """Contacts have a box of their own."""
    (wall,) = arm.built.scene.contacts
    scene = replace(arm.built.scene, contacts=(replace(wall, name="logged"),))
    page = visit.open(replace(arm.built, scene=scene))
    page.get_by_role("checkbox", name="logged", exact=True).uncheck()
    page.evaluate("window.ft.show(425)")
    with_contact = picture(page, "Robot")
    page.get_by_label("Contact wrenches").uncheck()
    page.evaluate("window.ft.show(425)")
    assert picture(page, "Robot") != with_contact
