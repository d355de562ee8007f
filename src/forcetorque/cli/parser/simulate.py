# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque simulate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption
from forcetorque.cli.output import Format


def simulate(
    scenario: Annotated[str, typer.Argument(help="Scenario file (TOML), or icub-insitu or wrist for a bundled one.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder to make.")],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Make recordings of a simulated robot whose sensors are known.

    Example: forcetorque simulate wrist -o simulated
    """
    from forcetorque.cli.simulate import run

    run(scenario, output=output, output_format=output_format)
