# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque evaluate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.output import Format
from forcetorque.cli.parser.options import ExperimentArgument, FormatOption


def evaluate(
    experiment: ExperimentArgument,
    calibration: Annotated[
        list[Path], typer.Option("--calibration", "-c", help="Calibration file; repeat to compare several.")
    ],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Judge calibrations on the validation intervals, prior against new.

    Example: forcetorque evaluate experiment.toml --calibration right_leg.json
    """
    from forcetorque.cli.evaluate import run

    run(experiment, calibrations=calibration, output_format=output_format)
