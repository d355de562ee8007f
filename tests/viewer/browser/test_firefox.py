# SPDX-License-Identifier: BSD-3-Clause
"""The page in Firefox: numbers, poses, keys, and data that a server gives."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from forcetorque.viewer.packing import packed
from forcetorque.viewer.page import DATA_URL, ViewerServer, page_of
from forcetorque.viewer.scene_arrays import read_array
from tests.firefox import FirefoxPage, firefox_page
from tests.viewer.browser.arm_scene import WALL, Arm
from tests.viewer.browser.test_packed import POSE

pytestmark = [pytest.mark.browser, pytest.mark.long]

SIZE = (1000, 650)
TABLE = "[...document.querySelector('section[aria-label=Series] .values').querySelectorAll('td')].map(d => d.innerText)"
NO_WEBGL = "WebGL"
"""Word in every error of a Firefox without graphics card and display: it has no WebGL then, and the page says so."""


@pytest.fixture(scope="module")
def firefox(tmp_path_factory: pytest.TempPathFactory) -> Iterator[FirefoxPage]:
    """A tab for all tests: it takes seconds to start."""
    with firefox_page(tmp_path_factory.mktemp("firefox") / "profile", SIZE) as page:
        yield page


@pytest.fixture
def page(firefox: FirefoxPage, arm: Arm, tmp_path_factory: pytest.TempPathFactory) -> FirefoxPage:
    """The packed scene as a file."""
    file = tmp_path_factory.mktemp("page") / "view.html"
    file.write_bytes(page_of(packed(arm.built)))
    firefox.errors.clear()
    firefox.go(file.as_uri())
    return firefox


def test_numbers_and_poses_are_those_of_the_library(page: FirefoxPage, arm: Arm) -> None:
    """Wrenches to the digits that are shown, and poses; no error is told, but of what draws in three dimensions."""
    for sample in (0, 123, 599):
        page.evaluate(f"window.ft.show({sample})")
        shown = page.evaluate(TABLE)
        wanted = [
            value
            for series in arm.built.scene.sensors[0].wrenches
            for value in read_array(arm.built.block, series.values)[sample, :3]
        ]
        numbers = [float(text.replace("\N{MINUS SIGN}", "-")) for text in shown if text.strip()]
        assert len(numbers) == 4 * len(wanted) // 3
        components = np.reshape(numbers, (-1, 4))[:, :3].ravel()
        np.testing.assert_allclose(components, wanted, rtol=0, atol=0.1)
        poses = page.evaluate(f"window.ft.linkPoses({sample})")
        for link in ("hand", "finger"):
            np.testing.assert_allclose(np.reshape(poses[link], (4, 4)), arm.link_pose(link, sample), rtol=0, atol=POSE)
    assert [error for error in page.errors if NO_WEBGL not in error] == []


def test_it_opens_at_the_worst_sample_and_keys_find_it_again(page: FirefoxPage, arm: Arm) -> None:
    """The largest error of the validation data, which is outside what is ignored."""
    worst = page.evaluate("window.ft.sample()")
    expected, *_ = (read_array(arm.built.block, one.values) for one in arm.built.scene.sensors[0].wrenches)
    march = arm.built.scene.sensors[0].wrenches[2]
    error = np.linalg.norm((read_array(arm.built.block, march.values) - expected)[:, :3], axis=1)
    error[:300], error[560:], error[WALL] = 0.0, 0.0, 0.0
    assert error[worst] == pytest.approx(error.max(), abs=0.05)
    page.evaluate("window.ft.show(5)")
    page.press("w")
    assert page.evaluate("window.ft.sample()") == worst


def test_time_plots_have_the_scale_of_what_they_show(page: FirefoxPage) -> None:
    """Four rows of errors and four of wrenches, whose ends are numbers; fewer seconds after a key."""
    plots = page.evaluate("window.ft.plots()")
    assert [plot["kind"] for plot in plots].count("error") == 4
    assert all(np.isfinite([*plot["x"], *plot["y"]]).all() for plot in plots)
    page.press("+")
    after = page.evaluate("new Promise(done => requestAnimationFrame(() => done(window.ft.plots())))")
    assert np.ptp(after[0]["x"]) < np.ptp(plots[0]["x"])


def test_a_served_page_fetches_its_arrays(firefox: FirefoxPage, arm: Arm) -> None:
    """By ranges of one address, under its security policy."""
    small = packed(arm.built)
    firefox.errors.clear()
    with ViewerServer(page_of(small, data_url=DATA_URL), small.block, None) as server:
        firefox.go(server.url)
        poses = firefox.evaluate("window.ft.linkPoses(123)")
    np.testing.assert_allclose(np.reshape(poses["hand"], (4, 4)), arm.link_pose("hand", 123), rtol=0, atol=POSE)
    assert [error for error in firefox.errors if NO_WEBGL not in error] == []
