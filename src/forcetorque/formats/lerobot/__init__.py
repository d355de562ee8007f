# SPDX-License-Identifier: BSD-3-Clause
"""Datasets of LeRobot, in which one episode is one recording."""
