# SPDX-License-Identifier: BSD-3-Clause
"""Errors of many calibrations, for choosing among them: on the same samples, and at pushes around the sensor."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.evaluation.candidate_inputs import CandidateInputs, checked_candidates
from forcetorque.robot.mechanics.estimate import Evaluator

BLOCKS = 10
"""Contiguous blocks of time whose means say how a mean scatters: neighbouring samples repeat each other."""

_FEW = 10_000_000
"""Fewer samples times candidates than this take the readable evaluator no longer than loading the compiled one."""

_SAMPLES, _NUMBERS = 2048, 65536
"""Most samples, and numbers, of a pass of the readable evaluator: its working arrays stay in the processor's cache."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PooledErrors(ArrayRecord):
    """Mean errors of k candidates over all samples, or the standard errors of these means."""

    mean_absolute: FloatArray = field(metadata=array("k", 6))
    """Of the absolute error per component; shape (k, 6); N, N m."""
    force_mean: FloatArray = field(metadata=array("k"))
    """Of the norm of the force error; shape (k,); N."""
    moment_mean: FloatArray = field(metadata=array("k"))
    """Of the norm of the moment error; shape (k,); N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CandidateErrors(ArrayRecord):
    """Mean errors of k candidates in each of b contiguous blocks of time."""

    count: IntArray = field(metadata=array("b", dtype="int"))
    """Number of samples of each block; shape (b,)."""
    mean_absolute: FloatArray = field(metadata=array("k", "b", 6))
    """Mean absolute error per component; shape (k, b, 6); N, N m."""
    force_mean: FloatArray = field(metadata=array("k", "b"))
    """Mean norm of the force error; shape (k, b); N."""
    moment_mean: FloatArray = field(metadata=array("k", "b"))
    """Mean norm of the moment error; shape (k, b); N m."""

    def pooled(self) -> PooledErrors:
        """Take the means over all samples.

        Returns:
            Means of the blocks, weighted by their number of samples.
        """
        return self._over_blocks(lambda means: np.average(means, axis=1, weights=self.count))

    def standard_error(self) -> PooledErrors:
        """Take the standard errors of the means over all samples.

        Returns:
            Scatter of the means of the blocks over the root of their number; NaN for a single block.
        """
        b = len(self.count)
        if b < 2:
            return self._over_blocks(lambda means: np.full_like(means[:, 0], np.nan))
        return self._over_blocks(lambda means: means.std(axis=1, ddof=1) / np.sqrt(b))

    def _over_blocks(self, take: Callable[[FloatArray], FloatArray]) -> PooledErrors:
        return PooledErrors(
            mean_absolute=take(self.mean_absolute),
            force_mean=take(self.force_mean),
            moment_mean=take(self.moment_mean),
        )


def evaluator_of_work(candidates: int, samples: int) -> Evaluator:
    """Choose who computes the errors of so many candidates in so many samples.

    Args:
        candidates: Number of candidates.
        samples: Number of samples, of all calls of `candidate_errors` together.

    Returns:
        The readable evaluator for little work.
    """
    return Evaluator.READABLE if candidates * samples < _FEW else Evaluator.COMPILED


def candidate_errors(
    raw: Any,
    reference: Any,
    matrices: Any,
    offsets: Any,
    *,
    variables: Any = None,
    coefficients: Any = None,
    blocks: int = BLOCKS,
    evaluator: Evaluator | None = None,
    threads: int | None = None,
    progress: Callable[[int], None] | None = None,
) -> CandidateErrors:
    """Judge candidate calibrations by their mean errors.

    The error of a candidate in a sample is matrix raw + coefficients variables + offset - reference.

    Args:
        raw: Raw readings in the order of time; shape (n, c), n and c at least 1; counts.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.
        matrices: Calibration matrices; shape (k, 6, c), k at least 1; N/count, N m/count.
        offsets: Offsets in wrench space; shape (k, 6); N, N m.
        variables: Extra variables, such as the temperature less a reference temperature; shape (n, v); None for none.
        coefficients: Coefficients of the extra variables; shape (k, 6, v).
        blocks: Contiguous blocks of time, at least 1; there are no more than samples.
        evaluator: Who computes; by the amount of work if None.
        threads: Threads of the compiled evaluator; as many as there are processors if None.
        progress: Called with the number of samples done so far, by all candidates.

    Returns:
        Mean errors of every candidate in every block, in the order of the candidates.

    Raises:
        ShapeError: If the shapes are not these, or a value is not finite.
    """
    inputs = checked_candidates(
        raw, reference, matrices, offsets, variables=variables, coefficients=coefficients, blocks=blocks
    )
    k, n = len(inputs.matrices), len(inputs.raw)
    sums = np.zeros((k, len(inputs.blocks), 8))
    if evaluator is None:
        evaluator = evaluator_of_work(k, n)
    if Evaluator(evaluator) is Evaluator.READABLE:
        _run_readable(inputs, sums, progress)
    else:
        # imported here: it loads the compiler
        from forcetorque.evaluation.block.run import run_compiled

        run_compiled(inputs, sums, threads=threads, progress=progress)
    count = np.array([block.stop - block.start for block in inputs.blocks])
    means = sums / count[:, None]
    return CandidateErrors(
        count=count, mean_absolute=means[:, :, :6], force_mean=means[:, :, 6], moment_mean=means[:, :, 7]
    )


def _run_readable(inputs: CandidateInputs, sums: FloatArray, progress: Callable[[int], None] | None) -> None:
    """Add up absolute errors, six, and the norms of force and moment errors; sums of shape (k, b, 8)."""
    group = max(_NUMBERS // (6 * min(_SAMPLES, len(inputs.raw))), 1)
    for b, block in enumerate(inputs.blocks):
        for first in range(block.start, block.stop, _SAMPLES):
            last = min(first + _SAMPLES, block.stop)
            columns, reference = inputs.centred(slice(first, last))
            for start in range(0, len(sums), group):
                some = slice(start, start + group)
                error = inputs.matrices[some] @ columns + inputs.constants[some, :, None] - reference  # (group, 6, n)
                sums[some, b, :6] += np.abs(error).sum(axis=2)
                square = np.square(error, out=error)
                for k, part in enumerate((square[:, :3], square[:, 3:]), start=6):
                    sums[some, b, k] += np.sqrt(part[:, 0] + part[:, 1] + part[:, 2]).sum(axis=1)
            if progress is not None:
                progress(last)


PUSH_N: Final = 50.0
"""Force of a push; N."""
LEVER_M: Final = 0.3
"""Largest distance of its point from the sensor; m."""
_PUSHES = 2000
_SEED = 2024


@dataclass(frozen=True, slots=True, kw_only=True)
class PushError:
    """Mean error of the reading over pushes in random directions at random points."""

    force_N: float
    """Mean norm of the force error."""
    moment_Nm: float
    """Mean norm of the moment error."""

    def over(self, before: PushError) -> float:
        """Compare with the error of another matrix.

        Args:
            before: Error of the other one.

        Returns:
            The larger of the ratios of force and moment.
        """
        return max(self.force_N / before.force_N, self.moment_Nm / before.moment_Nm)


@cache
def pushes() -> FloatArray:
    """Give the pushes, the same ones on every call.

    Returns:
        Wrenches at the sensor; shape (n, 6); N, N m; read-only.
    """
    rng = np.random.default_rng(_SEED)
    force, lever = rng.normal(size=(2, _PUSHES, 3))
    force *= PUSH_N / np.linalg.norm(force, axis=1, keepdims=True)
    lever *= LEVER_M * rng.uniform(size=(_PUSHES, 1)) / np.linalg.norm(lever, axis=1, keepdims=True)
    wrench = np.hstack([force, np.cross(lever, force)])
    wrench.setflags(write=False)
    return wrench


def push_error(matrix: FloatArray, truth: FloatArray) -> PushError:
    """Judge a matrix by what it reads of pushes.

    Args:
        matrix: The matrix; shape (6, c); N/count, N m/count.
        truth: That of the sensor; shape (6, c).

    Returns:
        Its mean errors; offsets are no matter.
    """
    error = pushes() @ (matrix @ np.linalg.pinv(truth) - np.eye(6)).T
    force, moment = (float(np.linalg.norm(error[:, part], axis=1).mean()) for part in FORCE_AND_MOMENT)
    return PushError(force_N=force, moment_Nm=moment)
