# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque export`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption
from forcetorque.cli.output import ExportFormat, Format


def export(
    calibration: Annotated[list[Path], typer.Argument(help="Calibration files; one for icub-matrix.")],
    to: Annotated[
        ExportFormat,
        typer.Option(
            "--to",
            help="Matrix file for the sensor's DSP, XML groups for wholebodydynamics, a plain table, or the "
            "coefficients of temperature and other variables by themselves.",
        ),
    ],
    output: Annotated[Path, typer.Option("--output", "-o", help="File to write; - for standard output.")],
    full_scale: Annotated[
        tuple[int, int, int, int, int, int] | None,
        typer.Option(
            "--full-scale", help="Six full scales for icub-matrix; N, N m. Default: chosen to hold the matrix."
        ),
    ] = None,
    sensor_name: Annotated[
        str | None,
        typer.Option("--sensor-name", help="Name of the sensor in the robot's configuration, for wholebodydynamics."),
    ] = None,
    stream: Annotated[
        Path | None,
        typer.Option(
            "--stream", help="Calibration that the stream is already made with. Default: the prior matrix alone."
        ),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Write calibrations as files that a robot or another program reads.

    Example: forcetorque export leg.json --to wholebodydynamics -o leg.xml
    """
    from forcetorque.cli.export import run

    run(
        calibration,
        to=to,
        output=output,
        full_scale=full_scale,
        sensor_name=sensor_name,
        stream=stream,
        output_format=output_format,
    )
