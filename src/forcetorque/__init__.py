# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate force-torque sensors where they are mounted, and say how far to trust them."""
