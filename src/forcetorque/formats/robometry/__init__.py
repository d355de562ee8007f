# SPDX-License-Identifier: BSD-3-Clause
"""Logs of robometry: YarpRobotLoggerDevice and telemetryDeviceDumper."""
