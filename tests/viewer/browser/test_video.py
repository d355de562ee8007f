# SPDX-License-Identifier: BSD-3-Clause
"""A film has the frames that were asked for, and a browser can show each of them."""

from __future__ import annotations

import base64
import struct
from typing import TYPE_CHECKING

import numpy as np
import pytest

from forcetorque.viewer.video import Film, frame_count
from tests.viewer.browser.arm_scene import Arm

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

FRAMES, FPS = 6, 5
WANTED = {"start": 100, "end": 200, "fps": FPS, "speed": 2, "width": 320, "height": 200}

# shows the middle of every frame, and gives its size and what its pixels add up to
DECODE = """async ([film, frames, fps]) => {
    const video = document.createElement("video"), canvas = document.createElement("canvas");
    video.muted = true;
    video.src = "data:video/mp4;base64," + film;
    await new Promise((done, fail) => { video.onloadeddata = done; video.onerror = () => fail(video.error.message); });
    const sums = [];
    [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
    const pen = canvas.getContext("2d", { willReadFrequently: true });
    for (let k = 0; k < frames; k++) {
        // a browser says that it is there before it gives the picture to canvases
        const shown = new Promise(done => {
            const look = (_, frame) =>
                Math.abs(frame.mediaTime - k / fps) < 0.5 / fps ? done() : video.requestVideoFrameCallback(look);
            video.requestVideoFrameCallback(look);
        });
        video.currentTime = (k + 0.5) / fps;
        await shown;
        pen.drawImage(video, 0, 0);
        const data = pen.getImageData(0, 0, canvas.width, canvas.height).data;
        sums.push(data.reduce((sum, value, k) => (sum * 31 + value + k) % 1000003, 7));
    }
    return { width: video.videoWidth, height: video.videoHeight, duration: video.duration, sums };
}"""


def sizes_of_frames(film: bytes) -> list[int]:
    """Sizes in the sample table (ISO 14496-12, 8.7.3.2)."""
    at = film.index(b"stsz") + 8
    same, count = struct.unpack_from(">II", film, at)
    return [same] * count if same else list(struct.unpack_from(f">{count}I", film, at + 8))


def test_film_decodes_to_the_frames_that_were_asked_for(page: Page, arm: Arm) -> None:
    """2.0 s (and the 0.1 s of a gap) at twice the speed and 5 frames per second are six, each another picture."""
    assert int((arm.time_s[200] - arm.time_s[100]) * FPS / 2) + 1 == FRAMES
    page.evaluate("window.ft.show(42)")
    film = page.evaluate("wanted => window.ft.video(wanted)", WANTED)
    assert page.evaluate("window.ft.sample()") == 42, "the page shows what it showed before"
    data = base64.b64decode(film)
    assert data[4:8] == b"ftyp"
    sizes = sizes_of_frames(data)
    assert len(sizes) == FRAMES
    assert min(sizes) > 0
    seen = page.evaluate(DECODE, [film, FRAMES, FPS])
    assert (seen["width"], seen["height"]) == (320, 200)
    assert seen["duration"] == pytest.approx(FRAMES / FPS, abs=0.01)
    assert len(set(seen["sums"])) == FRAMES


def test_the_command_counts_the_frames_of_the_page(page: Page, arm: Arm) -> None:
    """Also where the last frame falls on the last sample but for rounding, as with times in decimal fractions."""
    times, fps = arm.time_s, 10
    spans = [(a, a + 20 + b) for a in range(300) for b in range(6) if a + b < 179 or a > 199]  # not across the gap
    shares = np.array([(times[b] - times[a]) * fps for a, b in spans])
    (short,) = np.nonzero((np.floor(shares) < np.round(shares)) & (np.abs(shares - np.round(shares)) < 1e-9))
    assert len(short), "no span is short of a frame by rounding"
    (start, end), frames = spans[short[0]], round(shares[short[0]]) + 1
    wanted = {**WANTED, "start": start, "end": end, "speed": 1, "fps": fps}
    film = base64.b64decode(page.evaluate("wanted => window.ft.video(wanted)", wanted))
    assert len(sizes_of_frames(film)) == frames == frame_count(Film(**wanted), arm.built)  # type: ignore[arg-type]


def test_same_film_again_is_the_same_file(page: Page) -> None:
    """Frames depend on the scene alone; with VP9 the bytes do too. Another part of the log is another film."""
    wanted = {**WANTED, "codec": "vp9"}
    first, again, other = (
        base64.b64decode(
            page.evaluate("wanted => window.ft.video(wanted)", {**wanted, "start": start, "end": start + 50})
        )
        for start in (100, 100, 110)
    )
    assert b"vp09" in first
    assert first == again
    assert first != other


def test_button_makes_a_film_of_the_shown_time(page: Page) -> None:
    """The file is offered when it is complete."""
    page.get_by_text("Video", exact=True).click()
    page.get_by_label("Video end in seconds").fill("0.6")
    page.get_by_label("Video frames per second").fill("4")
    with page.expect_download() as offer:
        page.get_by_role("button", name="Record video").click()
    assert offer.value.suggested_filename == "arm_at_the_wall.mp4"
    page.get_by_text("The video is made.").wait_for()


def test_impossible_film_is_refused_in_words(page: Page) -> None:
    """The message says what was expected and got."""
    from playwright.sync_api import Error

    with pytest.raises(Error, match="got fps 20, speed 1, samples 9 to 3 of 600"):
        page.evaluate("window.ft.video({ start: 9, end: 3 })")
    with pytest.raises(Error, match="expected an even width and height"):
        page.evaluate("window.ft.video({ width: 321 })")
