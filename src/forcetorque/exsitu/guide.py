# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with a block as soon as it is there, while it can be recorded again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.exsitu.block import Block
from forcetorque.exsitu.loads import BenchLoads
from forcetorque.spatial import FORCE_AND_MOMENT

SIZE = (0.7, 1.4)
"""Share of the expected load that a sensor reads by its nominal matrix at least and at most: specimens differ by some
11 %, weights that are mistaken for each other by more than three times that."""

_SAME = 0.02
"""Share of a change of reading below which two blocks are of the same position."""
_OWN = 0.5
"""Distance to another load, over that to its own, below which a block is of the other."""
_NEAR = 0.35
"""Distance to the other, over its size, that specimens differ by at most."""


def block_findings(
    blocks: Sequence[Block], biases: Sequence[Block], loads: BenchLoads, nominal: FloatArray | None
) -> list[tuple[str, ...]]:
    """Check blocks, each with those that were recorded before it.

    Args:
        blocks: Blocks of positions, as they came.
        biases: The block without load that each is taken from.
        loads: All loads.
        nominal: Matrix of the sensor, roughly; shape (6, c); None for none, and signs and sizes are not checked then.

    Returns:
        What is wrong with every block, in sentences; none where it is sound.
    """
    findings = []
    for k, (block, bias) in enumerate(zip(blocks, biases, strict=True)):
        before = (blocks[k - 1].mean - biases[k - 1].mean) if k else None
        change = block.mean - bias.mean
        sentences = [*_at_rest(block), *(f"bias: {words}" for words in _at_rest(bias))]
        if before is not None and np.linalg.norm(change - before) < _SAME * np.linalg.norm(before):
            sentences.append(f"it reads as position {blocks[k - 1].position} before it: was the load moved?")
        elif nominal is not None and not block.saturated:
            sentences += _of_load(nominal @ change, block.position, loads)
        findings.append(tuple(sentences))
    return findings


def _at_rest(block: Block) -> Iterator[str]:
    if block.saturated:
        yield "a channel is at its limit: no load can be told from it"
    if block.frozen:
        yield "no channel changes at all: is the log frozen?"
    if block.moved:
        yield f"not still: the mean of a tenth of it wanders by {block.movement.max():.0f} counts"


def _of_load(wrench: FloatArray, position: str, loads: BenchLoads) -> Iterator[str]:
    """Compare a wrench by the nominal matrix with the load of its position, and with all others."""
    sizes = np.repeat([np.linalg.norm(loads.wrench[:, part], axis=1).max() for part in FORCE_AND_MOMENT], 3)
    known = loads.wrench / sizes
    own, read = known[loads.names.index(position)], wrench / sizes
    share = float(read @ own / (own @ own))
    distance = np.linalg.norm(known - read, axis=1)
    nearest = int(np.argmin(distance))
    swapped_halves = float(np.linalg.norm(np.roll(wrench, 3) / sizes - own))
    own_distance = float(distance[loads.names.index(position)])
    is_near = distance[nearest] < _NEAR * np.linalg.norm(known[nearest])
    if is_near and distance[nearest] < _OWN * own_distance:
        yield f"it reads like position {loads.names[nearest]}: was that one recorded in place of it?"
    elif swapped_halves < _OWN * own_distance:
        yield "it reads as if forces and moments were swapped: check the order of the channels"
    elif share < 0.0:
        yield "its sign is the other way round: check where it hangs, and measure_direction"
    elif not SIZE[0] <= share <= SIZE[1]:
        yield f"it reads {share:.2f} of its load: check the weight"
