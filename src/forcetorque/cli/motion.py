# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque motion`: whether a robot oscillates, how long it takes to settle, how well it tracks."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, FormatOption
from forcetorque.cli.output import Format, show, start_logging


def motion(
    log: Annotated[Path, typer.Argument(help="Experiment file (TOML), with or without sensors, or a log.")],
    column: Annotated[
        list[str] | None,
        typer.Option("--column", help="Column of the log, or of `balance`, such as com.y; repeat for more."),
    ] = None,
    desired: Annotated[
        list[str] | None,
        typer.Option("--desired", help="Column of the log with what was wanted; one for each --column, in its order."),
    ] = None,
    interval: Annotated[
        list[str] | None,
        typer.Option("--interval", help="Label of an interval; repeat for more. Default: all that are not ignored."),
    ] = None,
    step_at: Annotated[
        list[float] | None,
        typer.Option("--step-at", help="Instant of a step, s; repeat for more. Default: steps of --desired."),
    ] = None,
    band: Annotated[
        float, typer.Option("--band-percent", help="Half of the band about its end in which a column has settled.")
    ] = 5.0,
    calibration: CalibrationsOption = None,
    figure: Annotated[Path | None, typer.Option("--figure", help="PNG of the columns with their swings.")] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Say whether a motion oscillates, how long it settles, how well it tracks.

    Example: forcetorque motion walk.toml --column com.y --column zmp.y
    """
    from forcetorque import analysis
    from forcetorque.atomic import write_bytes_atomically
    from forcetorque.cli.figure_file import refuse_figure
    from forcetorque.cli.reading import read_calibrations
    from forcetorque.experiment.inputs import stated_in

    start_logging().info("reading %s", log)
    refuse_figure(figure)
    calibrations = read_calibrations(calibration)
    with stated_in(str(log)):
        signals = analysis.motion_signals(
            log, column or (), desired=desired or (), intervals=interval or (), calibrations=calibrations
        )
        result = analysis.motion(signals, steps_s=step_at or (), band_share=band / 100.0)
    if figure is not None:
        from forcetorque.report.figures import motion_figure
        from forcetorque.report.figures.canvas import png_bytes

        write_bytes_atomically(figure, png_bytes(motion_figure(result)))
        result = result.model_copy(update={"figure": str(figure)})
    show(result, output_format)
