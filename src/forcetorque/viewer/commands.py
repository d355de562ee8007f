# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque view`: robot pose and force space of a recording, in the browser."""

from __future__ import annotations

import logging
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import STANDARD_OUTPUT, declare_outputs
from forcetorque.results.terminal.command_output import (
    Format,
    refuse_standard_output,
    refuse_two_on_standard_output,
    show,
    start_logging,
)
from forcetorque.results.terminal.options import (
    CalibrationsOption,
    DetailsOption,
    ForceOption,
    FormatOption,
    SensorOption,
)

if TYPE_CHECKING:
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.viewer.scene_builder import BuiltScene


def view(
    experiment: Annotated[
        Path, typer.Argument(help="Experiment file (TOML), or the .numbers.json of a report; see docs/viewer.md.")
    ],
    calibration: CalibrationsOption = None,
    sensor: SensorOption = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            help="File for the page, which then works offline, or by its ending for Rerun (.rrd) or Foxglove and ROS 2 "
            "(.mcap, with a layout for Foxglove beside it); - for standard output. Default: the page is served.",
        ),
    ] = None,
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Print the address and open nothing.")] = False,
    port: Annotated[
        int | None, typer.Option("--port", help="Port of 127.0.0.1 to serve at. Default: any that is free.")
    ] = None,
    mesh_dir: Annotated[
        list[Path] | None,
        typer.Option("--mesh-dir", help="Folder that holds the packages of meshes, or is one; repeat for more."),
    ] = None,
    video: Annotated[Path | None, typer.Option("--video", help="File for a video (MP4); needs chromium.")] = None,
    fps: Annotated[float, typer.Option("--fps", help="Frames per second of the video.")] = 25.0,
    speed: Annotated[float, typer.Option("--speed", help="Seconds of the log per second of the video.")] = 1.0,
    start: Annotated[float | None, typer.Option("--start", help="Start of the video; s. Default: of the log.")] = None,
    end: Annotated[float | None, typer.Option("--end", help="End of the video; s. Default: of the log.")] = None,
    size: Annotated[tuple[int, int], typer.Option("--size", help="Width and height of the video; pixels.")] = (
        1280,
        720,
    ),
    browser: Annotated[
        Path | None, typer.Option("--browser", help="Program that draws the video. Default: chromium or chrome.")
    ] = None,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Show robot pose and force space, linked in time, in the browser.

    Example: forcetorque view experiment.toml -c right_leg.json -o view.html

    Python: `experiment.view("view.html", calibration)`, also `"view.rrd"` and `"view.mcap"`
    """
    from forcetorque.experiment.loading import Purpose
    from forcetorque.results.terminal.command_inputs import read_calibrations, read_experiment
    from forcetorque.viewer.scene_builder import View, scene_of, view_source
    from forcetorque.viewer.video import Film, film_between, find_browser, frame_count, require_playwright, write_video
    from forcetorque.viewer.view_file import require_writer, view_files, write_view

    log = start_logging()
    _refuse_contradictions(output, port, video, force=force)
    refuse_two_on_standard_output(output, output_format)
    path, files = view_source(experiment, calibration or ())
    if video is not None:
        film = Film(start=0, end=0, fps=fps, speed=speed, width=size[0], height=size[1])
        require_playwright()
        program = find_browser(browser)
    if output is not None:
        require_writer(output)
    calibrations = read_calibrations(files, sensor)
    recorded = read_experiment(path, log, Purpose.DISPLAY)
    built = scene_of(
        path,
        recorded,
        calibrations,
        sensors=sensor,
        mesh_folders=mesh_dir,
        progress=log.info,
        accept=partial(_accept, output, log, recorded),
    )
    for note in built.scene.notes:
        log.info("%s", note)
    shown = View.of(built)
    if output is not None:
        shown = shown.model_copy(update={"file": str(output), "file_bytes": write_view(output, built, log.info)})
        for layout in view_files(output)[1:]:
            log.info("layout for Foxglove written to %s", layout)
    if video is not None:
        film = film_between(film, built, start_s=start, end_s=end)
        frames = frame_count(film, built)
        log.info("filming %d frames with %s", frames, program)
        write_video(video, film, built, browser=program)
        shown = shown.model_copy(update={"video": str(video), "video_frames": frames})
    if output is None and video is None:
        _serve(path, built, port or 0, not no_browser, output_format, details=details)
    elif output != STANDARD_OUTPUT:  # else the page itself went there
        show(shown, output_format, details=details)


_LEAST_BYTES, _SAMPLE_BYTES, _NUMBER_BYTES, _LARGE_BYTES = 250_000_000, 700, 60, 1_200_000_000
"""Memory of a view, of each sample that is shown, and of each number in the log, as in docs/measured.md; and the
memory from which it is stated before it is taken."""


def _accept(output: Path | None, log: logging.Logger, experiment: Experiment, samples: int) -> None:
    """Refuse a page that would be too large, or say how much memory many samples take, before either costs any."""
    from forcetorque.viewer.view_file import require_room

    if output is not None:
        require_room(output, samples)
    streams = experiment.recording.streams.values()
    numbers = sum(len(one) * sum(len(signal.columns) for signal in one.signals.values()) for one in streams)
    if (size := _LEAST_BYTES + samples * _SAMPLE_BYTES + numbers * _NUMBER_BYTES) > _LARGE_BYTES:
        log.warning(
            "%d samples are shown at once, in about %.1f GB of memory%s; where there is less, give a part of the log",
            samples,
            size * 1e-9,
            ", of one sensor nearly as much as of all" if len(experiment.sensors) > 1 else "",
        )


def _refuse_contradictions(output: Path | None, port: int | None, video: Path | None, *, force: bool) -> None:
    from forcetorque.viewer.view_file import view_files

    if port is not None and (output is not None or video is not None):
        raise ForceTorqueError("--port belongs to a page that is served; leave out --output and --video, or --port")
    refuse_standard_output("--video", video)
    declare_outputs(*view_files(output), video, force=force)


def _serve(
    path: Path, built: BuiltScene, port: int, open_browser: bool, output_format: Format, *, details: bool
) -> None:
    from forcetorque.viewer.packing import packed
    from forcetorque.viewer.page import ANNOTATIONS_URL, DATA_URL, Session, ViewerServer, open_in_browser, page_of
    from forcetorque.viewer.scene_builder import View

    log = start_logging()
    served = packed(built, log.info)
    page = page_of(served, data_url=DATA_URL, annotations_url=ANNOTATIONS_URL)
    session = Session(path, built, log.info)
    try:  # around all of it: who reads the address may interrupt before the command waits
        with ViewerServer(page, served.block, session.save, port=port) as server:
            show(View.of(built).model_copy(update={"url": server.url}), output_format, details=details)
            sys.stdout.flush()
            if open_browser and not open_in_browser(server.url):
                log.warning("no browser could be opened; open the address yourself")
            log.info("served until Ctrl-C")
            server.wait()
    except KeyboardInterrupt:
        log.info("stopped")
