# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of ros2_control: the broadcaster of a sensor, and the filter that takes off the weight of a tool [1, 2].

The broadcaster publishes `(reading + offset) * multiplier`, axis by axis. The filter takes `mass * gravity_field`,
turned into the sensor's frame, and its moment about the origin off what it is given.

References:
    [1] ros2_controllers, force_torque_sensor_broadcaster.
    [2] control_toolbox, control_filters/GravityCompensationWrench.
"""

from __future__ import annotations

from forcetorque.base.errors import FormatError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.payload.robot_files.plain_yaml import number, numbers, word
from forcetorque.payload.robot_files.robot_load import RobotLoad

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
