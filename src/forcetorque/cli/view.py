# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque view`: robot pose and force space of a recording, in the browser."""

from __future__ import annotations

import sys
import threading
from collections.abc import Sequence
from logging import Logger
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from forcetorque.atomic import STANDARD_OUTPUT, refuse_unwritable, write_bytes_atomically
from forcetorque.cli.output import (
    Format,
    console,
    print_result,
    refuse_standard_output,
    refuse_two_on_standard_output,
    start_logging,
)
from forcetorque.cli.reading import read_calibrations, read_experiment
from forcetorque.cli.scene import scene_of
from forcetorque.cli.view_source import view_source
from forcetorque.errors import ForceTorqueError
from forcetorque.viewer import BuiltScene, ViewerServer, page_of, write_page
from forcetorque.viewer.annotations import Annotations, save_annotations, saved_files
from forcetorque.viewer.scene import read_array
from forcetorque.viewer.serve import ANNOTATIONS_URL, DATA_URL
from forcetorque.viewer.video import Film, film_page, find_browser, require_playwright

MOST_VIDEO_S = 600.0
"""Longest video; s. At 4 Mbit/s it has 300 MB, and a browser hands over texts below 512 MB."""


class ViewResult(BaseModel):
    """What `forcetorque view` shows."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/view/1"] = Field(default="forcetorque/view/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    sensors: list[str]
    """Sensors that are shown."""
    samples: int
    """Number of samples."""
    url: str | None
    """Address of the page while it is served; null otherwise."""
    file: str | None
    """File of the page, where one was written."""
    file_bytes: int | None
    """Its size."""
    video: str | None
    """File of the video, where one was written."""
    video_frames: int | None
    """Its number of frames."""
    notes: list[str]
    """What is absent, and why."""


def run(
    path: Path,
    *,
    calibrations: Sequence[Path] | None,
    sensors: Sequence[str] | None,
    mesh_folders: Sequence[Path] | None,
    output: Path | None,
    port: int | None,
    open_browser: bool,
    video: Path | None,
    fps: float,
    speed: float,
    start_s: float | None,
    end_s: float | None,
    size: tuple[int, int],
    browser: Path | None,
    output_format: Format,
) -> None:
    """Write the page of an experiment, film it, or serve it until somebody interrupts.

    Args:
        path: Experiment file, or the numbers of a report.
        calibrations: Calibration files; of a sensor any number.
        sensors: Sensors to show; all if None.
        mesh_folders: Folders with packages of meshes.
        output: File of the page, `-` for standard output, which then takes no result; None to serve it, unless a
            video is wanted.
        port: Port to serve at; any that is free if None.
        open_browser: Whether the served page is opened.
        video: File of the video; None for none.
        fps: Its frames per second.
        speed: Seconds of the recording per second of the video.
        start_s: Where it starts; s; the start of the log if None.
        end_s: Where it ends; s; the end of the log if None.
        size: Its width and height; pixels.
        browser: Browser that draws it; looked for if None.
        output_format: Form of the result.
    """
    log = start_logging()
    _refuse_contradictions(output, port, video)
    refuse_two_on_standard_output(output, output_format)
    path, files = view_source(path, calibrations)
    program = None
    if video is not None:
        Film(start=0, end=0, fps=fps, speed=speed, width=size[0], height=size[1])
        require_playwright()
        program = find_browser(browser)
    loaded = read_calibrations(files)
    built = scene_of(path, read_experiment(path, log), loaded, sensors=sensors, mesh_folders=mesh_folders)
    for note in built.scene.notes:
        log.info("%s", note)
    result = ViewResult(
        experiment=built.scene.title,
        sensors=[sensor.name for sensor in built.scene.sensors],
        samples=built.scene.samples,
        url=None,
        file=None if output is None else str(output),
        file_bytes=None if output is None else write_page(output, built),
        video=None if video is None else str(video),
        video_frames=None,
        notes=list(built.scene.notes),
    )
    if video is not None and program is not None:
        start, end = _span(built, start_s, end_s)
        film = Film(start=start, end=end, fps=fps, speed=speed, width=size[0], height=size[1])
        frames = _frames(built, film)
        _refuse_long(frames / fps)
        log.info("filming %d frames with %s", frames, program)
        page = page_of(built, data_url=DATA_URL)
        with ViewerServer(page, built.block, None) as server:
            write_bytes_atomically(video, film_page(server.url, film, browser=program))
        result = result.model_copy(update={"video_frames": frames})
    if output is None and video is None:
        _serve(path, built, result, port or 0, open_browser, output_format, log)
    elif output != STANDARD_OUTPUT:  # else the page itself went there
        _print(result, output_format)


def _refuse_contradictions(output: Path | None, port: int | None, video: Path | None) -> None:
    if port is not None and (output is not None or video is not None):
        raise ForceTorqueError("--port belongs to a page that is served; leave out --output and --video, or --port")
    refuse_standard_output("--video", video)
    for file in (output, video):
        if file is not None:
            refuse_unwritable(file)


def _span(built: BuiltScene, start_s: float | None, end_s: float | None) -> tuple[int, int]:
    """First and last sample between two instants."""
    times = read_array(built.block, built.scene.time_s)
    first, last = float(times[0]), float(times[-1])
    start = first if start_s is None else start_s
    end = last if end_s is None else end_s
    chosen = np.flatnonzero((times >= start) & (times <= end))
    if not len(chosen):
        raise ForceTorqueError(
            f"--start {start:g} --end {end:g}: expected a span with samples, which lie from {first:.3f} to {last:.3f} s"
        )
    return int(chosen[0]), int(chosen[-1])


def _frames(built: BuiltScene, film: Film) -> int:
    times = read_array(built.block, built.scene.time_s)
    return int(np.floor((times[film.end] - times[film.start]) * film.fps / film.speed + 1e-9)) + 1


def _refuse_long(seconds: float) -> None:
    """Refuse a film that the browser could not hand over, hours later."""
    if seconds > MOST_VIDEO_S:
        raise ForceTorqueError(
            f"video: expected at most {MOST_VIDEO_S:g} s, got {seconds:.0f} s; raise --speed, or choose a part by "
            "--start and --end"
        )


def _serve(
    path: Path,
    built: BuiltScene,
    result: ViewResult,
    port: int,
    open_browser: bool,
    output_format: Format,
    log: Logger,
) -> None:
    page = page_of(built, data_url=DATA_URL, annotations_url=ANNOTATIONS_URL)
    with ViewerServer(page, built.block, _Saver(path, built, log).save, port=port) as server:
        _print(result.model_copy(update={"url": server.url}), output_format)
        sys.stdout.flush()
        if open_browser and not _opened(server.url):
            log.warning("no browser could be opened; open the address yourself")
        log.info("served until Ctrl-C")
        try:
            server.wait()
        except KeyboardInterrupt:
            log.info("stopped")


def _opened(url: str) -> bool:
    import webbrowser

    try:
        return webbrowser.open(url)
    except webbrowser.Error:
        return False


class _Saver:
    """Writes what the page saves; files of an earlier session are kept once under another name."""

    def __init__(self, path: Path, built: BuiltScene, log: Logger) -> None:
        self.path, self.built, self.log = path, built, log
        self.is_first, self.lock = True, threading.Lock()

    def save(self, annotations: Annotations) -> list[str]:
        with self.lock:  # two windows may save at once
            files = [file for file in saved_files(self.path) if self.is_first and file.is_file()]
            earlier = {file: file.read_bytes() for file in files}
            written = save_annotations(annotations, self.built, self.path)
            self.is_first = False
            for file, content in earlier.items():
                kept = file.with_name(f"{file.stem}.previous{file.suffix}")
                write_bytes_atomically(kept, content)
                self.log.info("%s of an earlier session is now %s", file, kept)
        self.log.info("saved %d sample(s) to %s and %s", len(annotations.samples), *written)
        return [file.name for file in written]


def _print(result: ViewResult, output_format: Format) -> None:
    dumped = result.model_dump(mode="json", by_alias=True)
    row = {name: value for name, value in dumped.items() if name not in ("schema", "sensors", "notes")}
    print_result(dumped, [row], output_format, show=lambda: _show(result))


def _show(result: ViewResult) -> None:
    screen = console()
    screen.print(f"{result.experiment}: {result.samples} samples of {', '.join(result.sensors)}", soft_wrap=True)
    if result.file is not None and result.file_bytes is not None:
        screen.print(f"page of {result.file_bytes / 1e6:.1f} MB written to {result.file}", soft_wrap=True)
    if result.video is not None:
        screen.print(f"video of {result.video_frames} frames written to {result.video}", soft_wrap=True)
    if result.url is not None:
        screen.print(f"open {result.url}", soft_wrap=True)
