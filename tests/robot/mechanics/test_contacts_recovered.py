# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches that a robot was touched with are found again from what its sensors then read."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question, moving_joints
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from tests.robot.mechanics.random_robots import contacts_on, random_unit, robots
from tests.robot.mechanics.simulated import Simulation, random_pose, random_root
from tests.robot.mechanics.touched import Touched, touch, touched

RECOVERED = 1e-9
"""N, N m: wrenches of some 1e3, 1e-13 each by rounding, times a condition of at most 1e3 and a margin of ten."""

MOST_CONDITION = 1e3

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""

EXAMPLES = 120


def _contact(link: str, type: ContactType, k: int) -> Contact:
    rng = np.random.default_rng(k)
    direction = random_unit(rng) if type is ContactType.FORCE_ALONG else None
    return Contact(
        link=link, name=f"{link}/{k}", type=type, link_H_contact=random_pose(rng, reach=0.1), direction=direction
    )


WRENCH, FORCE, ALONG, KNOWN = ContactType

SETS: dict[str, tuple[tuple[str, ContactType], ...]] = {
    "a_wrench_on_each": tuple(
        (link, WRENCH)
        for link in ("l_hand", "r_forearm", "l_lower_leg", "r_upper_leg", "l_foot", "r_sole", "root_link")
    ),
    "a_force_on_each": (
        *((link, FORCE) for link in ("l_hand", "r_forearm", "l_lower_leg", "r_upper_leg", "l_foot", "r_sole")),
        ("chest", WRENCH),
    ),
    "forces_and_pushes": (
        ("l_hand", FORCE),
        ("l_forearm", ALONG),
        ("r_hand", ALONG),
        ("l_upper_leg", FORCE),
        ("l_lower_leg", ALONG),
        ("l_lower_leg", ALONG),
        ("r_sole", ALONG),
        ("r_foot", FORCE),
        ("head", WRENCH),
    ),
    "six_pushes_on_a_leg": (
        *(("l_lower_leg", ALONG) for _ in range(3)),
        *(("l_upper_leg", ALONG) for _ in range(3)),
        ("root_link", WRENCH),
    ),
}


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("root_link", ["root_link", "l_sole", "head"])
@pytest.mark.parametrize("name", SETS)
def test_what_touches_a_humanoid_is_found(name: str, root_link: str, evaluator: Evaluator) -> None:
    """Every contact, torque and residual is that of the simulation; flipped readings are not (negative control)."""
    contacts = tuple(_contact(link, type, k) for k, (link, type) in enumerate(SETS[name]))
    robot = touched(contacts[:-1], root_link=root_link)
    # the last one, on the part of the torso, holds the robot
    held = robot.simulation.total_needed() - np.sum(list(robot.simulation.on_links.values()), axis=0)
    robot.truth[contacts[-1].name] = robot.in_contact(contacts[-1], held)
    robot.simulation.touch(contacts[-1], robot.truth[contacts[-1].name])
    sensors = tuple(robot.tree.cuts)
    measured = Wrenches.of({sensor: robot.simulation.reading(sensor) for sensor in sensors})
    question = Question(
        tree=robot.tree, measured=sensors, contacts=contacts, torques=moving_joints(robot.tree), expected=()
    )
    found = estimate(question, robot.joints, robot.root, measured=measured, evaluator=evaluator)
    assert np.nan_to_num(found.condition).max() < MOST_CONDITION
    for contact in contacts:
        np.testing.assert_allclose(found.contact(contact.name), robot.truth[contact.name], rtol=0, atol=RECOVERED)
    for joint in question.torques:
        np.testing.assert_allclose(found.torque(joint), robot.simulation.torque(joint), rtol=0, atol=RECOVERED)
    np.testing.assert_allclose(found.residual, 0.0, rtol=0, atol=RECOVERED)
    assert len(question.torques) > 20
    flipped = Wrenches(names=measured.names, values=-measured.values)
    lame = estimate(question, robot.joints, robot.root, measured=flipped, evaluator=evaluator)
    for contact in contacts:
        assert np.abs(lame.contact(contact.name) - robot.truth[contact.name]).max() > VISIBLE


def _free(model: RobotModel, seed: int) -> tuple[JointMotion, RootMotion]:
    names = tuple(name for name, joint in model.joints.items() if joint.type.moves)
    position, velocity, acceleration = np.random.default_rng(seed).uniform(-2.0, 2.0, size=(3, 3, len(names)))
    return JointMotion(names=names, position=position, velocity=velocity, acceleration=acceleration), random_root(3, 5)


@pytest.mark.long
def test_what_touches_any_robot_is_found() -> None:
    """On random robots: where an equation determines all its unknowns they are found; net wrenches always."""
    seen = dict.fromkeys(ContactType, 0)

    # the same examples in every run, as kinds of them are counted
    @settings(
        max_examples=EXAMPLES,
        derandomize=True,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
    )
    @given(robots(), st.data())
    def check(model: RobotModel, data: st.DataObject) -> None:
        tree = build_tree(model, data.draw(st.sampled_from(tuple(model.links))))
        contacts = data.draw(contacts_on(tuple(model.links)))
        joints, root = _free(model, data.draw(st.integers(0, 2**31)))
        robot = touch(model, tree, joints, root, contacts, seed=7)
        question = Question(
            tree=tree,
            measured=robot.measured.names,
            contacts=contacts,
            minimum_norm=MinimumNorm(length_scale=0.3),
            net_wrenches=tuple(model.links),
        )
        found = estimate(question, joints, root, measured=robot.measured, known=_known(robot, contacts))
        for link in model.links:
            np.testing.assert_allclose(
                found.net_wrench(link), robot.simulation.net_wrench(link), rtol=0, atol=RECOVERED
            )
        for k, part in enumerate(question.parts):
            there = question.unknown_in(part)
            unknowns = sum(len(contact.type.unknowns) for contact in there)
            if part.sensor is None or not (found.rank[:, k] == unknowns).all():
                continue
            if unknowns and found.condition[:, k].max() > MOST_CONDITION:
                continue
            np.testing.assert_allclose(found.residual_of(part.name), 0.0, rtol=0, atol=RECOVERED)
            for contact in there:
                wanted = robot.truth[contact.name]
                np.testing.assert_allclose(found.contact(contact.name), wanted, rtol=0, atol=RECOVERED)
                seen[contact.type] += 1
        seen[KNOWN] += bool(question.known)

    check()
    assert min(seen.values()) >= 5, seen


def _known(robot: Touched, contacts: tuple[Contact, ...]) -> Wrenches | None:
    known = {contact.name: robot.truth[contact.name] for contact in contacts if contact.type is KNOWN}
    return Wrenches.of(known) if known else None


@pytest.mark.parametrize("evaluator", Evaluator)
def test_a_wrench_known_from_skin_restores_the_other_contact(evaluator: Evaluator) -> None:
    """With the forearm's wrench known the hand's is right; without, it takes the forearm's upon itself."""
    hand, forearm = _contact("l_hand", WRENCH, 1), _contact("l_forearm", KNOWN, 2)
    robot = touched([hand, forearm])
    answers: dict[bool, FloatArray] = {}
    for told in (True, False):
        contacts = (hand, forearm) if told else (hand,)
        question = Question(tree=robot.tree, measured=("l_arm_ft",), contacts=contacts, equations=())
        known = _known(robot, contacts)
        found = estimate(question, robot.joints, robot.root, measured=robot.measured, known=known, evaluator=evaluator)
        answers[told] = found.contact(hand.name)
    np.testing.assert_allclose(answers[True], robot.truth[hand.name], rtol=0, atol=RECOVERED)
    alone = Simulation(robot.model, robot.tree.root_link, robot.joints, robot.root)
    alone.touch(forearm, robot.truth[forearm.name])
    of_forearm = robot.in_contact(hand, alone.on_links["l_forearm"])
    np.testing.assert_allclose(answers[False], robot.truth[hand.name] + of_forearm, rtol=0, atol=RECOVERED)
    assert np.abs(of_forearm).max() > VISIBLE


@pytest.mark.parametrize("evaluator", Evaluator)
def test_contacts_that_come_and_go_equal_separate_estimations(evaluator: Evaluator) -> None:
    """Samples with the same contacts are as if only those had been asked about, torques among them."""
    hand, forearm = _contact("l_hand", WRENCH, 1), _contact("l_forearm", FORCE, 2)
    sole, root = _contact("r_sole", WRENCH, 3), _contact("root_link", WRENCH, 4)
    n = 40
    robot = touched([hand, forearm, sole], samples=n)
    rng = np.random.default_rng(6)
    active = {contact.name: rng.random(n) < 0.5 for contact in (hand, forearm, sole)}
    torques = moving_joints(robot.tree)

    def ask(contacts: tuple[Contact, ...]) -> Question:
        return Question(
            tree=robot.tree,
            measured=tuple(robot.tree.cuts),
            contacts=contacts,
            torques=torques,
            minimum_norm=MinimumNorm(length_scale=0.2),
        )

    def answer(question: Question, active: dict[str, np.ndarray] | None) -> dict[str, FloatArray]:
        found = estimate(
            question, robot.joints, robot.root, measured=robot.measured, active=active, evaluator=evaluator
        )
        wrenches = {contact.name: found.contact(contact.name) for contact in question.contacts}
        return wrenches | {"torques": found.torques, "residual": found.residual, "rank": found.rank}

    together, compared = answer(ask((hand, forearm, sole, root)), active), 0
    for marks in np.ndindex(2, 2, 2):
        there = tuple(c for c, mark in zip((hand, forearm, sole), marks, strict=True) if mark)
        samples = np.all([active[c.name] == (c in there) for c in (hand, forearm, sole)], axis=0)
        apart = answer(ask((*there, root)), None)
        for name, values in together.items():
            wanted = apart.get(name, np.zeros((n, 6)))  # a contact that is not there does nothing
            np.testing.assert_allclose(values[samples], wanted[samples], rtol=0, atol=RECOVERED)
        compared += int(samples.sum())
    assert compared == n
    always = answer(ask((hand, forearm, sole, root)), None)
    assert np.abs(always["torques"] - together["torques"]).max() > VISIBLE  # negative control
