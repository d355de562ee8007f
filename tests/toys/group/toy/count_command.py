# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque toy count`: how many taxels a layout has."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.command_output import Format, show
from forcetorque.results.terminal.options import FormatOption


def count(
    layout: Annotated[Path, typer.Argument(help="File with the layout of a patch.")],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Count the taxels of a layout.

    Example: forcetorque toy count patch.txt
    """
    from forcetorque.toy.taxel_count import toy_count

    show(toy_count(layout), output_format)
