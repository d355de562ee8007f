# SPDX-License-Identifier: BSD-3-Clause
"""Calibration devices by computation."""
