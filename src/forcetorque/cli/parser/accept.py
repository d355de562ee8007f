# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque accept`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ExperimentArgument, FormatOption, PopulationOption
from forcetorque.cli.output import Format


def accept(
    experiment: ExperimentArgument,
    spec: Annotated[
        Path, typer.Option("--spec", help="Acceptance file (TOML) with the limits; see docs/acceptance.md.")
    ],
    calibration: CalibrationsOption = None,
    population: PopulationOption = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Accept or reject sensors by limits; exit code 1 if one fails.

    Example: forcetorque accept experiment.toml --spec limits.toml -c leg.json
    """
    from forcetorque.cli.accept import run

    run(experiment, spec=spec, calibrations=calibration, population=population, output_format=output_format)
