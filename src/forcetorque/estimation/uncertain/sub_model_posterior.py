# SPDX-License-Identifier: BSD-3-Clause
"""The equations of all sub-models, the posterior of their unknowns, and the directions left undetermined."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import wrench_matrix
from forcetorque.estimation.uncertain.input_errors import Action, Actor
from forcetorque.robot.mechanics.contact_wrenches_and_torques import RANK_TOLERANCE
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.sub_models import SubModel
from forcetorque.robot.tree import Connection, outboard_bodies


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Affine:
    """Rows that are linear in unknowns x and errors e of unit variance."""

    constant: FloatArray
    """Shape (n, r)."""
    free: FloatArray
    """Shape (n, r, u)."""
    errors: FloatArray
    """Shape (n, r, m)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """What acts on which body, and what the bodies need."""

    question: Question
    """What is estimated."""
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

    @cached_property
    def _starts(self) -> list[tuple[int, int]]:
        """First column of each actor among unknowns and errors."""
        unknowns = accumulate((actor.free.shape[2] for actor in self.actors), initial=0)
        errors = accumulate((actor.errors.shape[2] for actor in self.actors), initial=0)
        return list(zip(unknowns, errors, strict=True))

    @cached_property
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


_SEEN = 1e-6
"""A result does not depend on undetermined directions if less than this share of it does."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Posterior:
    """What n samples of equations say; u unknowns, m errors."""

    unknowns: FloatArray
    """The likeliest unknowns, the smallest where they cannot be determined; shape (n, u)."""
    by_errors: FloatArray
    """How they follow errors; shape (n, u, m)."""
    errors: FloatArray
    """The likeliest errors; shape (n, m)."""
    left: FloatArray
    """Covariance of the errors after that, a projection; shape (n, m, m)."""
    hidden: FloatArray
    """Projection on what the equations do not see of the unknowns; shape (n, u, u)."""
    rank: IntArray
    """How many directions of the unknowns they see; shape (n,)."""
    condition: FloatArray
    """Largest over smallest singular value that is not zero; shape (n,); NaN for rank 0."""
    residual: FloatArray
    """What neither unknowns nor errors explain; shape (n, r)."""

    def linear(self, rows: Affine) -> tuple[FloatArray, FloatArray]:
        """Evaluate quantities that are linear in unknowns and errors.

        Args:
            rows: The quantities; shape (n, r).

        Returns:
            Means, shape (n, r), and what one standard deviation of each error leaves them wrong by, shape (n, r, m),
            whose product with its transpose is their covariance; NaN where they depend on what cannot be determined.
        """
        mean = rows.constant + _times(rows.free, self.unknowns) + _times(rows.errors, self.errors)
        wrong = (rows.errors + rows.free @ self.by_errors) @ self.left
        size = np.linalg.norm(rows.free, axis=2)
        open_rows = np.linalg.norm(rows.free @ self.hidden, axis=2) > _SEEN * np.maximum(
            size, np.finfo(np.float64).tiny
        )
        return np.where(open_rows, np.nan, mean), np.where(open_rows[:, :, None], np.nan, wrong)


def posterior_of(equations: Affine) -> Posterior:
    """Solve equations.

    Args:
        equations: What acts less what is needed, which is zero; in newtons; a sample with NaN gives NaN.

    Returns:
        What they say.
    """
    whole: BoolArray = np.all(np.isfinite(equations.constant), axis=1)
    for matrix in (equations.free, equations.errors):
        whole &= np.isfinite(matrix).all(axis=(1, 2))
    right = np.where(whole[:, None], -equations.constant, 0.0)
    free, errors = (np.where(whole[:, None, None], matrix, 0.0) for matrix in (equations.free, equations.errors))
    inverse, sigma = _inverse(free, np.linalg.norm(free, axis=(1, 2)))
    outside = np.eye(right.shape[1]) - free @ inverse
    seen = outside @ errors
    telling, _ = _inverse(seen, np.linalg.norm(errors, axis=(1, 2)))
    likeliest = _times(telling, _times(outside, right))
    unknowns = _times(inverse, right - _times(errors, likeliest))
    gap = np.where(whole, 0.0, np.nan)
    rank = (sigma > 0.0).sum(axis=1)
    smallest = np.where(sigma > 0.0, sigma, np.inf).min(axis=1, initial=np.inf)
    return Posterior(
        unknowns=unknowns + gap[:, None],
        by_errors=-inverse @ errors,
        errors=likeliest + gap[:, None],
        left=np.eye(errors.shape[2]) - telling @ seen + gap[:, None, None],
        hidden=whole[:, None, None] * (np.eye(free.shape[2]) - inverse @ free),
        rank=np.where(whole, rank, 0),
        condition=np.where(whole & (rank > 0), sigma.max(axis=1, initial=0.0) / smallest, np.nan),
        residual=right - _times(free, unknowns) - _times(errors, likeliest) + gap[:, None],
    )


def _inverse(matrices: FloatArray, size: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Pseudo-inverses, and singular values with zeros for those that are rounding of numbers of some size."""
    if not matrices.size:
        return np.zeros(matrices.transpose(0, 2, 1).shape), np.zeros((len(matrices), 0))
    u, sigma, vt = np.linalg.svd(matrices, full_matrices=False)
    kept = sigma > RANK_TOLERANCE * size[:, None]
    inverse = np.where(kept, 1.0 / np.where(kept, sigma, 1.0), 0.0)
    return (vt.transpose(0, 2, 1) * inverse[:, None, :]) @ u.transpose(0, 2, 1), np.where(kept, sigma, 0.0)


def _times(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    return (matrices @ vectors[:, :, None])[:, :, 0]


_PART: Final = 1e-6
"""A contact takes part in what is not seen if this share of it does."""
_SILENT: Final = 5e-3
"""N, N m: what rounds to zero in words."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Undetermined:
    """Contacts that can trade off against each other without any reading changing."""

    contacts: tuple[str, ...]
    """Their names."""
    samples: BoolArray
    """In which samples; shape (n,)."""
    directions: tuple[str, ...]
    """In the first of them: what could be added, in the contact frames."""

    @property
    def sentence(self) -> str:
        """What is not determined, and in how many samples."""
        count = int(np.count_nonzero(self.samples))
        return (
            f"not determined in {count} of {len(self.samples)} samples: no reading changes with "
            f"{'; nor with '.join(self.directions)}"
        )


def undetermined_of(actors: Sequence[Actor], hidden: FloatArray) -> tuple[Undetermined, ...]:
    """Find what is not seen.

    Args:
        actors: What acts.
        hidden: Projection of the unknowns on what the equations do not see; shape (n, u, u).

    Returns:
        One for every set of contacts that is hidden together in some samples.
    """
    owner = np.repeat(np.arange(len(actors)), [actor.free.shape[2] for actor in actors])
    present = np.concatenate([actor.free.any(axis=1) for actor in actors], axis=1)  # (n, u)
    unseen = np.einsum("nuu->nu", hidden) * present > _PART
    takes_part = np.stack([unseen[:, owner == k].any(axis=1) for k in range(len(actors))], axis=1)
    patterns, of_pattern = np.unique(takes_part, axis=0, return_inverse=True)
    results = []
    for k, pattern in enumerate(patterns):
        if pattern.any():
            samples = of_pattern.ravel() == k
            first = int(np.flatnonzero(samples)[0])
            basis = _sparse_basis(hidden[first] * present[first] * present[first][:, None])
            results.append(
                Undetermined(
                    contacts=tuple(actors[index].name for index in np.flatnonzero(pattern).tolist()),
                    samples=samples,
                    directions=tuple(_description(actors, owner, vector, first) for vector in basis),
                )
            )
    return tuple(results)


def _sparse_basis(projection: FloatArray) -> list[FloatArray]:
    """Vectors that span the range of a projection, each with as few unknowns as elimination leaves."""
    values, vectors = np.linalg.eigh(projection)
    rows = vectors[:, values > 0.5].T.copy()
    free = list(range(len(rows)))
    for row in free:
        pivot = int(np.abs(rows[row]).argmax())
        rows[row] /= rows[row, pivot]
        for other in free:
            if other != row:
                rows[other] -= rows[other, pivot] * rows[row]
    return list(rows)


def _description(actors: Sequence[Actor], owner: IntArray, vector: FloatArray, sample: int) -> str:
    """What a vector of unknowns does, scaled to a largest component of 1 N or 1 N m."""
    wrenches = {
        actor.name: actor.free[sample] @ vector[owner == k] for k, actor in enumerate(actors) if (owner == k).any()
    }
    tangential = {actor.name for actor in actors if actor.unknowns == ("s", "t")}
    largest = max(np.abs(wrench[:3] if name in tangential else wrench).max() for name, wrench in wrenches.items())
    clauses = []
    for name, wrench in wrenches.items():
        force, moment = wrench[:3] / largest, wrench[3:] / largest
        if np.abs(force).max() > _SILENT:
            clauses.append(f"a force of {_numbers(force)} N at {name!r}")
        if name not in tangential and np.abs(moment).max() > _SILENT:
            clauses.append(f"a moment of {_numbers(moment)} N m at {name!r}")
    return " and ".join(clauses)


def _numbers(vector: FloatArray) -> str:
    return "(" + ", ".join(f"{number + 0.0:.2f}" for number in np.round(vector, 2)) + ")"
