# SPDX-License-Identifier: BSD-3-Clause
"""Hundreds of calibrations of one sensor: our time and accuracy beside plain NumPy, one file per part."""
