# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque contest`: sensors and methods through one motion, on loads that were not fitted."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.options import FormatOption
from forcetorque.results.terminal.output import Format, show, start_logging


def contest(
    config: Annotated[
        Path, typer.Argument(help="File of the contest (TOML): runs and contestants; see docs/contests.md.")
    ],
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of errors by component and load, with their intervals.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Rank sensors and calibration methods on the same loads.

    Example: forcetorque contest contest.toml --figure contest.png

    Python: `forcetorque.contest("contest.toml")`
    """
    from importlib.metadata import version

    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.contests.entries import read_entries
    from forcetorque.contests.ranking import contest
    from forcetorque.experiment.input_files import stated_in
    from forcetorque.results.result import created_now
    from forcetorque.results.terminal.output import refuse_figure

    start_logging()
    refuse_figure(figure)
    entries = read_entries(config)
    with stated_in(str(config)):
        result = contest(entries, code_version=version("forcetorque"), created=created_now())
    if figure is not None:
        from forcetorque.contests.figure import contest_figure
        from forcetorque.results.figures import png_bytes

        write_bytes_atomically(figure, png_bytes(contest_figure(result.loads)))
        result = result.model_copy(update={"figure": str(figure)})
    show(result, output_format)
