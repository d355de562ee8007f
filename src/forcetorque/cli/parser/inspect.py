# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque inspect`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption
from forcetorque.cli.output import Format


def inspect(
    log: Annotated[
        Path, typer.Argument(help="Experiment file, YARP dumper folder, or folder of the project's own form.")
    ],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find gaps, lost messages, frozen or saturated sensors, steps and contacts.

    Example: forcetorque inspect experiment.toml
    """
    from forcetorque.cli.inspect import run

    run(log, output_format=output_format)
