# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque study`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption, SensorOption
from forcetorque.cli.output import Format


def study(
    experiments: Annotated[list[Path], typer.Argument(help="Experiment files (TOML) with the same sensors.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder to make, with a folder per sensor.")],
    sensor: SensorOption = None,
    data_set: Annotated[
        list[str] | None,
        typer.Option(
            "--data-set",
            help="NAME=LABEL,LABEL: intervals, by label or kind, that are fitted together; repeat for more. Default: "
            "every combination of kinds.",
        ),
    ] = None,
    kind: Annotated[
        list[str] | None,
        typer.Option("--type", help="Estimation type, SnTdTO to OwTrTO; repeat for more. Default: all nine."),
    ] = None,
    regularisation: Annotated[
        list[float] | None,
        typer.Option(
            "--lambda",
            help="Lambda of the thesis' equation (5.4) in counts2, as `calibrate` takes it; repeat for more. Default: "
            "the thirteen of its tables, six times as printed there.",
        ),
    ] = None,
    sphere: Annotated[
        list[str] | None,
        typer.Option(
            "--sphere",
            help="Interval whose motion draws a sphere, for the types S...; repeat for more. Default: what the files "
            "say.",
        ),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Fit every estimation type, lambda and data set, and choose.

    Example: forcetorque study simulated/*.toml --sphere grid -o study
    """
    from forcetorque.cli.study import run

    run(
        experiments,
        output=output,
        sensors=sensor,
        data_sets=data_set,
        kinds=kind,
        lambdas=regularisation,
        sphere=sphere,
        output_format=output_format,
    )
