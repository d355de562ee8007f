# SPDX-License-Identifier: BSD-3-Clause
"""Sensors where nothing touches: validated by the contact force that they report, and by joint torques."""
