# SPDX-License-Identifier: BSD-3-Clause
"""The files that a calibration can be written to for robots and other programs."""

from __future__ import annotations

from enum import StrEnum


class ExportFormat(StrEnum):
    """Form of the file that an export writes."""

    ICUB_MATRIX = "icub-matrix"
    WHOLEBODYDYNAMICS = "wholebodydynamics"
    CSV = "csv"
    COEFFICIENTS = "coefficients"
    ROS2 = "ros2"
    NUMPY = "numpy"

    @property
    def offset_handling(self) -> str:
        """What becomes of the offset, in words."""
        return _OFFSET_HANDLING[self]


_OFFSET_HANDLING = {
    ExportFormat.ICUB_MATRIX: "not stored, a matrix file has no place for it: add it to what the sensor sends",
    ExportFormat.WHOLEBODYDYNAMICS: "stored as FT_OFFSET, which the device ADDS, and only after the RPC command "
    "usePreEstimatedOffset",
    ExportFormat.CSV: "stored: add it to the product of matrix and raw reading",
    ExportFormat.COEFFICIENTS: "not stored, the file is for the variables: store it with the matrix",
    ExportFormat.ROS2: "stored: add it to the product of matrix and raw reading",
    ExportFormat.NUMPY: "stored: wrench = raw @ matrix.T + offset",
}
