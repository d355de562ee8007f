# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque extent`: how long sensors were logged."""

from __future__ import annotations

from forcetorque.cli.options import ExperimentArgument, FormatOption
from forcetorque.cli.output import Format, show, start_logging


def extent(experiment: ExperimentArgument, output_format: FormatOption = Format.TABLE) -> None:
    """Show how long sensors were logged.

    Example: forcetorque extent experiment.toml
    """
    from forcetorque import analysis
    from forcetorque.cli.reading import read_experiment

    content = read_experiment(experiment, start_logging())
    runs = [analysis.SensorRun(content, sensor) for sensor in content.sensors]
    show(analysis.Extent.together(analysis.extent(run) for run in runs), output_format)
