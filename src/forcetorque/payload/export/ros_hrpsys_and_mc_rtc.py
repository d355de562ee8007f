# SPDX-License-Identifier: BSD-3-Clause
"""Load parameters of ROS: ros2_control [1, 2], ft_tools_ros2 [3], force_torque_tools of KTH [4]; of hrpsys and mc_rtc.

ros2_control: the broadcaster publishes `(reading + offset) * multiplier`, axis by axis. The gravity filter subtracts
`mass * gravity_field`, turned into the sensor's frame, and its moment about the origin.

ft_tools_ros2: `reading = mass [g; c x g] + offset`, g pointing down. Its comments write the model with minus signs,
its code has none: g is signed, [0, 0, -9.81] in the base of the robot.

force_torque_tools: `reading = mass [a; c x a] + bias`, a what an IMU at rest reads: up.

hrpsys [5]: a line per sensor with its name, offsets of force and moment, centre of mass, and mass. The program
subtracts the offsets, and the weight along -z of the world.

mc_rtc [6], `calib_data.<sensor>`: thirteen numbers, one on a line: mass, roll, pitch and yaw by which the sensor is
turned against its model, centre of mass in the frame of the parent body, and the measurement without load in the order
of SpaceVecAlg: couple, then force. The program subtracts that, with the weight along -z of the world.

References:
[1] ros2_controllers, force_torque_sensor_broadcaster.
[2] control_toolbox, control_filters/GravityCompensationWrench.
[3] T. Poignonec, ft_tools_ros2, ft_tools/src/ft_calibration.cpp and ft_estimation.cpp.
[4] F. Vina, force_torque_tools, force_torque_sensor_calib/src/ft_calib.cpp and gravity_compensation.
[5] hrpsys-base, rtc/RemoveForceSensorLinkOffset/RemoveForceSensorLinkOffset.cpp.
[6] mc_rtc, mc_rbdyn/ForceSensor.cpp; mc_force_sensor_calibration_controller, RunCalibrationScript.cpp.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import read_text
from forcetorque.base.units import DECIMAL_NUMBER, STANDARD_GRAVITY
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.export.load_parameters import RobotLoad, number, numbers, word

CONTROLLER = "force_torque_sensor_broadcaster"
"""Name of the controller, as its examples have it; it is free."""


def broadcaster_text(load: RobotLoad) -> str:
    """Write the parameters of the broadcaster: without load the published wrench is then zero.

    Args:
        load: Sensor and bias; its matrix is diagonal.

    Returns:
        YAML.
    """
    factors = load.multiplier(where="ros2-broadcaster")
    # matrix reading - bias = matrix (reading - matrix^-1 bias)
    offset = -load.bias / factors
    lines = [
        f"{CONTROLLER}:",
        "  ros__parameters:",
        "    type: force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
        f"    frame_id: {word(load.frame)}",
        f"    sensor_name: {word(load.sensor)}",
        "    # published: (reading + offset) * multiplier",
    ]
    for name, values in (("offset", offset), ("multiplier", factors)):
        lines.append(f"    {name}:")
        for part, three in (("force", values[:3]), ("torque", values[3:])):
            axes = ", ".join(f"{axis}: {number(value)}" for axis, value in zip("xyz", three, strict=True))
            lines.append(f"      {part}: {{{axes}}}")
    return "\n".join(lines) + "\n"


def gravity_filter_text(load: RobotLoad, *, world_frame: str | None) -> str:
    """Write the parameters of the filter, for the chain of a broadcaster.

    Args:
        load: The load; the field points down where the sensor reads its weight, and up where it reads what holds it.
        world_frame: Frame of tf whose z axis points up.

    Returns:
        YAML.

    Raises:
        FormatError: If no frame is given.
    """
    if not world_frame:
        raise FormatError("gravity-filter: expected --world-frame, the frame of tf whose z axis points up, got none")
    field = (0.0, 0.0, -load.weight_sign * STANDARD_GRAVITY)
    return "\n".join(
        [
            "sensor_filter_chain:",
            "  filter1:",
            "    name: gravity_compensation",
            "    type: control_filters/GravityCompensationWrench",
            "    params:",
            f"      world_frame: {word(world_frame)}",
            f"      sensor_frame: {word(load.frame)}",
            "      tool:",
            f"        mass: {number(load.mass)}",
            f"        CoG: {numbers(load.centre_of_mass)}",
            f"        gravity_field: {numbers(field)}",
            "",
        ]
    )


_FILTER = ("mass", "CoG", "gravity_field")


def read_gravity_filter(path: Path | str) -> tuple[float, FloatArray, FloatArray, str]:
    """Read the tool of a filter of a chain, in the style in which it is written here.

    Args:
        path: The file.

    Returns:
        Mass, kg; centre of mass in the sensor's frame, shape (3,), m; field along the axes of the world, (3,), m/s2;
        name of the sensor's frame.

    Raises:
        FormatError: If it is no chain with one such filter.
    """
    text = read_text(Path(path), "parameters of a gravity filter")
    if text.count("control_filters/GravityCompensationWrench") != 1:
        raise FormatError(f"{path}: expected one control_filters/GravityCompensationWrench")
    values: list[list[float]] = []
    for key, count in zip(_FILTER, (1, 3, 3), strict=True):
        entries = re.findall(rf"^\s+{key}:\s+\[?(.*?)\]?\s*$", text, re.MULTILINE)
        words = [word.strip() for word in entries[0].split(",")] if len(entries) == 1 else []
        if len(words) != count or not all(map(DECIMAL_NUMBER.fullmatch, words)):
            raise FormatError(f"{path}: {key}: expected it once, with {count} number(s), got {entries}")
        values.append([float(word) for word in words])
    (mass,), centre, field = values
    if mass < 0.0:
        raise FormatError(f"{path}: {_FILTER[0]}: expected a mass of at least 0 kg, got {mass:g}")
    frames = re.findall(r"^\s+sensor_frame:\s+[\"']?(.+?)[\"']?\s*$", text, re.MULTILINE)
    if len(frames) != 1:
        raise FormatError(f"{path}: sensor_frame: expected the name of a frame, once, got {frames}")
    return mass, np.array(centre), np.array(field), frames[0]


FT_TOOLS_DIRECTION = MeasureDirection.CHILD_TO_PARENT
"""Who acts on whom in its readings."""

_FT_TOOLS_KEYS = ("mass", "sensor_frame_to_com", "force_offset", "torque_offset")


def ft_tools_text(load: RobotLoad) -> str:
    """Write the parameters.

    Returns:
        YAML.
    """
    load.require_direction(FT_TOOLS_DIRECTION, where="ft-tools")
    vectors = zip(_FT_TOOLS_KEYS[1:], (load.centre_of_mass, load.bias[:3], load.bias[3:]), strict=True)
    return "\n".join([f"mass: {number(load.mass)}", *(f"{key}: {numbers(values)}" for key, values in vectors), ""])


FORCE_TORQUE_TOOLS_DIRECTION = MeasureDirection.PARENT_TO_CHILD
"""Who acts on whom in its readings."""

_FORCE_TORQUE_TOOLS_KEYS = ("bias", "gripper_com_frame_id", "gripper_com_pose", "gripper_mass")


def force_torque_tools_text(load: RobotLoad) -> str:
    """Write the parameters.

    Returns:
        YAML.
    """
    load.require_direction(FORCE_TORQUE_TOOLS_DIRECTION, where="force-torque-tools")
    values = (
        numbers(load.bias),
        word(load.frame),
        numbers([*load.centre_of_mass, 0.0, 0.0, 0.0]),
        number(load.mass),
    )
    return "\n".join([*(f"{key}: {value}" for key, value in zip(_FORCE_TORQUE_TOOLS_KEYS, values, strict=True)), ""])


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
