# SPDX-License-Identifier: BSD-3-Clause
"""What people do wrong at a bench, each with what it does to the readings: hypotheses with names."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.exsitu.loads import BenchLoads
from forcetorque.exsitu.scatter import moved_loads, turned_loads
from forcetorque.spatial import WRENCH_COMPONENTS


class Fault(StrEnum):
    """A kind of fault."""

    SWAPPED = "swapped"
    """Two positions have each other's load."""
    WEIGHT = "wrong weight"
    """One weight is heavier or lighter than stated, as a share of it."""
    TILTED = "tilted"
    """Gravity points elsewhere at one position; rad."""
    DISPLACED = "displaced"
    """One weight hangs elsewhere; m."""
    COMPONENT = "wrong component"
    """One stated component of one wrench is wrong; N, N m."""
    PLATE_TILTED = "plate tilted"
    """Gravity points elsewhere at all positions, by one rotation in the sensor's axes; rad."""
    OTHER = "unlike the others"
    """One position disagrees in a way that has no name."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Signatures:
    """What faults of one kind do, one per set of positions."""

    fault: Fault
    """The kind."""
    components: tuple[int, ...] = ()
    """The component that each is about; none where they are about all."""
    positions: IntArray
    """Positions that each changes; shape (m, k)."""
    change: FloatArray
    """Change of their wrenches per unit of each of d amounts; shape (m, k, 6, d)."""
    whole: bool = False
    """Whether it happens or not, so that its one amount is 1."""


def signatures(loads: BenchLoads) -> Iterator[Signatures]:
    """List what can be wrong with loads.

    Args:
        loads: The loads.

    Yields:
        Faults by kind. Of weights: swapped, wrong, tilted, displaced, the plate; of stated wrenches: swapped as a
        whole or in one component, and single components.
    """
    n = len(loads)
    alone = np.arange(n)[:, None]
    yield from _swaps(loads)
    yield Signatures(fault=Fault.WEIGHT, positions=alone, change=loads.wrench[:, None, :, None])
    if loads.weights is None:
        for k in range(6):
            unit = np.broadcast_to(np.eye(6)[k][None, None, :, None], (n, 1, 6, 1))
            yield Signatures(fault=Fault.COMPONENT, components=(k,) * n, positions=alone, change=unit)
    else:
        turned, moved = turned_loads(loads), moved_loads(loads)
        yield Signatures(fault=Fault.TILTED, positions=alone, change=turned[:, None])
        yield Signatures(fault=Fault.DISPLACED, positions=alone, change=moved[:, None])
        yield Signatures(fault=Fault.PLATE_TILTED, positions=np.arange(n)[None], change=turned[None])
    yield Signatures(fault=Fault.OTHER, positions=alone, change=np.broadcast_to(np.eye(6)[None, None], (n, 1, 6, 6)))


def _swaps(loads: BenchLoads) -> Iterator[Signatures]:
    first, second = np.triu_indices(len(loads), k=1)
    apart = loads.wrench[second] - loads.wrench[first]
    yield _swap(first, second, apart, components=())
    if loads.weights is None:
        for k in range(len(WRENCH_COMPONENTS)):
            # only where the rest of the row differs too is a swap of one component another fault than one of all
            differs = (apart[:, k] != 0.0) & (np.delete(apart, k, axis=1) != 0.0).any(axis=1)
            if differs.any():
                kept = np.where(np.arange(6) == k, apart[differs], 0.0)
                yield _swap(first[differs], second[differs], kept, components=(k,) * int(differs.sum()))


def _swap(first: IntArray, second: IntArray, apart: FloatArray, components: tuple[int, ...]) -> Signatures:
    return Signatures(
        fault=Fault.SWAPPED,
        components=components,
        positions=np.column_stack([first, second]),
        change=np.stack([apart, -apart], axis=1)[..., None],
        whole=True,
    )
