# SPDX-License-Identifier: BSD-3-Clause
"""Estimates against iDynTree on random states of real robots: readings, contacts, torques, net wrenches."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, moving_joints
from forcetorque.robot.motion import RootMotion
from forcetorque.robot.sub_models import sub_models
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.robot.urdf import read_urdf
from tests.robot.mechanics.idyntree_oracle import IDynTree
from tests.robot.mechanics.simulated import random_pose, random_root, to_root
from tests.scenes.robots import example_robot, icub, random_motion

ROUNDING = 1e-12
"""Of the largest wrench: some 40 bodies of some 50 roundings each at eps = 2e-16 are 4e-13, added up on both sides.
The largest wrench is some 100 to 1000 N, so that this is 1e-10 to 1e-9 N."""

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""

SAMPLES = 6

ROBOTS: dict[str, tuple[Callable[[], Path], str]] = {
    "genova02_on_its_left_foot": (lambda: icub("iCubGenova02"), "l_foot"),
    "gazebo_v2_7": (lambda: icub("iCubGazeboV2_7"), "root_link"),
    "genova03_with_massless_links": (lambda: icub("iCubGenova03"), "root_link"),
    "nancy_from_the_head": (lambda: icub("iCubNancy01"), "head"),
    "lisboa_with_four_sensors": (lambda: icub("iCubLisboa01"), "chest"),
    "reduced": (lambda: example_robot("icub_description/robots/icub_reduced.urdf"), "r_sole"),
}

GRAVITY = STANDARD_GRAVITY * np.array([2.0, -1.0, -2.0]) / 3.0
"""m/s2, in the axes of the root link, which is tilted."""


class _Case:
    """A robot, its motion, readings of its sensors, and a full wrench anywhere on every sub-model."""

    def __init__(self, robot: str, *, floating: bool) -> None:
        find, self.root_link = ROBOTS[robot]
        self.model = read_urdf(find())
        self.tree: BodyTree = build_tree(self.model, self.root_link)
        self.joints = random_motion(self.model, samples=SAMPLES, seed=1)
        self.oracle = IDynTree(find(), self.joints)
        self.floating = floating
        self.root = random_root(SAMPLES, 2) if floating else RootMotion.fixed(GRAVITY / STANDARD_GRAVITY)
        rng = np.random.default_rng(3)
        assert len(self.oracle.sensors) >= 4
        assert set(self.oracle.sensors) == set(self.tree.cuts)
        self.measured = Wrenches.of({name: 30.0 * rng.normal(size=(SAMPLES, 6)) for name in self.oracle.sensors})
        self.contacts = []
        for part in sub_models(self.tree, self.oracle.sensors):
            frames = [frame for frame in self.tree.frames if self._is_on(frame, part.bodies)]
            link = frames[rng.integers(len(frames))]
            self.contacts.append(Contact(link=link, name=f"on {part.name}", link_H_contact=random_pose(rng)))
        assert len(self.contacts) == len(self.oracle.sensors) + 1

    def _is_on(self, frame: str, bodies: tuple[int, ...]) -> bool:
        link = self.oracle.link_of(frame)
        return bool(link) and self.tree.frames[frame][0] in bodies and self.tree.frames[link][0] in bodies

    def state(self, k: int) -> None:
        """Let the oracle take a sample."""
        if self.floating:
            self.oracle.float(k, self.root_link, self.root)
        else:
            self.oracle.fix(k, self.root_link, GRAVITY)

    def in_contact_frame(self, contact: Contact, wrench: FloatArray) -> FloatArray:
        """Turn iDynTree's wrench, which is along the axes of the link, about the contact's origin."""
        link_R_contact = self.oracle.link_H_frame(contact.link)[:3, :3] @ contact.link_H_contact[:3, :3]
        return np.concatenate([wrench[:3] @ link_R_contact, wrench[3:] @ link_R_contact])


def _agree(found: FloatArray, wanted: FloatArray, scale: float) -> None:
    np.testing.assert_allclose(found, wanted, rtol=0, atol=ROUNDING * max(scale, float(np.abs(wanted).max())))


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("floating", [False, True], ids=["fixed", "floating"])
@pytest.mark.parametrize("robot", ROBOTS)
def test_expected_readings_equal_idyntree(robot: str, floating: bool, evaluator: Evaluator) -> None:
    """Where one link takes up everything, the root or another, all readings are those of iDynTree."""
    case = _Case(robot, floating=floating)
    compared = 0
    for contact in (case.root_link, case.contacts[-1].link):
        question = Question(tree=case.tree, expected=case.oracle.sensors, expected_contact=contact)
        found = estimate(question, case.joints, case.root, evaluator=evaluator)
        for k in range(SAMPLES):
            case.state(k)
            readings, _ = case.oracle.expected(contact)
            scale = max(float(np.abs(values).max()) for values in readings.values())
            for name, wanted in readings.items():
                _agree(found.expected_of(name)[k], wanted, scale)
                assert np.abs(found.expected_of(name)[k] + wanted).max() > VISIBLE  # negative control
                compared += 1
    assert compared == 2 * SAMPLES * len(case.oracle.sensors)


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("floating", [False, True], ids=["fixed", "floating"])
@pytest.mark.parametrize("robot", ROBOTS)
def test_contacts_and_torques_equal_idyntree(robot: str, floating: bool, evaluator: Evaluator) -> None:
    """With readings, a full wrench on every sub-model and all torques are those of iDynTree."""
    case = _Case(robot, floating=floating)
    question = Question(
        tree=case.tree,
        measured=case.oracle.sensors,
        contacts=tuple(case.contacts),
        torques=moving_joints(case.tree),
    )
    found = estimate(question, case.joints, case.root, measured=case.measured, evaluator=evaluator)
    assert (found.rank == 6).all()
    compared = 0
    for k in range(SAMPLES):
        case.state(k)
        readings = {name: case.measured.of_name(name)[k] for name in case.oracle.sensors}
        wrenches, torques = case.oracle.estimate(readings, case.contacts)
        scale = max(float(np.abs(wrench).max()) for wrench in wrenches.values())
        for contact in case.contacts:
            _agree(found.contact(contact.name)[k], case.in_contact_frame(contact, wrenches[contact.name]), scale)
        ours = np.array([found.torque(joint)[k] for joint in case.joints.names])
        _agree(ours, torques, scale)
        compared += len(case.contacts) + len(ours)
    assert compared >= SAMPLES * (5 + 20)


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("robot", ROBOTS)
def test_torques_without_sensors_equal_idyntree(robot: str, evaluator: Evaluator) -> None:
    """With no reading, the torques of a robot held at its root are those of iDynTree's inverse dynamics."""
    case = _Case(robot, floating=True)
    joints = moving_joints(case.tree)
    question = Question(tree=case.tree, contacts=(Contact(link=case.root_link),), torques=joints)
    found = estimate(question, case.joints, case.root, evaluator=evaluator)
    assert len(joints) >= 20
    for k in range(SAMPLES):
        case.state(k)
        _, torques = case.oracle.expected(case.root_link)
        ours = np.array([found.torque(joint)[k] for joint in case.joints.names])
        _agree(ours, torques, float(np.abs(found.contact(case.root_link)[k]).max()))
        assert np.abs(ours + torques).max() > VISIBLE  # negative control: the other sign


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("robot", ROBOTS)
def test_net_wrenches_equal_idyntree(robot: str, evaluator: Evaluator) -> None:
    """The wrenches that move the links add up to those of iDynTree's links, which hold what is fixed to them."""
    case = _Case(robot, floating=True)
    links = tuple(case.model.links)
    found = estimate(Question(tree=case.tree, net_wrenches=links), case.joints, case.root, evaluator=evaluator)
    for k in range(SAMPLES):
        case.state(k)
        wanted = case.oracle.net_wrenches()
        assert len(wanted) >= 20
        sums = {name: np.zeros(6) for name in wanted}
        for link in links:
            host_H_link = case.oracle.link_H_frame(link)
            sums[case.oracle.link_of(link)] += to_root(host_H_link[None], found.net_wrench(link)[k : k + 1])[0]
        scale = max(float(np.abs(wrench).max()) for wrench in wanted.values())
        for name, wrench in wanted.items():
            _agree(sums[name], wrench, scale)
        assert max(np.abs(sums[name] + wrench).max() for name, wrench in wanted.items()) > VISIBLE  # negative control


@pytest.mark.parametrize("spoilt", ["sign", "lever arm", "orientation", "sensor"])
def test_a_spoilt_contact_disagrees_with_idyntree(spoilt: str) -> None:
    """Negative control: sign, place and axes of a contact, and each reading, show in the comparison."""
    case = _Case("gazebo_v2_7", floating=True)
    contacts, readings = list(case.contacts), {n: case.measured.of_name(n)[0] for n in case.oracle.sensors}
    leg = 1
    pose = np.array(contacts[leg].link_H_contact)
    if spoilt == "lever arm":
        pose[2, 3] += 0.05
    if spoilt == "orientation":
        pose[:3, :3] = pose[:3, :3][:, [1, 2, 0]]
    if spoilt == "sensor":
        readings[case.oracle.sensors[0]] = -readings[case.oracle.sensors[0]]
    contacts[leg] = Contact(link=contacts[leg].link, name=contacts[leg].name, link_H_contact=pose)
    question = Question(tree=case.tree, measured=case.oracle.sensors, contacts=tuple(contacts))
    found = estimate(question, case.joints, case.root, measured=case.measured)
    case.state(0)
    wrenches, _ = case.oracle.estimate(readings, case.contacts)
    worst = 0.0
    for contact in case.contacts:
        wanted = case.in_contact_frame(contact, wrenches[contact.name])
        worst = max(
            worst, float(np.abs(found.contact(contact.name)[0] - (-wanted if spoilt == "sign" else wanted)).max())
        )
    assert worst > VISIBLE
