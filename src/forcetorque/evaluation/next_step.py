# SPDX-License-Identifier: BSD-3-Clause
"""What follows an evaluation: calibrate, evaluate or export, in words and as a command."""

from __future__ import annotations

from forcetorque.results.answer import EXPERIMENT, typed


def to_plan(calibration: str) -> str:
    """Give the command that says what to record next.

    Args:
        calibration: File of the calibration.

    Returns:
        The command, with a distance from joint limits, which it needs.
    """
    return typed("plan", EXPERIMENT, "-c", calibration, "--clearance-deg", "10")


def to_calibrate(sensor: str) -> tuple[str, str]:
    """Give the step that follows where there is no calibration.

    Args:
        sensor: Name of the sensor.

    Returns:
        The step and its command.
    """
    return "calibrate the sensor", typed("calibrate", EXPERIMENT, "--sensor", sensor, "-o", f"{sensor}.json")


def to_evaluate(calibration: str) -> tuple[str, str]:
    """Give the step that follows where a calibration has no verdict yet.

    Args:
        calibration: Its file.

    Returns:
        The step and its command.
    """
    return "evaluate its errors at the loads to come", typed("evaluate", EXPERIMENT, "-c", calibration)


def to_export(calibration: str, sensor: str) -> tuple[str, str]:
    """Give the step that follows where a calibration may be used.

    Args:
        calibration: Its file.
        sensor: Name of the sensor.

    Returns:
        The step and its command.
    """
    return "export the matrix to the robot", typed("export", calibration, "--to", "csv", "-o", f"{sensor}.csv")
