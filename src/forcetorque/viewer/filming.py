# SPDX-License-Identifier: BSD-3-Clause
"""Which samples of a scene a film shows, and the file that it becomes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.atomic import write_bytes_atomically
from forcetorque.errors import ForceTorqueError
from forcetorque.viewer.block import read_array
from forcetorque.viewer.build import BuiltScene
from forcetorque.viewer.page import page_of
from forcetorque.viewer.serve import DATA_URL, ViewerServer
from forcetorque.viewer.video import Film, film_page

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
