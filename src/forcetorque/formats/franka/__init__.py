# SPDX-License-Identifier: BSD-3-Clause
"""Logs of robot states of Franka arms."""
