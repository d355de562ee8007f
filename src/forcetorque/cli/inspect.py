# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque inspect`: what a log or the recording of an experiment holds, and what is wrong with it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import FormatOption
from forcetorque.cli.output import Format, show, start_logging


def inspect(
    log: Annotated[
        Path, typer.Argument(help="Experiment file, or a log that is recognised, such as a YARP dumper folder.")
    ],
    log_format: Annotated[
        str | None,
        typer.Option(help="Format of a log, such as ros or hdf5, as in [recording]. Default: by what is there."),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find gaps, lost messages, frozen or saturated sensors, steps and contacts.

    Example: forcetorque inspect experiment.toml
    """
    from forcetorque import analysis

    start_logging().info("reading %s", log)
    show(analysis.inspect_log(log, log_format=log_format), output_format)
