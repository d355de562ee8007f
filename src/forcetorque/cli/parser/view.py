# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque view`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, FormatOption, SensorOption
from forcetorque.cli.output import Format


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
            help="File for the page, which then works offline; - for standard output. Default: it is served.",
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
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Show robot pose and force space, linked in time, in the browser.

    Example: forcetorque view experiment.toml -c right_leg.json -o view.html
    """
    from forcetorque.cli.view import run

    run(
        experiment,
        calibrations=calibration,
        sensors=sensor,
        mesh_folders=mesh_dir,
        output=output,
        port=port,
        open_browser=not no_browser,
        video=video,
        fps=fps,
        speed=speed,
        start_s=start,
        end_s=end,
        size=size,
        browser=browser,
        output_format=output_format,
    )
