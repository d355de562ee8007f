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
from forcetorque.base.noise.window_means import means_over
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.model_error_derivatives import derivatives_at
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS
from forcetorque.experiment.calibration.robot_model_error import OF_CABLES
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
_FILTERED: Final = 16
"""Windows whose levels are one product of matrices; its size grows with their square."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Signals:
    """Means of a sensor over w windows of a recording."""

    time_s: FloatArray
    """Middle of each window on the clock of the recording; shape (w,); s."""
    columns: FloatArray
    """Measured less expected wrench, expected wrench, then what errors of one standard deviation of the robot model add
    to the first, q for each component; shape (w, 6 + 6 + 6 q); N, N m."""
    of_model: tuple[str, ...]
    """Names of the q terms of the robot model."""
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
        wrenches, own = split_columns(self.columns)[:2], split_columns(self.columns)[2]
        terms = np.zeros((len(self), LOADS, len(names)))
        terms[:, :, [names.index(name) for name in self.of_model]] = own
        columns = np.hstack([*wrenches, terms.reshape(len(self), -1)])
        return replace(self, columns=columns, of_model=tuple(names))

    def starts(self) -> BoolArray:
        """Windows before which there is a pause, the first among them; shape (w,)."""
        return np.diff(self.time_s, prepend=-np.inf) > PAUSE_S


def split_columns(columns: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Split columns of `Signals`, or their changes.

    Args:
        columns: The columns; shape (w, 12 + 6 q).

    Returns:
        Of the residual and of the expected wrench, shape (w, 6), and of the terms of the robot model, shape (w, 6, q).
    """
    residual, load, of_model = np.split(columns, [LOADS, 2 * LOADS], axis=1)
    return residual, load, of_model.reshape(len(columns), LOADS, of_model.shape[1] // LOADS)


def signals_of(run: SensorRun, correction: Correction, interval: Interval) -> Signals:
    """Compare a sensor with the robot model over an interval.

    Args:
        run: The sensor.
        correction: How it is read; its offset does not matter.
        interval: The interval; its support says how the robot stands.

    Returns:
        Means over windows.
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
    terms, derivatives = derivatives_at(run, interval, "", at_ns, rates, without=OF_CABLES)
    known = np.isfinite(derivatives).all(axis=(1, 2))
    columns = np.empty((int(np.count_nonzero(known)), 2 * LOADS + LOADS * len(terms)))
    columns[:, : 2 * LOADS] = means[known]
    # a residual falls by what the expected wrench rises
    of_model = split_columns(columns)[2]
    np.multiply(derivatives if known.all() else derivatives[known], [-term.deviation for term in terms], out=of_model)
    return Signals(
        time_s=time_s[known],
        columns=columns,
        of_model=tuple(term.name for term in terms),
        unmodelled=np.repeat([UNMODELLED * _large(load[:, part]) for part in FORCE_AND_MOMENT], 3),
    )


def _large(vectors: FloatArray) -> float:
    """Size that 95 % of vectors stay below."""
    return float(np.percentile(np.linalg.norm(vectors, axis=1), 95)) if len(vectors) else 0.0


class Level:
    """The recent mean of columns, against which changes are taken."""

    def __init__(self, signals: Signals) -> None:
        """Start before the first window.

        Args:
            signals: The windows, of which `changes` is asked in turn.
        """
        self._values, self._starts = signals.columns, signals.starts()
        self._level = np.zeros(self._values.shape[1])
        self._count = 0

    def changes(self, first: int, end: int, *, held: bool = False) -> tuple[FloatArray, BoolArray]:
        """Take windows against the level of those before each.

        Args:
            first: The next window.
            end: The window behind the last one.
            held: Whether the level stays as it is once it is known, because something touches the robot.

        Returns:
            Columns of the windows less their level, shape (w, 12 + 6 q), and whether the level is known; shape (w,).
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
        changes = np.empty_like(values)
        for k in range(0, len(values), _FILTERED):
            block = slice(k, k + _FILTERED)
            levels = _weights(tuple(gains[block])) @ np.vstack([self._level, values[block]])
            np.subtract(values[block], levels[:-1], out=changes[block])
            # a new array: a copy of this object keeps the level that it was made with
            self._level = levels[-1].copy()
        return changes, known

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
        Changes of their columns, without the windows that have no level yet; shape (w, 12 + 6 q).
    """
    changes = np.empty((sum(map(len, intervals)), intervals[0].columns.shape[1]))
    count = 0
    for signals in intervals:
        level = Level(signals)
        for first in range(0, len(signals), TOGETHER):
            columns, known = level.changes(first, min(first + TOGETHER, len(signals)))
            before, count = count, count + int(np.count_nonzero(known))
            changes[before:count] = columns[known]
    return changes[:count]
