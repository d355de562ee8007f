# SPDX-License-Identifier: BSD-3-Clause
"""Mean errors of many candidates in blocks of time, readable or compiled, and errors of pushes around a sensor."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cache
from itertools import pairwise
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, require_shape
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.robot.mechanics.estimate import Evaluator


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CandidateInputs:
    """k candidates and n samples of c channels and v variables; m columns are channels, then variables.

    With the centre taken off the samples, the error of a candidate is matrix columns + constant -
    reference. Offsets of 24 000 counts enter it only through the constant, and cost no digits.
    """

    raw: FloatArray
    """Raw samples; shape (n, c); counts."""
    variables: FloatArray
    """Extra variables; shape (n, v)."""
    reference: FloatArray
    """Expected wrenches; shape (n, 6); N, N m."""
    columns_centre: FloatArray
    """Mean of every column; shape (m,)."""
    reference_centre: FloatArray
    """Mean expected wrench; shape (6,); N, N m."""
    matrices: FloatArray
    """Matrices and coefficients side by side; shape (k, 6, m)."""
    constants: FloatArray
    """Error at the centre; shape (k, 6); N, N m."""
    blocks: tuple[slice, ...]
    """Contiguous blocks of samples, whose lengths differ by one at most."""

    def centred(self, samples: slice) -> tuple[FloatArray, FloatArray]:
        """Take the centre off some samples.

        Args:
            samples: Indices of the samples.

        Returns:
            Columns, shape (m, samples), and reference, shape (6, samples).
        """
        columns = np.concatenate([self.raw[samples], self.variables[samples]], axis=1) - self.columns_centre
        return columns.T, (self.reference[samples] - self.reference_centre).T


def checked_candidates(
    raw: Any, reference: Any, matrices: Any, offsets: Any, *, variables: Any, coefficients: Any, blocks: int
) -> CandidateInputs:
    """Check candidates and samples; the arguments are those of `candidate_errors`.

    Args:
        raw: Raw samples.
        reference: Expected wrenches.
        matrices: Matrices.
        offsets: Offsets.
        variables: Extra variables, or None.
        coefficients: Their coefficients, or None.
        blocks: Number of blocks; there are fewer if there are fewer samples.

    Returns:
        Candidates and samples.

    Raises:
        ShapeError: If the shapes do not fit each other, there is no sample or candidate, or a value is not finite.
    """
    if (variables is None) != (coefficients is None):
        raise ShapeError("expected variables and their coefficients, or neither, got one of the two")
    r, C = _finite(raw, "raw", (None, None)), _finite(matrices, "matrices", (None, 6, None))
    n, channels, k = *r.shape, len(C)
    if not n or not channels or not k or blocks < 1:
        raise ShapeError(
            "expected at least one sample, channel, candidate and block, got "
            f"{n} samples of {channels} channels, {k} candidates and {blocks} blocks"
        )
    require_shape(C, name="matrices", shape=(k, 6, channels))
    v = _finite(np.empty((n, 0)) if variables is None else variables, "variables", (n, None))
    c = _finite(np.empty((k, 6, 0)) if coefficients is None else coefficients, "coefficients", (k, 6, v.shape[1]))
    f, o = _finite(reference, "reference", (n, 6)), _finite(offsets, "offsets", (k, 6))
    columns_centre, reference_centre = np.append(r.mean(axis=0), v.mean(axis=0)), f.mean(axis=0)
    matrices = np.concatenate([C, c], axis=2)
    # hundreds of newtons cancel here, for all samples alike: extended precision where there is one
    constants = matrices.astype(np.longdouble) @ columns_centre + o - reference_centre
    return CandidateInputs(
        raw=r,
        variables=v,
        reference=f,
        columns_centre=columns_centre,
        reference_centre=reference_centre,
        matrices=matrices,
        constants=constants.astype(np.float64),
        blocks=_contiguous(n, min(blocks, n)),
    )


def _finite(values: Any, name: str, shape: tuple[int | None, ...]) -> FloatArray:
    array: FloatArray = np.asarray(values, dtype=np.float64)
    require_shape(array, name=name, shape=shape)
    if not np.isfinite(array).all():
        first = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ShapeError(f"{name}: expected finite values only, got {array[first]} at {first}; leave out gaps")
    return array


def _contiguous(n: int, blocks: int) -> tuple[slice, ...]:
    """Divide samples as `numpy.array_split` does."""
    shortest, longer = divmod(n, blocks)
    return tuple(slice(*ends) for ends in pairwise(b * shortest + min(b, longer) for b in range(blocks + 1)))


BLOCKS = 10
"""Contiguous blocks of time, whose means give the standard error of a mean: neighbouring samples are correlated."""

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
class BlockErrors(ArrayRecord):
    """Mean errors of k candidates in each of b contiguous blocks of time."""

    count: IntArray = field(metadata=array("b", dtype="int"))
    """Number of samples of each block; shape (b,)."""
    mean_absolute: FloatArray = field(metadata=array("k", "b", 6))
    """Mean absolute error per component; shape (k, b, 6); N, N m."""
    force_mean: FloatArray = field(metadata=array("k", "b"))
    """Mean norm of the force error; shape (k, b); N."""
    moment_mean: FloatArray = field(metadata=array("k", "b"))
    """Mean norm of the moment error; shape (k, b); N m."""
    sessions: tuple[str, ...] = ()
    """Session of every block; empty where the samples are of one."""

    def of_sessions(self, sessions: Collection[str] | None) -> BlockErrors:
        """Select the blocks of some sessions.

        Args:
            sessions: The sessions; all if None.

        Returns:
            Errors of every candidate in these blocks.
        """
        if sessions is None:
            return self
        mask = np.array([session in sessions for session in self.sessions])
        return BlockErrors(
            count=self.count[mask],
            mean_absolute=self.mean_absolute[:, mask],
            force_mean=self.force_mean[:, mask],
            moment_mean=self.moment_mean[:, mask],
            sessions=tuple(session for session in self.sessions if session in sessions),
        )

    def pooled(self, sessions: Collection[str] | None = None) -> PooledErrors:
        """Take the means over all samples of some sessions.

        Args:
            sessions: The sessions; all if None.

        Returns:
            Means of the blocks, weighted by their number of samples.
        """
        blocks = self.of_sessions(sessions)
        return blocks._over_blocks(lambda means: np.average(means, axis=1, weights=blocks.count))

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
    """Choose the evaluator for a number of candidates and samples.

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
) -> BlockErrors:
    """Compute the mean errors of candidate calibrations.

    The error of a candidate in a sample is matrix raw + coefficients variables + offset - reference.

    Args:
        raw: Raw samples in the order of time; shape (n, c), n and c at least 1; counts.
        reference: Expected wrenches; shape (n, 6); N, N m.
        matrices: Calibration matrices; shape (k, 6, c), k at least 1; N/count, N m/count.
        offsets: Offsets in wrench space; shape (k, 6); N, N m.
        variables: Extra variables, such as the temperature less a reference temperature; shape (n, v); None for none.
        coefficients: Coefficients of the extra variables; shape (k, 6, v).
        blocks: Contiguous blocks of time, at least 1; there are no more than samples.
        evaluator: Evaluator; chosen by the amount of work if None.
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
        _run_compiled(inputs, sums, threads=threads, progress=progress)
    count = np.array([block.stop - block.start for block in inputs.blocks])
    means = sums / count[:, None]
    return BlockErrors(
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


_TASK_SAMPLES = 16384
"""Most samples of one task: long against the cost of starting it."""
_TASK_CANDIDATES = 512
"""Most candidates of one task: their matrices and sums stay in the second-level cache."""


def _run_compiled(
    inputs: CandidateInputs, sums: FloatArray, *, threads: int | None, progress: Callable[[int], None] | None
) -> None:
    """Add up the same in compiled code; the sums do not depend on the number of threads."""
    # imported here: they load the compiler
    from forcetorque.base.compiled_functions import announced, frozen
    from forcetorque.study.compiled_errors import compiled_error_sums

    add_errors = compiled_error_sums(inputs.matrices.shape[2])
    centre = frozen(inputs.columns_centre), frozen(inputs.reference_centre)

    def task(block_samples_candidates: tuple[int, slice, slice]) -> FloatArray:
        _, samples, some = block_samples_candidates
        arrays = (inputs.raw[samples], inputs.variables[samples], inputs.reference[samples])
        task_sums = np.zeros((some.stop - some.start, 8))
        candidates = (frozen(inputs.matrices[some]), frozen(inputs.constants[some]))
        add_errors(*map(frozen, arrays), *centre, *candidates, task_sums)
        return task_sums

    with announced("compiling the errors of candidates for this machine, once; it takes some seconds"):
        task((0, slice(0, 0), slice(0, 0)))  # two threads would compile the same
    tasks = list(_tasks(inputs.blocks, len(sums)))
    with ThreadPoolExecutor(threads or os.cpu_count() or 1) as pool:
        for (b, samples, some), task_sums in zip(tasks, pool.map(task, tasks), strict=True):
            sums[some, b] += task_sums
            if progress is not None and some.stop == len(sums):
                progress(samples.stop)


def _tasks(blocks: tuple[slice, ...], candidates: int) -> Iterator[tuple[int, slice, slice]]:
    """Divide the work: number of the block of time, samples, candidates."""
    for b, block in enumerate(blocks):
        for first in range(block.start, block.stop, _TASK_SAMPLES):
            for start in range(0, candidates, _TASK_CANDIDATES):
                samples = slice(first, min(first + _TASK_SAMPLES, block.stop))
                yield b, samples, slice(start, min(start + _TASK_CANDIDATES, candidates))


PUSH_N: Final = 50.0
"""Force of a push; N."""
LEVER_M: Final = 0.3
"""Largest distance of its point from the sensor; m."""
_PUSHES = 2000
_SEED = 2024


@dataclass(frozen=True, slots=True, kw_only=True)
class PushError:
    """Mean error of the measured wrench over pushes in random directions at random points."""

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
    """Draw the pushes, the same ones on every call.

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
    """Compute the mean errors of a matrix over pushes.

    Args:
        matrix: The matrix; shape (6, c); N/count, N m/count.
        truth: True matrix of the sensor; shape (6, c).

    Returns:
        Its mean errors; offsets do not enter.
    """
    error = pushes() @ (matrix @ np.linalg.pinv(truth) - np.eye(6)).T
    force, moment = (float(np.linalg.norm(error[:, part], axis=1).mean()) for part in FORCE_AND_MOMENT)
    return PushError(force_N=force, moment_Nm=moment)
