# SPDX-License-Identifier: BSD-3-Clause
"""Pictures depend on the sample alone, and the robot stands where the library says."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from tests.browser import Visit
from tests.viewer.browser.arm_scene import SAMPLES, Arm
from tests.viewer.browser.press import picture

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.browser

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
    """All links, across turning, sliding and fixed joints, beneath a root that moves."""
    compared = 0
    for sample in (0, 137, SAMPLES - 1):
        poses = page.evaluate(f"window.ft.linkPoses({sample})")
        assert set(poses) == set(arm.model.links)
        for link, pose in poses.items():
            np.testing.assert_allclose(np.reshape(pose, (4, 4)), arm.link_pose(link, sample), atol=FLOAT32)
            compared += 1
    assert compared == 3 * len(arm.model.links)
    # the comparison can fail: neighbouring samples differ by far more
    assert not np.allclose(np.reshape(poses["hand"], (4, 4)), arm.link_pose("hand", SAMPLES - 2), atol=1e3 * FLOAT32)
