# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque gains`: how far the channels are from saturation, and which amplifier gains would suit them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.results.terminal.options import CalibrationsOption, ExperimentArgument, FormatOption, SensorOption
from forcetorque.results.terminal.output import Format, show, start_logging

if TYPE_CHECKING:
    from forcetorque.experiment.experiment import Experiment, ExperimentSensor


def gains(
    experiment: ExperimentArgument,
    sensor: SensorOption = None,
    margin: Annotated[
        float, typer.Option("--margin", help="Share of the limit to keep free for forces that were not recorded.")
    ] = 0.2,
    amplifier_gain: Annotated[
        str | None,
        typer.Option("--amplifier-gain", help="Present gains, like 24 or 24,24,24,36,36,36. Default: of the file."),
    ] = None,
    allowed_gains: Annotated[
        str | None,
        typer.Option("--allowed-gains", help="Gains that can be set, like 8,16,24,36,48. Default: of the file."),
    ] = None,
    calibration: CalibrationsOption = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the channels against their limits, before and after.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Show the head-room of raw channels and which amplifier gains suit them.

    Example: forcetorque gains experiment.toml --margin 0.2

    Python: `run.gains()`
    """
    from forcetorque.experiment.applicability import one_per_sensor
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.results.terminal.reading import read_calibrations, read_experiment, refuse_left_out, sensors_named
    from forcetorque.sensor.gains.gains import Gains, select_gains, sensor_gains

    log = start_logging()
    refuse_figure(figure)
    calibrations = read_calibrations(calibration)
    content = read_experiment(experiment, log)
    sensors = sensors_named(content, sensor)
    matrices = one_per_sensor(content, calibrations)
    refuse_left_out(content, sensors, calibrations)
    runs = [SensorRun(content, _with_gains(content, chosen, amplifier_gain, allowed_gains)) for chosen in sensors]
    answer = Gains.together(
        select_gains(run, dict([matrices[run.sensor.name]]) if run.sensor.name in matrices else None, margin=margin)
        for run in runs
    )
    if figure is not None:
        from forcetorque.base.output_file import write_bytes_atomically
        from forcetorque.results.figures import png_bytes
        from forcetorque.sensor.figures import gain_figure

        drawn = gain_figure([sensor_gains(run, margin=margin) for run in runs])
        write_bytes_atomically(figure, png_bytes(drawn))
        answer = answer.model_copy(update={"figure": str(figure)})
    show(answer, output_format)


def _with_gains(
    experiment: Experiment, sensor: ExperimentSensor, amplifier_gain: str | None, allowed_gains: str | None
) -> ExperimentSensor:
    """The sensor with what the options say in place of what the experiment file says."""
    if amplifier_gain is not None:
        present = _numbers("--amplifier-gain", amplifier_gain)
        channels = len(experiment.recording.stream(sensor.stream).signal(sensor.quantity).columns)
        if len(present) not in (1, channels):
            raise ForceTorqueError(
                f"--amplifier-gain {amplifier_gain}: expected one number, or one for each of the {channels} channels "
                f"of {sensor.name!r}, got {len(present)}"
            )
        sensor = replace(sensor, amplifier_gain=present * channels if len(present) == 1 else present)
    if allowed_gains is not None:
        sensor = replace(sensor, allowed_gains=_numbers("--allowed-gains", allowed_gains))
    if sensor.allowed_gains is not None and sensor.amplifier_gain is None:
        raise ForceTorqueError(
            f"sensor {sensor.name!r}: expected the gains that it was recorded with beside the allowed ones; "
            "give --amplifier-gain, or amplifier_gain in the experiment file"
        )
    return sensor


def _numbers(option: str, text: str) -> tuple[float, ...]:
    try:
        numbers = tuple(float(word) for word in text.split(","))
    except ValueError as error:
        raise ForceTorqueError(f"{option} {text}: expected numbers with commas between them") from error
    if any(not 0.0 < number < float("inf") for number in numbers):
        raise ForceTorqueError(f"{option} {text}: expected finite numbers above 0")
    return numbers
