# SPDX-License-Identifier: BSD-3-Clause
"""Robots, motions and sensors with known truth, for users as much as for our tests."""

from forcetorque.simulation.motion import random_smooth_motion
from forcetorque.simulation.recording import ARM_URDF, simulate_recording
from forcetorque.simulation.sensor import SimulatedSensor, distorted_by_mounting, y_shaped_matrix

__all__ = [
    "ARM_URDF",
    "SimulatedSensor",
    "distorted_by_mounting",
    "random_smooth_motion",
    "simulate_recording",
    "y_shaped_matrix",
]
