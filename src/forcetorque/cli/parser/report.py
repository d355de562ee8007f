# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque report`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption, PopulationOption
from forcetorque.cli.output import Format


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
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Write everything about sensors into one document, verdict first.

    Example: forcetorque report experiment.toml right_leg.json -o report.html
    """
    from forcetorque.cli.report import run

    run(results, outputs=output, title=title, population=population, with_viewer=viewer, output_format=output_format)
