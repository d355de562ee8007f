# SPDX-License-Identifier: BSD-3-Clause
"""Robots, motions and sensors with known truth, for users as much as for our tests."""

from forcetorque.simulation.board import calibrated_by_board
from forcetorque.simulation.family import FAMILIES, SensorFamily
from forcetorque.simulation.imu import SimulatedImu
from forcetorque.simulation.load import with_load
from forcetorque.simulation.motions import (
    Movement,
    MovementKind,
    Phase,
    PhaseKind,
    Stance,
    Stand,
    Touch,
    Waypoints,
    balancing_movement,
    contact_switching_movement,
    grid_movement,
    random_movement,
    random_placement,
    random_smooth_motion,
    squat_movement,
    standing_movement,
    stepping_movement,
    sway_movement,
    z_torque_movement,
)
from forcetorque.simulation.motor import SimulatedMotor
from forcetorque.simulation.network import (
    fail_groups,
    jitter_stamps,
    lose_messages,
    offset_clocks,
    repeat_stamps,
    step_back,
)
from forcetorque.simulation.recording import record, simulate_recording
from forcetorque.simulation.robot_errors import RobotErrors
from forcetorque.simulation.robots import ARM_URDF, BIPED_URDF
from forcetorque.simulation.sensor import SimulatedSensor, distorted_by_mounting, y_shaped_matrix
from forcetorque.simulation.trace import Trace, trace_movement

__all__ = [
    "ARM_URDF",
    "BIPED_URDF",
    "FAMILIES",
    "Movement",
    "MovementKind",
    "Phase",
    "PhaseKind",
    "RobotErrors",
    "SensorFamily",
    "SimulatedImu",
    "SimulatedMotor",
    "SimulatedSensor",
    "Stance",
    "Stand",
    "Touch",
    "Trace",
    "Waypoints",
    "balancing_movement",
    "calibrated_by_board",
    "contact_switching_movement",
    "distorted_by_mounting",
    "fail_groups",
    "grid_movement",
    "jitter_stamps",
    "lose_messages",
    "offset_clocks",
    "random_movement",
    "random_placement",
    "random_smooth_motion",
    "record",
    "repeat_stamps",
    "simulate_recording",
    "squat_movement",
    "standing_movement",
    "step_back",
    "stepping_movement",
    "sway_movement",
    "trace_movement",
    "with_load",
    "y_shaped_matrix",
    "z_torque_movement",
]
