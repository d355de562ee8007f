# SPDX-License-Identifier: BSD-3-Clause
"""The generative fit of eight recordings, beside the same evidence by a generic solver: dense covariances and `lstsq`.

The peer whitens all columns under every shape of the noise with a Cholesky factor of the covariance written out, and
solves every row once per shape by least squares on data and prior together. It knows the sizes of the deviations, which
ours finds.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable

import numpy as np
from scipy.linalg import cholesky, solve_triangular

from benchmarks.calibration.measured import Measured
from benchmarks.harness import interleaved, median_ratio
from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.slow_noise import CANDIDATES, SlowNoise
from forcetorque.calibration.generative.fit import fit_generative
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import WindowMeans

RECORDINGS, ROWS, UNKNOWNS = 8, 6, 39
"""Recordings of one power-up; rows of the model; unknowns of sensor, frame, quadratic terms and derivative window."""
OURS = "ours, sizes and noise by evidence"
DENSE = "dense covariance and numpy.linalg.lstsq, sizes given"
FULL_SCALE = 32768.0


class Problem:
    """Recordings of a sensor that is some per cent off, with noise and a slow offset."""

    def __init__(self, means: int) -> None:
        """Draw the recordings, always the same.

        Args:
            means: Means of a second in each.
        """
        rng = np.random.default_rng(5)
        gains = np.diag([15.0, 15.0, 15.0, 900.0, 900.0, 900.0])
        response = (np.eye(6) + 0.03 * rng.normal(size=(6, 6))) @ gains
        self.prior = np.linalg.inv(gains)
        self.stretches = []
        for k in range(RECORDINGS):
            wrench = np.cumsum(rng.normal(size=(means, 6)), axis=0) * [8.0, 8.0, 12.0, 0.4, 0.4, 0.2]
            slow = np.cumsum(rng.normal(size=(means, 6)), axis=0)
            self.stretches.append(
                WindowMeans(
                    label=str(k),
                    session="one",
                    recording=str(k),
                    time_s=np.arange(float(means)),
                    count=np.full(means, 100.0),
                    raw=wrench @ response.T + slow + rng.normal(size=(means, 6)),
                    reference=wrench,
                    flattening=np.zeros((means, 6)),
                    variables=np.zeros((means, 0)),
                )
            )

    def ours(self) -> object:
        """Fit everything.

        Returns:
            The fit.
        """
        return fit_generative(self.stretches, self.prior, Assumptions.of_counts(6, FULL_SCALE))

    def dense(self) -> list[FloatArray]:
        """Whiten under every shape with the covariance written out, and solve every row.

        Returns:
            Unknowns of every row under every shape.
        """
        wrench = np.concatenate([s.reference - s.reference.mean(axis=0) for s in self.stretches])
        reading = np.concatenate([s.raw - s.raw.mean(axis=0) for s in self.stretches]) @ self.prior.T - wrench
        load = wrench @ np.linalg.inv(self.prior).T / FULL_SCALE
        first, second = np.triu_indices(6)
        columns = np.hstack([wrench, wrench, load[:, first] * load[:, second], wrench])
        penalty = np.eye(UNKNOWNS)
        solutions = []
        for noise in CANDIDATES:
            white = np.concatenate([self._whitened(noise, k, np.hstack([columns, reading])) for k in range(RECORDINGS)])
            for row in range(ROWS):
                system = np.vstack([white[:, :UNKNOWNS], penalty])
                target = np.concatenate([white[:, UNKNOWNS + row], np.zeros(UNKNOWNS)])
                solutions.append(np.linalg.lstsq(system, target, rcond=None)[0])
        return solutions

    def _whitened(self, noise: SlowNoise, k: int, columns: FloatArray) -> FloatArray:
        time = self.stretches[k].time_s
        covariance = np.eye(len(time))
        if noise.ratio:
            covariance += noise.ratio * np.exp(-np.abs(time[:, None] - time) / noise.time_constant_s)
        own = columns[k * len(time) : (k + 1) * len(time)]
        return np.asarray(solve_triangular(cholesky(covariance, lower=True), own, lower=True))


def measure(*, quick: bool, rounds: int) -> Measured:
    """Time both in turn.

    Args:
        quick: Whether with small inputs.
        rounds: Counted rounds.

    Returns:
        The figures.
    """
    means = 90 if quick else 600
    problem = Problem(means)
    tasks: dict[str, Callable[[], object]] = {OURS: problem.ours, DENSE: problem.dense}
    timed = interleaved(tasks, rounds=rounds)
    return Measured(
        ratios={f"generative, speed of {OURS} against {DENSE}": 1.0 / median_ratio(timed[OURS], timed[DENSE])},
        seconds={f"generative, {name}, s": values for name, values in timed.items()},
        accuracy={},
        figures={
            "generative, recordings": RECORDINGS,
            "generative, means of each": means,
            "generative, s": {name: statistics.median(values) for name, values in timed.items()},
        },
    )
