# SPDX-License-Identifier: BSD-3-Clause
"""Torques as sums over the whole tree and inside sub-models: where they agree, and by how much they do not."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, TorqueSum, moving_joints
from tests.robot.mechanics.simulated import Simulation
from tests.robot.mechanics.touched import Touched, touched

ROUNDING = 1e-9
"""N m: wrenches of some 1e3, 1e-13 each by rounding, times a condition of at most 1e3 and a margin of ten."""

VISIBLE = 0.1
"""N m: what a negative control must exceed."""

FULL = ("l_hand", "r_hand", "l_lower_leg", "r_lower_leg", "l_sole", "r_sole", "root_link")
"""Links on all seven sub-models."""


def _shaken(root_link: str) -> Touched:
    """The humanoid, with readings that only full wrenches explain."""
    robot = touched([], root_link=root_link)
    values = 30.0 * np.random.default_rng(2).normal(size=robot.measured.values.shape)
    measured = Wrenches(names=robot.measured.names, values=values)
    return Touched(robot.model, robot.tree, robot.joints, robot.root, robot.simulation, robot.truth, measured)


def _contacts(robot: Touched, without_full: tuple[str, ...]) -> tuple[Contact, ...]:
    types = {link: ContactType.FORCE if link in without_full else ContactType.WRENCH for link in FULL}
    return tuple(Contact(link=link, type=type) for link, type in types.items())


def _answer(robot: Touched, contacts: tuple[Contact, ...], torque_sum: TorqueSum, evaluator: Evaluator) -> Estimates:
    question = Question(
        tree=robot.tree,
        measured=tuple(robot.tree.cuts),
        contacts=contacts,
        torques=moving_joints(robot.tree),
        torque_sum=torque_sum,
    )
    return estimate(question, robot.joints, robot.root, measured=robot.measured, evaluator=evaluator)


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("root_link", ["root_link", "r_sole", "head"])
def test_both_sums_agree_where_a_full_wrench_takes_up_everything(root_link: str, evaluator: Evaluator) -> None:
    """With a full wrench on every sub-model both sums are what the links and contacts outboard add up to."""
    robot = _shaken(root_link)
    contacts = _contacts(robot, ())
    whole, inside = (_answer(robot, contacts, torque_sum, evaluator) for torque_sum in TorqueSum)
    np.testing.assert_allclose(whole.torques, inside.torques, rtol=0, atol=ROUNDING)
    state = Simulation(robot.model, robot.tree.root_link, robot.joints, robot.root)
    for contact in contacts:
        state.touch(contact, whole.contact(contact.name))
    for joint in whole.layout.joints:
        np.testing.assert_allclose(inside.torque(joint), state.torque(joint), rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(whole.residual, 0.0, rtol=0, atol=ROUNDING)
    open_foot, open_inside = (_answer(robot, _contacts(robot, ("l_sole",)), s, evaluator) for s in TorqueSum)
    assert np.abs(open_foot.torques - open_inside.torques).max() > VISIBLE  # negative control


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("root_link", ["root_link", "r_sole", "head"])
@pytest.mark.parametrize("open_links", [("l_sole",), ("l_lower_leg", "l_sole"), ("r_hand", "r_sole", "root_link")])
def test_each_sum_is_that_of_its_links(open_links: tuple[str, ...], root_link: str, evaluator: Evaluator) -> None:
    """Each torque is the sum it claims, done link by link; they differ by the residuals of outboard sub-models."""
    robot = _shaken(root_link)
    contacts = _contacts(robot, open_links)
    whole, inside = (_answer(robot, contacts, torque_sum, evaluator) for torque_sum in TorqueSum)
    np.testing.assert_array_equal(whole.contact_wrenches, inside.contact_wrenches)
    state = Simulation(robot.model, robot.tree.root_link, robot.joints, robot.root)
    for contact in contacts:
        state.touch(contact, whole.contact(contact.name))
    sensors = {sensor: robot.model.sensors[sensor].joint for sensor in robot.tree.cuts}
    # what is left of a sub-model and everything beyond it, less that of what is beyond it
    left = {sensor: state.passing(joint) - robot.passing(sensor) for sensor, joint in sensors.items()}
    differing = 0
    for joint in whole.layout.joints:
        far = state.far_side[joint]
        beyond = [s for s, at in sensors.items() if state.far_side[at] < far]
        nearest = [
            s for s in beyond if not any(state.far_side[sensors[s]] < state.far_side[sensors[o]] for o in beyond)
        ]
        sign = 1.0 if robot.model.joints[joint].child in far else -1.0
        np.testing.assert_allclose(whole.torque(joint), state.torque(joint), rtol=0, atol=ROUNDING)
        difference = np.sum([state.along(joint, left[sensor]) for sensor in nearest], axis=0)
        predicted = np.broadcast_to(sign * difference, len(robot.joints))
        np.testing.assert_allclose(whole.torque(joint) - inside.torque(joint), predicted, rtol=0, atol=ROUNDING)
        differing += bool(np.abs(predicted).max() > VISIBLE)
    assert differing >= 2
    assert differing < len(whole.layout.joints)
