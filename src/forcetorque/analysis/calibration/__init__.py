# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate a sensor, and say what makes the calibration doubtful."""
