# SPDX-License-Identifier: BSD-3-Clause
"""What no reading tells of contacts, sample by sample, and along which forces, in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.estimation.uncertain.actions import Actor

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
                    directions=tuple(_words(actors, owner, vector, first) for vector in basis),
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


def _words(actors: Sequence[Actor], owner: IntArray, vector: FloatArray, sample: int) -> str:
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
