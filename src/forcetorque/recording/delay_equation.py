# SPDX-License-Identifier: BSD-3-Clause
"""The equation that a delay solves: what is left of a reading does not follow the speed of its reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError

_ITERATIONS, _CLOSE = 60, 1e-4
"""Steps towards the solution, and the part of a step of time below which it is one."""
_NEAR = 0.25
"""Part of a step of time by which the equation is differentiated."""
_SMOOTH_STEPS = 2.0
"""Standard deviation of the smoothing, in steps of time: of what has half the fastest frequency it leaves 1 %."""
_ROUNDING = 1e-9
"""Part of the largest singular value below which a direction of the reference does not move."""
_WAVES = 6
"""Half waves along the recording that estimate the error of its sum. Fewer make intervals wide, more too narrow where
what is left lasts long: of a reading that the reference leaves part of, as long as the slowest motion."""
_FEWEST_STEPS = 10
"""Steps of time in a block, at least."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DelaySolution:
    """Delay and drift that solve the equation, with standard errors."""

    values: FloatArray
    """Delay in s, then drift where it was requested; shape (q,)."""
    standard_error: FloatArray
    """Standard errors; shape (q,)."""
    degrees_of_freedom: FloatArray
    """Of Student's t; shape (q,)."""
    explained: float
    """Share of the movement of the reading that is explained, in the column where that is largest."""


@dataclass(frozen=True, slots=True, eq=False)
class _Residual:
    """What is left at a delay."""

    error: FloatArray  # (n, k)
    information: FloatArray  # of the delay, sample by sample; (n,)
    score: FloatArray  # (n, q)
    curvature: FloatArray  # of Gauss and Newton; (q, q)


class DelayEquation:
    """Reading and reference of several intervals."""

    def __init__(
        self,
        times_s: Sequence[FloatArray],
        measured: Sequence[FloatArray],
        *,
        reference_time_s: FloatArray,
        reference: FloatArray,
        step_s: float,
        middle_s: float,
    ) -> None:
        """Take intervals that lie inside the reference, by as much as delays will be.

        Args:
            times_s: Even steps of time of every interval; shapes (n,); s.
            measured: Reading at these steps; shapes (n, k).
            reference_time_s: Stamps of the reference, rising; shape (m,); s.
            reference: Reference; shape (m, p).
            step_s: Step of time of the reading; s.
            middle_s: Instant at which drift adds nothing; s.
        """
        from scipy.interpolate import CubicSpline  # here because importing it takes longer than most commands

        self.time = np.concatenate(times_s)
        self.reading = np.concatenate(measured)
        self.step, self.since = step_s, self.time - middle_s
        self._curve = CubicSpline(reference_time_s, reference)
        lengths = list(map(len, times_s))
        number = np.repeat(np.arange(len(lengths)), lengths)
        along = np.concatenate([np.linspace(-1.0, 1.0, length) for length in lengths])
        own = number[:, None] == np.arange(len(lengths))
        self._constant = np.hstack([own, own * along[:, None]]).astype(np.float64)

    def solve(self, start: float, *, with_drift: bool) -> DelaySolution:
        """Solve it.

        Args:
            start: Delay to begin with, within a step or two of the solution; s.
            with_drift: Whether the delay grows with time.

        Returns:
            The solution.
        """
        theta = np.array([start, 0.0]) if with_drift else np.array([start])
        near = _NEAR * self.step / np.array([1.0, max(float(np.abs(self.since).max()), self.step)])[: len(theta)]
        for _ in range(_ITERATIONS):
            left = self._residual(theta)
            change = np.linalg.pinv(left.curvature) @ left.score.sum(axis=0)
            theta = theta + np.clip(change, -4.0 * near, 4.0 * near)
            if (np.abs(change) < _CLOSE * near).all():
                break
        left = self._residual(theta)
        q = len(theta)
        # of a reference with noise only the derivative of the equation itself gives how sharp the solution is
        slope = np.column_stack(
            [(self._score(theta - d) - self._score(theta + d)) / (2.0 * d[k]) for k, d in enumerate(np.diag(near))]
        )
        inverse = np.linalg.pinv(slope)
        waves = _slow_waves(left.score, left.information)
        covariance = inverse @ (waves.T @ waves / len(waves)) @ inverse.T
        sharp = bool((np.linalg.eigvals(slope).real > 0.0).all())
        error = np.sqrt(np.diag(covariance)) if sharp else np.full(q, np.inf)
        return DelaySolution(
            values=theta,
            standard_error=error,
            degrees_of_freedom=np.full(q, float(len(waves))),
            explained=self._explained(left.error),
        )

    def advantage(self, delay: float, rival: float | None, *, blocks: int) -> float:
        """Give how surely a delay leaves less than another.

        Args:
            delay: The delay; s.
            rival: The other; s; None for a reading that follows nothing.
            blocks: Segments of equal information that count as independent.

        Returns:
            Logarithm of what the other leaves more, block by block, in standard errors of its mean.
        """
        left = self._residual(np.array([delay]))
        other = self._unexplained() if rival is None else self._residual(np.array([rival])).error
        weight = 1.0 / np.maximum((left.error**2).mean(axis=0), np.finfo(float).tiny)
        squares = np.column_stack([other**2 @ weight, left.error**2 @ weight])
        sums = np.maximum(_block_sums(squares, left.information, blocks), np.finfo(float).tiny)
        more = np.log(sums[:, 0] / sums[:, 1])
        deviation = float(more.std(ddof=1))
        return float(more.mean() / deviation * np.sqrt(len(more))) if deviation > 0.0 else 0.0

    def _residual(self, theta: FloatArray) -> _Residual:
        at = self.time - theta[0] - (theta[1] * self.since if len(theta) > 1 else 0.0)
        design = np.hstack([self._constant, self._curve(at)])
        basis, coefficients = _projection(design, self.reading)
        error = self.reading - basis @ (basis.T @ self.reading)
        speed = -self._curve(at, 1) @ coefficients[self._constant.shape[1] :]
        scales = (np.ones_like(self.since), self.since)[: len(theta)]
        directions = [scale[:, None] * speed for scale in scales]
        directions = [one - basis @ (basis.T @ one) for one in directions]
        weight = 1.0 / np.maximum((error**2).mean(axis=0), np.finfo(float).tiny)
        return _Residual(
            error,
            (directions[0] ** 2) @ weight,
            np.column_stack([(one * error) @ weight for one in directions]),
            np.array([[float(((a * b) @ weight).sum()) for b in directions] for a in directions]),
        )

    def _score(self, theta: FloatArray) -> FloatArray:
        return self._residual(theta).score.sum(axis=0)

    def _unexplained(self) -> FloatArray:
        basis, _ = _projection(self._constant, self.reading)
        return self.reading - basis @ (basis.T @ self.reading)

    def _explained(self, error: FloatArray) -> float:
        square = (self._unexplained() ** 2).sum(axis=0)
        share = 1.0 - (error**2).sum(axis=0) / np.maximum(square, np.finfo(float).tiny)
        return float(share.max())


def even_means(time_s: FloatArray, values: FloatArray, at: FloatArray, step_s: float) -> FloatArray:
    """Give means of samples over steps of time about given instants, which delay nothing.

    Args:
        time_s: Stamps, rising; shape (n,); s.
        values: Samples; shape (n, k).
        at: Instants inside the stamps; shape (m,); s.
        step_s: Length of a step; s.

    Returns:
        Means of the straight lines between samples, or values on them where samples are as far apart as steps; shape
        (m, k).
    """
    if np.median(np.diff(time_s)) > 0.75 * step_s:
        return np.column_stack([np.interp(at, time_s, column) for column in values.T])
    area = np.vstack(
        [np.zeros(values.shape[1]), np.cumsum(np.diff(time_s)[:, None] * (values[1:] + values[:-1]) / 2, 0)]
    )
    edges = [np.clip(at + side * step_s / 2.0, time_s[0], time_s[-1]) for side in (-1.0, 1.0)]
    before, after = (np.column_stack([np.interp(edge, time_s, column) for column in area.T]) for edge in edges)
    return (after - before) / (edges[1] - edges[0])[:, None]


def smoothed(values: FloatArray) -> FloatArray:
    """Take from samples what is too fast to interpolate.

    A curve through samples with noise is quieter between than on them, and would draw a delay to the middle. Reading
    and reference are smoothed alike, so that they follow each other as before.

    Args:
        values: Samples at even steps; shape (n, k).

    Returns:
        The samples, smoothed; shape (n, k).
    """
    from scipy.ndimage import gaussian_filter1d  # here because importing it takes longer than most commands

    return gaussian_filter1d(values, _SMOOTH_STEPS, axis=0, mode="nearest")


def _projection(design: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Orthonormal columns that span the design, and coefficients of the values on it."""
    scale = np.sqrt((design**2).mean(axis=0))
    scale[scale == 0.0] = 1.0
    left, singular, right = np.linalg.svd(design / scale, full_matrices=False)
    kept = singular > _ROUNDING * singular[0]
    basis = left[:, kept]
    coefficients = (right[kept].T / singular[kept]) @ (basis.T @ values) / scale[:, None]
    return basis, coefficients


def _slow_waves(score: FloatArray, information: FloatArray) -> FloatArray:
    """What the slowest waves along the recording have of the score; shape (`_WAVES`, q)."""
    # each has the variance of the sum, however long the score lasts, if that is short of a wave: the estimate by evenly
    # weighted cosines of Lazarus, Lewis, Stock and Watson, HAR inference (2018); time counts as information does
    total = np.cumsum(information)
    at = (total - 0.5 * information) / total[-1]
    return np.sqrt(2.0) * np.cos(np.pi * np.arange(1, _WAVES + 1)[:, None] * at) @ score


def _block_sums(values: FloatArray, information: FloatArray, blocks: int) -> FloatArray:
    """Sums over blocks of equal information; shape (blocks, q)."""
    count = min(blocks, len(values) // _FEWEST_STEPS)
    if count < blocks // 2:
        raise RecordingError(f"expected at least {blocks // 2 * _FEWEST_STEPS} steps of time, got {len(values)}")
    total = np.cumsum(information)
    edges = np.searchsorted(total, total[-1] * np.arange(1, count) / count)
    return np.array([part.sum(axis=0) for part in np.split(values, edges)])
