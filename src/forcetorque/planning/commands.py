# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque plan`: what to record next, so that a sensor errs less where it is used."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.command_output import (
    Format,
    drawn_to,
    refuse_figure,
    refuse_standard_output,
    show,
    start_logging,
)
from forcetorque.results.terminal.options import DetailsOption, FormatOption


def plan(
    experiments: Annotated[
        list[Path],
        typer.Argument(
            help="Experiment files (TOML) with the same sensor; one without a recording is taken too, see "
            "docs/planning.md."
        ),
    ],
    calibration: Annotated[
        Path | None, typer.Option("--calibration", "-c", help="What is known so far. Default: the prior matrix.")
    ] = None,
    load_case: Annotated[
        str | None,
        typer.Option("--load-case", help="Use to plan for. Default: the one furthest from what is allowed."),
    ] = None,
    sensor: Annotated[
        str | None,
        typer.Option("--sensor", help="Sensor to plan for. Default: that of the calibration."),
    ] = None,
    clearance_deg: Annotated[
        float | None,
        typer.Option("--clearance-deg", help="What joints keep away from their limits. Default: that of [plan]."),
    ] = None,
    recordings: Annotated[int, typer.Option("--recordings", min=1, max=20, help="How many recordings to plan.")] = 3,
    seconds: Annotated[
        float | None, typer.Option("--seconds", help="About how long each recording may be. Default: 60.")
    ] = None,
    jointly: Annotated[
        bool,
        typer.Option(
            "--jointly",
            help="Order these recordings, real or simulated, by what they teach all sensors together; "
            "docs/calibration/joint.md.",
        ),
    ] = False,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Folder to make, for trajectories (CSV, ROS, YARP) and JSON.")
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", help="PNG, SVG or PDF of the predicted errors before and after each recording."),
    ] = None,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Say what to record next to lower the error at the loads of use.

    Example: forcetorque plan experiment.toml -c right_leg.json -o next

    Python: `run.plan(calibration, clearance_deg=10.0)`; `--jointly`: `planning.plan_jointly([experiment])`
    """
    from forcetorque.calibration.commands import refuse_beside_jointly
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.planning.joint_calibration_plan import plan_jointly
    from forcetorque.planning.planning import plan
    from forcetorque.planning.trajectory_files import refuse_full_folder, write_plan
    from forcetorque.results.terminal.command_inputs import (
        one_calibration,
        planned_experiments,
        planned_sensor,
        read_experiments,
    )

    log = start_logging()
    refuse_figure(figure)
    if jointly:
        alone = {"-c": calibration, "--load-case": load_case, "--sensor": sensor, "--clearance-deg": clearance_deg}
        refuse_beside_jointly(alone | {"--seconds": seconds, "--output": output})
        contents = list(read_experiments(experiments, log).values())
        ordered = plan_jointly(contents, recordings=recordings, progress=log.info)
        if figure is not None:
            ordered = drawn_to(ordered, figure)
        show(ordered, output_format, details=details, experiments=experiments)
        return
    refuse_standard_output("--output", output)
    if output is not None:
        refuse_full_folder(output, where="--output ")
    known = None if calibration is None else one_calibration(calibration, sensor)
    contents = planned_experiments(experiments, log)
    name = planned_sensor(contents[0], sensor, known)
    result = plan(
        [SensorRun(content, name) for content in contents],
        known,
        load_case=load_case,
        clearance_deg=clearance_deg,
        recordings=recordings,
        seconds=seconds,
        progress=log.info,
    )
    if figure is not None:
        result = drawn_to(result, figure)
    if output is not None:
        result = write_plan(result, output)
    show(result, output_format, details=details, experiments=experiments)
