# SPDX-License-Identifier: BSD-3-Clause
"""What is computed of a robot: expected wrenches, contact wrenches, torques, and what these need of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from enum import StrEnum
from functools import lru_cache
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray
from forcetorque.base.errors import EstimationError, ForceTorqueError, RobotError, ShapeError, require_known
from forcetorque.robot.contacts import Contact, ContactType
from forcetorque.robot.mechanics.estimate_arrays import Layout
from forcetorque.robot.sub_models import SubModel, sub_models
from forcetorque.robot.tree import BodyTree, cut_of, outboard_bodies, path_to_root


class TorqueSum(StrEnum):
    """Which links' net wrenches make a joint's torque; equal where outboard equations have no residual."""

    WHOLE_TREE = "whole_tree"
    """All links outboard of the joint, as in iDynTree; readings enter only by way of the contacts."""
    SUB_MODEL = "sub_model"
    """Links outboard of the joint inside its sub-model, and the readings at the cuts beyond (thesis 2.8)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MinimumNorm:
    """Leave to the smallest solution what the equation of a sub-model does not determine."""

    length_scale: float
    """Moment that weighs as much as one newton, in the norm and in the residual; m."""

    def __post_init__(self) -> None:
        if not 0.0 < self.length_scale < float("inf"):
            raise ShapeError(f"length_scale: expected a positive length in m, got {self.length_scale}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Question:
    """What to estimate; only what is asked is computed."""

    tree: BodyTree
    """Robot rooted at the link whose motion is known: that of an IMU, or the fixed one."""
    measured: tuple[str, ...] = ()
    """Sensors with readings, where the tree is cut to sub-models."""
    contacts: tuple[Contact, ...] = ()
    """Contacts with the world, unknown or known."""
    torques: tuple[str, ...] = ()
    """Joints whose torque is wanted; `moving_joints(tree)` for all."""
    torque_sum: TorqueSum = TorqueSum.WHOLE_TREE
    """Which links' wrenches make a torque."""
    equations: tuple[str, ...] | None = None
    """Sub-models whose rank, condition and residual are wanted, by the sensor at their base or the root link; None for
    all where there are readings or contacts, and for none where nothing but the model is asked."""
    minimum_norm: MinimumNorm | None = None
    """Needed where a sub-model has more than six unknowns; without it 1 N weighs like 1 N m."""
    expected: tuple[str, ...] = ()
    """Sensors whose reading is to be expected from the model; they need not be measured."""
    expected_contact: str | None = None
    """Link of the one contact that expected readings assume; the root link if None."""
    net_wrenches: tuple[str, ...] = ()
    """Links whose net wrench is wanted."""
    parts: tuple[SubModel, ...] = field(init=False)
    """Sub-models, inboard ones first."""
    layout: Layout = field(init=False)
    """Names of the columns of the result."""

    def __post_init__(self) -> None:
        for name in ("measured", "contacts", "torques", "expected", "net_wrenches"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        object.__setattr__(self, "torque_sum", TorqueSum(self.torque_sum))
        object.__setattr__(self, "parts", sub_models(self.tree, self.measured))
        names = tuple(part.name for part in self.parts)
        some = names if self.measured or self.contacts else ()
        equations = some if self.equations is None else tuple(self.equations)
        layout = Layout(
            sensors=self.expected,
            contacts=tuple(contact.name for contact in self.unknown),
            joints=self.torques,
            links=self.net_wrenches,
            parts=equations,
        )
        object.__setattr__(self, "layout", layout)
        _require_known(equations, names, "sub-model", EstimationError)
        _require_known(self.torques, moving_joints(self.tree), "moving joint", RobotError)
        links = [*self.net_wrenches, *(contact.link for contact in self.contacts)]
        links += [] if self.expected_contact is None else [self.expected_contact]
        _require_known(links, self.tree.frames, "frame or link", RobotError, once=False)
        for sensor in self.expected:
            cut_of(self.tree, sensor)
        repeated = [name for name, count in Counter(contact.name for contact in self.contacts).items() if count > 1]
        if repeated:
            raise EstimationError(f"contacts: expected each name once, {repeated[0]!r} comes again; name them apart")

    @property
    def unknown(self) -> tuple[Contact, ...]:
        """Contacts with an unknown."""
        return tuple(contact for contact in self.contacts if contact.type is not ContactType.KNOWN)

    @property
    def known(self) -> tuple[Contact, ...]:
        """Contacts whose wrench is given."""
        return tuple(contact for contact in self.contacts if contact.type is ContactType.KNOWN)

    @property
    def length_scale(self) -> float:
        """Moment that weighs as much as one newton; m."""
        return 1.0 if self.minimum_norm is None else self.minimum_norm.length_scale

    def body_of(self, contact: Contact) -> int:
        """Find the body that a contact is on.

        Returns:
            Index of the body.
        """
        return self.tree.frames[contact.link][0]

    def unknown_in(self, part: SubModel) -> tuple[Contact, ...]:
        """Pick the contacts of a sub-model that have an unknown.

        Returns:
            Its contacts, in the order of the question.
        """
        return tuple(contact for contact in self.unknown if self.body_of(contact) in part.bodies)

    def expected_path(self) -> tuple[int, ...]:
        """List the bodies from the contact of expected readings to the root.

        Returns:
            Bodies, the touched one first, the root last; the root alone where no expected sensor is in between,
            since the readings are then those of a contact there.
        """
        link = self.tree.root_link if self.expected_contact is None else self.expected_contact
        path = path_to_root(self.tree, self.tree.frames[link][0])
        between = any(self.tree.cuts[sensor].body in path for sensor in self.expected)
        return path if between else path[-1:]


def moving_joints(tree: BodyTree) -> tuple[str, ...]:
    """Name the joints that move, in the order of the tree.

    Args:
        tree: The robot.

    Returns:
        Joints, those that mimic others too: each carries a torque of its own.
    """
    return tuple(body.joint for body in tree.bodies if body.joint is not None)


def _require_known(
    wanted: Iterable[str], known: Iterable[str], what: str, error: type[ForceTorqueError], *, once: bool = True
) -> None:
    names, seen = set(known), set()
    for name in wanted:
        require_known(name, names, error, f"the robot has no {what} {name!r}")
        if once and name in seen:
            raise error(f"{what} {name!r}: expected each once, got it twice")
        seen.add(name)


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

    Returns:
        Joints, each once, from the root outwards; leaders instead of joints that mimic.
    """
    return needs_of(question).joints(question.tree)


def closed_form(question: Question, part: SubModel) -> bool:
    """Check whether one full wrench is the exact solution of the equation of a sub-model.

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
    """Mark bodies that carry a wrench: of their own inertia, of a contact, of a reading, or of their distal bodies."""
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
