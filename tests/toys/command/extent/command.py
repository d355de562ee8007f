# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque extent`: how long sensors were logged."""

from __future__ import annotations

from forcetorque.results.terminal.options import ExperimentArgument, FormatOption
from forcetorque.results.terminal.output import Format, show, start_logging


def extent(experiment: ExperimentArgument, output_format: FormatOption = Format.TABLE) -> None:
    """Show how long sensors were logged.

    Example: forcetorque extent experiment.toml
    """
    from forcetorque.extent.extents import Extent, sensor_extent

    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.results.terminal.reading import read_experiment

    content = read_experiment(experiment, start_logging())
    runs = [SensorRun(content, sensor) for sensor in content.sensors]
    show(Extent.together(sensor_extent(run) for run in runs), output_format)
