# SPDX-License-Identifier: BSD-3-Clause
"""The motors of an experiment: matched to joints of the robot and to columns of the recording."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.estimation.section import MotorTable
from forcetorque.experiment.input_files import stated_in
from forcetorque.recording.recording import Recording
from forcetorque.robot.model import RobotModel


def require_motors(
    motors: Sequence[MotorTable], file: Path, model: RobotModel, recording: Recording
) -> tuple[MotorTable, ...]:
    """Check that the motors are of joints that the robot has, and that the recording holds what they tell.

    Args:
        motors: Motors as the file states them.
        file: The experiment file, for messages.
        model: The robot.
        recording: The streams.

    Returns:
        The same.

    Raises:
        ExperimentError: If a joint is unknown, comes twice, is not in the recording, or motors differ in what they
        tell.
    """
    for index, motor in enumerate(motors):
        where = f"{file}: motor[{index}]"
        if motor.joint not in model.joints:
            raise ExperimentError(
                f"{where}: robot {model.name!r} has no joint {motor.joint!r}; {known_names(motor.joint, model.joints)}"
            )
        if motor.joint in [earlier.joint for earlier in motors[:index]]:
            raise ExperimentError(f"{where}: the joint {motor.joint!r} is listed twice; keep one motor")
        if motor.quantity != motors[0].quantity:
            raise ExperimentError(
                f"{where}: expected the quantity {motors[0].quantity}, as of the motors before, got {motor.quantity}; "
                "motors are one source"
            )
        with stated_in(where):
            signals = recording.joint_signals(motor.quantity)
        if motor.joint not in signals:
            raise ExperimentError(
                f"{where}: no stream holds {motor.quantity} of joint {motor.joint!r}; "
                f"{known_names(motor.joint, signals)}"
            )
    return tuple(motors)
