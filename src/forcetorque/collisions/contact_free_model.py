# SPDX-License-Identifier: BSD-3-Clause
"""What residuals are while nothing touches the robot: learnt from samples without contact."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.calibration.moments_of_samples import assumptions_of
from forcetorque.collisions.sensor_residual import WINDOW_S, split_columns
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS, SENSOR, sensor_root
from forcetorque.experiment.campaign_intervals import CampaignRecording
from forcetorque.experiment.sensor_run import SensorRun

_FAR: Final = 5.0
"""Robust standard deviations from which a free window does not count for noise and errors."""
_ROUNDS: Final = 4
_TINY: Final = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FreeModel:
    """What changes of the residual are while nothing touches the robot."""

    mean: FloatArray
    """Errors of the matrix and of the robot model, over their prior deviations; shape (p,)."""
    covariance: FloatArray
    """Their covariance; shape (p, p)."""
    noise: FloatArray
    """Covariance of the noise of a window; shape (6, 6); N, N m."""
    unmodelled: FloatArray
    """Standard deviation of slow errors that no term explains, of which `noise` has the square; shape (k,); N, N m."""
    correlation_s: float
    """Time over which noise goes on; s."""

    def under_load(self, unmodelled: FloatArray) -> FreeModel:
        """Give the model where errors that no term explains are larger, for the load is.

        Args:
            unmodelled: As of `Signals`; shape (k,); N, N m.

        Returns:
            The model with the larger of both.
        """
        larger = np.maximum(unmodelled, self.unmodelled)
        return replace(self, noise=self.noise + np.diag(larger**2 - self.unmodelled**2), unmodelled=larger)

    @classmethod
    def of(cls, residual: FloatArray, terms: FloatArray, unmodelled: FloatArray) -> FreeModel:
        """Learn from windows in which nothing touches the robot.

        Args:
            residual: Changes of the residual; shape (w, k), six of a sensor; N, N m.
            terms: Changes of the terms; shape (w, k, p).
            unmodelled: As of `Signals`; shape (k,); N, N m.

        Returns:
            The model; windows that are far from all others do not count.
        """
        p = terms.shape[2]
        squares, products = _normal_equations(residual, terms)
        mean, left = np.zeros(p), residual
        covariance: FloatArray = np.eye(p)
        correlation = 1.0
        noise = np.zeros((residual.shape[1], residual.shape[1]))
        for _ in range(_ROUNDS):
            scale: FloatArray = np.maximum(MAD_TO_DEVIATION * np.median(np.abs(left), axis=0), _TINY)
            kept = np.asarray(np.sqrt(((left / scale) ** 2).mean(axis=1)) < _FAR)
            correlation = _correlated(left[kept])
            noise = left[kept].T @ left[kept] / max(int(np.count_nonzero(kept)), 1) + np.diag(scale**2) * _TINY
            far_squares, far_products = _normal_equations(residual[~kept], terms[~kept])
            weights = 1.0 / (correlation * np.diag(noise))
            covariance = np.asarray(np.linalg.inv(np.eye(p) + np.tensordot(weights, squares - far_squares, axes=1)))
            mean = covariance @ (weights @ (products - far_products))
            left = residual - terms @ mean
        return cls(
            mean=mean,
            covariance=covariance,
            noise=noise + np.diag(unmodelled**2),
            unmodelled=unmodelled,
            correlation_s=correlation * WINDOW_S,
        )


def _normal_equations(residual: FloatArray, terms: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Squares of the terms, shape (k, p, p), and their products with the residual, shape (k, p), of k components."""
    of_components = terms.transpose(1, 2, 0)  # (k, p, w)
    squares = np.array([one @ one.T for one in of_components])
    return squares, (of_components @ residual.T[:, :, None])[:, :, 0]


def _correlated(left: FloatArray) -> float:
    """Number of windows that count as one, of the component whose noise goes on longest."""
    from scipy.fft import next_fast_len

    most, length = 1.0, next_fast_len(2 * len(left), real=True)
    for column in (left - left.mean(axis=0)).T:
        spectrum = np.abs(np.fft.rfft(column, length)) ** 2
        correlation = np.fft.irfft(spectrum, length)[: len(column)]
        if correlation[0] <= 0.0:
            continue
        correlation = correlation / correlation[0]
        negative = np.flatnonzero(correlation < 0.0)
        end = int(negative[0]) if len(negative) else len(correlation)
        most = max(most, 2.0 * float(correlation[:end].sum()) - 1.0)
    return most


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FreeChanges:
    """What changes of the columns of `Signals` are while nothing touches the robot beyond a sensor.

    What errors of its matrix add is linear in the load, so that levels need six loads in place of 36 terms.
    """

    free: FreeModel
    """Of the residual: the terms are the 36 errors of the matrix, then the q of the robot model."""
    of_load: FloatArray
    """As of `matrix_errors`; shape (6, 6, 36)."""
    _mean_of_load: FloatArray = field(init=False)
    """What the mean errors of the matrix add per load; shape (6, 6)."""
    _spread_of_loads: FloatArray = field(init=False)
    """What products of two loads add to the covariance; shape (36, 36)."""
    _spread_with_model: FloatArray = field(init=False)
    """What products of a load and a term of the robot model add to half of it; shape (6, 6 q)."""

    def __post_init__(self) -> None:
        covariance, of_load = self.free.covariance, self.of_load
        p = of_load.shape[2]
        spread = np.einsum("lkp,pq,mnq->lmkn", of_load, covariance[:p, :p], of_load, optimize=True)
        object.__setattr__(self, "_mean_of_load", of_load @ self.free.mean[:p])
        object.__setattr__(self, "_spread_of_loads", spread.reshape(LOADS**2, LOADS**2))
        object.__setattr__(self, "_spread_with_model", (of_load @ covariance[:p, p:]).reshape(LOADS, -1))

    @classmethod
    def of(cls, changes: FloatArray, unmodelled: FloatArray, of_load: FloatArray) -> FreeChanges:
        """Learn from windows in which nothing touches the robot.

        Args:
            changes: Changes of their columns; shape (w, 12 + 6 q).
            unmodelled: As of `Signals`; shape (6,).
            of_load: As of `matrix_errors`; shape (6, 6, 36).

        Returns:
            The model; windows that are far from all others do not count.
        """
        residual, load, of_model = split_columns(changes)
        of_matrix = (load @ of_load.reshape(LOADS, -1)).reshape(len(load), *of_load.shape[1:])
        terms = np.concatenate([of_matrix, of_model], axis=2)
        return cls(free=FreeModel.of(residual, terms, unmodelled), of_load=of_load)

    def under_load(self, unmodelled: FloatArray) -> FreeChanges:
        """Give the same where errors that no term explains are larger, for the load is.

        Args:
            unmodelled: As of `Signals`; shape (6,).

        Returns:
            The model with the larger of both.
        """
        return replace(self, free=self.free.under_load(unmodelled))

    def wrench(self, changes: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give what changes cannot be explained by.

        Args:
            changes: Changes of the columns of windows; shape (w, 12 + 6 q).

        Returns:
            What a sensor reads too much, shape (w, 6), and its covariance if nothing touches the robot; shape
            (w, 6, 6); N, N m.
        """
        residual, load, of_model = split_columns(changes)
        count, p = len(load), self.of_load.shape[2]
        of_loads = (load[:, :, None] * load[:, None, :]).reshape(count, LOADS**2) @ self._spread_of_loads
        half = (load @ self._spread_with_model).reshape(of_model.shape)
        # one product of two matrices for all windows, in place of one for each
        of_models = of_model.reshape(count * LOADS, of_model.shape[2]) @ self.free.covariance[p:, p:]
        half += 0.5 * of_models.reshape(of_model.shape)
        with_model = half @ of_model.transpose(0, 2, 1)
        covariances = (
            self.free.noise + of_loads.reshape(count, LOADS, LOADS) + with_model + with_model.transpose(0, 2, 1)
        )
        return residual - load @ self._mean_of_load - of_model @ self.free.mean[p:], covariances

    def contact(self, excess: FloatArray, covariance: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Correct the reading of a contact by the errors of the matrix.

        Args:
            excess: What the sensor reads too much; shape (6,); N, N m.
            covariance: Its covariance without a contact; shape (6, 6).

        Returns:
            What the contact adds to the true wrench, and its covariance, in the frame and direction of the sensor.
        """
        of_matrix = slice(self.of_load.shape[2])
        reading = np.eye(LOADS) + self._mean_of_load.T
        wrench = np.asarray(np.linalg.solve(reading, excess))
        terms = np.einsum("l,lkp->kp", wrench, self.of_load)
        spread = covariance + terms @ self.free.covariance[of_matrix, of_matrix] @ terms.T
        inverse = np.linalg.inv(reading)
        return wrench, inverse @ spread @ inverse.T


def matrix_errors(run: SensorRun, matrix: FloatArray) -> FloatArray:
    """Give what an error of one standard deviation of every coefficient of a sensor's matrix adds per load.

    Args:
        run: The sensor.
        matrix: Its matrix.

    Returns:
        Shape (6, 6, 36): by component of the load, component of the reading, coefficient.

    Raises:
        ExperimentError: If the full scale of the sensor is not known.
    """
    run.sensor.require_six_components("a search for collisions")
    scaled = matrix * assumptions_of(CampaignRecording.of(run)).full_scale
    size = SENSOR.expected * np.sqrt((scaled**2).mean(axis=1))
    root = sensor_root(np.asarray(np.linalg.pinv(scaled), dtype=np.float64))
    return np.einsum("k,km,lj->lkmj", size, np.eye(LOADS), root).reshape(LOADS, LOADS, LOADS * LOADS)
