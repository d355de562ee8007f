# SPDX-License-Identifier: BSD-3-Clause
"""Z-torque: a limb goes between postures that put much moment about z on a sensor (thesis 5.1.3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.errors import RobotError, ShapeError
from forcetorque.robot import JointMotion, RootMotion, expected_wrenches
from forcetorque.simulation.motions.limb import limb_of
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.stand import Stand

_TZ = 5
"""Component of a wrench."""


def z_torque_movement(
    stand: Stand,
    sensor: str,
    *,
    rng: np.random.Generator,
    joints: Sequence[str] | None = None,
    postures: int = 12,
    candidates: int = 200,
    hold_s: float = 0.0,
    name: str | None = None,
) -> Movement:
    """Go between postures that twist a sensor about its z axis, one way and the other in turn.

    A heuristic: of as many random postures as there are candidates the one is taken whose weight
    twists most, for every posture anew, so that no two are alike.

    Args:
        stand: The robot on its support.
        sensor: Sensor of interest.
        rng: Source of the postures.
        joints: Joints that may move; those of the sensor's limb, on either side of it, if None.
        postures: How many postures, the rest at either end not counted.
        candidates: How many random postures each is chosen from.
        hold_s: How long to rest at each; s.
        name: Name of the movement.

    Returns:
        The movement, from rest to rest.

    Raises:
        RobotError: If the limb has no joints.
        ShapeError: If there are no postures or no candidates.
    """
    if postures < 1 or candidates < 1:
        raise ShapeError(f"expected at least one posture and candidate, got {postures} and {candidates}")
    limb = limb_of(stand, sensor)
    moving = (*limb.own, *limb.outboard) if joints is None else tuple(joints)
    if not moving:
        raise RobotError(
            f"z-torque of sensor {limb.sensor!r} from {stand.support!r}: its limb has no joints; name some"
        )
    low, high = np.array([stand.range_of(joint) for joint in moving]).T
    drawn = np.tile(stand.rest, (postures, candidates, 1))
    drawn[:, :, stand.columns(moving)] = rng.uniform(low, high, (postures, candidates, len(moving)))
    still = JointMotion.at_rest(stand.joints, drawn.reshape(-1, len(stand.joints)))
    root = RootMotion.fixed(stand.gravity_direction, gravity=stand.gravity)
    wrench = expected_wrenches(stand.tree, still, root, [limb.sensor])[limb.sensor]
    twist = wrench[:, _TZ].reshape(postures, candidates)
    twist[1::2] *= -1.0
    chosen = drawn[np.arange(postures), twist.argmax(axis=1)]
    trajectory = stand.through(np.vstack([stand.rest, chosen, stand.rest]), hold_s=hold_s)
    title = f"z-torque {limb.sensor}" if name is None else name
    return stand.movement(title, MovementKind.Z_TORQUE, trajectory, trajectory.duration_s)
