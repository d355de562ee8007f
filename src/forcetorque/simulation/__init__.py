# SPDX-License-Identifier: BSD-3-Clause
"""Robots, motions and sensors with known truth, for users as much as for our tests."""

from forcetorque.simulation.board import calibrated_by_board
from forcetorque.simulation.motion import random_smooth_motion
from forcetorque.simulation.network import (
    fail_groups,
    jitter_stamps,
    lose_messages,
    offset_clocks,
    repeat_stamps,
    step_back,
)
from forcetorque.simulation.recording import ARM_URDF, simulate_recording
from forcetorque.simulation.sensor import SimulatedSensor, distorted_by_mounting, y_shaped_matrix

__all__ = [
    "ARM_URDF",
    "SimulatedSensor",
    "calibrated_by_board",
    "distorted_by_mounting",
    "fail_groups",
    "jitter_stamps",
    "lose_messages",
    "offset_clocks",
    "random_smooth_motion",
    "repeat_stamps",
    "simulate_recording",
    "step_back",
    "y_shaped_matrix",
]
