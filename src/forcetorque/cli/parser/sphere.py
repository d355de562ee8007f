# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque sphere`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import (
    ComparedCalibrationsOption,
    ExperimentArgument,
    FormatOption,
    SensorOption,
    SphereIntervalOption,
)
from forcetorque.cli.output import Format


def sphere(
    experiment: ExperimentArgument,
    sensor: SensorOption = None,
    calibration: ComparedCalibrationsOption = None,
    interval: SphereIntervalOption = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the forces, the ellipsoids and the weight by the model.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Compare how the three axes weigh a limb that is carried around.

    Example: forcetorque sphere experiment.toml --interval grid
    """
    from forcetorque.cli.sphere import run

    run(
        experiment,
        sensors=sensor,
        calibrations=calibration,
        intervals=interval,
        figure=figure,
        output_format=output_format,
    )
