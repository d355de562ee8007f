# SPDX-License-Identifier: BSD-3-Clause
"""A long log is drawn from its overviews: the page says what it says of the samples."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from forcetorque.viewer import packing as overview
from forcetorque.viewer.packing import packed
from forcetorque.viewer.scene_builder import BuiltScene
from tests.browser import Visit
from tests.viewer.browser.arm_scene import arm_scene
from tests.viewer.browser.press import wait_for_drawing

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

SAMPLES, ABSENT = 6000, 500
NUMBER = re.compile(r"-?\d+\.\d+|(?<=n = )\d+")
SCALE = 0.02
"""Difference of the ends of axes, as a share of them: the band of an overview is the widest of its block."""


def _shown(page: Page) -> dict[str, Any]:
    wait_for_drawing(page)
    return {
        "sample": page.evaluate("window.ft.sample()"),
        "numbers": page.locator("table.statistics").all_inner_texts(),
        "plots": [(plot["x"], plot["y"]) for plot in page.evaluate("window.ft.plots()")],
        "points": page.evaluate("window.ft.cloudSamples().length"),
    }


def _without_first_deviations(built: BuiltScene) -> BuiltScene:
    """The same scene, with no band in the first samples, as outside intervals."""
    block = bytearray(built.block)
    for series in built.scene.sensors[0].wrenches:
        if series.deviation is not None:
            absent = np.full((ABSENT, 6), np.nan, dtype="<f4").tobytes()
            block[series.deviation.offset : series.deviation.offset + len(absent)] = absent
    return replace(built, block=bytes(block))


def test_what_is_drawn_from_overviews_is_what_the_samples_give(
    visit: Visit, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The same worst sample, statistics but for a last digit, ends of axes nearly; of all the log and of parts."""
    built = _without_first_deviations(arm_scene(tmp_path_factory.mktemp("long"), samples=SAMPLES).built)
    plain = visit.open(packed(built))
    monkeypatch.setattr(overview, "FEWEST_SAMPLES", 1)
    monkeypatch.setattr(overview, "BLOCK", 40)
    monkeypatch.setattr(overview, "MOST_POINTS", 2000)
    small = packed(built)
    assert small.scene.sensors[0].wrenches[0].overview is not None
    page = visit.open(small)
    for window in (None, (1.0, 31.0), (2.0, 9.0), (10.0, 10.5)):
        if window is not None:
            for one in (page, plain):
                one.evaluate(f"location.hash = 'window={window[0]},{window[1]}'")
        shown, wanted = _shown(page), _shown(plain)
        assert len(shown["numbers"]) == 3
        assert shown["sample"] == wanted["sample"]
        numbers, others = (np.array(NUMBER.findall("".join(one["numbers"])), float) for one in (shown, wanted))
        assert len(others) > 30
        # of two samples as large on both sides, packing decides which is the larger one
        np.testing.assert_allclose(np.abs(numbers), np.abs(others), rtol=0, atol=0.0101)
        assert len(shown["plots"]) == 8
        for (x, y), (other_x, other_y) in zip(shown["plots"], wanted["plots"], strict=True):
            assert x == other_x
            np.testing.assert_allclose(y, other_y, rtol=0, atol=SCALE * np.ptp(other_y))
        assert wanted["points"] / 4 <= shown["points"] <= wanted["points"]
