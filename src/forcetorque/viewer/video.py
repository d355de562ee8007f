# SPDX-License-Identifier: BSD-3-Clause
"""Videos of the page, frame by frame in a browser without a window."""

from __future__ import annotations

import base64
import binascii
import importlib.util
import os
import shutil
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from forcetorque.base.errors import ForceTorqueError, MissingExtraError, MissingFileError, install_line
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.viewer.page import DATA_URL, ViewerServer, page_of
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
"""Programs that are looked for, in this order."""

_READY_S = 60.0
"""Patience until the page runs; s."""

_ARGUMENTS = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking")


@dataclass(frozen=True, slots=True, kw_only=True)
class Film:
    """What of a recording is filmed, and how."""

    start: int
    """First sample."""
    end: int
    """Last sample."""
    fps: float
    """Frames per second."""
    speed: float
    """Seconds of the recording per second of the video."""
    width: int
    """Width; pixels."""
    height: int
    """Height; pixels."""

    def __post_init__(self) -> None:
        if not (0 < self.fps <= 240 and 0 < self.speed < float("inf")):
            raise ForceTorqueError(
                f"video: expected up to 240 frames per second and a positive speed, got {self.fps:g} and {self.speed:g}"
            )
        if self.width % 2 or self.height % 2 or not (160 <= self.width <= 8192 and 120 <= self.height <= 8192):
            raise ForceTorqueError(
                "video: expected an even width and height of 160 x 120 to 8192 x 8192 pixels, "
                f"got {self.width} x {self.height}"
            )


def find_browser(given: Path | None = None) -> Path:
    """Find a browser that can draw without a window.

    Args:
        given: Program to use; None to look for one.

    Returns:
        Its path.

    Raises:
        MissingFileError: If there is none.
    """
    if given is not None:
        if given.is_file():
            return given
        raise MissingFileError(f"--browser {given}: expected a program, there is none")
    for name in BROWSERS:
        executable = shutil.which(name)
        if executable is not None:
            return Path(executable)
    raise MissingFileError(
        f"--video: expected a browser ({', '.join(BROWSERS)}), there is none; install chromium or name one by --browser"
    )


def require_playwright() -> None:
    """Check that what drives a browser is installed.

    Raises:
        MissingExtraError: If it is not.
    """
    if importlib.util.find_spec("playwright") is None:
        raise MissingExtraError(f"--video needs playwright: {install_line('video')}")


def film_page(url: str, film: Film, *, browser: Path) -> bytes:
    """Let the page film itself.

    Args:
        url: Address of the page on this machine; nothing else is reached.
        film: What is filmed.
        browser: The browser.

    Returns:
        The video, MP4.

    Raises:
        ForceTorqueError: If the page or the browser fails.
    """
    require_playwright()
    from playwright.sync_api import Error, sync_playwright

    root = getattr(os, "geteuid", lambda: 1)() == 0
    options = [*_ARGUMENTS, *(["--no-sandbox"] if root else [])]  # the sandbox does not work for root
    wanted = {
        "start": film.start,
        "end": film.end,
        "fps": film.fps,
        "speed": film.speed,
        "width": film.width,
        "height": film.height,
    }
    try:
        with (
            sync_playwright() as driver,
            driver.chromium.launch(executable_path=str(browser), args=options) as program,
        ):
            page = program.new_page(viewport={"width": film.width, "height": film.height})
            page.route(lambda address: not address.startswith((url, "blob:", "data:")), lambda route: route.abort())
            page.set_default_timeout(_READY_S * 1000)
            page.goto(url)
            page.evaluate("window.ft.ready")
            text = page.evaluate("wanted => window.ft.video(wanted)", wanted)  # waits as long as it takes
    except Error as error:
        raise ForceTorqueError(f"{browser}: the page could not be filmed: {error}") from error
    try:
        return base64.b64decode(str(text), validate=True)
    except binascii.Error as error:
        raise ForceTorqueError(f"{browser}: expected a video, got {str(text)[:60]!r}") from error


MOST_VIDEO_S = 600.0
"""Longest video; s. At 4 Mbit/s it has 300 MB, and a browser hands over texts below 512 MB."""


def film_between(film: Film, built: BuiltScene, *, start_s: float | None, end_s: float | None) -> Film:
    """Let a film show the samples between two instants.

    Args:
        film: The film, of whatever samples.
        built: The scene.
        start_s: First instant; the start of the log if None; s.
        end_s: Last instant; the end of the log if None; s.

    Returns:
        The film of these samples.

    Raises:
        ForceTorqueError: If there are none, or so many that the browser could not hand over the video, hours later.
    """
    times = read_array(built.block, built.scene.time_s)
    first, last = float(times[0]), float(times[-1])
    start = first if start_s is None else start_s
    end = last if end_s is None else end_s
    chosen = np.flatnonzero((times >= start) & (times <= end))
    if not len(chosen):
        raise ForceTorqueError(
            f"--start {start:g} --end {end:g}: expected a span with samples, which lie from {first:.3f} to {last:.3f} s"
        )
    film = replace(film, start=int(chosen[0]), end=int(chosen[-1]))
    seconds = frame_count(film, built) / film.fps
    if seconds > MOST_VIDEO_S:
        raise ForceTorqueError(
            f"video: expected at most {MOST_VIDEO_S:g} s, got {seconds:.0f} s; raise --speed, or choose a part by "
            "--start and --end"
        )
    return film


def frame_count(film: Film, built: BuiltScene) -> int:
    """Count the frames of a film.

    Args:
        film: The film.
        built: The scene.

    Returns:
        Their number.
    """
    times = read_array(built.block, built.scene.time_s)
    return int(np.floor((times[film.end] - times[film.start]) * film.fps / film.speed + 1e-9)) + 1


def write_video(path: Path, film: Film, built: BuiltScene, *, browser: Path) -> None:
    """Film a scene.

    Args:
        path: File to write or to replace, MP4.
        film: What is filmed.
        built: The scene.
        browser: The browser that draws it.
    """
    with ViewerServer(page_of(built, data_url=DATA_URL), built.block, None) as server:
        write_bytes_atomically(path, film_page(server.url, film, browser=browser))
