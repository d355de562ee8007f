# SPDX-License-Identifier: BSD-3-Clause
"""Expected wrenches: what must not change the readings, and what must change them in proportion."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.pose import rotation_from_rpy
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import (
    PENDULUM_URDF,
    icub,
    joint_xml,
    link_xml,
    random_motion,
    read_text,
    robot_xml,
    sensor_xml,
)

ROUNDING = 1e-10
"""N, N m: some 40 bodies with wrenches of some 1e3 at eps = 2e-16, with a margin of 100."""

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""


@pytest.fixture(scope="module")
def robot() -> RobotModel:
    """An iCub with six sensors."""
    return read_urdf(icub("iCubGenova02"))


@pytest.fixture(scope="module")
def tree(robot: RobotModel) -> BodyTree:
    """That iCub standing on its left sole."""
    return build_tree(robot, "l_sole")


def _root(samples: int, seed: int) -> RootMotion:
    acceleration, velocity, turning = np.random.default_rng(seed).normal(size=(3, samples, 3))
    return RootMotion(
        proper_acceleration=10 * acceleration, angular_velocity=velocity, angular_acceleration=3 * turning
    )


def _pick(motion: JointMotion, root: RootMotion, which: IntArray | slice) -> tuple[JointMotion, RootMotion]:
    """Some of the samples of a motion."""
    return (
        JointMotion(
            names=motion.names,
            position=motion.position[which],
            velocity=motion.velocity[which],
            acceleration=motion.acceleration[which],
        ),
        RootMotion(
            proper_acceleration=root.proper_acceleration[which],
            angular_velocity=root.angular_velocity[which],
            angular_acceleration=root.angular_acceleration[which],
        ),
    )


def _assert_same(found: dict[str, FloatArray], expected: dict[str, FloatArray]) -> None:
    assert set(found) == set(expected)
    assert found
    for name, values in expected.items():
        np.testing.assert_allclose(found[name], values, rtol=0, atol=ROUNDING, err_msg=name)


def _seen_from(root: RootMotion, a_R_b: FloatArray, a_p_b: FloatArray) -> RootMotion:
    """Motion of a frame b fixed to the body whose frame a moves so."""
    omega, alpha = root.angular_velocity, root.angular_acceleration
    at_b = root.proper_acceleration + np.cross(alpha, a_p_b) + np.cross(omega, np.cross(omega, a_p_b))
    return RootMotion(
        proper_acceleration=at_b @ a_R_b, angular_velocity=omega @ a_R_b, angular_acceleration=alpha @ a_R_b
    )


def test_the_link_of_the_root_body_does_not_matter(tmp_path: Path) -> None:
    """Rooted at another link of the same body, whose motion is that of the first, every reading is the same."""
    rpy, xyz = [0.4, -0.7, 1.1], [0.2, -0.1, 0.3]
    urdf = robot_xml(
        link_xml("a"),
        link_xml("b", mass=1.0),
        link_xml("c", mass=2.0, xyz="0.1 0.2 0", moments="0.02 0.001 0 0.03 0 0.04"),
        link_xml("d"),
        link_xml("e", mass=0.7, xyz="0 0 0.2"),
        joint_xml("rigid", "a", "b", xyz="0.2 -0.1 0.3", rpy="0.4 -0.7 1.1"),
        joint_xml("near", "b", "c", xyz="0 0.1 0", rpy="0 0.3 0"),
        joint_xml("hinge", "a", "d", type="revolute", xyz="0 0 0.1", axis="1 1 0"),
        joint_xml("far", "d", "e", rpy="0 0 0.5"),
        sensor_xml("near", "near"),
        sensor_xml("far", "far", frame="parent"),
    )
    model = read_text(urdf, tmp_path)
    motion, at_a = random_motion(model, samples=5, seed=1), _root(5, seed=2)
    at_b = _seen_from(at_a, rotation_from_rpy(rpy), np.array(xyz))
    from_a = expected_wrenches(build_tree(model, "a"), motion, at_a)
    _assert_same(expected_wrenches(build_tree(model, "b"), motion, at_b), from_a)
    unmoved = expected_wrenches(build_tree(model, "b"), motion, at_a)
    assert all(np.abs(unmoved[name] - from_a[name]).max() > VISIBLE for name in from_a)


def test_a_body_that_nothing_touches_reads_the_same_from_both_sides(tmp_path: Path) -> None:
    """Where the total external wrench is zero, rooting beyond the sensor flips nothing.

    A rigid dumbbell tumbles without torque: its centre of mass falls freely and
    alpha = -I^-1 (omega x I omega) about it.
    """
    urdf = robot_xml(
        link_xml("a", mass=2.0, moments="0.1 0.01 0 0.2 0 0.3"),
        link_xml("b", mass=1.0, moments="0.05 0 0.01 0.02 0 0.04"),
        joint_xml("mid", "a", "b", xyz="0.6 0.3 0"),
        sensor_xml("ft", "mid"),
    )
    model = read_text(urdf, tmp_path)
    centre, offset, omega = np.array([0.2, 0.1, 0.0]), np.array([0.6, 0.3, 0.0]), np.array([3.0, -2.0, 4.0])
    both = model.links["a"].second_moment + model.links["b"].second_moment
    for mass, arm in ((2.0, -centre), (1.0, offset - centre)):
        both = both + mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    nothing = JointMotion.at_rest([], np.zeros((1, 0)))
    differences = []
    for extra in (0.0, 1.0):  # the second is no free motion: the negative control
        alpha = -np.linalg.solve(both, np.cross(omega, both @ omega)) + extra
        falling = RootMotion(proper_acceleration=np.zeros(3), angular_velocity=omega, angular_acceleration=alpha)
        readings = [
            expected_wrenches(build_tree(model, root), nothing, _seen_from(falling, np.eye(3), at - centre))["ft"]
            for root, at in (("a", np.zeros(3)), ("b", offset))
        ]
        assert np.abs(readings[0]).max() > VISIBLE
        differences.append(np.abs(readings[0] - readings[1]).max())
    assert differences[0] < ROUNDING
    assert differences[1] > VISIBLE


def test_free_fall_reads_nothing(robot: RobotModel, tree: BodyTree) -> None:
    """Without rotation and proper acceleration, a robot at rest in itself has no reading but zero."""
    motion = random_motion(robot, samples=3, seed=3)
    still = JointMotion.at_rest(motion.names, motion.position)
    falling = RootMotion(
        proper_acceleration=np.zeros(3), angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3)
    )
    found = expected_wrenches(tree, still, falling)
    assert len(found) == 6
    for values in found.values():
        np.testing.assert_array_equal(values, np.zeros((3, 6)))
    standing = expected_wrenches(tree, still, RootMotion.fixed([0.0, 0.0, -1.0]))
    assert all(np.abs(values).max() > VISIBLE for values in standing.values())


def test_readings_at_rest_are_linear_in_gravity(robot: RobotModel, tree: BodyTree) -> None:
    """At rest, the reading under a sum of gravities is the sum of the readings."""
    motion = random_motion(robot, samples=3, seed=4)
    first, second = 7.0 * np.random.default_rng(5).normal(size=(2, 3))
    results = {}
    for name, joints in (("still", JointMotion.at_rest(motion.names, motion.position)), ("moving", motion)):
        one, two, both = (
            expected_wrenches(tree, joints, RootMotion.fixed(g / np.linalg.norm(g), gravity=float(np.linalg.norm(g))))
            for g in (first, second, first - 2.5 * second)
        )
        results[name] = [np.abs(both[key] - one[key] + 2.5 * two[key]).max() for key in both]
        assert len(results[name]) == 6
    assert max(results["still"]) < ROUNDING
    assert min(results["moving"]) > VISIBLE  # negative control: motion adds what gravity does not scale


def test_samples_do_not_see_each_other(robot: RobotModel, tree: BodyTree) -> None:
    """Permuted samples give permuted readings; one sample alone reads as among others."""
    motion, root = random_motion(robot, samples=50, seed=6), _root(50, seed=7)
    together = expected_wrenches(tree, motion, root)
    order = np.random.default_rng(8).permutation(50)
    permuted = expected_wrenches(tree, *_pick(motion, root, order))
    _assert_same(permuted, {name: values[order] for name, values in together.items()})
    assert np.abs(permuted["r_leg_ft"] - together["r_leg_ft"]).max() > VISIBLE
    alone = expected_wrenches(tree, *_pick(motion, root, slice(17, 18)))
    _assert_same(alone, {name: values[17:18] for name, values in together.items()})


def test_many_samples_equal_two_calls(tmp_path: Path) -> None:
    """More samples than one block holds read as two calls do, and each sample once."""
    samples, split = 2 * 4096 + 5, 4100
    model = read_text(PENDULUM_URDF, tmp_path)
    tree = build_tree(model, "base")
    motion, root = random_motion(model, samples=samples, seed=9), _root(samples, seed=10)
    first, second = (
        expected_wrenches(tree, *_pick(motion, root, part))["ft"] for part in (slice(split), slice(split, None))
    )
    found = expected_wrenches(tree, motion, root)["ft"]
    np.testing.assert_allclose(found, np.concatenate([first, second]), rtol=0, atol=ROUNDING)
    assert np.abs(found[4096:] - found[: samples - 4096]).max() > VISIBLE


def test_no_samples_give_no_readings(robot: RobotModel, tree: BodyTree) -> None:
    """A motion of no samples has readings of no samples."""
    found = expected_wrenches(tree, random_motion(robot, samples=0, seed=11), RootMotion.fixed([0.0, 0.0, -1.0]))
    assert {values.shape for values in found.values()} == {(0, 6)}


def test_order_and_number_of_joints_and_sensors_do_not_matter(robot: RobotModel, tree: BodyTree) -> None:
    """Joints are matched by name, others may be present, and a sensor reads the same when asked alone."""
    motion, root = random_motion(robot, samples=4, seed=12), _root(4, seed=13)
    together = expected_wrenches(tree, motion, root)
    shuffled = np.random.default_rng(14).permutation(len(motion.names))
    other = JointMotion(
        names=(*(motion.names[k] for k in shuffled), "not_in_the_robot"),
        position=np.column_stack([motion.position[:, shuffled], np.ones(4)]),
        velocity=np.column_stack([motion.velocity[:, shuffled], np.ones(4)]),
        acceleration=np.column_stack([motion.acceleration[:, shuffled], np.ones(4)]),
    )
    _assert_same(expected_wrenches(tree, other, root), together)
    asked = 0
    for name, values in together.items():
        _assert_same(expected_wrenches(tree, motion, root, [name]), {name: values})
        asked += 1
    assert asked == 6
