# SPDX-License-Identifier: BSD-3-Clause
"""A gap makes NaN of what depends on it, in its sample alone; what is not needed may be missing altogether."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, TorqueSum, moving_joints, required_joints_of
from forcetorque.robot.motion import JointMotion, RootMotion
from tests.robot.mechanics.touched import Touched, touched

SAMPLES, GAP = 140, 131
"""More than one block of the compiled evaluator; the gap is in the second."""

PARTS = ("root_link", "l_arm_ft", "r_arm_ft", "l_leg_ft", "r_leg_ft", "l_foot_ft", "r_foot_ft")

CONTACTS = (
    Contact(link="root_link"),
    Contact(link="l_hand"),
    Contact(link="r_hand", type=ContactType.FORCE),
    Contact(link="l_lower_leg"),
    Contact(link="r_lower_leg", type=ContactType.FORCE),
    Contact(link="l_sole"),
    Contact(link="r_sole"),
    Contact(link="l_forearm", name="skin", type=ContactType.KNOWN),
)


@dataclass
class _Inputs:
    """What the gaps are put in."""

    robot: Touched
    position: FloatArray
    velocity: FloatArray
    readings: dict[str, FloatArray]
    skin: FloatArray
    omega: FloatArray

    def answer(self, evaluator: Evaluator, torque_sum: TorqueSum) -> Estimates:
        robot, tree = self.robot, self.robot.tree
        question = Question(
            tree=tree,
            measured=tuple(tree.cuts),
            contacts=CONTACTS,
            torques=moving_joints(tree),
            torque_sum=torque_sum,
            expected=tuple(tree.cuts),
            net_wrenches=("l_forearm", "chest", "r_foot"),
        )
        joints = JointMotion(
            names=robot.joints.names,
            position=self.position,
            velocity=self.velocity,
            acceleration=robot.joints.acceleration,
        )
        root = RootMotion(
            proper_acceleration=robot.root.proper_acceleration,
            angular_velocity=self.omega,
            angular_acceleration=robot.root.angular_acceleration,
        )
        measured, known = Wrenches.of(self.readings), Wrenches.of({"skin": self.skin})
        return estimate(question, joints, root, measured=measured, known=known, evaluator=evaluator)


def _inputs() -> _Inputs:
    robot = touched(CONTACTS, samples=SAMPLES)
    return _Inputs(
        robot,
        np.array(robot.joints.position),
        np.array(robot.joints.velocity),
        {sensor: np.array(robot.measured.of_name(sensor)) for sensor in robot.tree.cuts},
        np.array(robot.truth["skin"]),
        np.array(robot.root.angular_velocity),
    )


def _elbow(inputs: _Inputs) -> None:
    inputs.position[GAP, inputs.robot.joints.names.index("l_elbow")] = np.nan


def _ankle(inputs: _Inputs) -> None:
    inputs.velocity[GAP, inputs.robot.joints.names.index("r_ankle_pitch")] = np.nan


def _reading(inputs: _Inputs) -> None:
    inputs.readings["r_leg_ft"][GAP] = np.nan


def _skin(inputs: _Inputs) -> None:
    inputs.skin[GAP] = np.nan


def _root(inputs: _Inputs) -> None:
    inputs.omega[GAP] = np.nan


Gaps = dict[str, set[str]]

EVERYTHING: Gaps = {
    "expected": set(PARTS[1:]),
    "contacts": {contact.name for contact in CONTACTS[:-1]},
    "residual": set(PARTS),
    "links": {"l_forearm", "chest", "r_foot"},
}

CASES: dict[str, tuple[Callable[[_Inputs], None], Gaps]] = {
    # the elbow is beyond the sensor of the arm: nothing else sees it
    "position_of_an_elbow": (
        _elbow,
        {"expected": {"l_arm_ft"}, "contacts": {"l_hand"}, "residual": {"l_arm_ft"}, "links": {"l_forearm"}},
    ),
    # the ankle is inboard of the foot's sensor: it moves the foot and is part of the leg
    "velocity_of_an_ankle": (
        _ankle,
        {
            "expected": {"r_leg_ft", "r_foot_ft"},
            "contacts": {"r_lower_leg", "r_sole"},
            "residual": {"r_leg_ft", "r_foot_ft"},
            "links": {"r_foot"},
        },
    ),
    # a reading is in the equations of both sides
    "reading_of_a_leg": (
        _reading,
        {
            "expected": set(),
            "contacts": {"root_link", "r_lower_leg"},
            "residual": {"root_link", "r_leg_ft"},
            "links": set(),
        },
    ),
    # what is known of an arm is also part of what the robot needs from its one contact
    "wrench_known_from_skin": (
        _skin,
        {"expected": {"l_arm_ft"}, "contacts": {"l_hand"}, "residual": {"l_arm_ft"}, "links": set()},
    ),
    "motion_of_the_root": (_root, EVERYTHING),
}


def _fields(found: Estimates) -> dict[str, tuple[tuple[str, ...], FloatArray]]:
    return {
        "expected": (found.layout.sensors, found.expected),
        "contacts": (found.layout.contacts, found.contact_wrenches),
        "residual": (found.layout.parts, found.residual),
        "links": (found.layout.links, found.net_wrenches),
    }


def _gaps(values: FloatArray) -> BoolArray:
    """Which names of which samples have a gap."""
    gaps: BoolArray = np.isnan(values).any(axis=2)
    return gaps


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize("case", CASES)
def test_a_gap_is_nan_where_it_matters_and_nowhere_else(case: str, evaluator: Evaluator) -> None:
    """By hand: what each gap touches is NaN in its sample; all else is to the last bit as without the gap."""
    spoil, wanted = CASES[case]
    inputs = _inputs()
    whole = inputs.answer(evaluator, TorqueSum.WHOLE_TREE)
    spoil(inputs)
    found = inputs.answer(evaluator, TorqueSum.WHOLE_TREE)
    compared = 0
    for field, (names, values) in _fields(found).items():
        gaps = _gaps(values)
        assert {names[k] for k in np.flatnonzero(gaps[GAP])} == wanted[field], field
        assert not np.delete(gaps, GAP, axis=0).any()
        np.testing.assert_array_equal(values[~gaps], _fields(whole)[field][1][~gaps])
        compared += int((~gaps).sum())
    assert compared > 10 * SAMPLES
    spoilt_parts = np.array([name in wanted["residual"] for name in found.layout.parts])
    np.testing.assert_array_equal(np.isnan(found.condition[GAP]), spoilt_parts)
    np.testing.assert_array_equal(found.rank[GAP] == 0, spoilt_parts)
    assert not np.isnan(np.delete(found.torques, GAP, axis=0)).any()


@pytest.mark.parametrize("torque_sum", TorqueSum)
@pytest.mark.parametrize("evaluator", Evaluator)
def test_a_gap_beyond_a_full_wrench_is_none_inboard(evaluator: Evaluator, torque_sum: TorqueSum) -> None:
    """What an arm does beyond its sensor is in the reading: the shoulder's torque does not see its elbow."""
    inputs = _inputs()
    _elbow(inputs)
    found = inputs.answer(evaluator, torque_sum)
    spoilt = {joint for joint in found.layout.joints if np.isnan(found.torque(joint)[GAP])}
    assert {"l_elbow", "l_wrist_prosup", "l_wrist_pitch"} & spoilt
    assert not spoilt & {"l_shoulder_pitch", "l_shoulder_roll", "torso_yaw", "r_elbow", "l_knee"}


@pytest.mark.parametrize("evaluator", Evaluator)
def test_only_what_is_needed_is_looked_at(evaluator: Evaluator) -> None:
    """One foot's expected reading needs the joints on the way to it; the others may be absent, or NaN."""
    robot = touched([], samples=SAMPLES)
    question = Question(tree=robot.tree, expected=("l_foot_ft",), equations=())
    needed = required_joints_of(question)
    assert set(needed) == {"l_hip_pitch", "l_hip_roll", "l_hip_yaw", "l_knee", "l_ankle_pitch", "l_ankle_roll"}
    columns = [robot.joints.names.index(joint) for joint in needed]
    arrays = (robot.joints.position, robot.joints.velocity, robot.joints.acceleration)
    few = JointMotion(names=needed, **dict(zip(FIELDS, (a[:, columns] for a in arrays), strict=True)))
    holes = [np.full_like(a, np.nan) for a in arrays]
    for hole, values in zip(holes, arrays, strict=True):
        hole[:, columns] = values[:, columns]
    gappy = JointMotion(names=robot.joints.names, **dict(zip(FIELDS, holes, strict=True)))
    all_of_it = estimate(question, robot.joints, robot.root, evaluator=evaluator).expected
    assert np.isfinite(all_of_it).all()
    for joints in (few, gappy):
        np.testing.assert_array_equal(estimate(question, joints, robot.root, evaluator=evaluator).expected, all_of_it)
    for k, joint in enumerate(needed):  # negative control: each of these is needed
        lame = [np.array(a) for a in (few.position, few.velocity, few.acceleration)]
        lame[0][:, k] += 0.1
        moved = JointMotion(names=needed, **dict(zip(FIELDS, lame, strict=True)))
        other = estimate(question, moved, robot.root, evaluator=evaluator).expected
        assert np.abs(other - all_of_it).max() > 0.01, joint


FIELDS = ("position", "velocity", "acceleration")


@pytest.mark.parametrize("evaluator", Evaluator)
def test_expected_readings_beside_the_one_contact(evaluator: Evaluator) -> None:
    """A sensor that is not between the root and the one contact reads as if the root were held."""
    robot = touched([])
    held, beside = (
        estimate(
            Question(tree=robot.tree, expected=("l_arm_ft",), expected_contact=link),
            robot.joints,
            robot.root,
            evaluator=evaluator,
        ).expected
        for link in ("root_link", "r_sole")
    )
    np.testing.assert_array_equal(held, beside)
    beyond = Question(tree=robot.tree, expected=("l_arm_ft",), expected_contact="l_hand")
    assert np.abs(estimate(beyond, robot.joints, robot.root, evaluator=evaluator).expected - held).max() > 1.0
