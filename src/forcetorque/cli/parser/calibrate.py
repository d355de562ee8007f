# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque calibrate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import ExperimentArgument, FormatOption, SensorOption
from forcetorque.cli.output import Format


def calibrate(
    experiment: ExperimentArgument,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="A .json file for one sensor, or a folder for one file per sensor.")
    ],
    sensor: SensorOption = None,
    regularisation: Annotated[
        str | None,
        typer.Option("--lambda", help="Lambda in counts2, or `held-out`. Default: what the experiment file says."),
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option("--type", help="Estimation type, SnTdTO to OwTrTO. Default: what the experiment file says."),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Fit the matrix and offset of each sensor on the calibration intervals.

    Example: forcetorque calibrate experiment.toml -o right_leg.json
    """
    from forcetorque.cli.calibrate import run

    run(
        experiment,
        output=output,
        sensors=sensor,
        regularisation=regularisation,
        kind=kind,
        output_format=output_format,
    )
