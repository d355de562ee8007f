# SPDX-License-Identifier: BSD-3-Clause
"""Balancing loads one leg and moves the other."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.simulation.motions.held_robot import legs_of
from forcetorque.simulation.motions.joint_motions import balancing_movement, balancing_postures, weight_at_support
from tests.simulation.motions.stands import POLES, ROBOTS, arm, on_foot, on_pole, times


@pytest.mark.parametrize(("foot", "swing"), [("l", "r"), ("r", "l")])
@pytest.mark.parametrize("name", ROBOTS)
def test_the_standing_leg_carries_the_weight(name: str, foot: str, swing: str) -> None:
    """Its sensors bear most of the weight, those of the free leg only what hangs on them, and that leg is moved."""
    stand = on_foot(name, f"{foot}_sole")
    movement = balancing_movement(stand, f"{swing}_sole", rng=np.random.default_rng(1), candidates=10)
    at = times(movement)
    readings = movement.readings(at)
    weight = 9.80665 * sum(link.mass for link in stand.model.links.values())
    force = {name: np.linalg.norm(readings.of_name(name)[:, :3], axis=1) for name in readings.names}
    for sensor, part in (("leg_ft", 0.8), ("foot_ft", 0.9)):
        assert force[f"{foot}_{sensor}"].min() > part * weight - 10.0  # accelerations of some 0.3 m/s2
        assert force[f"{swing}_{sensor}"].max() < 0.25 * weight
    motion = movement.joints(at)
    legs = legs_of(stand, f"{swing}_sole")
    assert len(legs.swing) == len(legs.support) == 6
    for joints, least, most in ((legs.swing, 0.7, 1.0), (legs.support, 0.02, 0.25)):
        for joint in joints:
            low, high = stand.range_of(joint)
            used = np.ptp(motion.position[:, motion.names.index(joint)]) / (high - low)
            assert least < used <= most + 1e-9, joint
    assert np.ptp(motion.position[:, motion.names.index(f"{swing}_elbow")]) > 0.2


def test_postures_are_nearer_to_balance_than_at_random() -> None:
    """Out of fifty the weight is nearer to above the foot than out of one."""
    stand = on_foot("biped")
    distance = []
    for candidates in (1, 50):
        postures = balancing_postures(
            stand, "r_sole", rng=np.random.default_rng(2), trunk=None, postures=20, candidates=candidates
        )
        wrench = weight_at_support(stand, postures)
        distance.append((np.linalg.norm(wrench[:, 3:], axis=1) / np.linalg.norm(wrench[:, :3], axis=1)).mean())
    assert distance[1] < 0.6 * distance[0]


@pytest.mark.parametrize("name", ROBOTS)
def test_the_trunk_may_be_named(name: str) -> None:
    """The waist is found from the tree, and naming it changes nothing."""
    stand = on_foot(name)
    assert legs_of(stand, "r_sole") == legs_of(stand, "r_sole", trunk=POLES[name])
    assert set(legs_of(stand, "r_sole").support) == {joint for joint in stand.joints if joint in _LEFT_LEG}


_LEFT_LEG = {f"l_{joint}" for joint in ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")}


def test_robots_without_two_legs_are_refused() -> None:
    """The message names the feet and what their legs share."""
    rng = np.random.default_rng(3)
    with pytest.raises(RobotError, match="legs from 'base' to 'base' and 'hand': expected joints of their own, 'base'"):
        balancing_movement(arm(), "hand", rng=rng)
    with pytest.raises(RobotError, match="'l_foot'.*expected joints of their own"):
        balancing_movement(on_foot("biped"), "l_foot", rng=rng)
    with pytest.raises(RobotError, match="no link 'r_sol'; did you mean \"r_sole\""):
        balancing_movement(on_foot("biped"), "r_sol", rng=rng)
    with pytest.raises(RobotError, match="expected joints of their own"):
        balancing_movement(on_pole("biped"), "l_sole", rng=rng)
    with pytest.raises(ShapeError, match="at least one posture and candidate, got 12 and 0"):
        balancing_movement(on_foot("biped"), "r_sole", rng=rng, candidates=0)
