# SPDX-License-Identifier: BSD-3-Clause
"""The robot of an experiment: URDF with fixed joints, declared sensors and corrections, and how far it may be off."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.experiment import file as schema
from forcetorque.experiment.calibration.model_error import EXACT, ModelTolerance
from forcetorque.experiment.calibration.robot_correction import read_model_errors, robot_errors
from forcetorque.experiment.core_tables import Sensor
from forcetorque.experiment.input_files import Inputs, stated_in
from forcetorque.experiment.sensors import declare_sensors
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import fix_joints
from forcetorque.robot.urdf import read_urdf


def read_robot(
    table: schema.Robot, sensors: Sequence[Sensor], file: Path, inputs: Inputs
) -> tuple[RobotModel, ModelTolerance]:
    """Read the robot of an experiment.

    Args:
        table: What the file says of it.
        sensors: Sensors of the file.
        file: The file, for messages.
        inputs: Resolves and remembers the files.

    Returns:
        The robot, corrected where the file names what a calibration found of it, and how far it may be off.

    Raises:
        ExperimentError: If the tolerance names links or joints that the robot does not have.
        RobotError: If the correction is of another robot.
    """
    given = inputs.in_memory.robot
    if given is None:
        with stated_in(f"{file}: [robot] urdf"):
            urdf = inputs.robot(table.urdf)
        model = read_urdf(urdf)
    else:
        model = given
    with stated_in(f"{file}: robot: fixed"):
        model = fix_joints(model, table.fixed)
    model = declare_sensors(sensors, file, model)
    tolerance = table.tolerance
    if tolerance == "exact":
        return model, EXACT
    for key, named, known in (
        ("links", tolerance.links, model.links),
        ("joints", tolerance.joints, model.joints),
        ("sensors", tolerance.sensors, model.sensors),
    ):
        for name in named:
            if name not in known:
                raise ExperimentError(
                    f"{file}: [robot] tolerance.{key}: expected {key} of robot {model.name!r}, got {name!r}; "
                    f"{known_names(name, known)}"
                )
    if tolerance.found_by is None:
        return model, tolerance.model_tolerance({})
    with stated_in(f"{file}: [robot] tolerance.from"):
        errors = read_model_errors(inputs.file(tolerance.found_by))
        corrected = robot_errors(model, errors).applied_to(model)
    return corrected, tolerance.model_tolerance({error.name: error.standard_error for error in errors})
