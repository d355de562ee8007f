# SPDX-License-Identifier: BSD-3-Clause
"""The groups with which YARP's device wholebodydynamics corrects force-torque sensors that are already calibrated."""

from forcetorque.exchange.wholebodydynamics.correction import SensorCorrection, corrected, from_calibration
from forcetorque.exchange.wholebodydynamics.reading import read_groups
from forcetorque.exchange.wholebodydynamics.writing import write_groups

__all__ = ["SensorCorrection", "corrected", "from_calibration", "read_groups", "write_groups"]
