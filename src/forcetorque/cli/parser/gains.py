# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque gains`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ExperimentArgument, FormatOption, SensorOption
from forcetorque.cli.output import Format


def gains(
    experiment: ExperimentArgument,
    sensor: SensorOption = None,
    margin: Annotated[
        float, typer.Option("--margin", help="Share of the limit to keep free for forces that were not recorded.")
    ] = 0.2,
    amplifier_gain: Annotated[
        str | None,
        typer.Option("--amplifier-gain", help="Present gains, like 24 or 24,24,24,36,36,36. Default: of the file."),
    ] = None,
    allowed_gains: Annotated[
        str | None,
        typer.Option("--allowed-gains", help="Gains that can be set, like 8,16,24,36,48. Default: of the file."),
    ] = None,
    calibration: CalibrationsOption = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the channels against their limits, before and after.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Show the head-room of raw channels and which amplifier gains suit them.

    Example: forcetorque gains experiment.toml --margin 0.2
    """
    from forcetorque.cli.gains import run

    run(
        experiment,
        sensors=sensor,
        margin=margin,
        amplifier_gain=amplifier_gain,
        allowed_gains=allowed_gains,
        calibrations=calibration,
        figure=figure,
        output_format=output_format,
    )
