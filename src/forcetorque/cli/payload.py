# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque payload`: what hangs on a wrist sensor, with the sensor's bias."""

from __future__ import annotations

from forcetorque.cli.options import ExperimentArgument, FormatOption
from forcetorque.cli.output import Format, show, start_logging


def payload(experiment: ExperimentArgument, output_format: FormatOption = Format.TABLE) -> None:
    """Estimate mass, centre of mass and bias of a wrist sensor's load.

    Example: forcetorque payload experiment.toml
    """
    from forcetorque import analysis
    from forcetorque.experiment import load_experiment
    from forcetorque.experiment.inputs import stated_in

    start_logging().info("reading %s", experiment)
    content = load_experiment(experiment)
    with stated_in(str(experiment)):
        load = analysis.weigh_load(analysis.SensorRun(content, content.sensors[0]))
    show(load, output_format)
