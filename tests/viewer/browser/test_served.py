# SPDX-License-Identifier: BSD-3-Clause
"""The page from the library's own server: data in pieces, and saved samples sent back."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.viewer.annotations import Annotations
from forcetorque.viewer.page import ViewerServer, page_of
from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm, arm_scene

pytestmark = [pytest.mark.browser, pytest.mark.long]

PIECE_BYTES = 4 * 1024 * 1024


def test_data_come_in_pieces(visit: Visit, tmp_path: Path) -> None:
    """All of a block that is longer than a piece arrives, and nothing is asked for twice."""
    long = arm_scene(tmp_path, samples=20_000)
    pieces = -(-len(long.built.block) // PIECE_BYTES)
    assert pieces > 1
    with ViewerServer(page_of(long.built, data_url="data.bin"), long.built.block, None) as server:
        page = visit.go(server.url)
        page.evaluate("window.ft.show(19999)")
        assert page.evaluate("window.ft.sample()") == 19_999
        hand = page.evaluate("window.ft.linkPoses(19999).hand[3]")
    assert hand == pytest.approx(long.link_pose("hand", 19_999)[0, 3], abs=1e-6)
    assert sum(url.endswith("data.bin") for url in visit.requests) == pieces
    assert len(visit.requests) == pieces + 1


def test_saved_samples_are_written_beside_the_experiment(visit: Visit, arm: Arm) -> None:
    """The server gets what the page lists, and the page names the files, or says why there are none."""
    got: list[Annotations] = []

    def keep(annotations: Annotations) -> list[str]:
        got.append(annotations)
        if len(got) > 1:
            raise ForceTorqueError("the folder is full")
        return ["arm.samples.csv", "arm.intervals.toml"]

    page = page_of(arm.built, data_url="data.bin", annotations_url="annotations")
    with ViewerServer(page, arm.built.block, keep) as server:
        view = visit.go(server.url)
        for sample, kind in ((50, "begin"), (60, "end"), (200, "point")):
            view.evaluate(f"window.ft.show({sample})")
            view.keyboard.press(kind[0])
            view.keyboard.press("s")
        button = view.get_by_role("button", name="Write beside the experiment")
        button.click()
        view.get_by_text("Written beside the experiment: arm.samples.csv, arm.intervals.toml").wait_for()
        button.click()
        view.get_by_text("the folder is full").wait_for()
    assert [(s.sample, s.mark) for s in got[0].samples] == [(50, "begin"), (60, "end"), (200, "point")]
    (interval,) = got[0].intervals
    assert (interval.start_s, interval.end_s) == pytest.approx((arm.time_s[50], arm.time_s[61]))
    assert [error for error in visit.errors if "400" not in error] == []  # the browser reports the refusal
    visit.errors.clear()


def test_a_file_offers_no_writing(visit: Visit, arm: Arm) -> None:
    """Nothing would take it."""
    page = visit.open(arm.built)
    assert page.get_by_role("button", name="Samples as CSV").is_visible()
    assert page.get_by_role("button", name="Write beside the experiment").count() == 0
