# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin check`: what is wrong with the layout of a patch."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.options import FormatOption
from forcetorque.results.terminal.output import Format, show, start_logging, stop_at_failures


def check(
    layout: Annotated[Path, typer.Argument(help="File with the layout of a patch; see docs/skin_layout.md.")],
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of positions and normals, as written and as rebuilt.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find what is wrong with a layout; exit code 1 if anything is.

    Example: forcetorque skin check right_leg_lower.txt
    """
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.skin.layout.check import check_skin

    refuse_figure(figure)
    start_logging().info("reading %s", layout)
    answer = check_skin(layout)
    if figure is not None:
        from forcetorque.base.files import write_bytes_atomically
        from forcetorque.results.figures.canvas import png_bytes
        from forcetorque.skin.figures import skin_layout_figure

        write_bytes_atomically(figure, png_bytes(skin_layout_figure(answer.positions, answer.normals)))
        answer = answer.model_copy(update={"figure": str(figure)})
    show(answer, output_format)
    stop_at_failures(answer.findings)
