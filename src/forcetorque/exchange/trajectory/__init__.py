# SPDX-License-Identifier: BSD-3-Clause
"""Joint trajectories as the players of robots take them."""

from forcetorque.exchange.trajectory.ros import ros_trajectory
from forcetorque.exchange.trajectory.table import TIME_COLUMN, trajectory_table
from forcetorque.exchange.trajectory.writing import write_trajectory
from forcetorque.exchange.trajectory.yarp import PORT, write_yarp_positions

__all__ = ["PORT", "TIME_COLUMN", "ros_trajectory", "trajectory_table", "write_trajectory", "write_yarp_positions"]
