# SPDX-License-Identifier: BSD-3-Clause
"""The page follows a run while it lasts: readings, status, robot, hold and go on, and how it says that a run ended."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.gravity_and_tool_weight import JointPositions
from forcetorque.live.loop import LiveLoop
from forcetorque.live.option_values import HeldQuantity, OffsetSource
from forcetorque.live.packets import Packet, PacketCounts
from forcetorque.live.recent_samples import RecentSamples
from forcetorque.live.ros_topics import RosSource
from forcetorque.live.sample_status import Status
from forcetorque.live.settings import Settings
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.viewer.live_page import live_page
from tests.browser import Visit, needs_axe, violations
from tests.live.test_ros_topics import Loopback
from tests.scenes.calibrations import make_calibration
from tests.viewer.browser.test_accessibility import FEWEST_RULES, OPEN

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

RAW = np.array([[100.0, -200.0, 300.0, -400.0, 500.0, -600.0]])
JOINT = "shoulder_pitch"


class Arm(RosSource):
    """An arm that moves one joint, at 200 Hz, until it is told to stop; every 50th packet does not come."""

    def __init__(self) -> None:
        model = read_urdf(ARM_URDF)
        names = [name for name, joint in model.joints.items() if joint.type.moves and joint.mimic is None]
        super().__init__(
            Loopback(),
            {"leg_ft": "/ft"},
            frames={"leg_ft": "hand"},
            domain=0,
            clock=time.monotonic,
            positions=JointPositions(names),
        )
        self.counts = PacketCounts(countable=True)
        self.stop, self.faulty, self.angle = threading.Event(), threading.Event(), 0.0

    def packets(self) -> Iterator[Packet | None]:
        assert self.positions is not None
        number = 0
        while not self.stop.is_set():
            number += 1
            time.sleep(0.005)
            if number % 50 == 0:
                continue
            self.angle = 0.001 * (number % 1000)
            self.positions.add(self.positions.names, [self.angle if n == JOINT else 0.0 for n in self.positions.names])
            yield Packet(
                values=RAW * (1.0 + 0.1 * np.sin(0.05 * number)), stamp_ns=number * 5_000_000, sequence=number,
                positions=self.positions.vector, faults=[int(Status.DEVICE)] if self.faulty.is_set() else None,
            )  # fmt: skip


@contextmanager
def _running(calibration: Calibration, source: Arm) -> Iterator[str]:
    """Address of the page of a run that goes on until the block ends."""
    options = CorrectorOptions(quantity=HeldQuantity.RAW, offset=OffsetSource.TARE, tare_s=0.2)
    correctors = (Corrector(calibration, options),)
    settings = Settings(robot=Path(ARM_URDF), joints="/joints", frame=("hand",), ros2=("/ft",), shown=True)
    urls: list[str] = []
    with live_page(settings, source, correctors, window_s=3.0, opened=urls.append) as page:
        loop = LiveLoop(source, correctors, [], clock=time.monotonic, recent=page.recent)
        page.follow(loop)
        thread = threading.Thread(target=lambda: page.end(loop.run()))
        thread.start()
        try:
            yield urls[0]
        finally:
            source.stop.set()
            thread.join()


def _until(page: Page, holds: str) -> None:
    """Wait: a page of this policy evaluates no text by itself."""
    end = time.monotonic() + 20.0
    while not page.evaluate(holds):
        assert time.monotonic() < end, holds
        page.wait_for_timeout(50)


def _live(page: Page) -> dict[str, Any]:
    state: dict[str, Any] = page.evaluate("window.ft.live()")
    return state


def test_the_page_follows_a_run(visit: Visit) -> None:
    """The window moves on, holds, goes on without a gap, and stays when the run ends."""
    source, calibration = Arm(), make_calibration()
    with _running(calibration, source) as url:
        page = visit.go(url)
        _until(page, "window.ft.live().span[1] > 4")
        first = _live(page)
        assert first["span"][1] - first["span"][0] <= 3.01
        assert first["skipped"] == 0
        assert first["update"]["lost"] == pytest.approx(first["update"]["received"] / 49, abs=1.1)
        page.get_by_role("row", name="leg_ft ok 0.00 0 of").wait_for()
        _until(page, "window.ft.sample() > 100")

        page.get_by_role("button", name="Hold").click()
        page.wait_for_timeout(300)
        held = _live(page)
        source.faulty.set()
        page.get_by_role("row", name="leg_ft device").wait_for()  # the state goes on
        assert _live(page)["span"] == held["span"]
        assert _live(page)["update"]["received"] > held["update"]["received"]
        source.faulty.clear()
        page.get_by_role("button", name="Follow").click()
        _until(page, f"window.ft.live().span[1] > {held['span'][1] + 0.5}")
        assert _live(page)["skipped"] == 0
        source.stop.set()
        page.get_by_text("The run ended: end of input. What came last stays here.").wait_for()
    last = _live(page)
    assert last["update"]["ended_by"] == "end of input"
    assert page.get_by_role("button", name="Follow").is_disabled()
    shown = page.evaluate("window.ft.sample()")
    page.keyboard.press(" ")
    assert page.get_by_role("button", name="Follow").is_disabled()
    assert page.evaluate("window.ft.sample()") == shown > 0

    sample = last["samples"] - 1
    model = read_urdf(ARM_URDF)
    tree = build_tree(model, model.root_link)
    names = tuple(source.positions.names) if source.positions else ()
    joints = JointMotion.at_rest(names, np.array([[source.angle if name == JOINT else 0.0 for name in names]]))
    expected = link_pose(tree, joints, "hand")[0]
    assert page.evaluate(f"window.ft.linkPoses({sample}).hand") == pytest.approx(expected.ravel().tolist(), abs=1e-5)
    assert expected[2, 3] != pytest.approx(
        link_pose(tree, JointMotion.at_rest(names, np.zeros((1, 5))), "hand")[0, 2, 3]
    )
    values = page.get_by_role("table").filter(has_text="Force [N]").inner_text()
    assert "corrected" in page.content()
    assert values.count("\n") >= 2


def test_a_page_says_that_it_shows_less_than_is_wanted(visit: Visit, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no room is for the time; not before."""
    monkeypatch.setattr("forcetorque.viewer.live_page.RecentSamples", partial(RecentSamples, kept=200))
    with _running(make_calibration(), Arm()) as url:
        page = visit.go(url)
        _until(page, "window.ft.live().samples > 20")
        assert "shown are" not in page.locator("footer").inner_text()
        page.get_by_text("shown are 1 s, not 3 s: 200 samples at most").wait_for()


@pytest.mark.parametrize("key", [" ", "Home", "End"])
def test_a_page_that_is_held_before_the_first_sample_goes_on(visit: Visit, key: str) -> None:
    """Held while nothing came, it follows when it is told to."""
    begin, source = threading.Event(), Arm()
    moving = source.packets

    def packets() -> Iterator[Packet | None]:
        while not (begin.wait(0.05) or source.stop.is_set()):
            yield None
        yield from moving()

    source.packets = packets  # type: ignore[method-assign]
    with _running(make_calibration(), source) as url:
        page = visit.go(url)
        page.get_by_role("button", name="Hold").wait_for()
        page.keyboard.press(key)
        page.get_by_role("button", name="Follow").wait_for()
        begin.set()
        _until(page, "window.ft.live().update.total > 10")
        assert _live(page)["samples"] == 0
        page.get_by_role("button", name="Follow").click()
        _until(page, "window.ft.live().samples > 10")


def test_a_page_that_is_closed_does_not_end_the_run(visit: Visit) -> None:
    """Another one that is opened later shows the last seconds."""
    source = Arm()
    with _running(make_calibration(), source) as url:
        page = visit.go(url)
        _until(page, "window.ft.live().samples > 0")
        page.close()
        again = visit.go(url)
        _until(again, "window.ft.live().span[1] > 2")
        assert _live(again)["skipped"] == 0
        content = again.content()
    assert "connect-src 'self'" in content
    assert "default-src 'none'" in content


def test_a_server_that_is_gone_is_named(visit: Visit) -> None:
    """What came stays on the page."""
    source = Arm()
    with _running(make_calibration(), source) as url:
        page = visit.go(url)
        _until(page, "window.ft.live().samples > 0")
        page.route("**/stream*", lambda route: route.abort())
        page.get_by_text("The run ended: the server of the run does not answer").wait_for()
        assert _live(page)["samples"] > 0
    assert visit.errors, "the browser reports it too"
    visit.errors.clear()


@needs_axe
def test_no_violation_of_accessibility(visit: Visit) -> None:
    """Of a page that follows a run, with all details open and the time plots enlarged."""
    with _running(make_calibration(), Arm()) as url:
        page = visit.go(url)
        _until(page, "window.ft.live().samples > 0")
        page.get_by_role("button", name="Hold").click()
        page.evaluate(OPEN)
        assert violations(page, FEWEST_RULES) == []
        page.get_by_role("button", name="Enlarge time plots").click()
        assert violations(page, FEWEST_RULES) == []
