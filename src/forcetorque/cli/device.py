# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque device`: a calibration device by computation, with its URDF, motions and simulated recordings."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.cli.options import FormatOption
from forcetorque.cli.output import Format, refuse_output_folder, refuse_standard_output, show, start_logging

if TYPE_CHECKING:
    from forcetorque.analysis import DeviceDesign


def device(
    file: Annotated[
        Path | None,
        typer.Argument(help="Device file (TOML); see docs/device.md. Default: the device that comes with the library."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Folder to make, for URDFs, trajectories, logs and experiment files."),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the motion, and of the torques on its axes.")
    ] = None,
    space: Annotated[
        Path | None,
        typer.Option("--space", help="PNG of the forces and torques that the innermost sensor sees, by order of axes."),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Check a calibration device by computation, and simulate what it records.

    Example: forcetorque device device.toml -o simulated
    """
    from forcetorque import analysis
    from forcetorque.cli.figure_file import refuse_figure
    from forcetorque.exsitu.device import DEFAULT_DEVICE, read_device

    log = start_logging()
    refuse_standard_output("--output", output)
    for picture in (figure, space):
        refuse_figure(picture)
    if output is not None:
        refuse_output_folder(output)
    design = analysis.device(read_device(DEFAULT_DEVICE if file is None else file))
    if output is not None:
        design = analysis.write_device(design, output, progress=log.info)
    show(_drawn(design, figure, space), output_format)


def _drawn(design: DeviceDesign, figure: Path | None, space: Path | None) -> DeviceDesign:
    from forcetorque.atomic import write_bytes_atomically
    from forcetorque.report.figures import device_figure, space_figure
    from forcetorque.report.figures.canvas import png_bytes

    picture = design.picture
    if figure is not None:
        torques = {joint: picture.answer.torque(joint) for joint in picture.answer.joints}
        drawn = device_figure(picture.time_s, picture.motion, torques)
        write_bytes_atomically(figure, png_bytes(drawn))
    if space is not None:
        write_bytes_atomically(space, png_bytes(space_figure(picture.clouds)))
    return design.model_copy(update={"figures": tuple(str(file) for file in (figure, space) if file is not None)})
