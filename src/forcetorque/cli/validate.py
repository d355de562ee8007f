# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque validate`: contact forces that sensors report where nothing touches, and joint torques from them."""

from __future__ import annotations

from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ExperimentsArgument, FormatOption
from forcetorque.cli.output import Format, OtherSensorsChoice, show, start_logging


def validate(
    experiments: ExperimentsArgument,
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
    from forcetorque import analysis
    from forcetorque.cli.reading import campaign_of, read_calibrations, read_experiments
    from forcetorque.evaluation import OtherSensors
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    calibrations = read_calibrations(calibration)
    contents = read_experiments(experiments, log)
    content = next(iter(contents.values()))
    groups = analysis.by_sensor(content, calibrations)
    names = sensor or groups or [known.name for known in content.sensors]
    results = []
    for name in dict.fromkeys(content.sensor(known).name for known in names):
        log.info("validating %s", name)
        rest = {file: one for other, group in groups.items() if other != name for file, one in group.items()}
        if others is OtherSensorsChoice.MEASURED:
            analysis.one_per_sensor(content, rest)
        campaign = campaign_of(contents, name)
        with stated_in(f"{experiments[0]}: sensor {name!r}" if len(experiments) == 1 else f"sensor {name!r}"):
            validation = analysis.validate(
                campaign,
                groups.get(name, {}),
                others=rest,
                other_sensors=OtherSensors(others.value),
                sub_model=sub_model,
                contact=contact,
            )
        results.append(validation)
    show(analysis.Validation.together(results), output_format)
