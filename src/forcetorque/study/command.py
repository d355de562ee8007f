# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque study`: every estimation type, lambda and combination of data sets, and the best of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.results.terminal.options import FormatOption, SensorOption
from forcetorque.results.terminal.output import Format, refuse_output_folder, show, start_logging

if TYPE_CHECKING:
    from forcetorque.study.study import SensorStudy


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

    Python: `app.study("first.toml", "second.toml", folder="study")`
    """
    from importlib.metadata import version

    from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, estimation_type
    from forcetorque.experiment.input_files import stated_in
    from forcetorque.results.result import created_now
    from forcetorque.study.candidate import SWEEP_LAMBDAS
    from forcetorque.study.folder import write_study_folder
    from forcetorque.study.study import study_sensor
    from forcetorque.study.study_data import read_study_data

    log = start_logging()
    refuse_output_folder(output)
    combinations = None if data_set is None else _data_sets(data_set)
    kinds = [estimation_type(name) for name in kind or ESTIMATION_TYPES]
    lambdas = _lambdas(SWEEP_LAMBDAS if regularisation is None else regularisation)
    created = created_now()
    studied = read_study_data(experiments, sensor, progress=log.info)

    def studies() -> Iterator[SensorStudy]:
        for data in studied:
            log.info("studying %s (%s)", data.identity.name, data.identity.serial)
            with stated_in(f"sensor {data.identity.name!r}"):
                yield study_sensor(
                    data,
                    data_sets=combinations,
                    kinds=kinds,
                    lambdas=lambdas,
                    sphere=sphere,
                    code_version=version("forcetorque"),
                    created=created,
                    progress=log.info,
                )

    names = [str(path) for path in experiments]
    show(write_study_folder(output, studies(), experiments=names, progress=log.info), output_format)


def _data_sets(texts: Sequence[str]) -> dict[str, list[str]]:
    combinations: dict[str, list[str]] = {}
    for text in texts:
        name, _, words = text.partition("=")
        labels = [word.strip() for word in words.split(",") if word.strip()]
        if not name.strip() or not labels:
            raise ForceTorqueError(f"--data-set: expected NAME=LABEL,LABEL with labels or kinds, got {text!r}")
        if name.strip() in combinations:
            raise ForceTorqueError(f"--data-set: the name {name.strip()!r} comes twice; name the data sets apart")
        combinations[name.strip()] = labels
    return combinations


def _lambdas(given: Sequence[float]) -> tuple[float, ...]:
    lambdas = tuple(sorted(set(given)))
    if not all(0.0 <= value < float("inf") for value in lambdas):
        raise FitError(f"--lambda: expected numbers of at least 0 counts2, got {list(lambdas)}")
    return lambdas
