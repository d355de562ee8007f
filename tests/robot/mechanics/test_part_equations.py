# SPDX-License-Identifier: BSD-3-Clause
"""Equations of parts close with true readings, whatever touches the other parts."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import EstimationError, RobotError
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import transform_wrench
from forcetorque.robot.contacts import Contact
from forcetorque.robot.mechanics.sub_model_equations import (
    joints_of_cuts,
    joints_of_part,
    part_equations,
    sensors_of,
    untouched_parts,
    weight_equations,
)
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.robot.mechanics.simulated import Simulation, random_root
from tests.scenes.robots import icub, random_motion

SENSORS = ("l_leg_ft", "r_leg_ft", "l_foot_ft", "r_foot_ft", "l_arm_ft")
FEET = ("l_sole", "r_sole")
ROOT = "root_link_imu_frame"
SAMPLES = 20


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    """A humanoid whose feet are pushed about, seen from the IMU in its waist."""
    rng = np.random.default_rng(3)
    model = read_urdf(icub("iCubGazeboV2_7"))
    joints = random_motion(model, samples=SAMPLES, seed=3)
    robot = Simulation(model=model, root_link=ROOT, joints=joints, root=random_root(samples=SAMPLES, seed=3))
    on_left = 100.0 * rng.normal(size=(SAMPLES, 6))
    robot.touch(Contact(link="l_sole"), on_left)
    # the other foot bears what is left
    left, right = (robot.links[foot].pose for foot in FEET)
    rest = robot.total_needed() - transform_wrench(left, on_left)
    robot.touch(Contact(link="r_sole"), transform_wrench(invert_pose(right), rest))
    return robot


def _named(motion: JointMotion, names: tuple[str, ...]) -> JointMotion:
    """Some of the joints."""
    columns = [motion.names.index(joint) for joint in names]
    return JointMotion(
        names=names,
        position=motion.position[:, columns],
        velocity=motion.velocity[:, columns],
        acceleration=motion.acceleration[:, columns],
    )


def test_parts_that_nothing_touches_are_closed_by_true_readings(simulation: Simulation) -> None:
    """Torso, shanks and an arm; not the feet, which something touches."""
    tree = build_tree(simulation.model, ROOT)
    parts = untouched_parts(tree, SENSORS, FEET)
    assert {part.name for part in parts} == {ROOT, "l_leg_ft", "r_leg_ft", "l_arm_ft"}
    for equation in part_equations(tree, parts, simulation.joints, simulation.root):
        readings = np.stack([simulation.reading(name) for name in equation.sensors], axis=1)
        total = np.einsum("nkij,nkj->ni", equation.transmission, readings)
        np.testing.assert_allclose(total, equation.demand, atol=1e-9 * np.abs(equation.demand).max())


def test_a_part_that_is_touched_does_not_close(simulation: Simulation) -> None:
    """Negative control: the foot that is pushed."""
    tree = build_tree(simulation.model, ROOT)
    parts = [part for part in untouched_parts(tree, SENSORS, ()) if part.name == "l_foot_ft"]
    (equation,) = part_equations(tree, parts, simulation.joints, simulation.root)
    total = np.einsum("nij,nj->ni", equation.transmission[:, 0], simulation.reading("l_foot_ft"))
    assert np.abs(total - equation.demand).max() > 50.0


def test_only_the_joints_of_a_part_are_needed(simulation: Simulation) -> None:
    """Those between the root and it, and its own; a missing one is named."""
    tree = build_tree(simulation.model, ROOT)
    (shank,) = (part for part in untouched_parts(tree, SENSORS, FEET) if part.name == "l_leg_ft")
    needed = joints_of_part(tree, shank)
    assert sensors_of(shank) == ("l_leg_ft", "l_foot_ft")
    assert {"l_hip_pitch", "l_knee", "l_ankle_roll"} <= set(needed)
    assert not any(joint.startswith(("r_", "l_shoulder", "neck")) for joint in needed)
    motion = simulation.joints
    few = _named(motion, needed)
    (alone,) = part_equations(tree, [shank], few, simulation.root)
    (whole,) = part_equations(tree, [shank], motion, simulation.root)
    np.testing.assert_array_equal(alone.demand, whole.demand)
    fewer = JointMotion.at_rest(needed[:-1], np.zeros((SAMPLES, len(needed) - 1)))
    with pytest.raises(RobotError, match=f"needs joint '{needed[-1]}'"):
        list(part_equations(tree, [shank], fewer, simulation.root))


def test_the_weight_of_a_part_at_rest_needs_no_joints_of_its_own(simulation: Simulation) -> None:
    """Force rows of a robot at rest are those of the whole equation, by the joints between the sensors alone."""
    tree = build_tree(simulation.model, ROOT)
    (torso,) = (part for part in untouched_parts(tree, SENSORS, FEET) if part.name == ROOT)
    joints = JointMotion.at_rest(simulation.joints.names, simulation.joints.position)
    root = RootMotion.fixed([0.0, 0.6, -0.8])
    (whole,) = part_equations(tree, [torso], joints, root)
    needed = joints_of_cuts(tree, torso)
    assert not any(joint.startswith(("neck", "l_elbow", "l_wrist")) for joint in needed)
    (weight,) = weight_equations(tree, [torso], _named(joints, needed), root)
    np.testing.assert_allclose(weight.demand[:, :3], whole.demand[:, :3], atol=1e-10)
    np.testing.assert_array_equal(weight.transmission[:, :, :3], whole.transmission[:, :, :3])
    assert not weight.demand[:, 3:].any()
    assert not weight.transmission[:, :, 3:].any()
    # negative control: of a robot that moves it is only about right
    (moving,) = part_equations(tree, [torso], simulation.joints, simulation.root)
    (still,) = weight_equations(tree, [torso], simulation.joints, simulation.root)
    assert np.abs(moving.demand[:, :3] - still.demand[:, :3]).max() > 1.0


def test_touch_everywhere_is_refused() -> None:
    """And links that are not there."""
    tree = build_tree(read_urdf(icub("iCubGazeboV2_7")), ROOT)
    with pytest.raises(EstimationError, match="free of touch"):
        untouched_parts(tree, ["l_arm_ft"], ["l_hand", ROOT])
    with pytest.raises(RobotError, match="touched: the robot has no link 'l_toe'"):
        untouched_parts(tree, SENSORS, ["l_toe"])
