# SPDX-License-Identifier: BSD-3-Clause
"""The groups with which YARP's device wholebodydynamics corrects force-torque sensors."""
