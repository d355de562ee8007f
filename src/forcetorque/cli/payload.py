# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque payload`: what hangs on a wrist sensor, with the sensor's biases."""

from __future__ import annotations

from forcetorque.atomic import STANDARD_OUTPUT
from forcetorque.cli.load_file import (
    LoadFileOption,
    LoadFormatOption,
    SensorPoseOption,
    WorldFrameOption,
    refuse_load_file,
    write_load,
)
from forcetorque.cli.options import ExperimentsArgument, ForceOption, FormatOption
from forcetorque.cli.output import Format, show, show_warnings, start_logging


def payload(
    experiments: ExperimentsArgument,
    to: LoadFormatOption = None,
    output: LoadFileOption = None,
    world_frame: WorldFrameOption = None,
    sensor_pose: SensorPoseOption = None,
    force: ForceOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Estimate mass, centre of mass and bias of a wrist sensor's load.

    Example: forcetorque payload wrist.toml --to ft-tools -o load.yaml
    """
    from forcetorque import analysis
    from forcetorque.analysis.runs.campaign_recording import refuse_a_file_twice
    from forcetorque.experiment import load_experiment
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    refuse_load_file(output, to, output_format, force=force)
    refuse_a_file_twice(experiments)
    runs = []
    for path in experiments:
        log.info("reading %s", path)
        content = load_experiment(path)
        runs.append(analysis.SensorRun(content, content.sensors[0]))
    with stated_in(", ".join(str(path) for path in experiments)):
        load = analysis.weigh_load(runs)
        if output is not None and to is not None:
            together = load if len(runs) > 1 else None
            robot = analysis.robot_load(runs[-1], load.sessions[-1].bias, weighed=together)
            log.info("the bias is that of %r, the last power-up", load.sessions[-1].session)
            write_load(robot, output, to, world_frame=world_frame, sensor_pose=sensor_pose, log=log)
    if output == STANDARD_OUTPUT:  # the file itself went there
        show_warnings(load)
    else:
        show(load, output_format)
