# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque thermal`: what temperature does to a sensor at constant load."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.options import ExperimentArgument, FormatOption, SensorOption
from forcetorque.results.terminal.output import Format, show, start_logging


def thermal(
    experiment: ExperimentArgument,
    sensor: SensorOption = None,
    interval: Annotated[
        list[str] | None,
        typer.Option("--interval", help="Label of an interval; repeat for more. Default: all that are not ignored."),
    ] = None,
    variable: Annotated[
        str | None, typer.Option("--variable", help="Variable that is the temperature. Default: the only one in degC.")
    ] = None,
    calibration: Annotated[
        Path | None,
        typer.Option("--calibration", "-c", help="Calibration that reads the sensor, for the drift that it leaves."),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the drift over temperature, heating and cooling apart.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find how a reading drifts with temperature at a constant load.

    Example: forcetorque thermal cycles.toml --figure drift.png

    Python: `run.thermal(calibration)`
    """
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.experiment.input_files import stated_in
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.results.terminal.reading import read_calibrations, read_experiment, refuse_left_out, sensors_named
    from forcetorque.sensor.temperature.temperature_drift import Thermal, thermal

    log = start_logging()
    refuse_figure(figure)
    calibrations = read_calibrations(None if calibration is None else [calibration])
    content = read_experiment(experiment, log)
    wanted = [one.sensor.name for one in calibrations.values()] if sensor is None else sensor
    chosen = sensors_named(content, wanted)
    refuse_left_out(content, chosen, calibrations)
    name, read_by = next(iter(calibrations.items()), (None, None))
    with stated_in(str(experiment)):
        result = Thermal.together(
            thermal(
                SensorRun(content, one),
                intervals=interval or (),
                variable=variable,
                name=name,
                calibration=read_by,
            )
            for one in chosen
        )
    if figure is not None:
        from forcetorque.results.figures import png_bytes
        from forcetorque.sensor.figures import thermal_figure

        write_bytes_atomically(figure, png_bytes(thermal_figure(result.sensors)))
        result = result.model_copy(update={"figure": str(figure)})
    show(result, output_format)
