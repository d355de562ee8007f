# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor reads more than the robot model expects, and how uncertain that is at every instant.

Residuals are taken as changes against the recent level, so that a slow drift of the offset is none. An error of the
sensor's matrix and errors of the robot model (masses, centres, joint zeros, gravity, delay) move the residual in known
directions, each by a size that is known in advance. Samples in which nothing touches the robot tell their values; what
stays unknown of them, and the noise of these samples, is the covariance of the residual:

    change of residual = D nu + noise       nu ~ N(0, I) before the free samples, N(mean, covariance) after them

D has the change of the load, times the prior deviations of the matrix, and the change of the derivatives of the
expected wrench, times the tolerances of the robot model.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.noise.means import means_over
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.model_error_derivatives import derivatives_at
from forcetorque.calibration.moments import assumptions_of
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS, SENSOR, sensor_root
from forcetorque.experiment.campaign_intervals import CampaignRecording
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval

WINDOW_S: Final = 0.05
"""Length of the means in which contacts are looked for; s."""
LEVEL_S: Final = 5.0
"""Time constant of the level that changes are taken against; s."""
PAUSE_S: Final = 0.5
"""Pause in the readings after which the level begins anew; s."""
WARM_UP_S: Final = 1.0
"""Time that the level takes at first; s."""
TOGETHER: Final = 64
"""Windows that are compared at once while nothing touches the robot."""
UNMODELLED: Final = 0.02
"""Slow errors that no term explains, as a share of the load of the limb. A few seconds without contact do not show
them; on the yoga log of an iCub they are 2 to 4 N of 40 N at most."""
_FAR: Final = 5.0
"""Robust standard deviations from which a free window does not count for noise and errors."""
_ROUNDS: Final = 4
_TINY: Final = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Signals:
    """Means of a sensor over w windows of a recording."""

    time_s: FloatArray
    """Middle of each window on the clock of the recording; shape (w,); s."""
    columns: FloatArray
    """Measured less expected wrench, then what errors of one standard deviation add to it, of the matrix and of the
    robot model; shape (w, 6, 1 + p); N, N m."""
    of_model: tuple[str, ...]
    """Names of the terms of the robot model, which are the last ones."""
    of_load: FloatArray
    """What the first 36 terms are per unit of every component of a load; shape (6, 6, 36)."""
    unmodelled: FloatArray
    """Standard deviation of slow errors that no term explains, such as friction in cables; shape (6,); N, N m."""

    def __len__(self) -> int:
        return len(self.time_s)

    def kept(self, marks: BoolArray) -> Signals:
        """Keep some windows; where others are left out there is a pause.

        Args:
            marks: Which; shape (w,).

        Returns:
            The others left out.
        """
        return self if marks.all() else replace(self, time_s=self.time_s[marks], columns=self.columns[marks])

    def with_terms(self, names: Sequence[str]) -> Signals:
        """Order the terms of the robot model, and add those that another support has: here they move nothing.

        Args:
            names: Names of all, these among them.

        Returns:
            The same windows with these terms.
        """
        if tuple(names) == self.of_model:
            return self
        first = self.columns.shape[2] - len(self.of_model)
        columns = np.zeros((len(self), LOADS, first + len(names)))
        columns[:, :, :first] = self.columns[:, :, :first]
        columns[:, :, [first + names.index(name) for name in self.of_model]] = self.columns[:, :, first:]
        return replace(self, columns=columns, of_model=tuple(names))

    def starts(self) -> BoolArray:
        """Windows before which there is a pause, the first among them; shape (w,)."""
        return np.diff(self.time_s, prepend=-np.inf) > PAUSE_S


def signals_of(run: SensorRun, correction: Correction, interval: Interval) -> Signals:
    """Compare a sensor with the robot model over an interval.

    Args:
        run: The sensor.
        correction: How it is read; its offset does not matter.
        interval: The interval; its support says how the robot stands.

    Returns:
        Means over windows.

    Raises:
        ExperimentError: If the full scale of the sensor is not known.
    """
    part = run.interval_samples(interval, variables=correction.variables, smoothed=False, with_flattening=False)
    stamps = part.samples.stamp_ns
    start_ns = run.experiment.recording.start_ns
    seconds = (stamps - start_ns) * 1e-9
    expected = part.samples.reference
    residual = part.readings.wrench(correction) - expected
    whole = np.isfinite(residual).all(axis=1)
    time_s, means, _ = means_over(seconds[whole], np.hstack([residual, expected])[whole], WINDOW_S)
    load = means[:, LOADS:]
    at_ns: IntArray = start_ns + np.round(time_s * 1e9).astype(np.int64)
    rates = np.gradient(load, time_s, axis=0) if len(time_s) > 1 else np.zeros_like(load)
    terms, derivatives = derivatives_at(run, interval, "", at_ns, rates)
    known = np.isfinite(derivatives).all(axis=(1, 2))
    derivatives = derivatives if known.all() else derivatives[known]
    of_load = _of_load(run, correction.model.matrix)
    columns = np.empty((int(np.count_nonzero(known)), LOADS, 1 + of_load.shape[2] + len(terms)))
    columns[:, :, 0] = means[known, :LOADS]
    of_matrix, of_model = np.split(columns[:, :, 1:], [of_load.shape[2]], axis=2)
    of_matrix[:] = (load[known] @ of_load.reshape(LOADS, -1)).reshape(of_matrix.shape)
    # a residual falls by what the expected wrench rises
    np.multiply(derivatives, [-term.deviation for term in terms], out=of_model)
    return Signals(
        time_s=time_s[known],
        columns=columns,
        of_model=tuple(term.name for term in terms),
        of_load=of_load,
        unmodelled=np.repeat([UNMODELLED * _large(load[:, part]) for part in FORCE_AND_MOMENT], 3),
    )


def _large(vectors: FloatArray) -> float:
    """Size that 95 % of vectors stay below."""
    return float(np.percentile(np.linalg.norm(vectors, axis=1), 95)) if len(vectors) else 0.0


def _of_load(run: SensorRun, matrix: FloatArray) -> FloatArray:
    """What an error of one standard deviation of every coefficient of the matrix adds per load; shape (6, 6, 36)."""
    run.sensor.require_six_components("a search for collisions")
    assumptions = assumptions_of(CampaignRecording.of(run))
    scaled = matrix * assumptions.full_scale
    size = SENSOR.expected * np.sqrt((scaled**2).mean(axis=1))
    root = sensor_root(np.asarray(np.linalg.pinv(scaled), dtype=np.float64))
    return np.einsum("k,km,lj->lkmj", size, np.eye(LOADS), root).reshape(LOADS, LOADS, LOADS * LOADS)


class Level:
    """The recent mean of columns, against which changes are taken."""

    def __init__(self, signals: Signals) -> None:
        """Start before the first window.

        Args:
            signals: The windows, of which `changes` is asked in turn.
        """
        self._values, self._starts = signals.columns.reshape(len(signals), -1), signals.starts()
        self._shape = signals.columns.shape[1:]
        self._level = np.zeros(self._values.shape[1])
        self._count = 0

    def changes(self, first: int, end: int, *, held: bool = False) -> tuple[FloatArray, BoolArray]:
        """Take windows against the level of those before each.

        Args:
            first: The next window.
            end: The window behind the last one.
            held: Whether the level stays as it is once it is known, because something touches the robot.

        Returns:
            Columns of the windows less their level, shape (w, 6, 1 + p), and whether the level is known; shape (w,).
        """
        known, gains = np.zeros(end - first, dtype=np.bool_), []
        for k, starts in enumerate(self._starts[first:end].tolist()):
            if starts:
                self._count = 0
            known[k] = self._count * WINDOW_S >= WARM_UP_S
            gain = 0.0
            if not held or not known[k]:
                self._count += 1
                gain = max(WINDOW_S / LEVEL_S, 1.0 / self._count)
            gains.append(gain)
        values = self._values[first:end]
        levels = _weights(tuple(gains)) @ np.vstack([self._level, values])
        # a new array: a copy of this object keeps the level that it was made with
        self._level = levels[-1].copy()
        return (values - levels[:-1]).reshape(-1, *self._shape), known

    def restart(self) -> None:
        """Take the level anew from the next windows on."""
        self._count = 0


@lru_cache(maxsize=4)
def _weights(gains: tuple[float, ...]) -> FloatArray:
    """Weights of the level before the first window and of w windows in each level since then; shape (w + 1, 1 + w)."""
    weights = np.zeros((len(gains) + 1, 1 + len(gains)))
    weights[0, 0] = 1.0
    for k, gain in enumerate(gains):
        np.multiply(weights[k], 1.0 - gain, out=weights[k + 1])
        weights[k + 1, 1 + k] = gain
    return weights


def changes_of(intervals: Sequence[Signals]) -> FloatArray:
    """Take all windows against the level of those before them.

    Args:
        intervals: Windows of at least one interval, with the same terms.

    Returns:
        Changes of their columns, without the windows that have no level yet; shape (w, 6, 1 + p).
    """
    changes = np.empty((sum(map(len, intervals)), *intervals[0].columns.shape[1:]))
    count = 0
    for signals in intervals:
        level = Level(signals)
        for first in range(0, len(signals), TOGETHER):
            columns, known = level.changes(first, min(first + TOGETHER, len(signals)))
            before, count = count, count + int(np.count_nonzero(known))
            changes[before:count] = columns[known]
    return changes[:count]


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

    def wrench(self, change: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give what changes cannot be explained by.

        Args:
            change: Columns of windows, less their level; shape (w, 6, 1 + p).

        Returns:
            Unexplained wrenches, shape (w, 6), and their covariances if nothing touches the robot; shape (w, 6, 6);
            N, N m.
        """
        terms = change[:, :, 1:]
        # one product of two matrices for all windows, in place of one for each
        spread = (change.reshape(-1, change.shape[2])[:, 1:] @ self.covariance).reshape(terms.shape)
        return change[:, :, 0] - terms @ self.mean, self.noise + spread @ terms.transpose(0, 2, 1)

    def contact(self, excess: FloatArray, covariance: FloatArray, of_load: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Correct the reading of a contact by the errors of the matrix.

        Args:
            excess: What the sensor reads too much; shape (6,); N, N m.
            covariance: Its covariance without a contact; shape (6, 6).
            of_load: As of `Signals`; shape (6, 6, 36).

        Returns:
            What the contact adds to the true wrench, and its covariance, in the frame and direction of the sensor.
        """
        of_matrix = slice(of_load.shape[2])
        reading = np.eye(LOADS) + np.einsum("lkp,p->kl", of_load, self.mean[of_matrix])
        wrench = np.asarray(np.linalg.solve(reading, excess))
        terms = np.einsum("l,lkp->kp", wrench, of_load)
        spread = covariance + terms @ self.covariance[of_matrix, of_matrix] @ terms.T
        inverse = np.linalg.inv(reading)
        return wrench, inverse @ spread @ inverse.T

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
    most = 1.0
    for column in (left - left.mean(axis=0)).T:
        spectrum = np.abs(np.fft.rfft(column, 2 * len(column))) ** 2
        correlation = np.fft.irfft(spectrum)[: len(column)]
        if correlation[0] <= 0.0:
            continue
        correlation = correlation / correlation[0]
        negative = np.flatnonzero(correlation < 0.0)
        end = int(negative[0]) if len(negative) else len(correlation)
        most = max(most, 2.0 * float(correlation[:end].sum()) - 1.0)
    return most
