# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque report`: everything about sensors in one document, verdict first."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.results.terminal.command_output import Format, show, start_logging
from forcetorque.results.terminal.options import (
    DetailsOption,
    ForceOption,
    FormatOption,
    PopulationOption,
    SensorOption,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from forcetorque.experiment.calibration.calibration_file import Calibration
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.results.document.content import Section


def report(
    results: Annotated[
        list[Path],
        typer.Argument(
            help="Experiment files, calibrations or folders of them, an acceptance file, JSON results of commands."
        ),
    ],
    output: Annotated[
        list[Path],
        typer.Option("--output", "-o", help="File to write, .html or .pdf; repeat for both. A .json goes beside it."),
    ],
    calibration: Annotated[
        list[Path] | None,
        typer.Option("--calibration", "-c", help="Calibration, beside those among the files."),
    ] = None,
    title: Annotated[str | None, typer.Option("--title", help="Title. Default: names of the experiments.")] = None,
    sensor: SensorOption = None,
    population: PopulationOption = None,
    viewer: Annotated[
        bool, typer.Option("--viewer", help="Put the viewer of each experiment into the HTML; some 1 MB and more.")
    ] = False,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Write everything about sensors into one document, verdict first.

    Example: forcetorque report experiment.toml right_leg.json -o report.html

    Python: `run.report(calibration).save("report.html")`
    """
    from importlib.metadata import version

    from forcetorque.base.output_file import declare_outputs
    from forcetorque.experiment.applicability import read_population
    from forcetorque.experiment.loading import Purpose
    from forcetorque.report.report import report, require_writable
    from forcetorque.report.report_sections import viewer_section
    from forcetorque.report.sensor_assessment import Demands
    from forcetorque.report.sorted_input_files import assign_calibrations, sort_sources
    from forcetorque.results.result import created_now
    from forcetorque.results.terminal.command_inputs import read_experiment
    from forcetorque.viewer.page import require_few_samples

    log = start_logging()
    require_writable(output)
    files = [*output, output[0].with_suffix(".numbers.json")]
    declare_outputs(*files, force=force)
    paths, calibrations, acceptance, contents = sort_sources([*results, *(calibration or ())])
    demands = Demands(acceptance=acceptance, population=read_population(population) if population else None)
    experiments = [(str(path), read_experiment(path, log, Purpose.DISPLAY)) for path in paths]
    if viewer:
        for file, experiment in experiments:
            require_few_samples(f"--viewer of {file}", _shown_samples(experiment))
    groups = assign_calibrations([experiment for _, experiment in experiments], calibrations)
    if sensor:
        groups = [
            _of_sensors(file, experiment, group, sensor)
            for (file, experiment), group in zip(experiments, groups, strict=True)
        ]

    def section(place: int) -> Section:
        log.info("building the viewer")
        own = {file: calibration for group in groups[place].values() for file, calibration in group.items()}
        return viewer_section(paths[place], experiments[place][1], own)

    written = report(
        experiments,
        groups,
        created=created_now(),
        code_version=version("forcetorque"),
        title=title,
        demands=demands,
        results=contents,
        viewer=section if viewer else None,
        progress=log.info,
    )
    log.info("drawing")
    for failure in written.save(*files):
        log.warning("%s", failure)
    written = written.model_copy(update={"files": tuple(map(str, files))})
    show(written, output_format, details=details, experiments=paths)


def _shown_samples(experiment: Experiment) -> int:
    """Samples in the viewer; 0 where there is none, for which its section gives the reason."""
    from forcetorque.base.errors import ExperimentError, RecordingError
    from forcetorque.viewer.posture import sample_count

    try:
        return sample_count(experiment)
    except (ExperimentError, RecordingError):
        return 0


def _of_sensors(
    file: str, experiment: Experiment, group: dict[str, dict[str, Calibration]], sensors: Sequence[str]
) -> dict[str, dict[str, Calibration]]:
    """Calibrations of the sensors that are named, none of them left out, so that these are what is assessed."""
    from forcetorque.experiment.named_files import stated_in

    with stated_in(file):
        return {experiment.sensor(name).name: group.get(name, {}) for name in sensors}
