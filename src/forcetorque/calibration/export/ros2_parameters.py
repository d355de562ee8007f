# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations as parameters of a ROS 2 node: matrix row by row, offset, frame, and the formula in comments."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping

from forcetorque.base.errors import FormatError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.calibration.calibration_file import Calibration

_NAME = re.compile("[A-Za-z][A-Za-z0-9_]*")


def ros2_parameters(calibrations: Mapping[str, Calibration], frame_ids: Mapping[str, str]) -> str:
    """Write calibrations as a file of parameters for any node (`--params-file`).

    Args:
        calibrations: Linear calibrations by the name that their sensor has in the file.
        frame_ids: Frame of tf that the wrench is expressed in, by the same names.

    Returns:
        Text of the file, YAML.

    Raises:
        FormatError: If a name cannot be that of a parameter.
    """
    lines = [
        "# Calibrations of force-torque sensors, written by forcetorque.",
        "# wrench[i] = sum over j of matrix[i * channels + j] * raw[j] + offset[i]; i = 0 to 5: force xyz, torque xyz",
        "#   + coefficients[i] * (value - reference_value) for every variable",
        "# matrix: N, then N m, per raw_unit; offset, which is ADDED: N, then N m",
        "# The wrench is in the axes of frame_id and about its origin. measure_direction child_to_parent: what the",
        "# outboard part does to the inboard part; parent_to_child: the opposite.",
        "/**:",
        "  ros__parameters:",
    ]
    for name, calibration in calibrations.items():
        lines += _sensor(name, calibration, frame_ids[name])
    return "\n".join(lines) + "\n"


def _sensor(name: str, calibration: Calibration, frame_id: str) -> list[str]:
    for text in (name, *(variable.name for variable in calibration.variables)):
        if not _NAME.fullmatch(text):
            raise FormatError(
                f"expected a name of letters, digits and _ for a parameter of ROS 2, got {text!r}; name the sensor by "
                "--sensor-name, from Python sensor_name"
            )
    sensor, channels = calibration.sensor, calibration.matrix.shape[1]
    lines = [
        f"    {name}:",
        f"      serial: {json.dumps(sensor.serial)}",
        f"      frame_id: {json.dumps(frame_id)}",
        f"      measure_direction: {json.dumps(sensor.measure_direction.value)}",
        f"      channels: {channels}",
        f"      raw_unit: {json.dumps(raw_unit(calibration))}",
        f"      matrix: [  # row-major, 6 x {channels}",
    ]
    for k, (component, row) in enumerate(zip(WRENCH_COMPONENTS, calibration.matrix.tolist(), strict=True)):
        end = "," if k < len(WRENCH_COMPONENTS) - 1 else "]"
        lines.append(f"        {_doubles(row)}{end}  # {component}")
    lines.append(f"      offset: [{_doubles(calibration.offset.tolist())}]  # N, N m")
    if calibration.variables:
        lines.append("      variables:")
    for variable in calibration.variables:
        lines += [
            f"        {variable.name}:",
            f"          unit: {json.dumps(variable.unit)}",
            f"          reference_value: {_double(variable.reference_value)}",
            f"          coefficients: [{_doubles(variable.coefficients.tolist())}]  # N, N m per unit",
        ]
    return lines


def raw_unit(calibration: Calibration) -> str:
    """Give the unit of the raw samples that a calibration takes.

    Returns:
        `count`, or `N, N m` where it corrects a calibrated stream.
    """
    return "N, N m" if calibration.prior is not None and calibration.prior.source == "identity" else "count"


def _doubles(values: Iterable[float]) -> str:
    return ", ".join(map(_double, values))


def _double(value: float) -> str:
    """The shortest text that reads back, with the point that YAML 1.1 and ROS 2 need to see a double."""
    text = repr(float(value))
    mantissa, exponent, power = text.partition("e")
    return text if "." in mantissa else f"{mantissa}.0{exponent}{power}"
