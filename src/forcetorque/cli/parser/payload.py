# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque payload`."""

from __future__ import annotations

from forcetorque.cli.options import ExperimentArgument, FormatOption
from forcetorque.cli.output import Format


def payload(experiment: ExperimentArgument, output_format: FormatOption = Format.TABLE) -> None:
    """Estimate mass, centre of mass and bias of a wrist sensor's load.

    Example: forcetorque payload experiment.toml
    """
    from forcetorque.cli.payload import run

    run(experiment, output_format=output_format)
