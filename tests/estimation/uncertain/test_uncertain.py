# SPDX-License-Identifier: BSD-3-Clause
"""Covariances go linearly to contacts and torques: against the plain estimator, by hand, and by drawing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError
from forcetorque.estimation.uncertain.estimate_with_covariance import estimate_with_covariance
from forcetorque.estimation.uncertain.input_errors import Actor, Tangents, Uncertainty, wrench_covariances
from forcetorque.estimation.uncertain.sub_model_posterior import Affine, _sparse_basis, posterior_of, undetermined_of
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, TorqueSum, moving_joints
from forcetorque.robot.tree import build_tree
from tests.robot.mechanics.simulated import random_pose, random_root
from tests.robot.mechanics.touched import Touched, touch, touched
from tests.scenes.robots import joint_xml, link_xml, random_motion, read_text, robot_xml

ROUNDING = 1e-7
"""N, N m: wrenches of some 1e3 by 1e-13 each, through matrices of condition 1e3."""
DRAWS = 4000
SPREAD = 0.12
"""A standard deviation of 4000 draws is off by 1.1 %, the largest of hundreds by 4 %; correlations a little more."""
VISIBLE = 0.5
"""Relative; what a negative control must exceed."""


def _covariance(seed: int, size: float) -> FloatArray:
    half = np.random.default_rng(seed).normal(size=(6, 6)) * size
    return half @ half.T


ALONE = ("l_leg_ft", "r_arm_ft")
"""Sensors with an unknown wrench beyond each, so that no equation is surplus."""


def _pushed(cut: tuple[str, ...] | None = None) -> tuple[Touched, Question, Wrenches]:
    """A humanoid held at its root link, with unknown wrenches and a known one on limbs, cut at all sensors or some."""
    rng = np.random.default_rng(4)
    contacts = (
        Contact(link="l_lower_leg", name="skin", type=ContactType.KNOWN, link_H_contact=random_pose(rng)),
        Contact(link="l_foot", name="foot", link_H_contact=random_pose(rng)),
        Contact(link="r_hand", name="hand", link_H_contact=random_pose(rng)),
        Contact(link="root_link"),
    )
    robot = touched(contacts[:-1])
    held = robot.simulation.total_needed() - np.sum(list(robot.simulation.on_links.values()), axis=0)
    robot.simulation.touch(contacts[-1], held)
    robot.truth["root_link"] = held
    sensors = cut or tuple(robot.tree.cuts)
    measured = Wrenches.of({sensor: robot.simulation.reading(sensor) for sensor in sensors})
    joints = moving_joints(robot.tree)
    question = Question(
        tree=robot.tree, measured=sensors, contacts=contacts, torques=joints, torque_sum=TorqueSum.SUB_MODEL
    )
    return robot, question, measured


def test_exact_input_gives_the_truth_and_no_spread() -> None:
    """Without covariance the answer is the simulation's, as is that of the plain estimator."""
    robot, question, measured = _pushed()
    known = Wrenches.of({"skin": robot.truth["skin"]})
    answer = estimate_with_covariance(question, robot.joints, robot.root, measured=measured, known=known)
    plain = estimate(question, robot.joints, robot.root, measured=measured, known=known)
    for name in ("foot", "hand", "root_link", "skin"):
        np.testing.assert_allclose(answer.contact(name), robot.truth[name], rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(answer.torques, plain.torques, rtol=0, atol=ROUNDING)
    for joint in question.torques:
        np.testing.assert_allclose(answer.torque(joint), robot.simulation.torque(joint), rtol=0, atol=ROUNDING)
    assert not answer.undetermined
    assert np.abs(answer.torque_covariance).max() == 0.0


@pytest.mark.long
def test_covariance_is_that_of_draws() -> None:
    """What readings and skin err by comes out as their covariance says, in every contact and torque."""
    robot, question, measured = _pushed(ALONE)
    first = _first_sample(robot, measured)
    covariances = {name: _covariance(k, 0.03) for k, name in enumerate(question.measured)}
    of_skin = _covariance(9, 0.1)
    uncertainty = Uncertainty(measured=covariances, known={"skin": of_skin})
    inputs = {"joints": first.joints, "root": first.root}
    known = Wrenches.of({"skin": robot.truth["skin"][:1]})
    answer = estimate_with_covariance(question, **inputs, measured=first.measured, known=known, uncertainty=uncertainty)
    contacts, torques = _drawn(question, first, known, covariances, of_skin)
    looked = 0
    for name in ("foot", "hand", "root_link"):
        ratio = contacts[name].std(axis=0) / answer.contact_sd(name)[0]
        np.testing.assert_allclose(ratio, 1.0, rtol=0, atol=SPREAD)
        looked += 1
    told = answer.torque_sd[0]
    moved = told > ROUNDING
    np.testing.assert_allclose(torques.std(axis=0)[moved] / told[moved], 1.0, rtol=0, atol=SPREAD)
    np.testing.assert_allclose(torques.std(axis=0)[~moved], 0.0, rtol=0, atol=ROUNDING)
    drawn = np.corrcoef(torques[:, moved].T)
    stated = answer.torque_covariance[0][np.ix_(moved, moved)] / np.outer(told[moved], told[moved])
    np.testing.assert_allclose(stated, drawn, rtol=0, atol=SPREAD)
    assert looked == 3
    assert moved.sum() > 10
    # negative control: twice the errors are seen
    wrong = estimate_with_covariance(
        question,
        **inputs,
        measured=first.measured,
        known=known,
        uncertainty=replace(uncertainty, known={"skin": 4.0 * of_skin}),
    )
    assert np.abs(wrong.contact_sd("foot") / answer.contact_sd("foot") - 1.0).max() > VISIBLE


def _first_sample(robot: Touched, measured: Wrenches) -> Touched:
    joints = robot.joints.samples(slice(0, 1))
    root = type(robot.root)(
        **{
            name: getattr(robot.root, name)[:1]
            for name in ("proper_acceleration", "angular_velocity", "angular_acceleration")
        }
    )
    return replace(robot, joints=joints, root=root, measured=Wrenches(names=measured.names, values=measured.values[:1]))


def _drawn(
    question: Question, first: Touched, known: Wrenches, covariances: dict[str, FloatArray], of_skin: FloatArray
) -> tuple[dict[str, FloatArray], FloatArray]:
    """Errors of the plain estimator, by drawing."""
    rng = np.random.default_rng(5)
    values = np.repeat(first.measured.values, DRAWS, axis=0)
    for k, name in enumerate(first.measured.names):
        values[:, k] += rng.multivariate_normal(np.zeros(6), covariances[name], DRAWS)
    skin = known.of_name("skin") + rng.multivariate_normal(np.zeros(6), of_skin, DRAWS)
    joints = type(first.joints)(
        names=first.joints.names,
        **{
            name: np.repeat(getattr(first.joints, name), DRAWS, axis=0)
            for name in ("position", "velocity", "acceleration")
        },
    )
    plain = estimate(
        question,
        joints,
        first.root,
        measured=Wrenches(names=first.measured.names, values=values),
        known=Wrenches.of({"skin": skin}),
    )
    return {name: plain.contact(name) for name in ("foot", "hand", "root_link")}, plain.torques


def test_a_surplus_equation_weighs_both_by_their_covariance() -> None:
    """A known wrench and a sensor that both tell one contact: the mean of the two by inverse covariance, by hand."""
    robot, question, measured = _pushed()
    contacts = tuple(
        Contact(link=c.link, name=c.name, type=ContactType.KNOWN, link_H_contact=c.link_H_contact)
        if c.name in ("hand", "foot", "skin")
        else c
        for c in question.contacts
    )
    asked = replace(question, contacts=contacts)
    true = {name: robot.truth[name] for name in ("hand", "foot", "skin")}
    wrong = {**true, "hand": true["hand"] + 1.0}
    at_hand, at_arm = _covariance(1, 0.2), _covariance(2, 0.1)
    answer = estimate_with_covariance(
        asked,
        robot.joints,
        robot.root,
        measured=measured,
        known=Wrenches.of(wrong),
        uncertainty=Uncertainty(known={"hand": at_hand}, measured={"r_arm_ft": at_arm}),
    )
    hand = next(c for c in contacts if c.name == "hand")
    into_hand = _into_hand(robot, hand)
    looked = 0
    for k, matrix in enumerate(into_hand):
        seen = matrix @ at_arm @ matrix.T
        gain = at_hand @ np.linalg.inv(at_hand + seen)
        by_hand = wrong["hand"][k] + gain @ (true["hand"][k] - wrong["hand"][k])
        np.testing.assert_allclose(answer.contact("hand")[k], by_hand, rtol=0, atol=ROUNDING)
        np.testing.assert_allclose(answer.covariance_of("hand")[k], at_hand - gain @ at_hand, rtol=0, atol=ROUNDING)
        looked += 1
    assert looked == len(robot.joints)


def _into_hand(robot: Touched, hand: Contact) -> FloatArray:
    """How an error of the arm's sensor would be a wrench at the hand, (n, 6, 6)."""
    columns = []
    for unit in np.eye(6):
        moved = replace(robot, measured=Wrenches.of({"r_arm_ft": np.tile(unit, (len(robot.joints), 1))}))
        columns.append(robot.in_contact(hand, moved.passing("r_arm_ft")))
    return np.stack(columns, axis=2)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (np.diag([1.0, 1.0, 1.0, 1.0, 1.0, -1.0]), "no negative eigenvalue, got -1"),
        (np.eye(6) + np.eye(6, k=1), "a symmetric matrix"),
        (np.diag([np.inf, 1.0, 1.0, 1.0, 1.0, 1.0]), "finite numbers"),
    ],
)
def test_what_is_no_covariance_is_refused(change: FloatArray, words: str) -> None:
    """Of whom, in which sample, and what is wrong."""
    several = np.stack([np.eye(6), change])
    with pytest.raises(EstimationError, match=f"covariance of 'skin', sample 1: expected {words}"):
        wrench_covariances(several, name="skin", samples=2)
    robot, question, measured = _pushed()
    known = Wrenches.of({"skin": robot.truth["skin"]})
    with pytest.raises(EstimationError, match="covariance of 'skin', sample 0"):
        estimate_with_covariance(
            question,
            robot.joints,
            robot.root,
            measured=measured,
            known=known,
            uncertainty=Uncertainty(known={"skin": change}),
        )


def test_an_unknown_name_is_refused() -> None:
    """A covariance of what the question does not have is a mistake, not nothing."""
    robot, question, measured = _pushed()
    known = Wrenches.of({"skin": robot.truth["skin"]})
    with pytest.raises(EstimationError, match="the question has none of 'l_leg'"):
        estimate_with_covariance(
            question,
            robot.joints,
            robot.root,
            measured=measured,
            known=known,
            uncertainty=Uncertainty(measured={"l_leg": np.eye(6)}),
        )


def test_a_slide_bears_a_force_and_a_hinge_a_moment(tmp_path: Path) -> None:
    """Of a robot that slides, in motion and touched at its tip: its joints bear what Newton's laws demand."""
    model = read_text(
        robot_xml(
            *(
                link_xml(name, mass=1.5, xyz="0.1 0.02 0", moments="0.02 0 0 0.02 0 0.02")
                for name in ("base", "upper", "fore")
            ),
            joint_xml("slide", "base", "upper", type="prismatic", xyz="0 0.2 0.1", rpy="0 0.5 0", axis="0 1 1"),
            joint_xml("turn", "upper", "fore", type="continuous", xyz="0.1 0.1 0", rpy="-0.6 0 0.2", axis="0 -3 1"),
        ),
        tmp_path,
    )
    contacts = (
        Contact(link="fore", name="tip", type=ContactType.KNOWN, link_H_contact=random_pose(np.random.default_rng(6))),
        Contact(link="base"),
    )
    motion, root, tree = random_motion(model, samples=5, seed=1), random_root(5, 2), build_tree(model, "base")
    robot = touch(model, tree, motion, root, contacts[:1], seed=3)
    question = Question(tree=tree, contacts=contacts, torques=("slide", "turn"), torque_sum=TorqueSum.SUB_MODEL)
    answer = estimate_with_covariance(question, motion, root, known=Wrenches.of({"tip": robot.truth["tip"]}))
    for joint in question.torques:
        np.testing.assert_allclose(answer.torque(joint), robot.simulation.torque(joint), rtol=0, atol=ROUNDING)
        assert np.abs(answer.torque(joint)).max() > VISIBLE


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_one_equation_of_two_unknowns_by_hand(unit: float) -> None:
    """Of x - 2 + 3 e = 0 follow x = 2 - 3 e and nothing of y, in any unit."""
    equation = Affine(constant=np.array([[-2.0]]), free=np.array([[[1.0, 0.0]]]), errors=np.array([[[3.0]]]))
    wanted = Affine(constant=np.array([[5.0, 0.0]]), free=unit * np.eye(2)[None], errors=np.zeros((1, 2, 1)))
    posterior = posterior_of(equation)
    mean, wrong = posterior.linear(wanted)
    np.testing.assert_allclose(mean, [[5.0 + 2.0 * unit, np.nan]], rtol=1e-12)
    np.testing.assert_allclose(wrong, [[[-3.0 * unit], [np.nan]]], rtol=1e-12)
    assert (posterior.rank[0], posterior.condition[0]) == (1, 1.0)


@pytest.mark.parametrize("size", [1e-8, 1.0, 1e8])
def test_rounding_is_told_from_a_negative_variance_in_any_unit(size: float) -> None:
    """A covariance of any size may have eigenvalues that rounding makes negative, and no others."""
    shape = np.diag([1.0, 1.0, 1.0, 1.0, 1.0, -1e-13])
    np.testing.assert_array_equal(wrench_covariances(size * shape, name="skin", samples=1)[0], size * shape)
    shape[5, 5] = -1e-4
    with pytest.raises(EstimationError, match="no negative eigenvalue"):
        wrench_covariances(size * shape, name="skin", samples=1)


@pytest.mark.parametrize("size", [1e-8, 1.0, 1e8])
def test_rounding_is_told_from_an_asymmetry_in_any_unit(size: float) -> None:
    """A covariance of any size may be as unsymmetric as rounding makes it, and no more."""
    shape = np.eye(6) + 1e-13 * np.eye(6, k=1)
    np.testing.assert_array_equal(wrench_covariances(size * shape, name="skin", samples=1)[0], size * shape)
    shape[0, 1] = 1e-4
    with pytest.raises(EstimationError, match="a symmetric matrix"):
        wrench_covariances(size * shape, name="skin", samples=1)


def test_the_residual_is_what_neither_unknowns_nor_errors_explain() -> None:
    """All parts add up to what is needed, and no change of the unknowns would make the residual smaller."""
    rng = np.random.default_rng(8)
    equations = Affine(
        constant=rng.normal(size=(3, 7)), free=rng.normal(size=(3, 7, 3)), errors=rng.normal(size=(3, 7, 2))
    )
    found = posterior_of(equations)
    acting = np.einsum("nru,nu->nr", equations.free, found.unknowns)
    erring = np.einsum("nrm,nm->nr", equations.errors, found.errors)
    np.testing.assert_allclose(equations.constant + acting + erring + found.residual, 0.0, atol=1e-12)
    np.testing.assert_allclose(np.einsum("nru,nr->nu", equations.free, found.residual), 0.0, atol=1e-12)
    np.testing.assert_allclose(np.einsum("nrm,nr->nm", equations.errors, found.residual), 0.0, atol=1e-12)
    assert np.linalg.norm(found.residual, axis=1).min() > 0.1


@pytest.mark.parametrize("unit", [1e-8, 1.0, 1e8])
def test_rank_and_condition_are_those_of_the_unknowns_in_any_unit(unit: float) -> None:
    """As numpy has them; equations in another unit determine the same unknowns to the same accuracy."""
    rng = np.random.default_rng(9)
    free, errors, constant = rng.normal(size=(3, 7, 4)), rng.normal(size=(3, 7, 9)), rng.normal(size=(3, 7))
    free[1, :, 3] = free[1, :, 0] - free[1, :, 1]
    found = posterior_of(Affine(constant=unit * constant, free=unit * free, errors=unit * errors))
    assert found.rank.tolist() == np.linalg.matrix_rank(free).tolist() == [4, 3, 4]
    values = np.linalg.svd(free, compute_uv=False)
    np.testing.assert_allclose(found.condition, values[:, 0] / values[[0, 1, 2], found.rank - 1], rtol=1e-9)
    in_newtons = posterior_of(Affine(constant=constant, free=free, errors=errors))
    for name in ("unknowns", "by_errors", "errors", "left", "hidden"):
        np.testing.assert_allclose(getattr(found, name), getattr(in_newtons, name), atol=1e-9)


def test_friction_of_a_known_bound_widens_the_covariance_of_a_push() -> None:
    """The same contacts and torques as of a push whose covariance has the slip in it."""
    robot, question, measured = _pushed(ALONE)
    known = Wrenches.of({"skin": robot.truth["skin"] + 0.1})
    rng, n = np.random.default_rng(11), len(robot.joints)
    of_skin, maps, sizes = _covariance(3, 0.1), rng.normal(size=(n, 6, 2)), rng.uniform(0.5, 2.0, n)
    slip = sizes[:, None, None] ** 2 * maps @ maps.swapaxes(1, 2)
    at_leg = {"l_leg_ft": _covariance(4, 0.1)}
    by_slip, by_covariance = (
        estimate_with_covariance(
            question, robot.joints, robot.root, measured=measured, known=known, uncertainty=uncertainty
        )
        for uncertainty in (
            Uncertainty(measured=at_leg, known={"skin": of_skin}, tangents={"skin": Tangents(maps=maps, sd_N=sizes)}),
            Uncertainty(measured=at_leg, known={"skin": of_skin + slip}),
        )
    )
    for name in ("contact_wrenches", "contact_covariance", "torques", "torque_covariance", "residual"):
        np.testing.assert_allclose(getattr(by_slip, name), getattr(by_covariance, name), rtol=0, atol=ROUNDING)
    assert np.abs(by_slip.contact_sd("foot")).max() > VISIBLE


def test_a_slip_that_nothing_bounds_is_found_by_sensors_on_both_sides() -> None:
    """Skin feels the push alone; exact sensors show what it lacks along either tangent, without any bound."""
    robot, question, measured = _pushed()
    rng, n = np.random.default_rng(17), len(robot.joints)
    maps, slip = rng.normal(size=(n, 6, 2)), rng.normal(size=(n, 2, 1))
    known = Wrenches.of({"skin": robot.truth["skin"] - (maps @ slip)[:, :, 0]})
    found, blind = (
        estimate_with_covariance(
            question, robot.joints, robot.root, measured=measured, known=known, uncertainty=Uncertainty(tangents=own)
        )
        for own in ({"skin": Tangents(maps=maps)}, {})
    )
    for name, wrench in robot.truth.items():
        np.testing.assert_allclose(found.contact(name), wrench, rtol=0, atol=1e2 * ROUNDING)
    np.testing.assert_allclose(found.contact_covariance, 0.0, atol=ROUNDING)
    # negative control: with the tangents taken as zero, skin is believed
    assert np.abs(blind.contact("skin") - robot.truth["skin"]).max() > VISIBLE


def test_a_basis_of_what_is_hidden_has_each_unknown_once() -> None:
    """Vectors that span the range of a projection, as Gauss and Jordan eliminate them."""
    rng = np.random.default_rng(13)
    columns = np.linalg.qr(rng.normal(size=(7, 3)))[0]
    basis = np.array(_sparse_basis(columns @ columns.T))
    assert np.linalg.matrix_rank(basis) == len(basis) == 3
    np.testing.assert_allclose(basis @ columns @ columns.T, basis, atol=1e-12)
    eliminated = [k for k in range(7) if np.allclose(np.sort(basis[:, k]), [0.0, 0.0, 1.0], atol=1e-12)]
    assert len(eliminated) == 3


def test_what_no_reading_sees_is_named_in_newtons() -> None:
    """Two wrenches of 4 N and 2 N m per unknown that cancel: the largest component is made 1 N; absent ones do not."""
    acts = np.array([0.0, 4.0, 0.0, 0.0, 0.0, 2.0])
    actors = [
        Actor(
            name=name,
            unknowns=("push",),
            given=np.zeros((1, 6)),
            free=sign * acts[None, :, None],
            errors=np.zeros((1, 6, 0)),
        )
        for name, sign in (("shin", 1.0), ("knee", 0.0), ("toe", -1.0))
    ]
    seen = np.concatenate([actor.free for actor in actors], axis=2)
    equation = Affine(constant=np.zeros((1, 6)), free=seen, errors=np.zeros((1, 6, 0)))
    (found,) = undetermined_of(actors, posterior_of(equation).hidden)
    assert found.contacts == ("shin", "toe")
    assert found.directions == (
        "a force of (0.00, 1.00, 0.00) N at 'shin' and a moment of (0.00, 0.00, 0.50) N m at 'shin' and "
        "a force of (0.00, -1.00, 0.00) N at 'toe' and a moment of (0.00, 0.00, -0.50) N m at 'toe'",
    )


@pytest.mark.parametrize(("moment", "named"), [(0.0052, True), (0.0048, False)])
def test_what_prints_as_zero_is_left_out(moment: float, named: bool) -> None:
    """A moment of half a hundredth of the largest component is the least that two decimals show."""
    acts = np.array([1.0, 0.0, 0.0, 0.0, 0.0, moment])
    actor = Actor(
        name="shin",
        unknowns=("push",),
        given=np.zeros((1, 6)),
        free=acts[None, :, None],
        errors=np.zeros((1, 6, 0)),
    )
    (found,) = undetermined_of([actor], np.ones((1, 1, 1)))
    force, *rest = found.directions[0].split(" and ")
    assert force == "a force of (1.00, 0.00, 0.00) N at 'shin'"
    assert rest == (["a moment of (0.00, 0.00, 0.01) N m at 'shin'"] if named else [])


def test_a_gap_stays_in_its_sample() -> None:
    """NaN in a reading makes NaN of that sample and of no other."""
    robot, question, measured = _pushed()
    values = measured.values.copy()
    values[2, 0, 3] = np.nan
    answer = estimate_with_covariance(
        question,
        robot.joints,
        robot.root,
        measured=Wrenches(names=measured.names, values=values),
        known=Wrenches.of({"skin": robot.truth["skin"]}),
    )
    gap = np.isnan(answer.torques).any(axis=1)
    assert gap.tolist() == [k == 2 for k in range(len(answer))]
    assert not answer.undetermined
