# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque tare`: the offset with which a sensor at rest reads what its load weighs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.atomic import STANDARD_OUTPUT
from forcetorque.cli.load_file import (
    LoadFileOption,
    LoadFormatOption,
    SensorPoseOption,
    WorldFrameOption,
    refuse_load_file,
    write_load,
)
from forcetorque.cli.options import ExperimentArgument, ForceOption, FormatOption, SensorOption
from forcetorque.cli.output import Format, show, show_warnings, start_logging
from forcetorque.errors import ForceTorqueError

if TYPE_CHECKING:
    from forcetorque.calibration import Calibration
    from forcetorque.experiment import Experiment


def tare(
    experiment: ExperimentArgument,
    interval: Annotated[str, typer.Option("--interval", help="Label of an interval in which nothing moves.")],
    sensor: SensorOption = None,
    calibration: Annotated[
        list[Path] | None,
        typer.Option("--calibration", "-c", help="Calibration that reads a sensor; repeat for more. Default: none."),
    ] = None,
    to: LoadFormatOption = None,
    output: LoadFileOption = None,
    world_frame: WorldFrameOption = None,
    sensor_pose: SensorPoseOption = None,
    force: ForceOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find the offset that keeps the weight of a load, from a stretch at rest.

    Example: forcetorque tare wrist.toml --interval still
    """
    from forcetorque import analysis
    from forcetorque.cli.reading import read_calibrations, read_experiment, refuse_left_out, sensors_named
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    refuse_load_file(output, to, output_format, force=force)
    calibrations = read_calibrations(calibration)
    content = read_experiment(experiment, log)
    chosen = sensors_named(content, sensor)
    refuse_left_out(content, chosen, calibrations)
    by_sensor = _one_for_each(content, calibrations)
    runs = [analysis.SensorRun(content, one) for one in chosen]
    names = [by_sensor.get(run.sensor.name) for run in runs]
    with stated_in(str(experiment)):
        result = analysis.Tare.together(
            analysis.tare(run, interval, name=name, calibration=calibrations[name] if name else None)
            for run, name in zip(runs, names, strict=True)
        )
    if output is not None and to is not None:
        load = analysis.robot_load(runs[0], result.sensors[0].bias)
        write_load(load, output, to, world_frame=world_frame, sensor_pose=sensor_pose, log=log)
    if output == STANDARD_OUTPUT:
        show_warnings(result)
    else:
        show(result, output_format)


def _one_for_each(content: Experiment, calibrations: Mapping[str, Calibration]) -> dict[str, str]:
    """Names of calibrations by the sensors that they read."""
    names: dict[str, str] = {}
    for name, calibration in calibrations.items():
        other = names.setdefault(content.sensor(calibration.sensor.name).name, name)
        if other != name:
            raise ForceTorqueError(f"{name}: calibrates the sensor of {other}; expected one calibration for each")
    return names
