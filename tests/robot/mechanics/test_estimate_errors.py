# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be answered is refused, with the place and what would have been right."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import EstimationError, ForceTorqueError, RobotError, ShapeError
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question
from forcetorque.robot.motion import JointMotion, RootMotion
from tests.robot.mechanics.touched import Touched, touched

SAMPLES = 140
"""More than one block of the compiled evaluator."""

HAND, ARM = Contact(link="l_hand"), Contact(link="l_forearm")
SKIN = Contact(link="l_forearm", name="skin", type=ContactType.KNOWN)


@pytest.fixture(scope="module")
def robot() -> Touched:
    """A robot that nothing touches."""
    return touched([], samples=SAMPLES)


def _ask(robot: Touched, *contacts: Contact, **more: Any) -> Question:
    return Question(tree=robot.tree, measured=("l_arm_ft",), contacts=contacts, **more)


def _arrays(robot: Touched) -> dict[str, np.ndarray]:
    return {field: np.array(getattr(robot.joints, field)) for field in ("position", "velocity", "acceleration")}


INFINITE: dict[str, tuple[Callable[[dict[str, np.ndarray]], Any], str]] = {
    "position": (lambda a: a["position"], "joint position.*l_elbow is inf in sample 133"),
    "velocity": (lambda a: a["velocity"], "joint velocity.*l_elbow is inf in sample 133"),
    "acceleration": (lambda a: a["acceleration"], "joint acceleration.*l_elbow is inf in sample 133"),
}


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("field", INFINITE)
def test_an_infinite_joint_is_named(robot: Touched, field: str, evaluator: Evaluator) -> None:
    """Infinity is no gap: the message has the column and the sample; where it is not needed it is not looked at."""
    arrays = _arrays(robot)
    pick, message = INFINITE[field]
    pick(arrays)[133, robot.joints.names.index("l_elbow")] = np.inf
    joints = JointMotion(names=robot.joints.names, **arrays)
    with pytest.raises(EstimationError, match=message):
        estimate(_ask(robot, HAND), joints, robot.root, measured=robot.measured, evaluator=evaluator)
    foot = Question(tree=robot.tree, expected=("l_foot_ft",), equations=())
    assert np.isfinite(estimate(foot, joints, robot.root, evaluator=evaluator).expected).all()


@pytest.mark.parametrize("evaluator", Evaluator)
def test_an_infinite_wrench_or_root_is_named(robot: Touched, evaluator: Evaluator) -> None:
    """Readings, known wrenches and the root's motion are looked through as well."""
    question = _ask(robot, HAND, SKIN)
    for name, pattern in (("l_arm_ft", "measured: .*l_arm_ft is -inf in sample 5"), ("skin", "known: .*skin is -inf")):
        arrays = {"l_arm_ft": np.zeros((SAMPLES, 6)), "skin": np.zeros((SAMPLES, 6))}
        arrays[name][5, 2] = -np.inf
        wrenches = Wrenches.of(arrays)
        with pytest.raises(EstimationError, match=pattern):
            estimate(question, robot.joints, robot.root, measured=wrenches, known=wrenches, evaluator=evaluator)
    omega = np.zeros((SAMPLES, 3))
    omega[7, 1] = np.inf
    root = RootMotion(proper_acceleration=np.zeros(3), angular_velocity=omega, angular_acceleration=np.zeros(3))
    fine = Wrenches.of({"l_arm_ft": np.zeros((SAMPLES, 6)), "skin": np.zeros((SAMPLES, 6))})
    with pytest.raises(EstimationError, match="root motion, angular velocity: .*y is inf in sample 7"):
        estimate(question, robot.joints, root, measured=fine, known=fine, evaluator=evaluator)


@pytest.mark.parametrize("evaluator", Evaluator)
def test_no_unknown_reports_the_residual(robot: Touched, evaluator: Evaluator) -> None:
    """An arm without contacts is no error: its residual is reading less expectation, up to the sensor's sign."""
    noise = np.random.default_rng(1).normal(size=robot.measured.values.shape)
    measured = Wrenches(names=robot.measured.names, values=robot.measured.values + noise)
    question = _ask(robot, expected=("l_arm_ft",), equations=("l_arm_ft",))
    found = estimate(question, robot.joints, robot.root, measured=measured, evaluator=evaluator)
    difference = measured.of_name("l_arm_ft") - found.expected_of("l_arm_ft")
    sign = robot.tree.cuts["l_arm_ft"].sign
    np.testing.assert_allclose(found.residual_of("l_arm_ft"), -sign * difference, rtol=0, atol=1e-11)
    assert np.abs(difference).max() > 0.1
    assert (found.rank == 0).all()
    assert np.isnan(found.condition).all()


def _with(**fields: Any) -> Callable[[Touched], object]:
    return lambda robot: Question(tree=robot.tree, **fields)


def _estimate(robot: Touched, *contacts: Contact, **inputs: Any) -> Estimates:
    question = _ask(robot, *contacts, **inputs.pop("question", {}))
    arguments = {"joints": robot.joints, "root": robot.root, "measured": robot.measured} | inputs
    return estimate(question, **arguments)


ZEROS = np.zeros((SAMPLES, 6))

REFUSED: dict[str, tuple[Callable[[Touched], object], type[ForceTorqueError], str]] = {
    "unknown_link": (_with(contacts=(Contact(link="l_hnd"),)), RobotError, 'no frame or link.*"l_hand"'),
    "unknown_net_link": (_with(net_wrenches=("l_hnd",)), RobotError, 'did you mean "l_hand"'),
    "unknown_expected_contact": (_with(expected_contact="l_sle"), RobotError, 'did you mean "l_sole"'),
    "unknown_sensor": (_with(expected=("l_arm",)), RobotError, 'did you mean "l_arm_ft"'),
    "unknown_measured": (_with(measured=("l_arm",)), RobotError, 'did you mean "l_arm_ft"'),
    "measured_twice": (_with(measured=("l_arm_ft", "l_arm_ft")), RobotError, "at one joint"),
    "unknown_torque": (_with(torques=("l_elbw",)), RobotError, 'did you mean "l_elbow"'),
    "torque_of_a_fixed_joint": (_with(torques=("l_arm_ft_sensor",)), RobotError, "no moving joint"),
    "torque_twice": (_with(torques=("l_elbow", "l_elbow")), RobotError, "'l_elbow': expected each once"),
    "net_of_nothing": (_with(net_wrenches=("",)), RobotError, "no frame or link"),
    "unknown_equation": (_with(equations=("l_arm_ft",)), EstimationError, "no sub-model 'l_arm_ft'.*root_link"),
    "contacts_of_one_name": (_with(contacts=(HAND, HAND)), EstimationError, "'l_hand' comes again"),
    "unknown_torque_sum": (_with(torque_sum="half"), ValueError, "half"),  # type: ignore[dict-item]
    "no_length": (lambda _: MinimumNorm(length_scale=0.0), ShapeError, "positive length"),
    "direction_missing": (lambda _: Contact(link="x", type=ContactType.FORCE_ALONG), ShapeError, "a direction"),
    "direction_unwanted": (lambda _: Contact(link="x", direction=np.array([1.0, 0, 0])), ShapeError, "no direction"),
    "direction_not_unit": (
        lambda _: Contact(link="x", type=ContactType.FORCE_ALONG, direction=np.array([1.0, 1.0, 0])),
        ShapeError,
        "unit direction",
    ),
    "pose_of_wrong_shape": (lambda _: Contact(link="x", link_H_contact=np.eye(3)), ShapeError, "link_H_contact"),
    "point_of_wrong_shape": (lambda _: Contact.at_point("x", [1.0, 2.0]), ShapeError, "point"),
    "more_than_six_unknowns": (
        lambda robot: _estimate(robot, HAND, ARM),
        EstimationError,
        "'l_arm_ft' has 12 unknowns in 'l_hand', 'l_forearm'.*minimum_norm",
    ),
    "reading_missing": (
        lambda robot: _estimate(robot, HAND, measured=Wrenches.of({"l_arm": ZEROS})),
        EstimationError,
        "reading of sensor 'l_arm_ft' is missing; did you mean",
    ),
    "readings_missing": (lambda robot: _estimate(robot, HAND, measured=None), EstimationError, "known: none"),
    "known_wrench_missing": (lambda robot: _estimate(robot, SKIN), EstimationError, "wrench of contact 'skin'"),
    "joint_missing": (
        lambda robot: _estimate(robot, HAND, joints=JointMotion.at_rest(["torso_yaw"], np.zeros((SAMPLES, 1)))),
        RobotError,
        "needs joint.*seen from 'root_link'.*known: torso_yaw",
    ),
    "readings_of_other_length": (
        lambda robot: _estimate(robot, HAND, measured=Wrenches.of({"l_arm_ft": ZEROS[:5]})),
        ShapeError,
        f"expected {SAMPLES} samples.*got 5",
    ),
    "root_of_other_length": (
        lambda robot: _estimate(
            robot,
            HAND,
            root=RootMotion(
                proper_acceleration=np.zeros((5, 3)), angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3)
            ),
        ),
        ShapeError,
        f"expected 1 or {SAMPLES} samples, got 5",
    ),
    "known_contact_switched": (
        lambda robot: _estimate(
            robot, HAND, SKIN, known=Wrenches.of({"skin": ZEROS}), active={"skin": ZEROS[:, 0] > 0}
        ),
        EstimationError,
        "no unknown contact 'skin'; known: l_hand",
    ),
    "switch_of_another_contact": (
        lambda robot: _estimate(robot, HAND, active={"l_hnd": np.ones(SAMPLES, dtype=bool)}),
        EstimationError,
        'did you mean "l_hand"',
    ),
    "switch_that_is_a_number": (
        lambda robot: _estimate(robot, HAND, active={"l_hand": np.ones(SAMPLES)}),
        ShapeError,
        "expected bool, got float64",
    ),
    "switch_of_other_length": (
        lambda robot: _estimate(robot, HAND, active={"l_hand": np.ones(5, dtype=bool)}),
        ShapeError,
        "shape",
    ),
    "out_of_another_question": (
        lambda robot: _estimate(robot, HAND, out=Estimates.empty(_ask(robot).layout, SAMPLES)),
        ShapeError,
        "out: expected",
    ),
    "out_of_other_length": (
        lambda robot: _estimate(robot, HAND, out=Estimates.empty(_ask(robot, HAND).layout, 5)),
        ShapeError,
        "out: expected",
    ),
    "out_in_single_precision": (
        lambda robot: Estimates.empty(
            _ask(robot, HAND).layout, 5, make=lambda _, shape, __: np.zeros(shape, dtype=np.float32)
        ),
        ShapeError,
        "expected a C-ordered array of float64",
    ),
    "unknown_evaluator": (lambda robot: _estimate(robot, HAND, evaluator="fast"), ValueError, "fast"),  # type: ignore[dict-item]
    "asked_for_nothing_of_it": (lambda robot: _estimate(robot, HAND).torque("l_elbow"), EstimationError, "known: none"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(robot: Touched, case: str) -> None:
    """Each mistake has its error, whose message names what was expected."""
    attempt, error, message = REFUSED[case]
    with pytest.raises(error, match=message):
        attempt(robot)


def test_more_than_six_unknowns_are_fine_if_never_at_once(robot: Touched) -> None:
    """Two wrenches on an arm that take turns need no minimum norm; once together they do."""
    first = np.arange(SAMPLES) < 70
    found = _estimate(robot, HAND, ARM, active={"l_hand": first, "l_forearm": ~first})
    assert (found.rank[:, found.layout.parts.index("l_arm_ft")] == 6).all()
    with pytest.raises(EstimationError, match="12 unknowns"):
        _estimate(robot, HAND, ARM, active={"l_hand": first, "l_forearm": np.ones(SAMPLES, dtype=bool)})
    loose = {"minimum_norm": MinimumNorm(length_scale=0.3)}
    assert np.isfinite(_estimate(robot, HAND, ARM, question=loose).contact_wrenches).all()
