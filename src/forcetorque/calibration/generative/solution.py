# SPDX-License-Identifier: BSD-3-Clause
"""Rows whose unknowns are known: the matrix that they come to, and what is known of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.generative.agreement import require_response, require_sensor
from forcetorque.calibration.generative.design import Design
from forcetorque.calibration.generative.evidence import Unknowns
from forcetorque.experiment.calibration.assumptions import LOADS, Assumptions, Rows, rows_of
from forcetorque.experiment.calibration.linear_variable import LinearVariable
from forcetorque.experiment.calibration.posterior import Posterior, RowNoise
from forcetorque.experiment.calibration.quadratic_correction import PAIRS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedRows:
    """The rows of a regression with the unknowns that explain them."""

    rows: Rows
    """What was regressed."""
    design: Design
    """On what."""
    basis: Sequence[FloatArray]
    """What the columns of the design are worth in the unknowns of every row; shape (a, q) each."""
    unknowns: Sequence[Unknowns]
    """Unknowns of every row."""
    expected_rows: FloatArray
    """What variables were expected to add to every row, which was taken off; shape (rows, v)."""
    matrix: FloatArray
    """Matrix about which the rows are written: the prior, or one that reads the data roughly; shape (6, c)."""
    with_prior: bool
    """Whether it is the prior."""
    assumptions: Assumptions
    """Full scales, accuracy of the reference and repeatability."""

    def solution(self, variables: Sequence[LinearVariable], wrench: FloatArray) -> tuple[FloatArray, Posterior]:
        """Give the matrix, and what is known of all unknowns.

        Args:
            variables: The linear variables.
            wrench: Wrenches of the means; shape (n, 6); N, N m.

        Returns:
            The matrix, shape (6, c), and the posterior.

        Raises:
            FitError: If the data say that the sensor has lost a direction, or do not tell all of a matrix without a
                prior.
        """
        rows, unit, sessions = self.rows, self.rows.unit, self.design.sessions
        known = [self._row(k) for k in range(len(unit))]
        mean = np.stack([row[0] for row in known]) * unit[:, None]
        covariance = np.stack([row[1] for row in known]) * unit[:, None, None] ** 2
        learnt = covariance[:, :LOADS, :LOADS].copy()
        noise = self._noise()
        matrix, to_wrench = self._matrix(mean[:, :LOADS], noise)
        if rows.space == "channel":
            mean[:, :LOADS] += rows.from_load * unit[:, None]
        covariance += self._repeatability(matrix)
        prior = self._before(unit) if self.with_prior else None
        if not self.with_prior:
            response = mean[:, :LOADS] if rows.space == "channel" else np.eye(LOADS) + mean[:, :LOADS]
            require_response(response / unit[:, None], learnt / unit[:, None, None] ** 2, wrench)
        posterior = Posterior(
            space=rows.space,
            variables=tuple(variable.name for variable in variables),
            sessions=sessions,
            drift=self.design.free.shape[1] > len(sessions),
            mean=mean,
            covariance=covariance,
            learnt_covariance=learnt,
            prior_covariance=prior,
            to_wrench=to_wrench,
            noise=noise,
            accuracy=self.assumptions.reference_accuracy(self.matrix),
            repeatability=self.assumptions.repeatability,
            load_centre=self.design.load_centre,
        )
        return matrix, posterior

    def quadratic(self) -> FloatArray:
        """Give what the quadratic terms of the loads add to the rows.

        Returns:
            Coefficients; shape (rows, 21); N, N m or counts.
        """
        place = 2 * LOADS + self.expected_rows.shape[1]
        terms = np.stack([unknown.coefficients[place : place + len(PAIRS[0])] for unknown in self.unknowns])
        return terms * self.rows.unit[:, None]

    def _noise(self) -> tuple[RowNoise, ...]:
        """Noise of every row, in its unit of readings."""
        return tuple(
            RowNoise(
                white=float(np.sqrt(unknown.variance) * unit),
                time_constant_s=unknown.data.noise.time_constant_s,
                ratio=unknown.data.noise.ratio,
            )
            for unknown, unit in zip(self.unknowns, self.rows.unit, strict=True)
        )

    def _row(self, k: int) -> tuple[FloatArray, FloatArray]:
        """Mean and covariance of [six coefficients, variables, offsets, drifts] of a row, in its unit."""
        unknown, basis, design = self.unknowns[k], self.basis[k], self.design
        sessions, free = len(design.sessions), design.free.shape[1]
        used = LOADS + self.expected_rows.shape[1]
        data = unknown.data
        worth = data.free_columns @ basis  # of the free unknowns, by what the others explain
        from_unknowns = np.zeros((used + free, len(unknown.coefficients)))
        from_unknowns[:used] = basis[:used]
        from_unknowns[used:] = -worth
        from_unknowns[used : used + sessions] -= design.column_means[:, :used] @ basis[:used]
        constant = np.zeros(used + free)
        constant[LOADS:used] = self.expected_rows[k]
        constant[used:] = data.free_response[:, k]
        constant[used : used + sessions] += design.response_means[:, k]
        covariance = from_unknowns @ unknown.covariance @ from_unknowns.T
        covariance[used:, used:] += unknown.variance * data.free_covariance
        return constant + from_unknowns @ unknown.coefficients, 0.5 * (covariance + covariance.T)

    def _matrix(self, change: FloatArray, noise: Sequence[RowNoise]) -> tuple[FloatArray, FloatArray]:
        """The matrix, and what turns errors of rows into errors of wrenches."""
        rows, unit = self.rows, self.rows.unit
        if rows.space == "wrench":
            require_sensor(np.eye(LOADS) + change * (unit / unit[:, None]))
            to_wrench = np.asarray(np.linalg.inv(np.eye(LOADS) + change), dtype=np.float64)
            return to_wrench @ self.matrix, to_wrench
        response = rows.from_load * unit[:, None] + change
        precision = np.array([1.0 / (one.white**2 * (1.0 + one.ratio)) for one in noise])[:, None]
        weighed = precision * response
        matrix = np.asarray(np.linalg.solve(response.T @ weighed, weighed.T), dtype=np.float64)
        return matrix, matrix

    def _before(self, unit: FloatArray) -> FloatArray:
        """Covariance of the six coefficients of every row before any data."""
        prior = []
        for k, unknown in enumerate(self.unknowns):
            root = self.basis[k][:LOADS, : 2 * LOADS] * unknown.deviations[: 2 * LOADS]
            prior.append(unit[k] ** 2 * root @ root.T)
        return np.stack(prior)

    def _repeatability(self, matrix: FloatArray) -> FloatArray:
        """Covariance by motions in which the sensor answers otherwise, about the mean load of each session."""
        rows, design = self.rows, self.design
        sessions, free = len(design.sessions), design.free.shape[1]
        used = LOADS + self.expected_rows.shape[1]
        jacobian = np.zeros((used + free, LOADS))
        jacobian[:LOADS] = np.eye(LOADS)
        jacobian[used : used + sessions] = -design.column_means[:, :LOADS]
        roots = rows_of(matrix, self.assumptions, in_wrench=rows.space == "wrench").sensor_root
        spread = self.assumptions.repeatability * jacobian @ (roots * rows.unit[:, None, None])
        return spread @ spread.transpose(0, 2, 1)
