# SPDX-License-Identifier: BSD-3-Clause
"""The page from the library's own server: data in pieces, and saved samples sent back."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.viewer.annotations import Annotations
from forcetorque.viewer.page import ViewerServer, page_of
from tests.browser import Visit
from tests.viewer.browser.arm_scene import Arm, arm_scene

if TYPE_CHECKING:
    from playwright.sync_api import Request

pytestmark = [pytest.mark.browser, pytest.mark.long]

PIECE_BYTES = 1 << 18
NO_REST = """const before = window.fetch;
window.fetch = (...all) =>
    document.documentElement.dataset.ready ? Promise.reject(new Error("the server has ended")) : before(...all);"""
"""Nothing comes any more that is not waited for."""


@pytest.fixture
def long(tmp_path: Path) -> Arm:
    """A scene of some pieces."""
    scene = arm_scene(tmp_path, samples=20_000)
    assert len(scene.built.block) > 4 * PIECE_BYTES
    return scene


@pytest.mark.parametrize("script", [NO_REST, ""], ids=["on demand", "the rest later"])
def test_data_come_in_pieces_first_those_that_are_shown(visit: Visit, long: Arm, script: str) -> None:
    """Numbers are the library's, before and after the rest has come; no byte comes twice."""
    total = len(long.built.block)
    ranges: list[tuple[int, int]] = []

    def note(request: Request) -> None:
        if request.url.endswith("data.bin"):
            first, last = request.headers["range"].removeprefix("bytes=").split("-")
            ranges.append((int(first), min(int(last) + 1, total)))

    with ViewerServer(page_of(long.built, data_url="data.bin"), long.built.block, None) as server:
        page = visit.blank(offline=False)
        page.on("request", note)
        page.add_init_script(script)
        page.goto(server.url)
        page.evaluate("window.ft.ready")
        while not script and sum(end - start for start, end in ranges) < total:
            page.wait_for_timeout(20)
        before = len(ranges)
        page.evaluate("window.ft.show(19999)")
        hand = page.evaluate("window.ft.linkPoses(19999).hand[3]")
    assert hand == pytest.approx(long.link_pose("hand", 19_999)[0, 3], abs=1e-6)
    ordered = sorted(ranges)
    assert [end <= start for (_, end), (start, _) in pairwise(ordered)] == [True] * (len(ordered) - 1)
    if script:
        assert sum(end - start for start, end in ranges) < total, "what is not shown has not come"
    else:
        assert len(ranges) == before, "nothing was missing"
        assert (ordered[0][0], ordered[-1][1]) == (0, total)


@pytest.mark.parametrize("kind", ["fetch", "xhr"])
def test_a_server_that_has_ended_is_named(visit: Visit, long: Arm, kind: str) -> None:
    """Who waits for what does not come learns what to do."""
    with ViewerServer(page_of(long.built, data_url="data.bin"), long.built.block, None) as server:
        page = visit.blank(offline=False)
        page.route(
            "**/data.bin", lambda route: route.abort() if route.request.resource_type == kind else route.continue_()
        )
        page.goto(server.url)
        page.get_by_role("alert").get_by_text("the server does not answer; start the command again").wait_for()
    assert visit.errors, "the browser reports it too"
    visit.errors.clear()


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
