# SPDX-License-Identifier: BSD-3-Clause
"""A matrix that is known in part and loads that nobody weighed, told apart as far as the rows allow.

A reading tells `(1 + E) wrench`: loads that are heavier by a share and a sensor that answers less by it read alike.
Only the prior of E splits them. Two things would lean on that where the largest joint density of E and loads is taken:
a prior of another size than the deviations have, and the range of matrices that explain the rows, which is the narrower
the heavier the loads are taken. So sizes of deviations are those that the rows tell, as in the generative calibration,
and loads are chosen by their evidence, averaged over E:

    log evidence(loads) = max over E of log joint density - 1/2 sum_i log det H_i,   H_i = Q_i^-1 + W^T W / s_i^2

The slope of the last term goes into the problem (MacKay, Bayesian interpolation, Neural Computation 4, 1992; for a
bilinear form Levin, Weiss, Durand, Freeman, Understanding and evaluating blind deconvolution algorithms, CVPR 2009).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import reading_sign
from forcetorque.experiment.calibration.expected_sensor_errors import FRAME, SENSOR, Assumptions, rows_of
from forcetorque.payload.identification.estimate_under_noise import noise_sizes
from forcetorque.payload.identification.estimation_problem import LoadProblem
from forcetorque.payload.identification.measurement_model import load_columns, load_wrench
from forcetorque.payload.identification.parameter_vector import Guess, Kind
from forcetorque.payload.identification.robust_fit import plain_fit

_ROUNDS = 40
"""Rounds in which sizes and loads settle; eight are usual."""
_SETTLED = 1e-4
"""Relative change of the sizes at which they are settled."""
_FARTHEST = 0.5
"""Size of the deviations beyond which the matrix is no longer known in part: they and the loads would run away."""
_COMPONENTS = 6
_KINDS: Final = (SENSOR, FRAME)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixSpread:
    """How far a matrix may be off, in kinds of deviations whose sizes the rows tell, for forces and moments apart."""

    roots: FloatArray
    """L of every kind and row, with L L^T the covariance of the six coefficients of E where the size of the kind is 1;
    shape (kinds, 6, 6, 6); N or N m per N, N m."""
    group: IntArray
    """Rows of one number share their sizes; shape (6,)."""

    @classmethod
    def of(cls, matrix: FloatArray, assumptions: Assumptions) -> MatrixSpread:
        """Take what the generative calibration takes for granted.

        Args:
            matrix: The matrix so far; shape (6, c); N/count, N m/count.
            assumptions: Full scales of its channels, and how far the matrix may be off where that is stated.

        Returns:
            The spread.
        """
        rows = rows_of(matrix, assumptions, in_wrench=matrix.shape[1] == _COMPONENTS)
        # the size of a kind is relative to what is expected where nobody states it
        sizes = rows.prior_sizes(assumptions, SENSOR.expected)[:, None, None] / SENSOR.expected
        kinds = (sizes * rows.sensor_root, rows.frame_root)
        if rows.space == "wrench":
            return cls(roots=np.stack(kinds) * rows.unit[:, None, None], group=rows.group)
        # of other than six channels: what the deviations of the channels come to in the wrench that the prior reads
        share = (matrix * rows.unit) ** 2
        squares = [np.einsum("ij,jab->iab", share, root @ root.transpose(0, 2, 1)) for root in kinds]
        return cls(roots=np.linalg.cholesky(np.stack(squares)), group=np.repeat([0, 1], 3))

    @property
    def expected(self) -> FloatArray:
        """Sizes before any rows; shape (groups, kinds)."""
        return np.tile([kind.expected for kind in _KINDS], (int(self.group.max()) + 1, 1))

    def covariance(self, sizes: FloatArray) -> FloatArray:
        """Give the covariance of E.

        Args:
            sizes: Of every group and kind; shape (groups, kinds).

        Returns:
            That of each row; shape (6, 6, 6).
        """
        scaled = self.roots * sizes[self.group].T[:, :, None, None]
        return np.einsum("kiab,kicb->iac", scaled, scaled)

    def told(self, sizes: FloatArray, deviation: FloatArray, posterior: FloatArray) -> FloatArray:
        """Give the sizes that deviations have.

        Args:
            sizes: Sizes under which these were found; shape (groups, kinds).
            deviation: E; shape (6, 6).
            posterior: Covariance of every row of E; shape (6, 6, 6).

        Returns:
            Sizes, with those that were expected as a few coefficients; shape (groups, kinds).
        """
        prior = self.covariance(sizes)
        squares, determined = np.zeros_like(sizes), np.zeros_like(sizes)
        for row, number in enumerate(self.group):
            for kind in range(len(_KINDS)):
                variance = sizes[number, kind] ** 2
                gain = variance * self.roots[kind, row].T @ np.linalg.inv(prior[row])
                squares[number, kind] += float(((gain @ deviation[row]) ** 2).sum())
                # share of what was not known that is known now
                learnt = gain @ (prior[row] - posterior[row]) @ gain.T
                determined[number, kind] += float(np.trace(learnt)) / variance
        weight = np.array([kind.weight for kind in _KINDS])
        return np.asarray(np.sqrt((squares + weight * self.expected**2) / (determined + weight)), dtype=np.float64)


def settled(problem: LoadProblem, spread: MatrixSpread) -> LoadProblem:
    """Let the rows say how far the matrix is off, and weigh loads by all matrices that explain them.

    Args:
        problem: Rows and loads; whether biases drift must be stated.
        spread: How far the matrix may be off.

    Returns:
        The problem with `matrix_prior` and `slope`, to solve.

    Raises:
        FitError: If no matrix near the prior explains the rows.
    """
    sizes = spread.expected
    problem = replace(problem, matrix_prior=spread.covariance(sizes))
    for _ in range(_ROUNDS):
        guess, residual = plain_fit(problem, drift=bool(problem.drift))
        noise = noise_sizes(residual)
        posterior = _covariance_of_rows(problem, guess, noise)
        learnt = spread.told(sizes, guess.response - np.eye(_COMPONENTS), posterior)
        slope = _slope(problem, guess, posterior, noise)
        if learnt.max() > _FARTHEST:
            raise FitError(
                f"loads: no matrix near its prior explains the readings, it would have to be {learnt.max():.0%} off; "
                "check gravity_direction and measure_direction, the units of joints and wrench, the prior, and whether "
                "the sensor is turned against the URDF (`forcetorque inspect`)"
            )
        change = np.abs(learnt / sizes - 1.0).max()
        sizes = learnt
        problem = replace(problem, matrix_prior=spread.covariance(sizes), slope=slope)
        if change < _SETTLED:
            break
    return problem


def _covariance_of_rows(problem: LoadProblem, guess: Guess, noise: FloatArray) -> FloatArray:
    """Covariance of every row of E if the loads were known; shape (6, 6, 6)."""
    wrench = _about_sessions(problem, load_wrench(problem, guess))
    information = np.einsum("n,ni,nj->ij", problem.rows.share, wrench, wrench)
    prior = np.linalg.inv(np.zeros((6, 6, 6)) if problem.matrix_prior is None else problem.matrix_prior)
    return np.linalg.inv(prior + information / noise[:, None, None] ** 2)


def _slope(problem: LoadProblem, guess: Guess, posterior: FloatArray, noise: FloatArray) -> tuple[FloatArray, ...]:
    """Change of half the logarithms of the determinants with the inertial parameters of every load; shapes (10,)."""
    sign = reading_sign(problem.direction, child_is_outboard=True)
    columns = sign * load_columns(problem.rows, guess.rotation, guess.of(Kind.TILT))
    wrench = _about_sessions(problem, load_wrench(problem, guess))
    weight = (posterior / noise[:, None, None] ** 2).sum(axis=0)
    along = problem.rows.share[:, None] * wrench @ weight
    return tuple(
        np.einsum("ni,nia->a", along[problem.rows.load == number], columns[problem.rows.load == number])
        for number in range(len(problem.loads))
    )


def _about_sessions(problem: LoadProblem, values: FloatArray) -> FloatArray:
    """Values less their mean in every session, whose bias is not known."""
    about = values.copy()
    for number in np.unique(problem.rows.session):
        mine = problem.rows.session == number
        about[mine] -= np.average(about[mine], axis=0, weights=problem.rows.share[mine])
    return about
