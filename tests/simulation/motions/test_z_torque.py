# SPDX-License-Identifier: BSD-3-Clause
"""Z-torque motions twist the sensor far more than grids do."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import grid_movement, z_torque_movement
from tests.scenes.robots import PENDULUM_URDF, read_text
from tests.simulation.motions.stands import DOWN, ROBOTS, arm, on_foot, on_pole, times


@pytest.mark.parametrize(("sensor", "ratio"), [("l_leg_ft", 10.0), ("r_arm_ft", 5.0)])
@pytest.mark.parametrize("name", ROBOTS)
def test_the_twist_is_far_larger_than_in_a_grid(name: str, sensor: str, ratio: float) -> None:
    """The standard deviation of the moment about z is many times that of the grid, to both sides alike."""
    stand = on_pole(name)
    grid = grid_movement(stand, sensor, steps=5)
    twist = z_torque_movement(stand, sensor, rng=np.random.default_rng(1))
    in_grid, twisted = (m.readings(times(m, 300), [sensor]).of_name(sensor)[:, 5] for m in (grid, twist))
    assert twisted.std() > ratio * in_grid.std()
    assert twisted.max() > 0.25 * np.ptp(twisted)
    assert twisted.min() < -0.25 * np.ptp(twisted)


def test_the_way_of_the_twist_alternates() -> None:
    """At its postures the arm's sensor is twisted one way and the other in turn, far more than at rest."""
    movement = z_torque_movement(arm(), "arm_ft", rng=np.random.default_rng(2), postures=8, hold_s=0.1)
    twist = movement.readings(movement.trajectory.departures_s[1:]).of_name("arm_ft")[:, 5]
    assert len(twist) == 8
    assert (np.sign(twist) == [1, -1] * 4).all()
    assert np.abs(twist).min() > 1.0


def test_the_rest_of_the_robot_stays_still() -> None:
    """Only the sensor's limb moves, unless joints are named."""
    stand = on_pole("biped")
    for joints, expected in ((None, "l_"), (("waist_yaw", "l_elbow"), ("waist_yaw", "l_elbow"))):
        movement = z_torque_movement(stand, "l_arm_ft", rng=np.random.default_rng(3), joints=joints, postures=3)
        moved = np.ptp(movement.joints(times(movement)).position, axis=0) > 0
        names = [name for name, moves in zip(stand.joints, moved, strict=True) if moves]
        assert len(names) >= 2
        assert all(name.startswith(expected) for name in names)


def test_what_makes_no_sense_is_refused(tmp_path: Path) -> None:
    """A limb without joints, and no postures to choose from."""
    rng = np.random.default_rng(4)
    stiff = read_text(PENDULUM_URDF.replace('type="continuous"', 'type="fixed"'), tmp_path)
    with pytest.raises(RobotError, match="z-torque of sensor 'ft' from 'base': its limb has no joints"):
        z_torque_movement(Stand(model=stiff, support="base", gravity_direction=np.array(DOWN)), "ft", rng=rng)
    with pytest.raises(ShapeError, match="at least one posture and candidate, got 0 and 200"):
        z_torque_movement(arm(), "arm_ft", rng=rng, postures=0)
    with pytest.raises(RobotError, match="no free joint 'l_knie'"):
        z_torque_movement(on_foot("biped"), "l_leg_ft", rng=rng, joints=("l_knie",))
