# SPDX-License-Identifier: BSD-3-Clause
"""Unknowns that trade off against each other are named, group by group, and no others."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.robot.contacts import Contact, ContactType
from forcetorque.robot.mechanics.contact_wrenches_and_torques import indistinguishable
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question
from forcetorque.robot.motion import JointMotion
from tests.robot.mechanics.touched import Touched, touched

FORCE, WRENCH, ALONG = ContactType.FORCE, ContactType.WRENCH, ContactType.FORCE_ALONG

SHIFT = [0.1, 0.0, 0.0]
"""m, along x: what trades off can be told by hand."""


def _at(name: str, point: list[float], type: ContactType, *, link: str = "l_forearm") -> Contact:
    return Contact.at_point(link, point, name=name, type=type, direction=np.eye(3)[0] if type is ALONG else None)


CASES: dict[str, tuple[tuple[Contact, ...], tuple[tuple[str, ...], ...], int]] = {
    "two_forces_push_along_their_line": (
        (_at("a", [0, 0, 0], FORCE), _at("b", SHIFT, FORCE)),
        (("a.fx", "b.fx"),),
        5,
    ),
    "a_force_beside_a_wrench": (
        (_at("a", [0, 0, 0], WRENCH), _at("b", SHIFT, FORCE)),
        (("a.fx", "b.fx"), ("a.fy", "a.tz", "b.fy"), ("a.fz", "a.ty", "b.fz")),
        6,
    ),
    "a_push_along_the_line_to_a_force": (
        (_at("a", [0, 0, 0], FORCE), _at("b", SHIFT, ALONG)),
        (("a.fx", "b.f"),),
        3,
    ),
    "a_push_across_the_line_to_a_force": ((_at("a", [0, 0, 0], FORCE), _at("b", [0, 0.1, 0], ALONG)), (), 4),
    "a_wrench": ((_at("a", [0, 0, 0], WRENCH),), (), 6),
    "one_place_twice": (
        (_at("a", SHIFT, FORCE), _at("b", SHIFT, FORCE)),
        (("a.fx", "b.fx"), ("a.fy", "b.fy"), ("a.fz", "b.fz")),
        3,
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_groups_are_those_by_hand(case: str) -> None:
    """Contacts on one link, displaced along x: which components a lever couples is plain; the rank fits."""
    contacts, groups, rank = CASES[case]
    robot = touched([])
    question = Question(
        tree=robot.tree,
        measured=("l_arm_ft",),
        contacts=contacts,
        equations=("l_arm_ft",),
        minimum_norm=MinimumNorm(length_scale=0.3),
    )
    found = indistinguishable(question, robot.joints)
    assert found == ({"l_arm_ft": groups} if groups else {})
    answer = estimate(question, robot.joints, robot.root, measured=robot.measured)
    assert (answer.rank == rank).all()


def test_two_forces_on_one_limb_are_six_unknowns_of_rank_five() -> None:
    """Two forces on links that move against each other: all six components take part, as the line between turns."""
    contacts = (_at("hand", [0, 0, 0], FORCE, link="l_hand"), _at("arm", [0, 0, 0], FORCE))
    robot = touched(contacts, samples=30)
    question = Question(tree=robot.tree, measured=("l_arm_ft",), contacts=contacts, equations=("l_arm_ft",))
    assert (_ask(question, robot).rank == 5).all()
    names = tuple(f"{name}.f{axis}" for name in ("hand", "arm") for axis in "xyz")
    assert indistinguishable(question, robot.joints) == {"l_arm_ft": (names,)}
    # the trade-off is what the answer lacks: along it lies the difference to the truth
    error = {name: _ask(question, robot).contact(name) - robot.truth[name] for name in ("hand", "arm")}
    assert np.abs(error["hand"]).max() > 0.1
    for name, wrong in error.items():
        np.testing.assert_allclose(wrong[:, 3:], 0.0, atol=1e-12, err_msg=name)


def _ask(question: Question, robot: Touched) -> Estimates:
    return estimate(question, robot.joints, robot.root, measured=robot.measured)


def test_contacts_that_are_never_there_together_do_not_trade_off() -> None:
    """Taking turns, two wrenches on an arm are told apart; one shared sample of many suffices to lose that."""
    contacts = (_at("a", [0, 0, 0], WRENCH), _at("b", SHIFT, WRENCH))
    robot = touched([], samples=1000)
    question = Question(
        tree=robot.tree, measured=("l_arm_ft",), contacts=contacts, minimum_norm=MinimumNorm(length_scale=0.3)
    )
    first = np.arange(1000) < 500
    assert indistinguishable(question, robot.joints, active={"a": first, "b": ~first}) == {}
    both = first.copy()
    both[777] = True
    groups = indistinguishable(question, robot.joints, active={"a": both, "b": ~first})
    assert {name for group in groups["l_arm_ft"] for name in group} >= {"a.fx", "b.fx", "a.tz", "b.tz"}


def test_a_gap_in_the_poses_hides_nothing() -> None:
    """Poses with gaps are passed over; with no whole pose nothing is claimed."""
    contacts = CASES["two_forces_push_along_their_line"][0]
    robot = touched([], samples=3)
    position = np.array(robot.joints.position)
    question = Question(tree=robot.tree, measured=("l_arm_ft",), contacts=contacts, equations=())
    position[1:] = np.nan
    joints = JointMotion.at_rest(robot.joints.names, position)
    assert indistinguishable(question, joints) == {"l_arm_ft": (("a.fx", "b.fx"),)}
    assert indistinguishable(question, JointMotion.at_rest(joints.names, position[1:])) == {}
