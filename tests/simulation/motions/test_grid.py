# SPDX-License-Identifier: BSD-3-Clause
"""Grids keep the limb stiff and spread the force."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.base.pose import invert_pose
from forcetorque.simulation.motions.held_robot import Stand, limb_of
from forcetorque.simulation.motions.joint_motions import grid_movement, random_movement
from forcetorque.simulation.motions.movement import Movement
from tests.robot.kinematics import links_below
from tests.simulation.motions.stands import ROBOTS, arm, on_foot, on_pole, robot, times


def _centre_of_mass(movement: Movement, sensor: str, at: FloatArray) -> FloatArray:
    """Of the links beyond a sensor, in its child link, by adding up the links; shape (n, 3)."""
    joint = movement.model.joints[movement.model.sensors[sensor].joint]
    child = invert_pose(movement.base_pose(at, joint.child))
    first, mass = np.zeros((len(at), 3)), 0.0
    for link in links_below(movement.model, joint.name):
        inertia, child_H_link = movement.model.links[link], child @ movement.base_pose(at, link)
        first += child_H_link[:, :3, :3] @ inertia.first_moment + inertia.mass * child_H_link[:, :3, 3]
        mass += inertia.mass
    assert mass > 0.3
    return first / mass


@pytest.mark.parametrize("sensor", ["l_leg_ft", "r_foot_ft", "l_arm_ft"])
@pytest.mark.parametrize("name", ROBOTS)
def test_the_limb_stays_stiff(name: str, sensor: str) -> None:
    """The centre of mass of what hangs on the sensor does not move in the sensor's child frame."""
    stand = on_pole(name)
    movement = grid_movement(stand, sensor, steps=4)
    at = times(movement, 50)
    # rounding of poses from some 10 joints
    assert np.ptp(_centre_of_mass(movement, sensor, at), axis=0).max() < 1e-13
    moved = [
        joint for joint, way in zip(stand.joints, np.ptp(movement.joints(at).position, axis=0), strict=True) if way
    ]
    assert len(moved) == 2
    if sensor != "r_foot_ft":  # negative control; a foot has no joints of its own
        loose = random_movement(stand, rng=np.random.default_rng(1), duration_s=10.0)
        assert np.ptp(_centre_of_mass(loose, sensor, times(loose, 50)), axis=0).max() > 1e-3


@pytest.mark.parametrize("name", ROBOTS)
def test_the_grid_fills_the_ranges(name: str) -> None:
    """Hip pitch and roll of every humanoid go over their ranges, and rest at every crossing."""
    stand = on_pole(name)
    movement = grid_movement(stand, "l_leg_ft", steps=3, hold_s=0.5)
    rests = movement.joints(movement.trajectory.departures_s).position
    pitch, roll = (rests[:, stand.joints.index(joint)] for joint in ("l_hip_pitch", "l_hip_roll"))
    for values, joint in ((pitch, "l_hip_pitch"), (roll, "l_hip_roll")):
        low, high = stand.range_of(joint)
        np.testing.assert_allclose(np.unique(values.round(12)), np.linspace(low, high, 3), atol=1e-11)
    pairs = {tuple(pair) for pair in np.column_stack([pitch, roll]).round(9)}
    assert len(rests) == 8  # departures: the last crossing is not left
    assert len(pairs) == 8
    # to and fro: one joint at a time
    assert (np.count_nonzero(np.diff(rests, axis=0).round(12), axis=1) == 1).all()


def test_the_force_goes_over_a_sphere() -> None:
    """The force keeps its size when slow, and its direction spans most of a half sphere."""
    movement = grid_movement(on_pole("biped", speed=0.01), "l_leg_ft")
    force = movement.readings(times(movement, 300), ["l_leg_ft"]).of_name("l_leg_ft")[:, :3]
    size = np.linalg.norm(force, axis=1)
    assert np.ptp(size) < 1e-3 * size.mean()  # accelerations of 1e-4 m/s2
    assert (np.ptp(force, axis=0) > size.mean()).all()


def test_joints_along_gravity_are_passed_over() -> None:
    """The arm's first joint turns about the vertical, which changes nothing; hung sideways it is used."""
    at = [0.0]
    assert "shoulder_yaw" in limb_of(arm(), "arm_ft").own
    movement = grid_movement(arm(), "arm_ft")
    moved = np.ptp(movement.joints(times(movement)).position, axis=0) > 0
    assert [n for n, m in zip(movement.joints(at).names, moved, strict=True) if m] == [
        "shoulder_pitch",
        "shoulder_roll",
    ]
    wall = Stand(model=robot("arm"), support="base", gravity_direction=np.array([1.0, 0, 0]))
    movement = grid_movement(wall, "arm_ft")
    moved = np.ptp(movement.joints(times(movement)).position, axis=0) > 0
    assert [n for n, m in zip(movement.joints(at).names, moved, strict=True) if m] == ["shoulder_yaw", "shoulder_pitch"]


@pytest.mark.parametrize("name", ROBOTS)
def test_an_arm_does_not_begin_at_the_waist(name: str) -> None:
    """Joints of the trunk carry more than one limb and are not the limb's own."""
    limb = limb_of(on_pole(name), "l_arm_ft")
    assert limb.own == ("l_shoulder_pitch", "l_shoulder_roll", "l_shoulder_yaw")
    assert len(limb.between) > len(limb.own)
    assert "l_elbow" in limb.outboard
    assert not {joint for joint in limb.outboard if not joint.startswith("l_")}


def test_named_joints_are_used_and_checked() -> None:
    """The caller may choose any two that carry the sensor, and no others."""
    stand = on_pole("biped")
    movement = grid_movement(stand, "l_arm_ft", joints=("waist_pitch", "l_shoulder_yaw"), steps=2, name="mine")
    moved = np.ptp(movement.joints(times(movement)).position, axis=0) > 0
    assert {n for n, m in zip(stand.joints, moved, strict=True) if m} == {"waist_pitch", "l_shoulder_yaw"}
    assert movement.name == "mine"
    with pytest.raises(RobotError, match="between 'pelvis' and the sensor, got 'l_elbow'; known: 'waist_yaw'"):
        grid_movement(stand, "l_arm_ft", joints=("l_shoulder_yaw", "l_elbow"))
    with pytest.raises(RobotError, match="expected two joints, got 'waist_yaw' twice"):
        grid_movement(stand, "l_arm_ft", joints=("waist_yaw", "waist_yaw"))
    with pytest.raises(RobotError, match="no free joint 'l_elbw'; did you mean"):
        grid_movement(stand, "l_arm_ft", joints=("l_shoulder_yaw", "l_elbw"))


def test_limbs_without_two_joints_are_refused() -> None:
    """The message says which joints there are and what to do."""
    with pytest.raises(RobotError, match="of its limb that turn .*got none out of none; .*choose another support"):
        grid_movement(on_foot("biped"), "l_foot_ft")
    with pytest.raises(RobotError, match="no force-torque sensor 'l_leg'"):
        grid_movement(on_foot("biped"), "l_leg")
    with pytest.raises(ShapeError, match="steps: expected at least 2"):
        grid_movement(on_pole("biped"), "l_leg_ft", steps=1)
