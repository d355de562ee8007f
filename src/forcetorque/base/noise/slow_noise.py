# SPDX-License-Identifier: BSD-3-Clause
"""White noise plus a slowly wandering offset, and products of signals under it."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import Any, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, read_only, require_shape
from forcetorque.base.errors import FitError


@dataclass(frozen=True, slots=True, kw_only=True)
class SlowNoise:
    """Shape of the noise of means; its size s is another matter."""

    time_constant_s: float
    """How long the offset takes to forget itself; s; 0 where there is none."""
    ratio: float
    """Variance of the offset over that of the white part; 0 where there is none."""

    def __post_init__(self) -> None:
        if not (self.ratio >= 0.0 and self.time_constant_s >= 0.0) or (self.ratio > 0.0) != (
            self.time_constant_s > 0.0
        ):
            raise FitError(
                "slow noise: expected a time constant and a ratio above 0, or both 0, got "
                f"{self.time_constant_s:g} s and {self.ratio:g}"
            )

    @property
    def is_white(self) -> bool:
        """Whether there is no slow part."""
        return self.ratio == 0.0


CANDIDATES = (
    SlowNoise(time_constant_s=0.0, ratio=0.0),
    *(
        SlowNoise(time_constant_s=time, ratio=ratio)
        for time, ratio in product((2.0, 5.0, 15.0, 50.0, 200.0), (0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0))
    ),
)
"""Shapes that are tried, white noise first: what lasts shorter than 2 s averages out, what lasts longer than 200 s is
an offset to recordings of minutes."""


_LEAST_STEP = 1e-6
"""Instants count as at least this part of a time constant apart: at the same instant the process has no inverse."""

_TOO_CLOSE = "slow noise: the instants are too close to each other to tell it from white noise"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Timeline:
    """When n means were taken; slow noise goes on within a recording and starts anew with the next."""

    time_s: FloatArray
    """Instants, not falling within a recording; shape (n,); s."""
    recording: IntArray
    """Number of the recording of each; those of one recording stand together; shape (n,)."""
    share: FloatArray
    """Samples in each mean over the usual number: its white noise has the variance s^2 / share; shape (n,)."""
    _precisions: dict[float, tuple[FloatArray, FloatArray, float]] = field(default_factory=dict, init=False, repr=False)

    @classmethod
    def of(cls, time_s: Any, recording: Any = None, share: Any = None) -> Self:
        """Check instants.

        Args:
            time_s: Instants; shape (n,); s.
            recording: Number of the recording of each; shape (n,); None for one recording.
            share: Samples in each mean over the usual number; shape (n,); None for the same everywhere.

        Returns:
            The timeline.

        Raises:
            ShapeError: If the shapes differ.
            FitError: If time falls within a recording, or a share is not above 0.
        """
        time = read_only(time_s, name="time_s", shape=(None,))
        n = len(time)
        number = np.zeros(n, dtype=np.int64) if recording is None else np.array(recording, dtype=np.int64)
        require_shape(number, name="recording", shape=(n,))
        number.setflags(write=False)
        part = read_only(np.ones(n) if share is None else share, name="share", shape=(n,))
        if (np.diff(time)[np.diff(number) == 0] < 0.0).any():
            raise FitError("time_s: expected instants that do not fall within a recording; sort the samples")
        if not (part > 0.0).all():
            raise FitError("share: expected numbers above 0; leave out means of no sample")
        return cls(time_s=time, recording=number, share=part)

    def __len__(self) -> int:
        return len(self.time_s)

    def product(self, columns: FloatArray, noise: SlowNoise) -> tuple[FloatArray, float]:
        """Multiply columns by each other, each instant counted by what it is worth.

        Args:
            columns: Signals X at the instants; shape (n, m). Take off constants that are large against what changes:
                they cost as many digits.
            noise: Shape of the noise, whose covariance for s = 1 is V.

        Returns:
            `X^T V^-1 X`, shape (m, m), and the logarithm of the determinant of V.

        Raises:
            FitError: If instants are too close to each other.
        """
        solved, log_determinant = self.solve(columns, noise)
        product = columns.T @ solved
        return 0.5 * (product + product.T), log_determinant

    def solve(self, columns: FloatArray, noise: SlowNoise) -> tuple[FloatArray, float]:
        """Multiply columns by the inverse covariance.

        Args:
            columns: Signals X at the instants; shape (n, m).
            noise: Shape of the noise, whose covariance for s = 1 is V.

        Returns:
            `V^-1 X`, shape (n, m), and the logarithm of the determinant of V.

        Raises:
            FitError: If instants are too close to each other.
        """
        from scipy.linalg.lapack import dpttrs  # here because importing it takes longer than most commands

        weighed, log_white = columns * self.share[:, None], -float(np.log(self.share).sum())
        if noise.is_white or not len(self):
            return weighed, log_white
        if len(self) == 1:  # LAPACK wants a side diagonal
            total = 1.0 + noise.ratio * float(self.share[0])
            return weighed / total, log_white + float(np.log(total))
        pivots, multipliers, log_inverse = self._factors(noise)
        inner, wrong = dpttrs(pivots, multipliers, weighed)
        if wrong:
            raise FitError(_TOO_CLOSE)
        solved = weighed - noise.ratio * self.share[:, None] * inner
        return solved, log_white + float(np.log(pivots).sum()) - log_inverse

    def precision_diagonal(self, noise: SlowNoise) -> FloatArray:
        """Give what every instant is worth where all others are known.

        Args:
            noise: Shape of the noise, whose covariance for s = 1 is V.

        Returns:
            Diagonal of `V^-1`; shape (n,).

        Raises:
            FitError: If instants are too close to each other.
        """
        if noise.is_white or not len(self):
            return self.share
        if len(self) == 1:
            return self.share / (1.0 + noise.ratio * self.share)
        forward = self._factors(noise)[0]
        turned = Timeline(time_s=-self.time_s[::-1], recording=self.recording[::-1], share=self.share[::-1])
        backward = turned._factors(noise)[0][::-1]
        diagonal = self._precisions[noise.time_constant_s][0] + noise.ratio * self.share
        inner = 1.0 / (forward + backward - diagonal)  # diagonal of the inverse of a tridiagonal matrix
        return self.share - noise.ratio * self.share**2 * inner

    def _factors(self, noise: SlowNoise) -> tuple[FloatArray, FloatArray, float]:
        """Pivots and multipliers of `T + r D^-1`, and the log determinant of T."""
        from scipy.linalg.lapack import dpttrf

        if noise.time_constant_s not in self._precisions:  # shapes that are tried have few time constants
            self._precisions[noise.time_constant_s] = self._precision(noise.time_constant_s)
        diagonal, beside, log_inverse = self._precisions[noise.time_constant_s]
        pivots, multipliers, failed = dpttrf(diagonal + noise.ratio * self.share, beside)
        if failed:
            raise FitError(_TOO_CLOSE)
        return pivots, multipliers, log_inverse

    def _precision(self, time_constant_s: float) -> tuple[FloatArray, FloatArray, float]:
        """Diagonal and side diagonal of the inverse covariance of the slow process, and its log determinant."""
        steps = np.maximum(np.diff(self.time_s) / time_constant_s, _LEAST_STEP)
        joined = np.diff(self.recording) == 0
        kept = np.where(joined, np.exp(-steps), 0.0)  # correlation with the instant before
        lost = np.where(joined, -np.expm1(-2.0 * steps), 1.0)  # 1 - kept^2, exact for small steps
        diagonal = np.ones(len(self))
        diagonal[1:] = 1.0 / lost
        diagonal[:-1] += kept**2 / lost
        return diagonal, -kept / lost, -float(np.log(lost).sum())
