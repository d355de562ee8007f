# SPDX-License-Identifier: BSD-3-Clause
"""Sensors that were calibrated on a workbench."""
