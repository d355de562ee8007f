# SPDX-License-Identifier: BSD-3-Clause
"""How well an expected wrench explains a measured one, whatever the errors of a mounted sensor's matrix are.

Every component is measured as `expected + error of the matrix + offset + drift + noise`. Coefficients of the matrix are
normal, with one of a few deviations relative to their row, of which the likeliest counts; they, offset and drift are
integrated out, so that a specific explanation wins over a bad matrix wherever both fit (Bayesian model comparison).
What is left has the deviation of the best explanation, and counts for a limited number of independent samples.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.base.wrench import FORCE_AND_MOMENT

_SCALES = (0.01, 0.03, 0.1, 0.2, 0.4)
"""Deviations of the coefficients of a matrix relative to their row, of a good sensor to a bad one; twice as much in
rows of moments."""
_INDEPENDENT = 40.0
"""Most independent samples that a log counts for: errors of the robot model last as long as a posture does."""
_FLOOR = 0.005
"""Least deviation of what no explanation accounts for, relative to how much the wrench moves."""
_CENTRE_M = 0.002
"""Least lever of the deviation of moments: centres of mass are known no better; m."""
_LEVER_M = 0.02
"""Least lever of the size of moments; m."""
_OFFSET, _DRIFT = 30.0, 0.1
"""Deviation of offset, and of drift over half of the log, relative to how much the wrench moves."""
_FOLLOWS = (0.8, 0.6)
"""Shares of the variance of force and moment that an explanation has to explain to be one."""
_UNIMPORTANT = 0.1
"""Movement, relative to the size of forces or moments, below which they hardly move."""
_TAIL = 9.0
"""Squared distance, in deviations, from which on a sample counts less: contacts and jumps are no noise."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fit(ArrayRecord):
    """How well one expected wrench explains the measurements."""

    evidence: float
    """Logarithm of the marginal likelihood, up to a constant that all explanations share."""
    residual: FloatArray = field(metadata=array("n", 6))
    """What is left without offset, drift and error of the matrix; shape (n, 6); N, N m."""
    unexplained: FloatArray = field(metadata=array("n", 6))
    """What is left without offset and drift; shape (n, 6); N, N m."""
    step: FloatArray = field(metadata=array("p"))
    """Change of the parameters that explains most of the rest; shape (p,)."""
    covariance: FloatArray = field(metadata=array("p", "p"))
    """Covariance of the parameters; shape (p, p)."""
    coefficients: FloatArray = field(metadata=array("k", 6))
    """Error of the matrix per column of the design, offset and drift; shape (k, 6)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Evidence(ArrayRecord):
    """Measurements of a sensor that explanations are compared on."""

    measured: FloatArray = field(metadata=array("n", 6))
    """Measured wrenches; shape (n, 6); N, N m."""
    along: FloatArray = field(metadata=array("n"))
    """Time, -1 to 1 over the log; shape (n,)."""
    prior: FloatArray = field(metadata=array(6, "c"))
    """Matrix by which the sensor is read, or the identity for one that is not known; shape (6, c)."""
    deviation: FloatArray = field(metadata=array(6))
    """Deviation of what no explanation accounts for; shape (6,); N, N m."""
    weights: FloatArray = field(metadata=array("n"))
    """What each sample counts, at most 1; shape (n,)."""
    size: FloatArray = field(metadata=array(6))
    """How much forces and moments move; shape (6,); N, N m."""

    @classmethod
    def of(cls, measured: FloatArray, expected: FloatArray, time_s: FloatArray, prior: FloatArray | None) -> Evidence:
        """Begin with all samples alike, and the deviation of the best linear explanation.

        Args:
            measured: Measured wrenches; shape (n, 6); N, N m.
            expected: Expected wrenches by the model as it is; shape (n, 6); N, N m.
            time_s: Instants; shape (n,); s.
            prior: Matrix by which the sensor is read; shape (6, c); None where it is not known.

        Returns:
            The evidence.
        """
        along = np.zeros(len(time_s)) if len(time_s) < 2 else 2.0 * (time_s - time_s[0]) / np.ptp(time_s) - 1.0
        design = np.column_stack([expected, np.ones(len(along)), along])
        rest = measured - design @ np.linalg.lstsq(design, measured, rcond=None)[0]
        start = cls(
            measured=measured,
            along=along,
            prior=np.eye(6) if prior is None else prior,
            deviation=np.ones(6),
            weights=np.ones(len(along)),
            size=_size(measured),
        )
        return start._with(rest, np.ones(len(along)))

    def reweighted(self, best: Fit) -> Evidence:
        """Let samples that the best explanation leaves far off count less.

        Args:
            best: The best explanation so far.

        Returns:
            The evidence with its deviation and weights.
        """
        settled = self._with(best.residual, self.weights)
        distance = ((best.residual / settled.deviation) ** 2).mean(axis=1)
        return settled._with(best.residual, 1.0 / (1.0 + distance / _TAIL))

    def _with(self, residual: FloatArray, weights: FloatArray) -> Evidence:
        floor = np.maximum(_FLOOR * self.size, np.finfo(float).tiny)
        floor[3:] = np.maximum(floor[3:], _CENTRE_M * self.size[0])
        spread = MAD_TO_DEVIATION * np.median(np.abs(residual - np.median(residual, axis=0)), axis=0)
        return Evidence(
            measured=self.measured,
            along=self.along,
            prior=self.prior,
            deviation=np.maximum(spread, floor),
            weights=weights,
            size=self.size,
        )

    def fit(self, expected: FloatArray, turn: FloatArray | None = None, derivatives: FloatArray | None = None) -> Fit:
        """Compare an expected wrench with the measurements.

        Args:
            expected: Expected wrenches before `turn`; shape (n, 6); N, N m.
            turn: What the log makes of the wrench that the sensor feels; shape (6, 6); nothing if None.
            derivatives: Derivatives of what is expected of the log by p parameters; shape (n, 6, p); none if None.

        Returns:
            The fit.
        """
        turn = np.eye(6) if turn is None else turn
        columns = np.zeros((len(expected), 6, 0)) if derivatives is None else derivatives
        counts, row = self._counts(expected, turn)
        root = np.sqrt(self.weights)[:, None]
        design = np.column_stack([counts, np.ones(len(counts)), self.along])
        weighted, rest = root * design, root * (self.measured - expected @ turn.T)
        tempered = min(1.0, _INDEPENDENT / len(expected)) / self.deviation**2
        # per scale and component: (scale, 6, k)
        variance = np.empty((len(_SCALES), 6, row.shape[1] + 2))
        variance[:, :, :-2] = (np.array(_SCALES)[:, None, None] * row) ** 2
        variance[:, :, -2:] = np.array([_OFFSET**2, _DRIFT**2]) * self.size[None, :, None] ** 2
        gram = tempered[:, None, None] * (weighted.T @ weighted)
        right = (weighted.T @ rest).T * tempered[:, None]
        # scaled by the deviations of the prior, so that the factorisation is of 1 + something positive
        spread = np.sqrt(variance)
        inner = np.eye(design.shape[1]) + spread[..., :, None] * gram * spread[..., None, :]
        solved = np.linalg.solve(inner, (spread * right)[..., None])[..., 0]
        square = tempered * (rest**2).sum(axis=0)
        logs = np.linalg.slogdet(inner)[1]
        evidence = -0.5 * (square - (solved * spread * right).sum(axis=2) + logs).sum(axis=1)
        best = int(np.argmax(evidence))
        coefficients = (spread[best] * solved[best]).T
        rest_of_log = self.measured - expected @ turn.T - design[:, -1:] @ coefficients[-1:]
        residual = self.measured - expected @ turn.T - design @ coefficients
        step, covariance = self._step(weighted, rest, root[..., None] * columns, tempered, spread[best], inner[best])
        return Fit(
            evidence=float(evidence[best]),
            residual=residual,
            # the fitted offset goes with the errors of the matrix, without which it is another one
            unexplained=rest_of_log - self.weights @ rest_of_log / self.weights.sum(),
            step=step,
            covariance=covariance,
            coefficients=coefficients,
        )

    def left(self, fit: Fit, *, beside_matrix: bool = False) -> FloatArray:
        """Give the root mean square of what a fit leaves, outliers counted less.

        Args:
            fit: The fit.
            beside_matrix: Whether errors of the matrix are taken out too.

        Returns:
            Of the force and of the moment; shape (2,); N, N m.
        """
        square = self.weights @ (fit.residual if beside_matrix else fit.unexplained) ** 2 / self.weights.sum()
        return np.sqrt(np.array([square[own].sum() for own in FORCE_AND_MOMENT]))

    def follows(self, fit: Fit) -> bool:
        """Tell whether the measurements are mostly what a fit explains, so that nothing else, as a contact, moves them.

        Returns:
            Whether it explains most of the movement of the force, and of the moment.
        """
        share = self.weights / self.weights.sum()
        moved = self.measured - share @ self.measured
        square = np.array([(share @ moved**2)[own].sum() for own in FORCE_AND_MOMENT])
        square = np.maximum(square, (self.size[[0, 3]] * _UNIMPORTANT) ** 2)
        return bool((self.left(fit, beside_matrix=True) ** 2 < (1.0 - np.array(_FOLLOWS)) * square).all())

    @cached_property
    def _to_counts(self) -> FloatArray | None:
        """Counts per wrench by the prior, shape (6, c); None without a prior."""
        return None if np.array_equal(self.prior, np.eye(6)) else np.asarray(np.linalg.pinv(self.prior).T)

    def _counts(self, expected: FloatArray, turn: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Columns that errors of the matrix multiply, shape (n, c), and their deviation per unit of scale, (6, c)."""
        part = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])[:, None]
        if self._to_counts is not None:
            read = turn @ self.prior
            row = np.sqrt((read**2).mean(axis=1))[:, None] * np.ones((1, self.prior.shape[1]))
            return expected @ self._to_counts, part * row
        return expected / self.size, part * np.outer(np.abs(turn) @ self.size, np.ones(6))

    def _step(
        self,
        design: FloatArray,
        rest: FloatArray,
        columns: FloatArray,
        tempered: FloatArray,
        spread: FloatArray,
        inner: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:
        """Generalised least squares for the parameters, with errors of the matrix as correlated noise."""
        p = columns.shape[2]
        if not p:
            return np.empty(0), np.empty((0, 0))
        information, gradient = np.zeros((p, p)), np.zeros(p)
        for i in range(6):
            cross = spread[i][:, None] * (design.T @ columns[:, i]) * tempered[i]  # (k, p)
            kept = np.linalg.solve(inner[i], cross)
            information += tempered[i] * columns[:, i].T @ columns[:, i] - cross.T @ kept
            pull = spread[i] * (design.T @ rest[:, i]) * tempered[i]
            gradient += tempered[i] * columns[:, i].T @ rest[:, i] - kept.T @ pull
        covariance = np.linalg.pinv(information, hermitian=True)
        return np.asarray(covariance @ gradient), np.asarray(covariance, dtype=np.float64)


def _size(measured: FloatArray) -> FloatArray:
    middle = np.median(measured, axis=0)
    force, moment = (
        float(np.sqrt((np.percentile(np.abs(measured[:, own] - middle[own]), 90, axis=0) ** 2).sum()))
        for own in FORCE_AND_MOMENT
    )
    return np.repeat([force, max(moment, _LEVER_M * force)], 3) + np.finfo(float).tiny
