# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque schema`."""

from __future__ import annotations

from typing import Annotated

import typer


def schema(
    name: Annotated[
        str,
        typer.Argument(
            help="experiment, acceptance, scenario, recording, calibration, accept, calibrate, compare, estimate, "
            "evaluate, export, gains, inspect, payload, report, simulate, sphere, study, validate or view."
        ),
    ],
) -> None:
    """Print the JSON schema of a file or of a command's result.

    Example: forcetorque schema experiment
    """
    from forcetorque.cli.schema import run

    run(name)
