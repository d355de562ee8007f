# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque estimate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ExperimentArgument, FormatOption
from forcetorque.cli.output import Format


def estimate(
    experiment: ExperimentArgument,
    output: Annotated[Path, typer.Option("--output", "-o", help="File for every sample, .parquet or .csv.")],
    calibration: CalibrationsOption = None,
    contacts: Annotated[
        list[str] | None,
        typer.Option(
            "--contacts",
            help="FRAME, FRAME:force or FRAME:force_along:x,y,z; repeat for more. Default: those of the file, else "
            "at the sensors.",
        ),
    ] = None,
    length_scale: Annotated[
        float | None,
        typer.Option("--length-scale", help="Moment that weighs as much as one newton; m. For more than six unknowns."),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Estimate contact wrenches, joint torques and expected readings.

    Example: forcetorque estimate experiment.toml -o estimates.parquet
    """
    from forcetorque.cli.estimate import run

    run(
        experiment,
        output=output,
        calibrations=calibration,
        contacts=contacts,
        length_scale=length_scale,
        output_format=output_format,
    )
