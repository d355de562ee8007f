# SPDX-License-Identifier: BSD-3-Clause
"""Skin in a real browser: what is drawn at a sample is what the scene holds at its instant."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.viewer.page import page_of
from forcetorque.viewer.scene import SkinEventSeries, SkinPatch
from forcetorque.viewer.scene_arrays import Block, read_array
from forcetorque.viewer.scene_builder import BuiltScene, scene_of
from forcetorque.viewer.skin import contact_frames
from tests.browser import Visit
from tests.scenes.skin_alone import TOUCHED, write_events
from tests.viewer.browser.arm_scene import Arm, arm_scene
from tests.viewer.browser.opened import as_opened

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

VERTICES = np.array([[0.0, -0.03, 0.026], [0.1, -0.03, 0.026], [0.1, 0.03, 0.026], [0.0, 0.03, 0.026]])
PRESSURE = np.array([[0.0, 0, 0, 0], [4e3, 0, 2e3, 0], [1e4, 8e3, 2e3, 1e3]])
"""Pressures of three frames, of 2 s each from 1 s on; Pa."""
STARTS, HOLD_S = np.array([1.0, 3.0, 5.0]), 2.0
PLACES = [np.zeros((0, 3)), VERTICES[:1], VERTICES[[0, 2]]]
FORCES = [np.zeros((0, 3)), np.array([[0.0, 0.0, -10.0]]), np.array([[0.0, 0.0, -20.0], [3.0, 0.0, -4.0]])]
IDENTITIES = [np.array([], dtype=np.int64), np.array([1]), np.array([1, 3])]
SD_N = 0.5
RASTER = """(canvas, places) => places.map(([start, end, seconds, row]) => {
    const [left, right] = [58, canvas.clientWidth - 10];  // as the plots
    const sum = (colour) => colour.reduce((total, part) => total + Number(part), 0);
    const ground = sum(getComputedStyle(document.querySelector(".panel")).backgroundColor.match(/\\d+/g));
    const x = left + ((seconds - start) / (end - start)) * (right - left);
    const pixel = canvas.getContext("2d").getImageData(
        Math.round(x * devicePixelRatio), Math.round((14 * row + 7) * devicePixelRatio), 1, 1).data;
    return sum([...pixel].slice(0, 3)) * pixel[3] / 255 + ground * (1 - pixel[3] / 255);
})"""
"""Brightness of a row at an instant, on the ground of the page."""
METRES_TOLERANCE = 1e-5
"""Of tips: coordinates are float32."""


@pytest.fixture(scope="module", name="skinned")
def skinned_scene(tmp_path_factory: pytest.TempPathFactory) -> tuple[Arm, BuiltScene]:
    """The arm with a patch on its forearm and the contacts of a skinManager in its hand."""
    arm = arm_scene(tmp_path_factory.mktemp("skinned"))
    block = Block()
    block.add(np.frombuffer(arm.built.block, dtype=np.float32), "float32")
    covariances = [np.tile(SD_N**2 * np.eye(3), (len(force), 1, 1)) for force in FORCES]
    patch = SkinPatch(
        name="forearm_skin",
        link="fore",
        vertices=block.add(VERTICES, "float32"),
        faces=block.add(np.array([[0, 1, 2], [0, 2, 3]]), "uint32"),
        pressure=block.add(PRESSURE, "float32"),
        largest_Pa=float(PRESSURE.max()),
        contacts=contact_frames(
            block,
            time_s=STARTS,
            hold_s=HOLD_S,
            places=PLACES,
            forces=FORCES,
            identities=IDENTITIES,
            covariances=covariances,
        ),
    )
    events = SkinEventSeries(
        name="hand_events",
        link="hand",
        contacts=contact_frames(
            block,
            time_s=np.array([6.0]),
            hold_s=1.0,
            places=[np.array([[0.1, 0.0, 0.0]])],
            forces=[np.array([[-0.5, 0.0, 0.0]])],
            identities=[np.array([4])],
        ),
    )
    scene = replace(arm.built.scene, skin=(patch,), skin_events=(events,))
    return arm, BuiltScene(scene=scene, block=block.bytes())


@pytest.fixture(scope="module")
def shared_skin(
    chromium: Browser, skinned: tuple[Arm, BuiltScene], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[Visit, Page]]:
    """That scene, opened once."""
    visit = Visit(chromium, tmp_path_factory.mktemp("shared"))
    yield visit, visit.open(skinned[1])
    visit.close()


@pytest.fixture(name="skin_page")
def opened(shared_skin: tuple[Visit, Page]) -> Iterator[Page]:
    """The page of it as it was when it was opened, at its first sample."""
    yield from as_opened(*shared_skin)


def _shown(page: Page, time_s: Any, seconds: float) -> tuple[int, dict[str, Any]]:
    sample = int(np.searchsorted(time_s, seconds))
    page.evaluate(f"window.ft.show({sample})")
    return sample, page.evaluate("window.ft.skin()")


def test_skin_is_linked_to_time(skin_page: Page, skinned: tuple[Arm, BuiltScene]) -> None:
    """Pressed taxels, arrows and ellipsoids are those of the frame, on their link in its posture."""
    arm, built = skinned
    time_s = read_array(built.block, built.scene.time_s)
    frames = ((0.5, 0, []), (1.5, 0, []), (4.0, 2, FORCES[1]), (6.5, 4, FORCES[2]), (8.0, 0, []))
    for seconds, pressed, forces in frames:
        sample, shown = _shown(skin_page, time_s, seconds)
        assert shown["pressed"] == {"forearm_skin": pressed}
        tips = np.array(shown["contacts"]["forearm_skin"]).reshape(-1, 3)
        assert len(tips) == len(forces) == shown["ellipsoids"]
        if len(forces):
            pose = arm.link_pose("fore", sample)
            places = PLACES[len(forces)] @ pose[:3, :3].T + pose[:3, 3]
            length = np.linalg.norm(tips - places, axis=1) / np.linalg.norm(forces, axis=1)
            np.testing.assert_allclose(length, length[0], rtol=1e-4)  # one scale for all
            np.testing.assert_allclose(
                tips, places + length[0] * (np.array(forces) @ pose[:3, :3].T), atol=METRES_TOLERANCE
            )


def test_the_numbers_say_what_is_heuristic(skin_page: Page, skinned: tuple[Arm, BuiltScene]) -> None:
    """Newtons have their standard deviation; the skinManager's contacts have no newtons."""
    time_s = read_array(skinned[1].block, skinned[1].scene.time_s)
    region = skin_page.get_by_role("region", name="Skin")
    _shown(skin_page, time_s, 0.5)
    assert region.get_by_text("No contact on skin at this sample.").is_visible()
    _, shown = _shown(skin_page, time_s, 6.5)
    assert len(shown["contacts"]["hand_events"]) == 1
    texts = region.get_by_role("row").all_text_contents()
    assert texts == [
        "forearm_skin: contact 120.00 ± 0.50 N",
        "forearm_skin: contact 35.00 ± 0.50 N",
        "hand_events: contact 40.50 heuristic",
    ]
    assert region.get_by_text("10.0 kPa").is_visible()


def test_skin_is_switched_off(skin_page: Page, skinned: tuple[Arm, BuiltScene]) -> None:
    """Each of both by itself."""
    time_s = read_array(skinned[1].block, skinned[1].scene.time_s)
    _shown(skin_page, time_s, 6.5)
    skin_page.get_by_label("Pressure and contacts on skin").uncheck()
    skin_page.get_by_label("Contacts of the skinManager (heuristic, not newtons)").uncheck()
    off = skin_page.evaluate("window.ft.skin()")
    assert off == {"pressed": {"forearm_skin": 0}, "contacts": {"forearm_skin": [], "hand_events": []}, "ellipsoids": 0}


@pytest.mark.parametrize("ground", ["light", "dark"])
def test_contacts_are_a_raster_over_time(visit: Visit, skinned: tuple[Arm, BuiltScene], ground: Any) -> None:
    """A row for each patch and each link of a skinManager; the larger the force, the further from none.

    What was before the window is not at its left edge, which is as the right one, where nothing was.
    """
    (visit.folder / "view.html").write_bytes(page_of(skinned[1]))
    skin_page = visit.blank()
    skin_page.emulate_media(color_scheme=ground)
    skin_page.goto((visit.folder / "view.html").as_uri())
    skin_page.evaluate("window.ft.ready")
    raster = skin_page.get_by_role("img", name="Contacts on skin over time: forearm_skin, hand_events")
    box = raster.bounding_box()
    assert box is not None
    start, end = skin_page.evaluate("window.ft.plots()")[0]["x"]
    first, light = raster.evaluate(RASTER, [[start, end, 4.0, 0], [start, end, 4.0, 1]])
    none, dark = raster.evaluate(RASTER, [[start, end, 1.5, 0], [start, end, 6.9, 0]])
    nothing, late = raster.evaluate(RASTER, [[start, end, 1.5, 1], [start, end, 6.9, 1]])
    assert light == nothing  # at the hand
    assert dark + 100 < first < none - 100  # of 765
    assert abs(late - nothing) > 100
    largest = max(float(np.linalg.norm(force)) for forces in FORCES for force in forces)
    legend = skin_page.get_by_role("region", name="Skin").get_by_text("Time axis: strongest colour at")
    assert legend.text_content() == f"Time axis: strongest colour at {largest:.1f} N and 0.500 of the heuristic"
    plot = skin_page.locator(".u-over").first.bounding_box()
    assert plot is not None
    skin_page.mouse.move(plot["x"] + plot["width"] - 1, plot["y"] + 5)
    skin_page.mouse.wheel(0, -600)
    skin_page.wait_for_function("window.ft.plots()[0].x[0] > 7")
    skin_page.evaluate("window.ft.show(0)")
    width = box["width"] - 68
    edges = [raster.evaluate(RASTER, [[0, width, pixel, row] for pixel in (0, width - 1)]) for row in (0, 1)]
    assert [left - right for left, right in edges] == [0, 0]


def test_the_next_contact_is_one_key_away(skin_page: Page, skinned: tuple[Arm, BuiltScene]) -> None:
    """Where contacts begin: that of the first number, then the second of another patch with that of a new number."""
    time_s = read_array(skinned[1].block, skinned[1].scene.time_s)
    starts = [int(np.searchsorted(time_s, seconds)) for seconds in (3.0, 5.0, 6.0)]
    seen = []
    for _ in starts:
        skin_page.keyboard.press("c")
        seen.append(skin_page.evaluate("window.ft.sample()"))
    assert seen == starts
    skin_page.keyboard.press("c")  # there is none beyond
    assert skin_page.evaluate("window.ft.sample()") == starts[-1]
    skin_page.keyboard.press("Shift+C")
    assert skin_page.evaluate("window.ft.sample()") == starts[1]
    skin_page.get_by_role("button", name="Next contact").click()
    assert skin_page.evaluate("window.ft.sample()") == starts[2]


def test_a_robot_without_skin_has_no_such_section(visit: Visit, tmp_path: Path) -> None:
    """Neither section nor switch."""
    page = visit.open(arm_scene(tmp_path).built)
    assert page.get_by_role("region", name="Skin").count() == 0
    assert page.get_by_label("Pressure and contacts on skin").count() == 0
    assert page.get_by_role("img", name="Contacts on skin over time").count() == 0
    assert page.get_by_role("button", name="Next contact").count() == 0


def test_pressure_is_seen(skin_page: Page, skinned: tuple[Arm, BuiltScene]) -> None:
    """The picture of the robot changes with the pressure alone: the control, the same sample without skin, differs."""
    time_s = read_array(skinned[1].block, skinned[1].scene.time_s)
    _shown(skin_page, time_s, 6.5)
    canvas = skin_page.get_by_role("img", name="Robot")
    pressed = canvas.screenshot()
    skin_page.get_by_label("Pressure and contacts on skin").uncheck()
    skin_page.evaluate("window.ft.show(window.ft.sample())")
    assert canvas.screenshot() != pressed


def test_skin_alone_has_the_page_to_itself(visit: Visit, tmp_path: Path) -> None:
    """Without a sensor there is neither force space nor a course of forces; contacts are drawn and numbered.

    It opens at the largest contact, the control being that its first sample has none.
    """
    file = write_events(tmp_path)
    page = visit.open(scene_of(file, load_experiment(file, Purpose.DISPLAY), {}))
    assert page.get_by_role("region", name="Robot").is_visible()
    for empty in ("Force space", "Planes", "Series", "Error in view"):
        assert not page.get_by_role("region", name=empty).is_visible()
    assert page.get_by_role("img", name="Contacts on skin over time").is_visible()
    assert page.get_by_role("combobox", name="Sensor").count() == 0
    assert page.get_by_role("heading", name="Time").is_visible()
    assert sum(map(len, page.evaluate("window.ft.skin()")["contacts"].values())) > 0
    page.evaluate("window.ft.show(0)")
    assert sum(map(len, page.evaluate("window.ft.skin()")["contacts"].values())) == 0
    page.evaluate(f"window.ft.show({TOUCHED[3]})")
    assert [len(tips) for tips in page.evaluate("window.ft.skin()")["contacts"].values()] == [1, 0]
    texts = page.get_by_role("region", name="Skin").get_by_role("row").all_text_contents()
    assert texts == ["right forearm: contact 13.04 heuristic"]
    page.evaluate(f"window.ft.show({TOUCHED[0] - 2})")
    assert [len(tips) for tips in page.evaluate("window.ft.skin()")["contacts"].values()] == [0, 0]
