# SPDX-License-Identifier: BSD-3-Clause
"""Pictures depend on the sample alone, and the robot stands where the library says."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest

from tests.browser import Visit
from tests.viewer.browser.arm_scene import COORDINATES, SAMPLES, Arm
from tests.viewer.browser.press import picture

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

VIEWS = ("Robot", "Force space", "Plane x-y", "Plane y-z", "Plane x-z")
FLOAT32 = 1e-6
"""Poses of links at most 1 m away, from coordinates in float32."""


def test_same_sample_same_pixels(page: Page, visit: Visit, arm: Arm) -> None:
    """Also after other samples, after turning a view and resetting it, and in another window."""
    page.evaluate("window.ft.show(100)")
    before = {view: picture(page, view) for view in VIEWS}
    page.evaluate("window.ft.show(420)")
    for view in VIEWS:
        assert picture(page, view) != before[view], view
    page.get_by_role("img", name="Robot").press("Alt+ArrowLeft")
    page.evaluate("window.ft.show(100)")
    assert picture(page, "Robot") != before["Robot"]
    page.get_by_role("button", name="Reset the robot's view").click()
    page.evaluate("window.ft.show(100)")
    assert {view: picture(page, view) for view in VIEWS} == before
    other = visit.open(arm.built)
    other.evaluate("window.ft.show(100)")
    assert {view: picture(other, view) for view in VIEWS} == before


def test_links_are_where_the_library_puts_them(page: Page, arm: Arm) -> None:
    """All links, across turning, sliding, following and fixed joints, beneath a root that moves."""
    assert any(joint.multiplier == -0.5 and joint.offset == 0.1 for joint in arm.built.scene.robot.joints)
    for sample in (0, 137, SAMPLES - 1):
        _agree(page, arm, sample)


@pytest.mark.parametrize("joint", COORDINATES)
def test_a_link_elsewhere_is_noticed(page: Page, arm: Arm, joint: str) -> None:
    """Negative control: with one joint of the library 0.01 mrad or 0.01 mm away, the same comparison fails."""
    moved = arm.positions + 10 * FLOAT32 * (np.array(COORDINATES) == joint)
    with pytest.raises(AssertionError, match="finger"):
        _agree(page, replace(arm, positions=moved), 137)


def _agree(page: Page, arm: Arm, sample: int) -> None:
    """The page's poses of all links are the library's."""
    poses = page.evaluate(f"window.ft.linkPoses({sample})")
    assert set(poses) == set(arm.model.links)
    for link in reversed(arm.model.links):
        wanted = arm.link_pose(link, sample)
        np.testing.assert_allclose(np.reshape(poses[link], (4, 4)), wanted, rtol=0, atol=FLOAT32, err_msg=link)
