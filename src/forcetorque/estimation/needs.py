# SPDX-License-Identifier: BSD-3-Clause
"""What the answer to a question depends on: bodies and joints, nothing more."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray
from forcetorque.estimation.contact import ContactType
from forcetorque.estimation.question import Question, TorqueSum
from forcetorque.robot import BodyTree
from forcetorque.robot.sub_model import SubModel, cut_of, outboard_bodies

QUESTIONS: Final = 32
"""Questions whose needs are remembered: a control loop asks the same one for every sample."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Needs:
    """What has to be computed for a question."""

    moving: BoolArray
    """Bodies whose motion is needed; shape (bodies,)."""
    carrying: BoolArray
    """Bodies whose wrench is needed and may differ from zero; shape (bodies,)."""
    solved: tuple[SubModel, ...]
    """Sub-models whose equation is solved, inboard ones first."""
    leaving: tuple[SubModel, ...]
    """Those of them beyond a sensor whose residual is part of a wanted torque, inboard ones first."""

    def joints(self, tree: BodyTree) -> tuple[str, ...]:
        """Name the joints whose motion is needed.

        Args:
            tree: The robot.

        Returns:
            Joints, each once, from the root outwards; leaders instead of joints that mimic.
        """
        bodies = (body for body, moves in zip(tree.bodies, self.moving, strict=True) if moves)
        return tuple(dict.fromkeys(body.coordinate.joint for body in bodies if body.coordinate is not None))


def needs_of(question: Question, *, switched: Collection[str] = ()) -> Needs:
    """Find what a question depends on.

    Bodies without inertia that carry nothing are left out, so their joints may be absent from a log.

    Args:
        question: The question.
        switched: Contacts that are not there in every sample.

    Returns:
        The needs.
    """
    return _needs(question, frozenset(switched))


def required_joints_of(question: Question) -> tuple[str, ...]:
    """Name the joints whose motion the answer depends on.

    Args:
        question: The question.

    Returns:
        Joints, each once, from the root outwards; leaders instead of joints that mimic.
    """
    return needs_of(question).joints(question.tree)


def closed_form(question: Question, part: SubModel) -> bool:
    """Tell whether one full wrench takes up whatever the equation of a sub-model demands.

    Args:
        question: The question.
        part: One of its sub-models.

    Returns:
        True for a single unknown contact of type wrench.
    """
    return [contact.type for contact in question.unknown_in(part)] == [ContactType.WRENCH]


@lru_cache(maxsize=QUESTIONS)
def _needs(question: Question, switched: frozenset[str]) -> Needs:
    tree = question.tree
    wanted = np.zeros(len(tree.bodies), dtype=bool)
    solved = {part.name for part in question.parts if part.name in question.layout.parts or question.unknown_in(part)}
    leaving: set[str] = set()
    for index, body in enumerate(tree.bodies):
        if body.joint in question.torques and body.joint is not None:
            _add_torque(question, index, switched, wanted, solved, leaving)
    for part in question.parts:
        if part.name in solved:
            wanted[list(part.bodies)] = True
    path = question.expected_path()
    for sensor in question.expected:
        cut = cut_of(tree, sensor)
        wanted |= True if cut in path else outboard_bodies(tree, cut)
    carrying = wanted & _with_content(question)
    moving = carrying.copy()
    moving[[tree.frames[link][0] for link in question.net_wrenches]] = True
    for index in reversed(range(1, len(tree.bodies))):
        moving[tree.bodies[index].parent] |= moving[index]
    for marks in (moving, carrying):
        marks.setflags(write=False)
    return Needs(
        moving=moving,
        carrying=carrying,
        solved=tuple(part for part in question.parts if part.name in solved),
        leaving=tuple(part for part in question.parts if part.name in leaving),
    )


def _add_torque(
    question: Question, body: int, switched: Collection[str], wanted: BoolArray, solved: set[str], leaving: set[str]
) -> None:
    outboard = outboard_bodies(question.tree, body)
    beyond = []
    for part in question.parts:
        if body in part.bodies:
            wanted[[index for index in part.bodies if outboard[index]]] = True
            if any(outboard[question.body_of(contact)] for contact in question.unknown_in(part)):
                solved.add(part.name)
        elif outboard[part.base]:
            beyond.append(part)
    if question.torque_sum is TorqueSum.SUB_MODEL:
        return
    open_parts = [part for part in beyond if not _takes_up_all(question, part, switched)]
    for part in beyond:
        # what is left in a part passes through those between it and the joint
        if any(outboard_bodies(question.tree, part.base)[other.base] for other in open_parts):
            solved.add(part.name)
            leaving.add(part.name)


def _takes_up_all(question: Question, part: SubModel, switched: Collection[str]) -> bool:
    """Whether the equation of a sub-model has no residual: then the sum over it is the reading at its base."""
    return closed_form(question, part) and question.unknown_in(part)[0].name not in switched


def _with_content(question: Question) -> BoolArray:
    """Mark bodies that carry a wrench: of their own inertia, of a contact, of a reading, or of what hangs on them."""
    tree = question.tree
    content = np.array([not body.inertia.is_zero for body in tree.bodies])
    for contact in question.contacts:
        content[question.body_of(contact)] = True
    content[list(question.expected_path())] = True
    for sensor in question.measured:
        content[tree.cuts[sensor].body] = True
    for index in reversed(range(1, len(tree.bodies))):
        content[tree.bodies[index].parent] |= content[index]
    return content
