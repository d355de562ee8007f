# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque accept`: thresholds on what the other commands measure, and on the matrix by itself."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ExperimentsArgument, FormatOption, PopulationOption
from forcetorque.cli.output import Format, show, start_logging


def accept(
    experiments: ExperimentsArgument,
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
    from forcetorque import analysis
    from forcetorque.cli.reading import campaign_of, read_calibrations, read_experiments
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    stated = analysis.read_acceptance(spec)
    calibrations = read_calibrations(calibration)
    matrices = analysis.read_population(population) if population else None
    contents = read_experiments(experiments, log)
    content = next(iter(contents.values()))
    chosen = analysis.one_per_sensor(content, calibrations)
    results = []
    for sensor in content.sensors:
        if chosen and sensor.name not in chosen:
            continue
        log.info("judging %s", sensor.name)
        others = {name: other for place, (name, other) in chosen.items() if place != sensor.name}
        campaign, judged = campaign_of(contents, sensor.name), chosen.get(sensor.name)
        with stated_in(str(spec)):
            results.append(analysis.accept(campaign, stated, judged, others=others, population=matrices))
    result = analysis.Acceptance.together(results)
    show(result, output_format)
    if not result.accepted:
        sys.exit(1)
