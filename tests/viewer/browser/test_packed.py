# SPDX-License-Identifier: BSD-3-Clause
"""The page reads packed arrays as the library does."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.viewer.packing import packed, unpack
from forcetorque.viewer.page import page_of
from forcetorque.viewer.scene_arrays import read_array
from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm
from tests.viewer.browser.test_choosing import SERIES, table

pytestmark = [pytest.mark.browser, pytest.mark.long]

POSE = 3e-6
"""Error of a pose, metres: joints of the arm are off by some ten-millionths, at 1 m at most."""


def test_numbers_and_poses_of_a_packed_page_are_those_of_the_library(visit: Visit, arm: Arm) -> None:
    """Wrenches to the digits that are shown, with what is absent; and the same sample is the worst one."""
    small = packed(arm.built)
    page, plain = visit.open(small), visit.open(arm.built)
    assert page.evaluate("window.ft.sample()") == plain.evaluate("window.ft.sample()")
    for sample in (0, 123, 425, 599):
        page.evaluate(f"window.ft.show({sample})")
        shown = table(page)
        assert list(shown) == SERIES
        for series, before in zip(small.scene.sensors[0].wrenches, arm.built.scene.sensors[0].wrenches, strict=True):
            reference = series.values
            assert reference.packed_bytes is not None
            data = small.block[reference.offset : reference.offset + reference.packed_bytes]
            value = unpack(data, (reference.shape[0], 6))[sample, :3]
            np.testing.assert_allclose(shown[series.name][:3], value, atol=0.0051)
            np.testing.assert_allclose(value, read_array(arm.built.block, before.values)[sample, :3], atol=0.1)
        poses = page.evaluate(f"window.ft.linkPoses({sample})")
        for link in ("hand", "finger"):
            wanted = arm.link_pose(link, sample)
            np.testing.assert_allclose(np.reshape(poses[link], (4, 4)), wanted, rtol=0, atol=POSE)


def test_a_browser_of_before_2025_shows_the_same(visit: Visit, arm: Arm) -> None:
    """It decodes base64 another way."""
    file = visit.folder / "view.html"
    file.write_bytes(page_of(packed(arm.built)))
    shown = []
    for script in ("", "delete Uint8Array.fromBase64"):
        page = visit.blank()
        page.add_init_script(script)
        page.goto(file.as_uri())
        page.evaluate("window.ft.ready")
        shown.append((table(page), page.evaluate("window.ft.linkPoses(123)"), page.evaluate("window.ft.plots()")))
    assert page.evaluate("Uint8Array.fromBase64 === undefined")
    assert shown[0] == shown[1]
