# SPDX-License-Identifier: BSD-3-Clause
"""Robots that sway, squat and step on both feet: mechanics close, feet stand, and nothing jumps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import transform_wrench
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.dynamics import body_pose, expected_wrenches, link_pose
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.tree import build_tree
from forcetorque.simulation.motions.movement import Movement
from tests.simulation.motions.stances import IMU_LINKS, MOVEMENTS, on_both_feet, stance
from tests.simulation.motions.stands import ROBOTS, require_exact_derivatives, times

CLOSED = 1e-9
"""N, N m: rounding of 300 N over 40 bodies."""
IN_PLACE_M = 1e-4
"""A splined leg may be off by this between its samples."""

every_robot = pytest.mark.parametrize("name", ROBOTS)
every_kind = pytest.mark.parametrize("kind", MOVEMENTS)


def _feet(movement: Movement) -> tuple[str, str]:
    first, second = movement.touched
    return first, second


def _loads(movement: Movement, at: FloatArray) -> FloatArray:
    """Wrenches of both feet in their frames; shape (n, 2, 6)."""
    return np.asarray(movement.external_wrenches(at).values)


@every_robot
@every_kind
def test_the_ground_moves_the_robot(name: str, kind: str) -> None:
    """What the feet bear is what the whole robot takes to move as it does: nothing is left for the trunk."""
    movement = on_both_feet(name, kind)
    at = times(movement)
    assert np.abs(movement.support_wrench(at)).max() < CLOSED
    # negative control: one foot less
    alone = replace(movement, external=movement.external[:1])
    assert np.abs(alone.support_wrench(at)).max() > 100.0


@pytest.mark.parametrize("name", ["biped", "iCubGazeboV2_7"])
def test_pinocchio_finds_the_same_balance(name: str) -> None:
    """Generalised forces of its free-floating robot under our contacts are joint torques only."""
    pinocchio = pytest.importorskip("pinocchio")
    movement = on_both_feet(name, "stepping")
    model = pinocchio.buildModelFromUrdf(str(ROBOTS[name]()), pinocchio.JointModelFreeFlyer())
    data = model.createData()
    at = np.array([0.3, 1.0, 2.2, 3.1])  # both feet, the first in the air, both, the second in the air
    joints = movement.joints(at)
    base = movement.link_motion(at, movement.model.root_link)
    loads = _loads(movement, at)
    columns = [model.joints[model.getJointId(joint)].idx_v for joint in joints.names]
    model.gravity.linear = np.zeros(3)  # the acceleration of the base is a proper one
    off = np.empty((len(at), 6))
    for k in range(len(at)):
        q, v, a = pinocchio.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
        q[np.array(columns) + 1] = joints.position[k]
        v[columns], a[columns] = joints.velocity[k], joints.acceleration[k]
        v[3:6] = base.angular_velocity[k]
        a[:6] = np.concatenate([base.proper_acceleration[k], base.angular_acceleration[k]])
        off[k] = pinocchio.rnea(model, data, q, v, a)[:6]
        pinocchio.framesForwardKinematics(model, data, q)
        for foot, load in zip(_feet(movement), loads[k], strict=True):
            off[k] -= data.oMf[model.getFrameId(foot)].toDualActionMatrix() @ load
    assert np.abs(off).max() < 1e-8  # two ways of rounding


@every_robot
@every_kind
def test_feet_on_the_ground_stand_still(name: str, kind: str) -> None:
    """A foot that bears anything is where it was put, level, and one without a load lifts and comes back."""
    movement = on_both_feet(name, kind)
    places = stance(name, seed=1).world_H_feet
    at = times(movement, 1000)
    loads = _loads(movement, at)
    for index, foot in enumerate(_feet(movement)):
        pose = movement.base_pose(at, foot)
        bears = np.abs(loads[:, index]).max(axis=1) > 0.0
        assert np.abs(pose[bears] - places[index]).max() < IN_PLACE_M
        np.testing.assert_allclose(pose[bears][:, 2, :3], np.broadcast_to([0, 0, 1.0], (bears.sum(), 3)), atol=1e-4)
        assert bears.all() == (kind != "stepping")
        if kind == "stepping":
            lifted = pose[~bears][:, 2, 3]
            assert lifted.min() > -IN_PLACE_M
            assert lifted.max() > 0.02
            assert np.abs(pose[~bears] - places[index]).max() > 0.02
    assert (np.abs(loads).max(axis=2) > 0.0).any(axis=1).all()  # one of both bears


@every_robot
def test_the_first_foot_is_level_and_both_are_where_they_were_put(name: str) -> None:
    """A placement shifts and turns feet along the ground, and changes nothing else."""
    straight, moved = stance(name), stance(name, seed=3)
    shift = moved.world_H_feet[:, :3, 3] - straight.world_H_feet[:, :3, 3]
    np.testing.assert_allclose(shift[:, :2], moved.placement[:, :2], atol=1e-12)
    np.testing.assert_array_equal(shift[:, 2], 0.0)
    turned = moved.world_H_feet[:, :3, :3] @ straight.world_H_feet[:, :3, :3].transpose(0, 2, 1)
    np.testing.assert_allclose(np.arctan2(turned[:, 1, 0], turned[:, 0, 0]), moved.placement[:, 2], atol=1e-12)
    assert np.abs(moved.placement).min() > 0.0


@every_kind
def test_internal_pushes_have_no_sum(kind: str) -> None:
    """Feet that push against each other change what each bears, and not what both bear together."""
    pushing, calm = (on_both_feet("biped", kind, internal_force_N=force) for force in (15.0, 0.0))
    at = times(pushing)
    trunk_H_feet = [link_pose(pushing.tree, pushing.joints(at), foot) for foot in _feet(pushing)]
    change = _loads(pushing, at) - _loads(calm, at)
    total = sum(transform_wrench(pose, change[:, k]) for k, pose in enumerate(trunk_H_feet))
    assert np.abs(np.asarray(total)).max() < CLOSED
    assert np.abs(change[:, :, :2]).max() > 3.0


@pytest.mark.parametrize("name", ["biped", "iCubGazeboV2_7"])
def test_loads_are_handed_over_without_a_jump(name: str) -> None:
    """Wrenches of feet and readings change evenly, and a foot bears nothing from before it lifts until it is down."""
    movement = on_both_feet(name, "stepping")
    at = np.arange(0.0, 10.0, 0.001)
    loads = _loads(movement, at)
    # 330 N in 0.4 s by minimum jerk: at most 1.875 * 330 / 0.4 = 1550 N/s
    assert np.abs(np.diff(loads[:, :, :3], axis=0)).max() < 1.8
    assert np.abs(np.diff(loads[:, :, :3], n=2, axis=0)).max() < 0.02  # a jump of 20 mN would show
    for index, foot in enumerate(_feet(movement)):
        height = movement.base_pose(at, foot)[:, 2, 3]
        lifted = height > IN_PLACE_M
        assert lifted.sum() > 1000
        assert not loads[lifted, index].any()
        assert loads[:, index, 2].min() >= 0.0
        unloaded = ~loads[:, index].any(axis=1)
        assert unloaded.sum() > lifted.sum()
    sensors = movement.readings(at[::5], ["l_leg_ft", "r_foot_ft", "l_arm_ft"]).values
    assert np.abs(np.diff(sensors[:, :, :3], n=2, axis=0)).max() < 0.5


@every_robot
@every_kind
def test_legs_follow_with_exact_derivatives(name: str, kind: str) -> None:
    """Velocities and accelerations of joints are slopes, and joints stay in their limits."""
    movement = on_both_feet(name, kind)
    at = times(movement, 100)
    motion = movement.joints(at)
    for joint, position in zip(motion.names, motion.position.T, strict=True):
        limit = movement.model.joints[joint].limit
        assert limit is not None
        assert limit.lower is not None
        assert limit.upper is not None
        assert limit.lower <= position.min() <= position.max() <= limit.upper, joint
    if kind == "standing":
        # what the search for legs that stand leaves open
        assert np.abs(motion.velocity).max() < 1e-5
        return
    require_exact_derivatives(movement.joints, at)


@pytest.mark.parametrize("kind", ["sway", "stepping"])
@every_robot
def test_an_imu_moves_as_its_link(name: str, kind: str) -> None:
    """What it reads are second differences of where its link is, less gravity, and slopes of how it is turned."""
    movement, link, step = on_both_feet(name, kind), IMU_LINKS[name], 1e-4
    at = times(movement, 40)[1:-1]
    before, here, after = (movement.base_pose(at + shift, link) for shift in (-step, 0.0, step))
    motion = movement.link_motion(at, link)
    acceleration = (before + after - 2.0 * here)[:, :3, 3] / step**2 + [0.0, 0.0, movement.gravity]
    turning = here[:, :3, :3].transpose(0, 2, 1) @ (after - before)[:, :3, :3] / (2 * step)
    slopes = [(movement.link_motion(at + shift, link)).angular_velocity for shift in (-step, step)]
    # rounding of 1 m over the square of 0.1 ms
    own = np.einsum("nji,nj->ni", here[:, :3, :3], acceleration)
    np.testing.assert_allclose(motion.proper_acceleration, own, rtol=0, atol=1e-6)
    omega = np.stack([turning[:, 2, 1], turning[:, 0, 2], turning[:, 1, 0]], axis=1)
    np.testing.assert_allclose(motion.angular_velocity, omega, rtol=0, atol=1e-6)
    np.testing.assert_allclose(motion.angular_acceleration, (slopes[1] - slopes[0]) / (2 * step), rtol=0, atol=1e-4)
    assert np.ptp(motion.proper_acceleration, axis=0).max() > 0.3
    assert np.abs(motion.angular_velocity).max() > 0.05


@every_robot
def test_sub_models_between_sensors_close(name: str) -> None:
    """Shank and thigh between leg and foot, and the torso between legs and arms, take what their sensors read."""
    movement = on_both_feet(name, "stepping")
    at = times(movement)
    joints, root, read = movement.joints(at), movement.root(at), movement.readings(at)
    untouched = expected_wrenches(movement.tree, joints, root)
    for side in "lr":
        # what touches the foot passes both sensors of the leg, and nothing else does
        passed = []
        for limb in ("leg", "foot"):
            cut = movement.tree.cuts[f"{side}_{limb}_ft"]
            pose = body_pose(movement.tree, joints, cut.body) @ cut.body_H_sensor
            excess = read.of_name(f"{side}_{limb}_ft") - untouched[f"{side}_{limb}_ft"]
            passed.append(cut.sign * transform_wrench(pose, excess))
        np.testing.assert_allclose(passed[0], passed[1], rtol=0, atol=1e-8)
        assert np.abs(passed[0]).max() > 100.0
        np.testing.assert_allclose(read.of_name(f"{side}_arm_ft"), untouched[f"{side}_arm_ft"], rtol=0, atol=CLOSED)
    # seen from a foot the leg's sensor carries the torso and all beyond it
    first, second = movement.external
    from_foot = build_tree(movement.model, first.contact.link)
    question = Question(tree=from_foot, contacts=(second.contact,), expected=read.names, equations=())
    known = Wrenches.of({second.contact.name: second.wrench(at)})
    other = estimate(question, joints, movement.link_motion(at, first.contact.link), known=known)
    np.testing.assert_allclose(other.expected, read.values, rtol=0, atol=1e-8)
    # negative control: without what touches the other foot
    alone = expected_wrenches(from_foot, joints, movement.link_motion(at, first.contact.link), ["l_leg_ft"])
    assert np.abs(alone["l_leg_ft"] - read.of_name("l_leg_ft")).max() > 100.0


def test_standing_still_by_hand() -> None:
    """Level feet bear the weight, and the feet read what they bear less their own weight."""
    movement = on_both_feet("biped", "standing", internal_force_N=0.0)
    model = movement.model
    loads, read = _loads(movement, np.zeros(1))[0], movement.readings([0.0])
    weight = 9.80665 * sum(link.mass for link in model.links.values())
    assert loads[:, 2].sum() == pytest.approx(weight, abs=1e-9)
    for index, side in enumerate("lr"):
        own = 9.80665 * model.links[f"{side}_foot"].mass
        assert read.of_name(f"{side}_foot_ft")[0, 2] == pytest.approx(loads[index, 2] - own, abs=1e-3)


@every_kind
def test_seeds_make_movements(kind: str) -> None:
    """One seed gives one movement, another seed another, and no seed is out of an iCub's reach."""
    name = "iCubGazeboV2_7"
    first, again = (
        MOVEMENTS[kind](stance(name, seed=2), rng=np.random.default_rng(2), duration_s=4.0) for _ in range(2)
    )
    np.testing.assert_array_equal(first.joints([1.0]).position, again.joints([1.0]).position)
    for seed in range(3, 9):
        other = MOVEMENTS[kind](stance(name, seed=seed), rng=np.random.default_rng(seed), duration_s=4.0)
        assert not np.array_equal(first.joints([1.0]).position, other.joints([1.0]).position)
