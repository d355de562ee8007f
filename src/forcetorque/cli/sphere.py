# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque sphere`: the ellipsoid that a sensor makes of the sphere that gravity draws."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import (
    ComparedCalibrationsOption,
    ExperimentArgument,
    FormatOption,
    SensorOption,
    SphereIntervalOption,
)
from forcetorque.cli.output import Format, show, start_logging, stop_at_failures


def sphere(
    experiment: ExperimentArgument,
    sensor: SensorOption = None,
    calibration: ComparedCalibrationsOption = None,
    interval: SphereIntervalOption = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the forces, the ellipsoids and the weight by the model.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Compare how the three axes weigh a limb that is carried around.

    Example: forcetorque sphere experiment.toml --interval grid
    """
    from forcetorque import analysis
    from forcetorque.atomic import write_bytes_atomically
    from forcetorque.cli.figure_file import refuse_figure
    from forcetorque.cli.reading import read_calibrations, read_experiment, refuse_left_out, sensors_named

    log = start_logging()
    refuse_figure(figure)
    calibrations = read_calibrations(calibration)
    content = read_experiment(experiment, log)
    chosen = sensors_named(content, sensor)
    refuse_left_out(content, chosen, calibrations)
    result = analysis.spheres_of_sensors(
        content, chosen, calibrations, interval, file=str(experiment), progress=log.info
    )
    if figure is not None:
        from forcetorque.report.figures import sphere_figure
        from forcetorque.report.figures.canvas import png_bytes

        write_bytes_atomically(figure, png_bytes(sphere_figure(result.analyses)))
        result = result.model_copy(update={"figure": str(figure)})
    show(result, output_format)
    stop_at_failures(result.failures)
