# SPDX-License-Identifier: BSD-3-Clause
"""Plausibility checks, the generative fit of one sensor, the joint fit of all, the fits of the thesis, export."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.calibration.calibrate import calibrate_for_file, calibrate_sensor
    from forcetorque.calibration.export.export import (
        export_coefficients,
        export_icub_matrix,
        export_numpy,
        export_ros2_parameters,
        export_table,
        export_wholebodydynamics,
    )
    from forcetorque.calibration.joint.calibrate import calibrate_jointly
    from forcetorque.calibration.moments import recording_moments, store_moments
    from forcetorque.calibration.summary import information_figure

CAPABILITY = Capability(
    page="calibration/calibration.md",
    needs=(
        "inspection",
        "payload",
    ),
    commands=(
        "forcetorque.calibration.calibrate_command:calibrate",
        "forcetorque.calibration.export.command:export",
    ),
)

__all__ = [
    "calibrate_for_file",
    "calibrate_jointly",
    "calibrate_sensor",
    "export_coefficients",
    "export_icub_matrix",
    "export_numpy",
    "export_ros2_parameters",
    "export_table",
    "export_wholebodydynamics",
    "information_figure",
    "recording_moments",
    "store_moments",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "calibrate_for_file": "forcetorque.calibration.calibrate",
        "calibrate_jointly": "forcetorque.calibration.joint.calibrate",
        "calibrate_sensor": "forcetorque.calibration.calibrate",
        "export_coefficients": "forcetorque.calibration.export.export",
        "export_icub_matrix": "forcetorque.calibration.export.export",
        "export_numpy": "forcetorque.calibration.export.export",
        "export_ros2_parameters": "forcetorque.calibration.export.export",
        "export_table": "forcetorque.calibration.export.export",
        "export_wholebodydynamics": "forcetorque.calibration.export.export",
        "information_figure": "forcetorque.calibration.summary",
        "recording_moments": "forcetorque.calibration.moments",
        "store_moments": "forcetorque.calibration.moments",
    },
)
