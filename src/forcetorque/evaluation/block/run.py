# SPDX-License-Identifier: BSD-3-Clause
"""Run the compiled sums over all samples and candidates, on several threads."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.compiled import announced, frozen
from forcetorque.evaluation.block.candidate_sums import compiled_error_sums
from forcetorque.evaluation.candidate_inputs import CandidateInputs

_SAMPLES = 16384
"""Most samples of one task: long against the cost of starting it."""
_CANDIDATES = 512
"""Most candidates of one task: their matrices and sums stay in the second-level cache."""


def run_compiled(
    inputs: CandidateInputs, sums: FloatArray, *, threads: int | None, progress: Callable[[int], None] | None
) -> None:
    """Add up errors in compiled code; the sums do not depend on the number of threads.

    Args:
        inputs: Candidates and samples.
        sums: Where they are added, of absolute errors and of norms; shape (k, b, 8); zero.
        threads: Number of threads; as many as there are processors if None.
        progress: Called with the number of samples done so far.
    """
    judge = compiled_error_sums(inputs.matrices.shape[2])
    centre = frozen(inputs.columns_centre), frozen(inputs.reference_centre)

    def task(piece: tuple[int, slice, slice]) -> FloatArray:
        _, samples, some = piece
        arrays = (inputs.raw[samples], inputs.variables[samples], inputs.reference[samples])
        part = np.zeros((some.stop - some.start, 8))
        judge(*map(frozen, arrays), *centre, frozen(inputs.matrices[some]), frozen(inputs.constants[some]), part)
        return part

    with announced("compiling the errors of candidates for this machine, once; it takes some seconds"):
        task((0, slice(0, 0), slice(0, 0)))  # two threads would compile the same
    pieces = list(_pieces(inputs.blocks, len(sums)))
    with ThreadPoolExecutor(threads or os.cpu_count() or 1) as pool:
        for (b, samples, some), part in zip(pieces, pool.map(task, pieces), strict=True):
            sums[some, b] += part
            if progress is not None and some.stop == len(sums):
                progress(samples.stop)


def _pieces(blocks: tuple[slice, ...], candidates: int) -> Iterator[tuple[int, slice, slice]]:
    """Divide the work: number of the block of time, samples, candidates."""
    for b, block in enumerate(blocks):
        for first in range(block.start, block.stop, _SAMPLES):
            for start in range(0, candidates, _CANDIDATES):
                samples = slice(first, min(first + _SAMPLES, block.stop))
                yield b, samples, slice(start, min(start + _CANDIDATES, candidates))
