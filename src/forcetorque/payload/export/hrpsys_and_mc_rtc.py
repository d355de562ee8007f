# SPDX-License-Identifier: BSD-3-Clause
"""Offset files of hrpsys [1] and calibration files `calib_data.<sensor>` of mc_rtc [2].

hrpsys: a line per sensor with its name, offsets of force and moment, centre of mass, and mass. The program subtracts
the offsets, and the weight along -z of the world.

mc_rtc: thirteen numbers, one on a line: mass, roll, pitch and yaw by which the sensor is turned against its model,
centre of mass in the frame of the parent body, and the measurement without load in the order of SpaceVecAlg: couple,
then force. The program subtracts that, with the weight along -z of the world.

References:
[1] hrpsys-base, rtc/RemoveForceSensorLinkOffset/RemoveForceSensorLinkOffset.cpp.
[2] mc_rtc, mc_rbdyn/ForceSensor.cpp; mc_force_sensor_calibration_controller, RunCalibrationScript.cpp.
"""

from __future__ import annotations

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.export.load_parameters import RobotLoad
from forcetorque.payload.export.yaml_parameters import number

HRPSYS_DIRECTION = MeasureDirection.CHILD_TO_PARENT
"""Who acts on whom in its readings."""


def hrpsys_text(load: RobotLoad) -> str:
    """Write the line of a sensor.

    Args:
        load: The load; the name of its sensor has no blanks.

    Returns:
        The line.

    Raises:
        FormatError: If the name has blanks.
    """
    load.require_direction(HRPSYS_DIRECTION, where="hrpsys")
    if len(load.sensor.split()) != 1:
        raise FormatError(f"hrpsys: expected a name of a sensor without blanks, got {load.sensor!r}; rename it")
    values = [*load.bias, *load.centre_of_mass, load.mass]
    return " ".join([load.sensor, *(number(float(value)) for value in values)]) + "\n"


MC_RTC_DIRECTION = MeasureDirection.CHILD_TO_PARENT
"""Who acts on whom in its readings."""


def mc_rtc_text(load: RobotLoad, *, body_H_sensor: FloatArray | None) -> str:
    """Write the thirteen numbers.

    Args:
        load: The load.
        body_H_sensor: Pose of the sensor in its parent body; shape (4, 4); m.

    Returns:
        The file; the last number ends in a newline too, or mc_rtc refuses it.

    Raises:
        FormatError: If no pose is given.
    """
    load.require_direction(MC_RTC_DIRECTION, where="mc-rtc")
    if body_H_sensor is None:
        raise FormatError(
            "mc-rtc: expected --sensor-pose, that of the sensor in its parent body, since the file has the centre of "
            "mass there, got none; 0 0 0 0 0 0 where they are one"
        )
    centre = body_H_sensor[:3, :3] @ load.centre_of_mass + body_H_sensor[:3, 3]
    values = [load.mass, 0.0, 0.0, 0.0, *centre, *load.bias[3:], *load.bias[:3]]
    return "".join(f"{number(float(value))}\n" for value in values)
