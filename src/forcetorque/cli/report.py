# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque report`: everything about sensors in one document, verdict first."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.cli.options import ForceOption, FormatOption, PopulationOption
from forcetorque.cli.output import Format, say, show, start_logging

if TYPE_CHECKING:
    from forcetorque.report.document import Section


def report(
    results: Annotated[
        list[Path],
        typer.Argument(
            help="Experiment files, calibrations, an acceptance file, and JSON results of other commands, in any order."
        ),
    ],
    output: Annotated[
        list[Path],
        typer.Option("--output", "-o", help="File to write, .html or .pdf; repeat for both. A .json goes beside it."),
    ],
    title: Annotated[str | None, typer.Option("--title", help="Title. Default: names of the experiments.")] = None,
    population: PopulationOption = None,
    viewer: Annotated[
        bool, typer.Option("--viewer", help="Put the viewer of each experiment into the HTML; some 1 MB and more.")
    ] = False,
    force: ForceOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Write everything about sensors into one document, verdict first.

    Example: forcetorque report experiment.toml right_leg.json -o report.html
    """
    from importlib.metadata import version

    from forcetorque import report as reports
    from forcetorque.analysis import Demands, read_population
    from forcetorque.cli.reading import read_shown
    from forcetorque.created import created_now
    from forcetorque.output_file import declare_outputs

    log = start_logging()
    reports.require_writable(output)
    files = [*output, output[0].with_suffix(".numbers.json")]
    declare_outputs(*files, force=force)
    sources = reports.sort_sources(results)
    demands = Demands(acceptance=sources.acceptance, population=read_population(population) if population else None)
    experiments = [(str(path), read_shown(path, log)) for path in sources.experiments]
    groups = reports.assign_calibrations([experiment for _, experiment in experiments], sources.calibrations)

    def section(place: int) -> Section:
        log.info("building the viewer")
        own = {file: calibration for group in groups[place].values() for file, calibration in group.items()}
        return reports.viewer_section(sources.experiments[place], experiments[place][1], own)

    written = reports.report(
        experiments,
        groups,
        created=created_now(),
        code_version=version("forcetorque"),
        title=title,
        demands=demands,
        results=sources.results,
        viewer=section if viewer else None,
        progress=log.info,
    )
    log.info("drawing")
    written.save(*files)
    show(written, output_format)
    say(f"written: {', '.join(map(str, files))}", output_format)
