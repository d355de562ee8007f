# SPDX-License-Identifier: BSD-3-Clause
"""Joint torque control with estimated torques: the controller, and from which sensor error on its loop oscillates."""

from forcetorque.simulation.torque_loop.controller import TorqueController
from forcetorque.simulation.torque_loop.gains import TorqueGains
from forcetorque.simulation.torque_loop.plant import LinearPlant, held_joints, moving_joints
from forcetorque.simulation.torque_loop.stability import (
    Onset,
    Stability,
    TorqueLoop,
    delay_margin,
    error_in_torques,
    onset,
    stability,
)

__all__ = [
    "LinearPlant",
    "Onset",
    "Stability",
    "TorqueController",
    "TorqueGains",
    "TorqueLoop",
    "delay_margin",
    "error_in_torques",
    "held_joints",
    "moving_joints",
    "onset",
    "stability",
]
