# SPDX-License-Identifier: BSD-3-Clause
"""What hangs on a sensor, or on the robot."""
