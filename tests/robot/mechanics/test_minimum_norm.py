# SPDX-License-Identifier: BSD-3-Clause
"""Where contacts are not determined, or contradict the readings, the solution is that of a pseudo-inverse."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question
from tests.robot.mechanics.simulated import Simulation, from_root, random_pose, to_root
from tests.robot.mechanics.touched import Touched, touched

RECOVERED = 1e-9
"""N, N m: wrenches of some 1e3, 1e-13 each by rounding, times a condition of at most 1e3 and a margin of ten."""

MOST_CONDITION = 1e3

VISIBLE = 0.01
"""N, N m: what a negative control must exceed."""

DROPPED = 1e-9
"""Singular values below this part of the largest are rounding, as documented."""

PUSH = np.array([0.6, 0.0, 0.8])

ARM = {
    "two_wrenches": ((ContactType.WRENCH, "l_hand"), (ContactType.WRENCH, "l_forearm")),
    "a_wrench_a_force_and_a_push": (
        (ContactType.WRENCH, "l_forearm"),
        (ContactType.FORCE, "l_hand"),
        (ContactType.FORCE_ALONG, "l_elbow_1"),
    ),
    "two_forces": ((ContactType.FORCE, "l_hand"), (ContactType.FORCE, "l_forearm")),
    "one_force_for_six_readings": ((ContactType.FORCE, "l_hand"),),
    "pushes": ((ContactType.FORCE_ALONG, "l_hand"), (ContactType.FORCE_ALONG, "l_forearm")),
}


def _contacts(name: str) -> tuple[Contact, ...]:
    rng = np.random.default_rng(1)
    return tuple(
        Contact(
            link=link,
            type=type,
            link_H_contact=random_pose(rng, reach=0.1),
            direction=PUSH if type is ContactType.FORCE_ALONG else None,
        )
        for type, link in ARM[name]
    )


def _shaken(contacts: tuple[Contact, ...]) -> Touched:
    """The humanoid, with readings that no set of contacts on the arm may explain."""
    robot = touched(contacts)
    noise = np.random.default_rng(2).normal(size=robot.measured.values.shape)
    measured = Wrenches(names=robot.measured.names, values=robot.measured.values + 3.0 * noise)
    return Touched(robot.model, robot.tree, robot.joints, robot.root, robot.simulation, robot.truth, measured)


def _by_pseudo_inverse(robot: Touched, contacts: tuple[Contact, ...], length: float) -> dict[str, FloatArray]:
    """Smallest least-squares solution, moments divided by the length, about the origin of the sensor's body."""
    free = Simulation(robot.model, robot.tree.root_link, robot.joints, robot.root)
    cut = robot.tree.cuts["l_arm_ft"]
    link = robot.tree.bodies[cut.body].links[0]
    base = free.links[link].pose @ np.linalg.inv(robot.tree.frames[link][1])
    right = from_root(base, free.passing(robot.model.sensors["l_arm_ft"].joint) - robot.passing("l_arm_ft"))
    found = {contact.name: np.empty((len(right), 6)) for contact in contacts}
    for k in range(len(right)):
        columns, owners = [], []
        for contact in contacts:
            pose = free.links[contact.link].pose[k : k + 1] @ contact.link_H_contact
            for unit in contact.unknown_map().T:
                weight = length if unit[3:].any() else 1.0
                at_base = from_root(base[k : k + 1], to_root(pose, weight * unit[None]))[0]
                columns.append(np.concatenate([at_base[:3], at_base[3:] / length]))
                owners.append((contact.name, weight * unit))
        demand = np.concatenate([right[k, :3], right[k, 3:] / length])
        solution = np.linalg.pinv(np.column_stack(columns), rcond=DROPPED) @ demand
        for values in found.values():
            values[k] = 0.0
        for (name, unit), size in zip(owners, solution, strict=True):
            found[name][k] += size * unit
    return found


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("length", [0.05, 0.3, 2.0])
@pytest.mark.parametrize("name", ARM)
def test_solution_is_that_of_a_weighted_pseudo_inverse(name: str, length: float, evaluator: Evaluator) -> None:
    """Any contacts on an arm: the least residual, and of those solutions the smallest, for several length scales."""
    contacts = _contacts(name)
    robot = _shaken(contacts)
    question = Question(
        tree=robot.tree,
        measured=("l_arm_ft",),
        contacts=contacts,
        equations=("l_arm_ft",),
        minimum_norm=MinimumNorm(length_scale=length),
    )
    found = estimate(question, robot.joints, robot.root, measured=robot.measured, evaluator=evaluator)
    assert found.condition.max() < MOST_CONDITION
    wanted = _by_pseudo_inverse(robot, contacts, length)
    assert len(wanted) == len(contacts)
    for contact in contacts:
        np.testing.assert_allclose(found.contact(contact.name), wanted[contact.name], rtol=0, atol=RECOVERED)
    other = _by_pseudo_inverse(robot, contacts, 3.0 * length)
    assert max(np.abs(other[c.name] - wanted[c.name]).max() for c in contacts) > VISIBLE  # negative control


@pytest.mark.parametrize("evaluator", Evaluator)
def test_readings_that_contacts_explain_leave_nothing(evaluator: Evaluator) -> None:
    """Undetermined contacts explain all the same; no other solution with that residual is smaller."""
    contacts, length = _contacts("two_wrenches"), 0.3
    robot = touched(contacts)
    question = Question(
        tree=robot.tree,
        measured=("l_arm_ft",),
        contacts=contacts,
        equations=("l_arm_ft",),
        minimum_norm=MinimumNorm(length_scale=length),
    )
    found = estimate(question, robot.joints, robot.root, measured=robot.measured, evaluator=evaluator)
    assert (found.rank == 6).all()
    np.testing.assert_allclose(found.residual, 0.0, rtol=0, atol=RECOVERED)

    def size(wrenches: list[FloatArray]) -> FloatArray:
        weighted = [np.concatenate([w[:, :3], w[:, 3:] / length], axis=1) for w in wrenches]
        norm: FloatArray = np.linalg.norm(np.concatenate(weighted, axis=1), axis=1)
        return norm

    truth = [robot.truth[contact.name] for contact in contacts]
    ours = [found.contact(contact.name) for contact in contacts]
    assert (size(ours) < size(truth)).all()
    steps = [t - o for t, o in zip(truth, ours, strict=True)]  # the readings do not see these
    for part in (-0.1, 0.1):
        assert (size(ours) < size([o + part * s for o, s in zip(ours, steps, strict=True)])).all()
