# SPDX-License-Identifier: BSD-3-Clause
"""Torques at rest against the slope of the potential energy; all contacts together against the rate of momentum."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, moving_joints
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import sub_models
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.cases import some_cases
from tests.robot.kinematics import link_poses
from tests.robot.mechanics.simulated import Simulation, random_pose
from tests.scenes.robots import example_robot, icub, random_motion

STEP = 1e-3
"""s, rad or m: between the points of the difference quotients."""

SLOPE = 1e-8
"""N m, N: first quotients of fourth order err by STEP^4 / 30 times some 500 J, 2e-11, and by rounding of
eps 500 J / STEP, 1e-10; with a margin of 100."""

RATE = 1e-6
"""N, N m: second quotients of fourth order err by STEP^4 / 90 times a sixth derivative of some (10 rad/s)^6 1 m,
1e-8 m/s2, and by rounding of 10 eps / STEP^2, 2e-9 m/s2; times some 60 kg."""

ROUNDING = 1e-9
"""N, N m: wrenches of some 1e3, 1e-13 each by rounding, times a condition of at most 1e3 and a margin of ten."""

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""

GRAVITY = 9.80665 * np.array([2.0, -1.0, -2.0]) / 3.0

ROBOTS: dict[str, tuple[Callable[[], Path], str]] = {
    "genova03_on_a_foot": (lambda: icub("iCubGenova03"), "l_sole"),
    "gazebo_v2_7": (lambda: icub("iCubGazeboV2_7"), "root_link"),
    "tiago_on_a_slide": (lambda: example_robot("tiago_description/robots/tiago.urdf"), "base_footprint"),
    "tiago_from_its_wrist": (lambda: example_robot("tiago_description/robots/tiago.urdf"), "arm_7_link"),
}


def _robot(name: str) -> tuple[RobotModel, str]:
    find, root_link = ROBOTS[name]
    model = read_urdf(find())
    if not model.sensors:
        model = model.with_sensor("wrist", joint="wrist_ft_joint", direction="child_to_parent")  # type: ignore[arg-type]
    return model, root_link


def _energy(model: RobotModel, held: str, coordinates: dict[str, float]) -> float:
    """Potential energy of a robot that is held at one link; J."""
    poses = link_poses(model, coordinates)
    to_held = np.linalg.inv(poses[held])
    weights = [poses[link] @ [*inertia.first_moment, inertia.mass] for link, inertia in model.links.items()]
    return -float(GRAVITY @ (to_held @ np.sum(weights, axis=0))[:3])


@pytest.mark.parametrize("evaluator", Evaluator)
@some_cases("name", ROBOTS)
def test_torque_at_rest_is_the_slope_of_the_potential_energy(name: str, evaluator: Evaluator) -> None:
    """Virtual work: held at its root link, a robot at rest needs dU/dq at every joint, a force at a slide."""
    model, root_link = _robot(name)
    tree = build_tree(model, root_link)
    motion = random_motion(model, samples=2, seed=1)
    joints = JointMotion.at_rest(motion.names, motion.position)
    question = Question(tree=tree, contacts=(Contact(link=root_link),), torques=moving_joints(tree))
    root = RootMotion.fixed(GRAVITY / np.linalg.norm(GRAVITY))
    found = estimate(question, joints, root, evaluator=evaluator)
    biggest = 0.0
    compared = 0
    for k in range(len(joints)):
        here = _coordinates(model, joints, k)
        for joint in question.torques:
            lever = [_energy(model, root_link, here | {joint: here[joint] + d * STEP}) for d in (-2, -1, 1, 2)]
            slope = float(np.dot([1.0, -8.0, 8.0, -1.0], lever)) / (12 * STEP)
            assert abs(found.torque(joint)[k] - slope) < SLOPE
            biggest, compared = max(biggest, abs(slope)), compared + 1
    assert biggest > VISIBLE  # so that the other sign would show
    assert compared >= 2 * 20
    assert ("tiago" in name) == any(model.joints[joint].type == "prismatic" for joint in question.torques)


def _coordinates(model: RobotModel, joints: JointMotion, k: int, t: float = 0.0) -> dict[str, float]:
    """Coordinates at time t after a sample, those that mimic among them."""
    q = joints.position[k] + joints.velocity[k] * t + joints.acceleration[k] * t**2 / 2
    free = dict(zip(joints.names, q.tolist(), strict=True))
    return {
        name: free[name]
        if model.joints[name].mimic is None
        else model.joints[name].mimic.multiplier * free[model.joints[name].mimic.leader]  # type: ignore[union-attr]
        + model.joints[name].mimic.offset  # type: ignore[union-attr]
        for name in joints.names
    }


def _rate_of_momentum_less_gravity(model: RobotModel, joints: JointMotion, k: int, held: str) -> FloatArray:
    """Sum of m (a - g) and of r x m (a - g) over all matter, in a link that stands still and about its origin."""
    instants = []
    for step in range(-2, 3):
        poses = link_poses(model, _coordinates(model, joints, k, step * STEP))
        instants.append({link: np.linalg.inv(poses[held]) @ pose for link, pose in poses.items()})
    total = np.zeros(6)
    for link, inertia in model.links.items():
        poses_of_link = np.array([poses[link] for poses in instants])
        second = np.tensordot([-1.0, 16.0, -30.0, 16.0, -1.0], poses_of_link, 1) / (12 * STEP**2)
        second[:3, 3] -= GRAVITY
        # second moments of the matter about the link's planes, and its first moments and mass
        matter = np.empty((4, 4))
        matter[:3, :3] = np.trace(inertia.second_moment) / 2 * np.eye(3) - inertia.second_moment
        matter[:3, 3] = matter[3, :3] = inertia.first_moment
        matter[3, 3] = inertia.mass
        spread = poses_of_link[2] @ matter @ second.T  # sum of m r (a - g)^T
        total[:3] += (second @ matter)[:3, 3]
        total[3:] += [spread[1, 2] - spread[2, 1], spread[2, 0] - spread[0, 2], spread[0, 1] - spread[1, 0]]
    return total


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("name", ROBOTS)
def test_all_contacts_together_change_the_momentum(name: str, evaluator: Evaluator) -> None:
    """Newton and Euler for the whole robot: the contacts found add up to the rate of momentum less gravity.

    The readings are what a force and a push on every limb give, so that nothing is left over. Negative
    control: without one of the contacts the sum is another.
    """
    model, root_link = _robot(name)
    tree, rng, samples = build_tree(model, root_link), np.random.default_rng(2), 2
    motion = random_motion(model, samples=samples, seed=3)
    joints = JointMotion(
        names=motion.names, position=motion.position, velocity=motion.velocity / 2, acceleration=motion.acceleration
    )
    root = RootMotion.fixed(GRAVITY / np.linalg.norm(GRAVITY))
    simulation, contacts = Simulation(model, root_link, joints, root), [Contact(link=root_link)]
    for part in sub_models(tree, tuple(tree.cuts))[1:]:
        links = [link for link, (body, _) in tree.frames.items() if body in part.bodies]
        for type, direction in ((ContactType.FORCE, None), (ContactType.FORCE_ALONG, np.array([0.0, 0.6, 0.8]))):
            link = links[rng.integers(len(links))]
            contact = Contact(
                link=link,
                name=f"{type} on {part.name}",
                type=type,
                link_H_contact=random_pose(rng),
                direction=direction,
            )
            contacts.append(contact)
            truth = rng.normal(size=(samples, len(type.unknowns))) @ contact.unknown_map().T
            simulation.touch(contact, 20.0 * truth)
    measured = Wrenches.of({sensor: simulation.reading(sensor) for sensor in tree.cuts})
    question = Question(tree=tree, measured=measured.names, contacts=tuple(contacts))
    found = estimate(question, joints, root, measured=measured, evaluator=evaluator)
    np.testing.assert_allclose(found.residual, 0.0, rtol=0, atol=ROUNDING)
    together = Simulation(model, root_link, joints, root)
    for contact in contacts:
        together.touch(contact, found.contact(contact.name))
    all_together = np.sum(list(together.on_links.values()), axis=0)
    for k in range(samples):
        wanted = _rate_of_momentum_less_gravity(model, joints, k, root_link)
        np.testing.assert_allclose(all_together[k], wanted, rtol=0, atol=RATE)
        without_root = all_together[k] - found.contact(root_link)[k]
        assert np.abs(without_root - wanted).max() > VISIBLE
    assert len(contacts) >= 3
