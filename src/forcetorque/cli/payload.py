# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque payload`: what hangs on a wrist sensor, with the sensor's biases."""

from __future__ import annotations

from forcetorque.cli.options import ExperimentsArgument, FormatOption
from forcetorque.cli.output import Format, show, start_logging


def payload(experiments: ExperimentsArgument, output_format: FormatOption = Format.TABLE) -> None:
    """Estimate mass, centre of mass and bias of a wrist sensor's load.

    Example: forcetorque payload experiment.toml
    """
    from forcetorque import analysis
    from forcetorque.analysis.campaign_recording import refuse_a_file_twice
    from forcetorque.experiment import load_experiment
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    refuse_a_file_twice(experiments)
    runs = []
    for path in experiments:
        log.info("reading %s", path)
        content = load_experiment(path)
        runs.append(analysis.SensorRun(content, content.sensors[0]))
    with stated_in(", ".join(str(path) for path in experiments)):
        load = analysis.weigh_load(runs)
    show(load, output_format)
