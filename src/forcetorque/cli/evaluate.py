# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque evaluate`: prior against new on data that was not fitted."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import ExperimentsArgument, FormatOption
from forcetorque.cli.output import Format, show, start_logging


def evaluate(
    experiments: ExperimentsArgument,
    calibration: Annotated[
        list[Path], typer.Option("--calibration", "-c", help="Calibration file; repeat to compare several.")
    ],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Judge calibrations on the validation intervals, prior against new.

    Example: forcetorque evaluate experiment.toml --calibration right_leg.json
    """
    from forcetorque import analysis
    from forcetorque.cli.reading import campaign_of, read_calibrations, read_experiments
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    calibrations = read_calibrations(calibration)
    contents = read_experiments(experiments, log)
    results = []
    for sensor, group in analysis.by_sensor(next(iter(contents.values())), calibrations).items():
        log.info("judging %s", sensor)
        campaign = campaign_of(contents, sensor)
        with stated_in(f"{experiments[0]}: sensor {sensor!r}" if len(experiments) == 1 else f"sensor {sensor!r}"):
            results.append(analysis.evaluate(campaign, group))
    show(analysis.Evaluation.together(results), output_format)
