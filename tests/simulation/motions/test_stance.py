# SPDX-License-Identifier: BSD-3-Clause
"""Legs find the feet, splines their targets; what is out of reach is refused."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.simulation.motions.inverse_kinematics import joints_reaching
from forcetorque.simulation.motions.on_both_feet import standing_movement, sway_movement
from forcetorque.simulation.motions.stance import Stance
from forcetorque.simulation.motions.trajectories import Spline
from tests.simulation.motions.stances import stance
from tests.simulation.motions.stands import ROBOTS, on_foot, on_pole

LOOKED_FOR = 1.002
"""The farthest and fastest are looked for every tenth of a second."""
OUT_OF_REACH = r"link 'l_sole' seen from 'pelvis': expected poses within the reach of l_hip_pitch, .* is missed by"


@pytest.mark.parametrize("name", ROBOTS)
def test_legs_reach_where_legs_have_been(name: str) -> None:
    """Poses of a foot at random positions of a bent leg are reached again, by the same positions."""
    standing = stance(name)
    joints = standing.legs.swing
    ranges = np.array([standing.stand.range_of(joint) for joint in joints])
    middle, half = ranges.mean(axis=1), 0.5 * np.ptp(ranges, axis=1)
    position = middle + np.random.default_rng(1).uniform(-0.25, 0.25, (50, 6)) * half
    wanted = link_pose(standing.tree, JointMotion.at_rest(joints, position), "r_sole")
    again = joints_reaching(standing.tree, joints, "r_sole", wanted, start=middle)
    np.testing.assert_allclose(again, position, rtol=0, atol=1e-6)  # 1e-9 m over the smallest singular value


def test_knees_bend_the_way_they_can() -> None:
    """At rest all joints of the legs are in their ranges, and the knees are bent."""
    for name in ROBOTS:
        movement = standing_movement(stance(name), rng=np.random.default_rng(1), duration_s=1.0)
        motion = movement.joints([0.0])
        for knee in ("l_knee", "r_knee"):
            assert -0.9 < motion.position[0, motion.names.index(knee)] < -0.4, name


def test_what_is_out_of_reach_is_refused() -> None:
    """Too far a sway, joints beyond their limits, a leg of another number of joints, straight legs and no time."""
    rng = np.random.default_rng(1)
    biped = stance("biped")
    with pytest.raises(RobotError, match=OUT_OF_REACH):
        sway_movement(biped, rng=rng, duration_s=4.0, reach_m=0.5)
    with pytest.raises(RobotError, match=r"movement 'sway': joint '._ankle_pitch': expected positions in its limits"):
        sway_movement(replace(biped, crouch_m=0.1), rng=rng, duration_s=4.0)
    with pytest.raises(RobotError, match=re.escape("leg from 'pelvis' to 'l_upper_arm': expected 6 joints")):
        Stance(stand=on_foot("biped"), other="l_upper_arm")
    with pytest.raises(ShapeError, match=r"crouch_m: expected a positive way in m, straight legs are rigid; got 0"):
        replace(biped, crouch_m=0.0)
    with pytest.raises(ShapeError, match=r"internal_force_N: expected a force of at least 0 N, got -1"):
        sway_movement(biped, rng=rng, duration_s=4.0, internal_force_N=-1.0)
    with pytest.raises(ShapeError, match=r"duration_s: expected a positive time in s, got 0"):
        sway_movement(biped, rng=rng, duration_s=0.0)
    with pytest.raises(RobotError, match="no link 'nothing'"):
        Stance(stand=on_pole("biped"), other="nothing")


def test_splines_stay_within_their_reach() -> None:
    """They use most of it, never leave it, are no faster than asked, and go through what they are given."""
    at = np.arange(0.0, 30.0, 0.01)
    curve = Spline.towards_targets(
        ("a", "b"), [0.5, 0.5], duration_s=30.0, period_s=2.0, rng=np.random.default_rng(3), speeds=[np.inf, 0.1]
    )
    motion = curve.motion(at)
    assert 0.45 < np.abs(motion.position[:, 0]).max() <= 0.5 * LOOKED_FOR
    assert 0.09 < np.abs(motion.velocity[:, 1]).max() <= 0.1 * LOOKED_FOR
    np.testing.assert_allclose(curve(curve.seconds), curve.values, rtol=0, atol=1e-12)
    with pytest.raises(ShapeError, match="expected at least 6 instants, got 3"):
        Spline(names=("a",), seconds=np.arange(3.0), values=np.zeros((3, 1)))
