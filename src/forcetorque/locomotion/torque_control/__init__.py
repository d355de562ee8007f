# SPDX-License-Identifier: BSD-3-Clause
"""What errors of sensors do to a robot that controls its joint torques by them (thesis 5.6)."""
