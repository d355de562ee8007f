# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin check`: what is wrong with the layout of a patch."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption
from forcetorque.cli.output import Format, show, start_logging, stop_at_failures


def check(
    layout: Annotated[Path, typer.Argument(help="File with the layout of a patch; see docs/skin_layout.md.")],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find what is wrong with a layout; exit code 1 if anything is.

    Example: forcetorque skin check right_leg_lower.txt
    """
    from forcetorque import analysis

    start_logging().info("reading %s", layout)
    answer = analysis.check_skin(layout)
    show(answer, output_format)
    stop_at_failures(answer.findings)
