# SPDX-License-Identifier: BSD-3-Clause
"""Robots on both feet, and their movements."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from types import MappingProxyType

import numpy as np

from forcetorque.robot.model import RobotModel
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.movement import Movement
from forcetorque.simulation.motions.on_both_feet import (
    squat_movement,
    standing_movement,
    stepping_movement,
    sway_movement,
)
from forcetorque.simulation.motions.stance import Stance, random_placement
from tests.simulation.motions.stands import DOWN, robot

DURATION_S = 10.0

MOVEMENTS: Mapping[str, Callable[..., Movement]] = MappingProxyType(
    {
        "standing": standing_movement,
        "sway": sway_movement,
        "squat": squat_movement,
        "stepping": stepping_movement,
    }
)

IMU_LINKS = MappingProxyType({"biped": "imu", "iCubGazeboV2_7": "chest", "iCubGenova02": "chest"})
"""Link in the chest; joints of the waist are between it and the trunk."""


def stance(name: str, *, seed: int | None = None, model: RobotModel | None = None) -> Stance:
    """A robot on both feet, which stand anywhere with a seed."""
    stand = Stand(model=robot(name) if model is None else model, support="l_sole", gravity_direction=np.array(DOWN))
    placement = np.zeros((2, 3)) if seed is None else random_placement(np.random.default_rng(seed))
    return Stance(stand=stand, other="r_sole", placement=placement)


@cache
def on_both_feet(name: str, kind: str, *, seed: int = 1, internal_force_N: float = 15.0) -> Movement:
    """A movement of some seconds on both feet, made once."""
    move = MOVEMENTS[kind]
    rng = np.random.default_rng(seed)
    return move(stance(name, seed=seed), rng=rng, duration_s=DURATION_S, internal_force_N=internal_force_N)
