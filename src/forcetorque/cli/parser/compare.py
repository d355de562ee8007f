# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque compare`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import ComparedCalibrationsOption, FormatOption, SensorOption, SphereIntervalOption
from forcetorque.cli.output import Format, TrialsChoice


def compare(
    experiments: Annotated[
        list[Path], typer.Argument(help="Experiment files (TOML), in the order of the trials; see docs/sphere.md.")
    ],
    sensor: SensorOption = None,
    calibration: ComparedCalibrationsOption = None,
    interval: SphereIntervalOption = None,
    trials: Annotated[
        TrialsChoice,
        typer.Option("--trials", help="Whether a trial is a file with all its intervals, or each interval."),
    ] = TrialsChoice.FILES,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the indices of trials, their mean and the pooled fit.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Compare the spheres of many sensors, mountings and trials.

    Example: forcetorque compare first.toml second.toml third.toml
    """
    from forcetorque.cli.compare import run

    run(
        experiments,
        sensors=sensor,
        calibrations=calibration,
        intervals=interval,
        by_interval=trials is TrialsChoice.INTERVALS,
        figure=figure,
        output_format=output_format,
    )
