# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque device`: a calibration device by computation, with its URDF, motions and simulated recordings."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.options import FormatOption
from forcetorque.results.terminal.output import (
    Format,
    refuse_output_folder,
    refuse_standard_output,
    show,
    start_logging,
)


def device(
    file: Annotated[
        Path | None,
        typer.Argument(
            help="Device file (TOML); see docs/device/device.md. Default: the device that comes with the library."
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Folder to make, for URDFs, trajectories, logs and experiment files."),
    ] = None,
    figures: Annotated[
        Path | None,
        typer.Option("--figures", help="Folder to make, for PNGs of motion, excitation, swept space and errors."),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Check a calibration device by computation, and simulate what it records.

    Example: forcetorque device device.toml -o simulated

    Python: `app.design_device("device.toml")`; `device.write_device` writes it
    """
    from forcetorque.device.design import design_device
    from forcetorque.device.device_file import DEFAULT_DEVICE, read_device
    from forcetorque.device.simulated_recordings import write_device

    log = start_logging()
    refuse_standard_output("--output", output)
    refuse_standard_output("--figures", figures)
    for folder in (output, figures):
        if folder is not None:
            refuse_output_folder(folder)
    design = design_device(read_device(DEFAULT_DEVICE if file is None else file))
    if output is not None:
        design = write_device(design, output, progress=log.info)
    if figures is not None:
        from forcetorque.device.figures import write_device_figures

        design = write_device_figures(design, figures)
    show(design, output_format)
