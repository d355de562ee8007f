# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench response`: what a sensor with its mounting does to fast forces."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.options import DetailsOption, ExperimentsArgument, FormatOption
from forcetorque.results.terminal.output import Format, show, start_logging


def response(
    experiments: ExperimentsArgument,
    excitation: Annotated[
        str, typer.Option("--excitation", "-e", help="What was done to the sensor: impact, release or pendulum.")
    ],
    sensor: Annotated[str | None, typer.Option("--sensor", help="Sensor; the first of the file if left out.")] = None,
    component: Annotated[
        str | None, typer.Option("--component", help="Component of the wrench, such as fx; found if left out.")
    ] = None,
    force: Annotated[
        str | None,
        typer.Option("--force", help="Stream with the measured force (applied_wrench) or proper_acceleration."),
    ] = None,
    mass: Annotated[
        float | None, typer.Option("--mass-kg", help="Mass that was let go, or that the acceleration is of; kg.")
    ] = None,
    cut_off: Annotated[
        float | None, typer.Option("--cut-off-hz", help="Cut-off of the filter; its natural frequency if left out.")
    ] = None,
    interval: Annotated[
        list[str] | None,
        typer.Option("--interval", help="Label of an interval; repeat for more. Default: all that are not ignored."),
    ] = None,
    calibration: Annotated[
        Path | None, typer.Option("--calibration", "-c", help="Calibration that reads the sensor.")
    ] = None,
    figure: Annotated[Path | None, typer.Option("--figure", help="PNG of the response and of the decays.")] = None,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Tell bandwidth and resonance of a sensor, and a filter that undoes them.

    Example: forcetorque bench response taps.toml -e impact --force hammer

    Python: `run.response("impact", calibration)`
    """
    from forcetorque.experiment.campaign_intervals import refuse_a_file_twice
    from forcetorque.experiment.input_files import stated_in
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.results.terminal.output import drawn_to, refuse_figure
    from forcetorque.results.terminal.reading import read_calibrations, read_experiment
    from forcetorque.sensor.bandwidth.bandwidth import response

    log = start_logging()
    refuse_figure(figure)
    refuse_a_file_twice(experiments)
    calibrations = read_calibrations(None if calibration is None else [calibration])
    contents = [read_experiment(path, log) for path in experiments]
    with stated_in(", ".join(str(path) for path in experiments)):
        wanted = sensor if sensor is not None else contents[0].sensors[0].name
        result = response(
            [SensorRun(content, content.sensor(wanted)) for content in contents],
            excitation,
            calibrations or None,
            component=component,
            force=force,
            mass_kg=mass,
            cut_off_hz=cut_off,
            intervals=interval or (),
        )
    if figure is not None:
        result = drawn_to(result, figure)
    show(result, output_format, details=details, experiments=experiments)
