# SPDX-License-Identifier: BSD-3-Clause
"""The equations of all sub-models at once, linear in unknowns and errors, and the answers that are linear in both.

    C x + G e = r        what contacts, readings and their errors do is what the bodies need to move as they do
    y = c + A x + B e    wrenches of contacts, and torques: what is outboard of a joint inside its sub-model

Along the axes of the root link and about its origin. Readings are part of the equation on both of their sides, so that
an error of one appears in both, and what one side tells of it the other profits from.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.estimation.question import Question
from forcetorque.estimation.uncertain.actions import Action, Actor
from forcetorque.robot.sub_model import SubModel, outboard_bodies
from forcetorque.robot.tree import Connection
from forcetorque.spatial import invert_pose, wrench_matrix


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Affine:
    """Rows that are linear in unknowns x and errors e of unit variance."""

    constant: FloatArray
    """Shape (n, r)."""
    free: FloatArray
    """Shape (n, r, u)."""
    errors: FloatArray
    """Shape (n, r, m)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scene:
    """What acts on which body, and what the bodies need."""

    question: Question
    """What is asked."""
    actors: Sequence[Actor]
    """What acts."""
    actions: Sequence[Action]
    """What that does to which body."""
    needs: Mapping[int, FloatArray]
    """What moves each body as it moves, along the axes of the root link and about its origin; shape (n, 6)."""
    poses: Mapping[int, FloatArray]
    """`root_H_body`; shape (n, 4, 4); m."""

    def equations(self, parts: Sequence[SubModel]) -> Affine:
        """Stack the equations of sub-models, with r on the left side: what acts less what is needed.

        Args:
            parts: The sub-models.

        Returns:
            Six rows each.
        """
        return _stacked([self._sum(set(part.bodies), np.eye(6)) for part in parts], self._width)

    def contact_rows(self) -> Affine:
        """Give the wrenches of all contacts, unknown ones first, each in its frame.

        Returns:
            Six rows each.
        """
        count = len(self.question.contacts)
        return _stacked([self._spread(k, np.eye(6), actor.given) for k, actor in self._numbered(count)], self._width)

    def torque_rows(self) -> Affine:
        """Give the torques that are wanted.

        Returns:
            A row each.
        """
        joints = {body.joint: index for index, body in enumerate(self.question.tree.bodies) if body.joint is not None}
        return _stacked([self._torque(joints[joint]) for joint in self.question.torques], self._width)

    @property
    def lasting(self) -> BoolArray:
        """Which errors stay the same from sample to sample; shape (m,)."""
        marks = [np.arange(k := actor.errors.shape[2]) >= k - actor.lasting for actor in self.actors]
        return np.concatenate([np.zeros(0, dtype=np.bool_), *marks])

    def _torque(self, index: int) -> Affine:
        """What moves the outboard bodies of the sub-model less what acts on them, along the joint."""
        tree = self.question.tree
        component = 2 if tree.bodies[index].connection is Connection.PRISMATIC else 5
        along = wrench_matrix(invert_pose(self.poses[index]))[:, component : component + 1]  # (n, 1, 6)
        part = next(part for part in self.question.parts if index in part.bodies)
        beyond = outboard_bodies(tree, index)
        return self._sum({body for body in part.bodies if beyond[body]}, -along)

    def _sum(self, bodies: set[int], rows: FloatArray) -> Affine:
        """Rows times what acts on bodies less what they need."""
        count = rows.shape[-2]
        n, unknowns, errors = self._width
        constant = np.zeros((n, count))
        free, wrong = np.zeros((n, count, unknowns)), np.zeros((n, count, errors))
        for body in bodies & set(self.needs):
            constant -= (rows @ self.needs[body][:, :, None])[:, :, 0]
        for action in self.actions:
            if action.body in bodies:
                term = self._spread(action.actor, rows @ action.root_X_actor, self.actors[action.actor].given)
                constant += term.constant
                free += term.free
                wrong += term.errors
        return Affine(constant=constant, free=free, errors=wrong)

    def _spread(self, number: int, rows: FloatArray, given: FloatArray) -> Affine:
        """Rows times the wrench of one actor, in the columns that are its own."""
        n, unknowns, errors = self._width
        actor, matrix = self.actors[number], np.broadcast_to(rows, (n, *rows.shape[-2:]))
        free, wrong = np.zeros((n, rows.shape[-2], unknowns)), np.zeros((n, rows.shape[-2], errors))
        first, start = self._starts[number]
        free[:, :, first : first + actor.free.shape[2]] = matrix @ actor.free
        wrong[:, :, start : start + actor.errors.shape[2]] = matrix @ actor.errors
        return Affine(constant=(matrix @ given[:, :, None])[:, :, 0], free=free, errors=wrong)

    def _numbered(self, count: int) -> list[tuple[int, Actor]]:
        return list(enumerate(self.actors[:count]))

    @property
    def _starts(self) -> list[tuple[int, int]]:
        """First column of each actor among unknowns and errors."""
        unknowns = accumulate((actor.free.shape[2] for actor in self.actors), initial=0)
        errors = accumulate((actor.errors.shape[2] for actor in self.actors), initial=0)
        return list(zip(unknowns, errors, strict=True))

    @property
    def _width(self) -> tuple[int, int, int]:
        """Samples, unknowns, errors."""
        unknowns, errors = self._starts[-1]
        return len(next(iter(self.poses.values()))), unknowns, errors


def _stacked(blocks: Sequence[Affine], width: tuple[int, int, int]) -> Affine:
    n, unknowns, errors = width
    return Affine(
        constant=np.concatenate([np.zeros((n, 0)), *(block.constant for block in blocks)], axis=1),
        free=np.concatenate([np.zeros((n, 0, unknowns)), *(block.free for block in blocks)], axis=1),
        errors=np.concatenate([np.zeros((n, 0, errors)), *(block.errors for block in blocks)], axis=1),
    )
