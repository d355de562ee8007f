# SPDX-License-Identifier: BSD-3-Clause
"""Logs of robometry: YarpRobotLoggerDevice and telemetryDeviceDumper."""

from forcetorque.exchange.robometry.log_format import RobometryFormat
from forcetorque.exchange.robometry.log_table import RobometryLog

__all__ = ["RobometryFormat", "RobometryLog"]
