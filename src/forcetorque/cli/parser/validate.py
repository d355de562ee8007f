# SPDX-License-Identifier: BSD-3-Clause
"""The words of `forcetorque validate`."""

from __future__ import annotations

from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ExperimentArgument, FormatOption
from forcetorque.cli.output import Format, OtherSensorsChoice


def validate(
    experiment: ExperimentArgument,
    calibration: CalibrationsOption = None,
    sensor: Annotated[
        list[str] | None,
        typer.Option(
            "--sensor", help="Sensor to judge; repeat for more. Default: those of the calibrations, else all."
        ),
    ] = None,
    sub_model: Annotated[
        str | None,
        typer.Option(
            "--sub-model",
            help="Part of the robot that nothing touches, by the sensor at its base or the root link. Default: that "
            "beyond the sensor.",
        ),
    ] = None,
    contact: Annotated[
        str | None,
        typer.Option("--contact", help="Link at whose origin the contact is estimated. Default: that on the sensor."),
    ] = None,
    others: Annotated[
        OtherSensorsChoice,
        typer.Option("--others", help="What the other sensors of the part read: what the model expects, or measured."),
    ] = OtherSensorsChoice.MODEL,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Judge calibrations by contact force and joint torques where nothing touches.

    Example: forcetorque validate experiment.toml -c right_leg.json
    """
    from forcetorque.cli.validate import run
    from forcetorque.evaluation import OtherSensors

    run(
        experiment,
        calibrations=calibration,
        sensors=sensor,
        sub_model=sub_model,
        contact=contact,
        other_sensors=OtherSensors(others.value),
        output_format=output_format,
    )
