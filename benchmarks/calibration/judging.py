# SPDX-License-Identifier: BSD-3-Clause
"""Mean errors of many candidates on validation samples: all at once, beside NumPy one after the other.

Everyone gives the mean absolute error of each component and the mean norms of force and moment error
over all samples. Slow tasks take fewer candidates or samples, so that all times are per candidate and
sample; what is said of all candidates is extrapolated from these.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from benchmarks.calibration.measured import Measured
from benchmarks.harness import interleaved, median_ratio
from forcetorque.base.arrays import FloatArray
from forcetorque.robot.mechanics.estimate import Evaluator
from forcetorque.study.candidate_errors import candidate_errors

CANDIDATES = 351
"""Three data sets, nine types of estimation, thirteen lambdas."""
THREADS = 2
OURS = f"ours compiled, {THREADS} threads"
ONE_BY_ONE = "NumPy, one candidate at a time"
_BLOCK = 256
"""Samples of a product of the blocked peer; 128 to 512 take about the same time, more or fewer longer."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sizes:
    """How much each task does in a round."""

    samples: int
    """Samples of all tasks but the two below."""
    alone: int
    """Candidates that are judged one at a time."""
    blocked: int
    """Samples of the blocked peer, and of our readable evaluator."""


FULL = Sizes(samples=1_000_000, alone=8, blocked=100_000)
QUICK = Sizes(samples=100_000, alone=8, blocked=20_000)


class Problem:
    """A sensor with six channels that sit at thousands of counts, a temperature, and candidates around the truth."""

    def __init__(self, samples: int) -> None:
        """Draw samples and candidates, always the same.

        Args:
            samples: Number of samples.
        """
        rng = np.random.default_rng(1)
        offset_counts = rng.uniform(-24_000.0, 24_000.0, 6)
        self.raw = np.round(offset_counts + 3000.0 * rng.normal(size=(samples, 6)))
        self.variables = 5.0 * rng.normal(size=(samples, 1))
        matrix, coefficient = 0.01 * rng.normal(size=(6, 6)), 0.5 * rng.normal(size=(6, 1))
        self.reference = (self.raw - offset_counts) @ matrix.T + self.variables @ coefficient.T
        self.reference += rng.normal(scale=1.0, size=(samples, 6))
        self.matrices = matrix + 1e-4 * rng.normal(size=(CANDIDATES, 6, 6))
        self.coefficients = coefficient + 0.1 * rng.normal(size=(CANDIDATES, 6, 1))
        self.offsets = -self.matrices @ offset_counts + rng.normal(scale=0.5, size=(CANDIDATES, 6))
        # peers need not tell channels from variables
        self.columns = np.hstack([self.raw, self.variables])
        self.both = np.concatenate([self.matrices, self.coefficients], axis=2)

    def ours(self, samples: int, evaluator: Evaluator, threads: int) -> FloatArray:
        """Judge all candidates.

        Args:
            samples: Number of samples.
            evaluator: Who computes.
            threads: Threads of the compiled evaluator.

        Returns:
            Mean errors; shape (k, 8): components, force, moment; N, N m.
        """
        found = candidate_errors(
            self.raw[:samples],
            self.reference[:samples],
            self.matrices,
            self.offsets,
            variables=self.variables[:samples],
            coefficients=self.coefficients,
            evaluator=evaluator,
            threads=threads,
        ).pooled()
        return np.column_stack([found.mean_absolute, found.force_mean, found.moment_mean])

    def one_by_one(self, candidates: int, samples: int, dtype: Any = np.float64) -> FloatArray:
        """Judge some candidates in plain NumPy, as one would write it down.

        Args:
            candidates: Number of candidates.
            samples: Number of samples.
            dtype: Precision.

        Returns:
            As above, of the first candidates.
        """
        columns, reference = (a[:samples].astype(dtype, copy=False) for a in (self.columns, self.reference))
        rows = []
        for both, offset in zip(self.both[:candidates], self.offsets, strict=False):
            error = columns @ both.T.astype(dtype) + offset - reference
            norms = np.linalg.norm(error[:, :3], axis=1).mean(), np.linalg.norm(error[:, 3:], axis=1).mean()
            rows.append([*np.abs(error).mean(axis=0), *norms])
        return np.array(rows)

    def blocked(self, samples: int) -> FloatArray:
        """Judge all candidates by one product per block of samples: the fastest that we found in NumPy.

        Args:
            samples: Number of samples.

        Returns:
            As above.
        """
        stacked = self.both.reshape(6 * CANDIDATES, -1)
        sums, square = np.zeros((CANDIDATES, 8)), np.empty((CANDIDATES, 6, _BLOCK))
        for first in range(0, samples, _BLOCK):
            block = slice(first, min(first + _BLOCK, samples))
            error = (stacked @ self.columns[block].T).reshape(CANDIDATES, 6, -1)
            error += self.offsets[:, :, None]
            error -= self.reference[block].T
            squared = np.multiply(error, error, out=square[:, :, : error.shape[2]])
            for half, (x, y, z) in enumerate(((0, 1, 2), (3, 4, 5))):
                norm = np.add(squared[:, x], squared[:, y], out=squared[:, x])
                norm += squared[:, z]
                sums[:, 6 + half] += np.sqrt(norm, out=norm).sum(axis=1)
            sums[:, :6] += np.abs(error, out=error).sum(axis=2)
        return sums / samples


def measure(*, quick: bool, rounds: int) -> Measured:
    """Time everyone in turn and compare the answers.

    Args:
        quick: Whether with small inputs.
        rounds: Counted rounds.

    Returns:
        The figures.
    """
    sizes = QUICK if quick else FULL
    problem = Problem(sizes.samples)
    work: dict[str, tuple[int, int, Callable[[], object]]] = {  # candidates, samples, task
        OURS: (CANDIDATES, sizes.samples, partial(problem.ours, sizes.samples, Evaluator.COMPILED, THREADS)),
        "ours compiled, 1 thread": (
            CANDIDATES,
            sizes.samples,
            partial(problem.ours, sizes.samples, Evaluator.COMPILED, 1),
        ),
        "ours readable": (CANDIDATES, sizes.blocked, partial(problem.ours, sizes.blocked, Evaluator.READABLE, 1)),
        ONE_BY_ONE: (sizes.alone, sizes.samples, partial(problem.one_by_one, sizes.alone, sizes.samples)),
        "NumPy, one product per block": (CANDIDATES, sizes.blocked, partial(problem.blocked, sizes.blocked)),
    }
    timed = interleaved({name: task for name, (_, _, task) in work.items()}, rounds=rounds)
    per_pair = {name: [s / (work[name][0] * work[name][1]) for s in values] for name, values in timed.items()}
    pairs = CANDIDATES * sizes.samples
    return Measured(
        ratios={
            f"judging, speed of {OURS} against {name}": 1.0 / median_ratio(per_pair[OURS], values)
            for name, values in per_pair.items()
            if name != OURS
        },
        seconds={f"judging, {name}, s per candidate and sample": values for name, values in per_pair.items()},
        accuracy=_accuracy(problem, sizes),
        figures={
            "judging, candidates": CANDIDATES,
            "judging, samples": sizes.samples,
            f"judging, s for {CANDIDATES} candidates on {sizes.samples} samples": {
                name: {
                    "median": statistics.median(values) * pairs,
                    "extrapolated": candidates * samples < pairs,
                    "timed candidates": candidates,
                    "timed samples": samples,
                }
                for (name, values), (candidates, samples, _) in zip(per_pair.items(), work.values(), strict=True)
            },
        },
    )


def _accuracy(problem: Problem, sizes: Sizes) -> dict[str, float]:
    """Largest relative differences of any mean, on the same candidates and samples."""
    few, alone = sizes.blocked, sizes.alone
    ours = problem.ours(sizes.samples, Evaluator.COMPILED, THREADS)
    ours_few = problem.ours(few, Evaluator.COMPILED, THREADS)
    exact = problem.one_by_one(alone, few, np.longdouble)
    return {
        "judging, ours compiled and NumPy, one candidate at a time": _relative(
            ours[:alone], problem.one_by_one(alone, sizes.samples)
        ),
        "judging, ours compiled and NumPy, one product per block": _relative(ours_few, problem.blocked(few)),
        "judging, ours compiled and ours readable": _relative(ours_few, problem.ours(few, Evaluator.READABLE, 1)),
        "judging, ours compiled and long double": _relative(ours_few[:alone], exact),
        "judging, NumPy and long double": _relative(problem.one_by_one(alone, few), exact),
    }


def _relative(one: FloatArray, other: FloatArray) -> float:
    return float(np.abs(one / other - 1.0).max())
