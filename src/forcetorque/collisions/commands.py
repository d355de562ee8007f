# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque robot collisions` and `joint-collisions`: contacts that nobody expected."""

import logging
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, command

if TYPE_CHECKING:
    from forcetorque.collisions.result import Collisions, JointCollisions
    from forcetorque.experiment.calibrations_under_test import OneCalibration
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.experiment.sensor_run import SensorRun

_LOG = logging.getLogger(__name__)


@command("the force beyond the model over time, with the contacts")
def collisions(
    run: Annotated["SensorRun", Option("Sensor beyond which contacts are looked for.", "--sensor", all_sensors=True)],
    calibration: Annotated[
        "OneCalibration | None", Option("Calibration that reads the sensor. Default: its prior, or as logged.")
    ] = None,
    *,
    intervals: Annotated[
        Collection[str], Option("Label of an interval to look at. Default: all that are not ignored.", "--interval")
    ] = (),
    free: Annotated[
        Collection[str],
        Option(
            "Label of an interval in which nothing touches the robot beyond the sensor. Default: those for calibration."
        ),
    ] = (),
    alarms_per_hour: Annotated[float, Option("Rate of false alarms that thresholds are set for.")] = 1.0,
) -> "Collisions":
    """Detect, locate and measure contacts that nobody expected.

    Example: forcetorque robot collisions motion.toml --free still

    Python: `run.collisions(calibration)`

    Returns:
        Contacts with force, line and link, and the force from which a contact is noticed.

    Raises:
        ExperimentError: If there is no interval to look at, or too little time without contact.
    """
    from forcetorque.collisions.collision_and_sole_events import events_on_soles
    from forcetorque.collisions.collisions import find_collisions
    from forcetorque.experiment.calibrations_under_test import one_named

    name, read_by = one_named(calibration)
    found = find_collisions(run, run.read_by(name, read_by).bare, intervals, free, alarms_per_hour)
    events, untested = events_on_soles(run, None if read_by is None else (name or "", read_by), intervals)
    return found.model_copy(update={"sole_events": events, "warnings": (*found.warnings, *untested)})


@command("external torques of all joints over their thresholds, with the contacts")
def joint_collisions(
    experiment: Annotated[
        "Experiment | Path | str",
        Option("Experiment file (TOML) with joint torques; it needs no sensor.", typed=Path),
    ],
    *,
    intervals: Annotated[
        Collection[str], Option("Label of an interval to look at. Default: all that are not ignored.", "--interval")
    ] = (),
    free: Annotated[
        Collection[str],
        Option("Label of an interval in which nothing touches the robot. Default: those for calibration."),
    ] = (),
    alarms_per_hour: Annotated[float, Option("Rate of false alarms that thresholds are set for.")] = 1.0,
) -> "JointCollisions":
    """Detect contacts of an arm by its joint torques, without a sensor.

    Example: forcetorque robot joint-collisions arm.toml --free still

    Python: `collisions.joint_collisions("arm.toml")`

    Returns:
        Contacts with joint and link, and the external torque from which each joint shows one.

    Raises:
        ExperimentError: If no torques were logged, the base moves, or there is too little time without contact.
    """
    from forcetorque.collisions.collisions_by_joint_torques import find_joint_collisions
    from forcetorque.experiment.loading import Purpose
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.results.terminal.command_inputs import read_experiment

    if isinstance(experiment, Path | str):
        experiment = read_experiment(Path(experiment), _LOG, Purpose.MOTION)
    with stated_in(str(experiment.file)):
        return find_joint_collisions(experiment, intervals, free, alarms_per_hour)
