# SPDX-License-Identifier: BSD-3-Clause
"""Motions of robots with exact derivatives: the data sets of in situ calibration, for any URDF robot."""

from forcetorque.simulation.motions.balancing import balancing_movement
from forcetorque.simulation.motions.carriage import Carriage
from forcetorque.simulation.motions.contact_switching import STILL_S, contact_switching_movement
from forcetorque.simulation.motions.grid import grid_movement
from forcetorque.simulation.motions.limb import Limb, limb_of
from forcetorque.simulation.motions.movement import Movement, MovementKind, Touch
from forcetorque.simulation.motions.on_both_feet import (
    INTERNAL_FORCE_N,
    squat_movement,
    standing_movement,
    stepping_movement,
    sway_movement,
)
from forcetorque.simulation.motions.phase import Phase, PhaseKind
from forcetorque.simulation.motions.random_smooth import random_movement, random_smooth_motion
from forcetorque.simulation.motions.stance import Stance, random_placement
from forcetorque.simulation.motions.stand import Stand
from forcetorque.simulation.motions.waypoints import Waypoints, shortest_moves
from forcetorque.simulation.motions.z_torque import z_torque_movement

__all__ = [
    "INTERNAL_FORCE_N",
    "STILL_S",
    "Carriage",
    "Limb",
    "Movement",
    "MovementKind",
    "Phase",
    "PhaseKind",
    "Stance",
    "Stand",
    "Touch",
    "Waypoints",
    "balancing_movement",
    "contact_switching_movement",
    "grid_movement",
    "limb_of",
    "random_movement",
    "random_placement",
    "random_smooth_motion",
    "shortest_moves",
    "squat_movement",
    "standing_movement",
    "stepping_movement",
    "sway_movement",
    "z_torque_movement",
]
