# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque contest`: sensors and methods through one motion, on loads that nobody was fitted on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption
from forcetorque.cli.output import Format, show, start_logging


def contest(
    config: Annotated[
        Path, typer.Argument(help="File of the contest (TOML): runs and contestants; see docs/contest.md.")
    ],
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of errors by component and load, with their intervals.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Rank sensors and calibration methods on the same loads.

    Example: forcetorque contest contest.toml --figure contest.png
    """
    from importlib.metadata import version

    from forcetorque import analysis
    from forcetorque.atomic import write_bytes_atomically
    from forcetorque.cli.figure_file import refuse_figure
    from forcetorque.created import created_now
    from forcetorque.experiment.inputs import stated_in

    start_logging()
    refuse_figure(figure)
    entries = analysis.read_entries(config)
    with stated_in(str(config)):
        result = analysis.contest(entries, code_version=version("forcetorque"), created=created_now())
    if figure is not None:
        from forcetorque.report.figures import contest_figure
        from forcetorque.report.figures.canvas import png_bytes

        write_bytes_atomically(figure, png_bytes(contest_figure(result.loads)))
        result = result.model_copy(update={"figure": str(figure)})
    show(result, output_format)
