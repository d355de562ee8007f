# SPDX-License-Identifier: BSD-3-Clause
"""Robots on poles and on feet, and what holds for every movement of theirs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.movement import Movement
from forcetorque.simulation.robots import ARM_URDF, BIPED_URDF
from tests.scenes.robots import icub

ROBOTS: Mapping[str, Callable[[], Path]] = MappingProxyType(
    {
        "biped": lambda: BIPED_URDF,
        "iCubGazeboV2_7": lambda: icub("iCubGazeboV2_7"),
        "iCubGenova02": lambda: icub("iCubGenova02"),
    }
)
"""Robots with two legs; all have their soles and sensors under the same names."""

POLES = MappingProxyType({"biped": "pelvis", "iCubGazeboV2_7": "root_link", "iCubGenova02": "root_link"})
"""Link at the waist."""

DOWN = (0.0, 0.0, -1.0)


@cache
def robot(name: str) -> RobotModel:
    """A robot by name, read once."""
    return read_urdf(ARM_URDF if name == "arm" else ROBOTS[name]())


def on_pole(name: str, *, speed: float = 0.5) -> Stand:
    """A robot fixed at its waist, upright."""
    return Stand(model=robot(name), support=POLES[name], gravity_direction=np.array(DOWN), speed=speed)


def on_foot(name: str, foot: str = "l_sole", *, speed: float = 0.5) -> Stand:
    """A robot on the level sole of a foot."""
    return Stand(model=robot(name), support=foot, gravity_direction=np.array(DOWN), speed=speed)


def arm() -> Stand:
    """The small arm on its base."""
    return Stand(model=robot("arm"), support="base", gravity_direction=np.array(DOWN))


def times(movement: Movement, count: int = 200) -> FloatArray:
    """Instants over all of a movement."""
    return np.linspace(0.0, movement.duration_s, count)


def require_exact_derivatives(motion: Callable[[FloatArray], JointMotion], at: FloatArray) -> None:
    """Velocity and acceleration are the slopes of position and velocity."""
    # Rounding of positions up to 3 leaves 1e-15 / step in a slope; where a move starts, the slope of the
    # velocity errs by step / 2 times the jump of the jerk, at most 9 v^3 / d^2, some 500 for 0.5 rad/s over 0.05 rad.
    step = 1e-6
    before, here, after = (motion(at + shift) for shift in (-step, 0.0, step))
    speed, gain = (
        (b - a) / (2 * step) for a, b in ((before.position, after.position), (before.velocity, after.velocity))
    )
    np.testing.assert_allclose(speed, here.velocity, rtol=0, atol=2e-9)
    np.testing.assert_allclose(gain, here.acceleration, rtol=0, atol=1e-3)
    assert np.abs(here.velocity).max() > 0.05
    assert np.abs(here.acceleration).max() > 0.05


def require_inside_limits(stand: Stand, motion: JointMotion) -> None:
    """No joint comes nearer to its URDF limits than the margin, or moves faster than it may."""
    assert motion.names
    for k, name in enumerate(motion.names):
        limit = stand.model.joints[name].limit
        assert limit is not None
        assert limit.lower is not None
        assert limit.upper is not None
        spare = stand.margin * (limit.upper - limit.lower) * (1.0 - 1e-9)  # rounding
        assert motion.position[:, k].min() >= limit.lower + spare, name
        assert motion.position[:, k].max() <= limit.upper - spare, name
        fastest = min(stand.speed, limit.velocity or np.inf)
        assert np.abs(motion.velocity[:, k]).max() <= fastest * (1.0 + 1e-9), name
