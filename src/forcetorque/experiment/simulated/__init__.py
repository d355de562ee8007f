# SPDX-License-Identifier: BSD-3-Clause
"""Simulated recordings as experiment files with what is true of their sensors."""
