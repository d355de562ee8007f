# SPDX-License-Identifier: BSD-3-Clause
"""Random robots, questions and inputs: structure is drawn by Hypothesis, numbers come from a seeded generator."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from hypothesis import strategies as st

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.inertia import Inertia
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question, TorqueSum, moving_joints
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointType, Mimic, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree
from tests.robot.mechanics.simulated import random_pose, random_root

MOST_LINKS = 9

MATTER = ("solid", "solid", "massless", "massless but inert")
"""Kinds of links; real models have all of them."""


@dataclass(frozen=True, kw_only=True)
class Problem:
    """A question and all that it is answered from."""

    model: RobotModel
    question: Question
    joints: JointMotion
    root: RootMotion
    measured: Wrenches | None
    known: Wrenches | None
    active: dict[str, BoolArray]

    def inputs(self) -> dict[str, Any]:
        """Arguments of `estimate` but for the evaluator."""
        return {
            "joints": self.joints,
            "root": self.root,
            "measured": self.measured,
            "known": self.known,
            "active": self.active or None,
        }


def random_unit(rng: np.random.Generator) -> FloatArray:
    """A direction."""
    vector = rng.normal(size=3)
    unit: FloatArray = vector / np.linalg.norm(vector)
    return unit


def random_inertia(rng: np.random.Generator, matter: str) -> Inertia:
    """Inertia of a link of some kind."""
    if matter == "massless":
        return Inertia.zero()
    half = rng.normal(size=(3, 3))
    mass = float(rng.uniform(0.2, 4.0)) if matter == "solid" else 0.0
    return Inertia.about_centre_of_mass(
        mass=mass, centre_of_mass=rng.uniform(-0.2, 0.2, 3), second_moment=0.02 * half @ half.T
    )


@st.composite
def robots(draw: st.DrawFn) -> RobotModel:
    """Trees of up to nine links with joints and sensors of every kind."""
    rng = np.random.default_rng(draw(st.integers(0, 2**31)))
    count = draw(st.integers(2, MOST_LINKS))
    links = {f"link{i}": random_inertia(rng, draw(st.sampled_from(MATTER))) for i in range(count)}
    joints: dict[str, Joint] = {}
    sensors: dict[str, ForceTorqueSensor] = {}
    for i in range(1, count):
        type = draw(st.sampled_from([*JointType, JointType.FIXED]))
        leaders = [name for name, joint in joints.items() if joint.type.moves]
        follows = type.moves and leaders and draw(st.integers(0, 4)) == 0
        mimic = None
        if follows:
            multiplier, offset = rng.uniform(-2, 2, 2).tolist()
            mimic = Mimic(leader=draw(st.sampled_from(leaders)), multiplier=multiplier, offset=offset)
        joints[f"joint{i}"] = Joint(
            name=f"joint{i}",
            type=type,
            parent=f"link{draw(st.integers(0, i - 1))}",
            child=f"link{i}",
            parent_H_child=random_pose(rng),
            axis=random_unit(rng),
            mimic=mimic,
        )
        if not type.moves and draw(st.integers(0, 3)) > 0:
            sensors[f"ft{i}"] = ForceTorqueSensor(
                name=f"ft{i}",
                joint=f"joint{i}",
                frame=draw(st.sampled_from(SensorFrame)),
                direction=draw(st.sampled_from(MeasureDirection)),
                child_H_sensor=random_pose(rng),
            )
    return RobotModel(name="random", links=links, joints=joints, sensors=sensors)


def contacts_on(links: tuple[str, ...]) -> st.SearchStrategy[tuple[Contact, ...]]:
    """Up to five contacts of any type, several on a link among them."""

    @st.composite
    def contacts(draw: st.DrawFn) -> tuple[Contact, ...]:
        rng = np.random.default_rng(draw(st.integers(0, 2**31)))
        made = []
        for k in range(draw(st.integers(0, 5))):
            type = draw(st.sampled_from(ContactType))
            made.append(
                Contact(
                    link=draw(st.sampled_from(links)),
                    name=f"contact{k}",
                    type=type,
                    link_H_contact=random_pose(rng),
                    direction=random_unit(rng) if type is ContactType.FORCE_ALONG else None,
                )
            )
        return tuple(made)

    return contacts()


def _some(names: tuple[str, ...]) -> st.SearchStrategy[tuple[str, ...]]:
    return st.lists(st.sampled_from(names), unique=True).map(tuple) if names else st.just(())


@st.composite
def questions(draw: st.DrawFn, model: RobotModel) -> Question:
    """Questions of all that may be asked of a robot, from any of its links."""
    links = tuple(model.links)
    tree: BodyTree = build_tree(model, draw(st.sampled_from(links)))
    measured = draw(_some(tuple(tree.cuts)))
    return Question(
        tree=tree,
        measured=measured,
        contacts=draw(contacts_on(links)),
        torques=draw(_some(moving_joints(tree))),
        torque_sum=draw(st.sampled_from(TorqueSum)),
        equations=draw(st.none() | _some((tree.root_link, *measured))),
        minimum_norm=MinimumNorm(length_scale=draw(st.sampled_from([0.1, 0.3, 1.0]))),
        expected=draw(_some(tuple(tree.cuts))),
        expected_contact=draw(st.none() | st.sampled_from(links)),
        net_wrenches=draw(_some(links)),
    )


@st.composite
def problems(draw: st.DrawFn) -> Problem:
    """Questions with random inputs, contacts that come and go, and gaps."""
    model = draw(robots())
    question = draw(questions(model))
    n = draw(st.sampled_from([1, 3, 131]))  # the last fills more than one block of the compiled evaluator
    rng = np.random.default_rng(draw(st.integers(0, 2**31)))
    names = tuple(joint for joint in model.joints if model.joints[joint].type.moves)
    position, velocity, acceleration = rng.uniform(-2.0, 2.0, size=(3, n, len(names)))
    measured, known = ({name: 20.0 * rng.normal(size=(n, 6)) for name in some} for some in _given(question))
    if draw(st.booleans()):
        missing = rng.random(position.shape) < 0.02
        for array in (position, velocity, acceleration):
            array[missing] = np.nan
        for array in (*measured.values(), *known.values()):
            array[rng.random(n) < 0.02] = np.nan
    switched = draw(_some(tuple(contact.name for contact in question.unknown)))
    return Problem(
        model=model,
        question=question,
        joints=JointMotion(names=names, position=position, velocity=velocity, acceleration=acceleration),
        root=random_root(n, draw(st.integers(0, 2**31))),
        measured=Wrenches.of(measured) if measured else None,
        known=Wrenches.of(known) if known else None,
        active={name: rng.random(n) < 0.5 for name in switched},
    )


def _given(question: Question) -> tuple[tuple[str, ...], tuple[str, ...]]:
    return question.measured, tuple(contact.name for contact in question.known)
