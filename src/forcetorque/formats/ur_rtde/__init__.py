# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of the real-time data exchange (RTDE) of Universal Robots."""
