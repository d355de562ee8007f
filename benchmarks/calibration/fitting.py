# SPDX-License-Identifier: BSD-3-Clause
"""351 regularised fits from three data sets: moments and one eigenvalue problem per type, beside what one would write.

Peers are the thesis' own form, (5.8) with the explicit Kronecker product, and least squares on the
stacked samples and penalty. Both are timed on a part of the work and their times extrapolated.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from functools import partial

import numpy as np

from benchmarks.calibration.measured import Measured
from benchmarks.harness import interleaved, median_ratio
from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.thesis.regression import solve
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, Estimation
from forcetorque.experiment.calibration.moments import DataSet, Moments
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.study.candidate_fits import fit_candidates
from forcetorque.study.candidate_selection import SWEEP_LAMBDAS

DATA_SETS, TYPES = 3, len(ESTIMATION_TYPES)
FITS = DATA_SETS * TYPES * len(SWEEP_LAMBDAS)
OURS = "ours, moments and 351 fits"
KRONECKER = "Kronecker, one type of one data set"
STACKED = "numpy.linalg.lstsq, one fit"
_BLOCK = 1000
"""Samples of a block of the Kronecker form; all of a million at once would need 1.7 GB."""

TEMPERATURE = LinearVariable(name="temperature", unit="degC")
WEAK = (1.0, 0.1, 0.01, 0.001)
"""Excitation of the accuracy cases, relative to loads of 40 to 120 N."""


class Problem:
    """Data sets of a sensor whose raw readings sit at up to 24 000 counts, with a temperature."""

    def __init__(self, samples: int, *, excitation: float = 1.0) -> None:
        """Draw the samples, always the same.

        Args:
            samples: Samples of each data set.
            excitation: Size of the loads, relative to 40 to 120 N and 3 to 10 N m.
        """
        rng = np.random.default_rng(2)
        sensitivity = 30.0 * (np.eye(6) + 0.2 * rng.normal(size=(6, 6))) @ np.diag([1.0, 1, 1, 30, 30, 30])
        offset, drift = rng.uniform(-24_000.0, 24_000.0, 6), rng.normal(scale=12.0, size=6)
        self.prior = np.linalg.inv(sensitivity) * (1.0 + 0.05 * rng.normal(size=(6, 6)))
        self.truth = np.linalg.inv(sensitivity)
        self.data_sets = []
        for k in range(DATA_SETS):
            reference = excitation * rng.normal(size=(samples, 6)) * [40.0, 60, 120, 3, 10, 5]
            temperature = np.linspace(28.0 + 5.0 * k, 30.0 + 5.0 * k, samples)[:, None]
            raw = reference @ sensitivity.T + offset + temperature * drift + rng.normal(scale=3.0, size=(samples, 6))
            for array in (raw, reference, temperature):
                array.setflags(write=False)
            self.data_sets.append(DataSet(label=str(k), raw=raw, reference=reference, variables=temperature))

    def ours(self) -> object:
        """Fit every data set with every type and lambda, from the samples on.

        Returns:
            The candidates.
        """
        return fit_candidates(
            self.data_sets,
            {data.label: (data.label,) for data in self.data_sets},
            prior=self.prior,
            variables=[TEMPERATURE],
            kinds=list(ESTIMATION_TYPES.values()),
            lambdas=SWEEP_LAMBDAS,
            sphere=None,
        )

    def moments(self) -> list[Moments]:
        """Reduce all data sets.

        Returns:
            Their moments.
        """
        return [Moments.of(data.raw, data.reference, data.variables) for data in self.data_sets]

    def columns(self, samples: int) -> tuple[FloatArray, FloatArray]:
        """Regressors of the one-shot type with temperature, and the reference, of the first data set.

        Args:
            samples: Number of samples.

        Returns:
            Raw readings, temperature and ones; and the reference wrenches.
        """
        data = self.data_sets[0]
        ones = np.ones((samples, 1))
        return np.hstack([data.raw[:samples], data.variables[:samples], ones]), data.reference[:samples]

    def kronecker(self, samples: int) -> FloatArray:
        """Build (5.8) for one type of one data set with K = R x 1, and solve it for every lambda.

        Args:
            samples: Number of samples.

        Returns:
            Coefficients of the last lambda; shape (8, 6).
        """
        columns, reference = self.columns(samples)
        width = 6 * columns.shape[1]
        gram, target = np.zeros((width, width)), np.zeros(width)
        for first in range(0, samples, _BLOCK):
            expanded = np.kron(columns[first : first + _BLOCK], np.eye(6))
            gram += expanded.T @ expanded
            target += expanded.T @ reference[first : first + _BLOCK].ravel()
        penalised = np.zeros(width)
        penalised[:36] = 1.0
        pulled = np.zeros(width)
        pulled[:36] = self.prior.T.ravel()
        solution = target
        for regularisation in SWEEP_LAMBDAS:
            penalty = regularisation * penalised
            solution = np.linalg.solve(gram / samples + np.diag(penalty), target / samples + penalty * pulled)
        return solution.reshape(-1, 6)

    def stacked(self, samples: int, regularisation: float) -> FloatArray:
        """Solve one fit by least squares on the samples and the penalty below them.

        Args:
            samples: Number of samples.
            regularisation: Lambda of (5.4); counts2.

        Returns:
            Coefficients; shape (8, 6).
        """
        columns, reference = self.columns(samples)
        weight = np.sqrt(regularisation * samples)
        penalty = np.zeros((6, columns.shape[1]))
        penalty[:, :6] = weight * np.eye(6)
        system = np.vstack([columns, penalty])
        return np.linalg.lstsq(system, np.vstack([reference, weight * self.prior.T]), rcond=None)[0]


def measure(*, quick: bool, rounds: int) -> Measured:
    """Time everyone in turn and compare the answers.

    Args:
        quick: Whether with small inputs.
        rounds: Counted rounds.

    Returns:
        The figures.
    """
    samples = 100_000 if quick else 1_000_000
    part = 20_000
    problem = Problem(samples)
    tasks: dict[str, Callable[[], object]] = {
        OURS: problem.ours,
        "ours, moments of the three data sets": problem.moments,
        KRONECKER: partial(problem.kronecker, part),
        STACKED: partial(problem.stacked, samples, 100.0),
    }
    timed = interleaved(tasks, rounds=rounds)
    whole = {
        KRONECKER: [seconds * (samples / part) * DATA_SETS * TYPES for seconds in timed[KRONECKER]],
        STACKED: [seconds * FITS for seconds in timed[STACKED]],
    }
    return Measured(
        ratios={
            f"fitting, speed of {OURS} against {name}, extrapolated to all": 1.0 / median_ratio(timed[OURS], values)
            for name, values in whole.items()
        },
        seconds={f"fitting, {name}, s": values for name, values in timed.items()},
        accuracy=_accuracy(problem, part),
        figures={
            "fitting, fits": FITS,
            "fitting, samples of each data set": samples,
            "fitting, samples that the Kronecker form is timed on": part,
            f"fitting, s for {FITS} fits": {
                OURS: statistics.median(timed[OURS]),
                **{f"{name}, extrapolated": statistics.median(values) for name, values in whole.items()},
            },
        },
    )


def _accuracy(problem: Problem, samples: int) -> dict[str, float]:
    """Relative errors of the matrix against extended precision at lambda 0, and agreement of the forms at another."""
    found = {
        "fitting, Kronecker and ours, lambda 1e6": _relative(
            problem.kronecker(samples)[:6].T, _ours(problem, samples, 6e6)
        )
    }
    found["fitting, lstsq and ours, lambda 100"] = _relative(
        problem.stacked(samples, 600.0)[:6].T, _ours(problem, samples, 600.0)
    )
    for excitation in WEAK:
        weak = Problem(samples, excitation=excitation)
        columns, reference = weak.columns(samples)
        exact = _extended(columns, reference)
        q, r = np.linalg.qr(columns)
        by_qr = np.linalg.solve(r, q.T @ reference)[:6].T
        name = f"fitting, offsets of 24 000 counts, excitation {excitation:g}"
        found[f"{name}: ours"] = _relative(_ours(weak, samples, 0.0), exact)
        found[f"{name}: lstsq"] = _relative(weak.stacked(samples, 0.0)[:6].T, exact)
        found[f"{name}: QR"] = _relative(by_qr, exact)
        found[f"{name}: statistical"] = _relative(exact, weak.truth)
    return found


def _ours(problem: Problem, samples: int, regularisation: float) -> FloatArray:
    data = problem.data_sets[0]
    moments = Moments.of(data.raw[:samples], data.reference[:samples], data.variables[:samples])
    estimation = Estimation(
        kind=ESTIMATION_TYPES["OwTdTO"],
        prior=problem.prior,
        variables=(TEMPERATURE,),
        reference_values=np.zeros(1),
    )
    return solve(moments, estimation, regularisation).matrix


def _extended(columns: FloatArray, reference: FloatArray) -> FloatArray:
    """Matrix of the fit without penalty, by centred normal equations in extended precision."""
    x, f = columns[:, :-1].astype(np.longdouble), reference.astype(np.longdouble)
    x, f = x - x.mean(axis=0), f - f.mean(axis=0)
    gram, target = x.T @ x, x.T @ f
    for k in range(len(gram)):
        pivot = gram[k, k]
        gram[k], target[k] = gram[k] / pivot, target[k] / pivot
        for other in range(len(gram)):
            if other != k:
                factor = gram[other, k]
                gram[other] = gram[other] - factor * gram[k]
                target[other] = target[other] - factor * target[k]
    return np.asarray(target[:6].T, dtype=np.float64)


def _relative(one: FloatArray, other: FloatArray) -> float:
    return float(np.abs(one - other).max() / np.abs(other).max())
