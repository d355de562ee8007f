# SPDX-License-Identifier: BSD-3-Clause
"""Sensors and methods through one motion."""
