# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate`: from an experiment file to calibration files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.cli.options import ExperimentArgument, FormatOption, SensorOption
from forcetorque.cli.output import Format, refuse_standard_output, report_error, show, start_logging
from forcetorque.errors import ExperimentError, FitError, ForceTorqueError

if TYPE_CHECKING:
    from forcetorque.experiment import Experiment, ExperimentSensor


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
    from datetime import UTC, datetime
    from importlib.metadata import version

    from forcetorque import analysis
    from forcetorque.calibration import estimation_type
    from forcetorque.cli.reading import read_experiment, sensors_named
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    refuse_standard_output("--output", output)
    chosen_kind = None if kind is None else estimation_type(kind)
    content = read_experiment(experiment, log)
    sensors = sensors_named(content, sensor)
    files = _files(output, sensors)
    given = _lambda(regularisation, content)
    created = datetime.now(UTC).isoformat(timespec="seconds")
    results, refusals = [], []
    for chosen, file in zip(sensors, files, strict=True):
        log.info("fitting %s (%s)", chosen.name, chosen.serial)
        run = analysis.SensorRun(content, chosen)
        try:
            with stated_in(f"{experiment}: sensor {chosen.name!r}"):
                results.append(
                    analysis.calibrate_for_file(
                        run,
                        file,
                        code_version=version("forcetorque"),
                        created=created,
                        regularisation=given,
                        kind=chosen_kind,
                    )
                )
        except ForceTorqueError as error:  # a limb that stands still says nothing against the others
            refusals.append(error)
            for sentence in analysis.data_doubts(run):  # what may be the reason
                log.warning("%s", sentence)
    if results:
        calibrations = analysis.SensorCalibrations.together(results)
        calibrations.save()
        show(calibrations, output_format)
    _end(refusals)


def _end(refusals: Sequence[ForceTorqueError]) -> None:
    """Say what was refused, and leave with exit code 2 if anything was."""
    for refusal in refusals:
        report_error(refusal)
    if refusals:
        raise typer.Exit(2)


def _files(output: Path, sensors: Sequence[ExperimentSensor]) -> list[Path]:
    from urllib.parse import quote

    if output.suffix == ".json":
        if len(sensors) != 1:
            raise ExperimentError(
                f"--output {output}: one file for {len(sensors)} sensors; name a folder, or one sensor with --sensor"
            )
        return [output]
    if output.exists() and not output.is_dir():
        raise ExperimentError(f"--output {output}: expected a folder or a .json file, got another file")
    # quoted, because a name or a serial number may hold a slash
    return [output / f"{quote(f'{sensor.name}_{sensor.serial}', safe=' ')}.json" for sensor in sensors]


def _lambda(text: str | None, experiment: Experiment) -> float | None:
    if text is None:
        return experiment.regularisation
    if text == "held-out":
        return None
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not value >= 0.0:
        raise FitError(f"--lambda: expected a number of at least 0 counts2 or `held-out`, got {text!r}")
    return value
