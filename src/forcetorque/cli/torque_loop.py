# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque torque-loop`: what sensor errors do to a robot that controls its torques by them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption
from forcetorque.cli.output import Format, show, start_logging


def torque_loop(
    config: Annotated[
        Path | None,
        typer.Argument(
            help="File of the loop (TOML), see docs/torque_loop.md; without one, the default, which takes ten minutes."
        ),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of tracking, swings and falls over the size of the error.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Balance a simulated biped by torques that sensors with errors tell.

    Example: forcetorque torque-loop loop.toml --figure loop.png
    """
    from forcetorque import analysis
    from forcetorque.atomic import write_bytes_atomically
    from forcetorque.cli.figure_file import refuse_figure

    log = start_logging()
    refuse_figure(figure)
    file = None if config is None else analysis.read_torque_loop(config)
    result = analysis.torque_loop(file, progress=log.info)
    if figure is not None:
        from forcetorque.report.figures import torque_loop_figure
        from forcetorque.report.figures.canvas import png_bytes

        write_bytes_atomically(figure, png_bytes(torque_loop_figure(result)))
    show(result, output_format)
