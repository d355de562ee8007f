# SPDX-License-Identifier: BSD-3-Clause
"""White noise plus a slowly drifting offset, and least squares under it with standard errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, require_shape
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

_TOO_CLOSE = "slow noise: the instants are too close to each other to distinguish it from white noise"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Timeline(ArrayRecord):
    """When n means were taken; slow noise goes on within a recording and starts anew with the next."""

    time_s: FloatArray = field(metadata=array("n"))
    """Instants, not falling within a recording; shape (n,); s."""
    recording: IntArray = field(metadata=array("n", dtype="int"))
    """Number of the recording of each; those of one recording stand together; shape (n,)."""
    share: FloatArray = field(metadata=array("n"))
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
        line = cls(
            time_s=time_s,
            recording=np.zeros(np.shape(time_s), dtype=np.int64) if recording is None else recording,
            share=np.ones(np.shape(time_s)) if share is None else share,
        )
        if (np.diff(line.time_s)[np.diff(line.recording) == 0] < 0.0).any():
            raise FitError("time_s: expected instants that do not fall within a recording; sort the samples")
        if not (line.share > 0.0).all():
            raise FitError("share: expected numbers above 0; leave out means of no sample")
        return line

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
        factors = self.factors(noise)
        return factors.solve(columns, slice(0, len(self))).columns, factors.log_determinant

    def factors(self, noise: SlowNoise) -> NoiseFactors:
        """Prepare the inverse covariance, to be multiplied with blocks of columns.

        Args:
            noise: Shape of the noise, whose covariance for s = 1 is V.

        Returns:
            The factors.

        Raises:
            FitError: If instants are too close to each other.
        """
        log_white = -float(np.log(self.share).sum())
        if noise.is_white or not len(self):
            return NoiseFactors(share=self.share, ratio=0.0, log_determinant=log_white)
        pivots, multipliers, log_inverse = self._factors(noise)
        return NoiseFactors(
            share=self.share,
            ratio=noise.ratio,
            log_determinant=log_white + float(np.log(pivots).sum()) - log_inverse,
            pivots=pivots,
            multipliers=multipliers,
        )

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
        forward = self._factors(noise)[0]
        reverse = Timeline(time_s=-self.time_s[::-1], recording=self.recording[::-1], share=self.share[::-1])
        backward = reverse._factors(noise)[0][::-1]
        diagonal = self._precisions[noise.time_constant_s][0] + noise.ratio * self.share
        inner = 1.0 / (forward + backward - diagonal)  # diagonal of the inverse of a tridiagonal matrix
        return self.share - noise.ratio * self.share**2 * inner

    def _factors(self, noise: SlowNoise) -> tuple[FloatArray, FloatArray, float]:
        """Pivots and multipliers of `T + r D^-1`, and the log determinant of T."""
        from scipy.linalg.lapack import dpttrf

        if noise.time_constant_s not in self._precisions:  # shapes that are tried have few time constants
            self._precisions[noise.time_constant_s] = self._precision(noise.time_constant_s)
        diagonal, beside, log_inverse = self._precisions[noise.time_constant_s]
        diagonal = diagonal + noise.ratio * self.share
        if len(self) == 1:  # LAPACK wants a side diagonal
            return diagonal, beside, log_inverse
        pivots, multipliers, failed = dpttrf(diagonal, beside)
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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedBlock:
    """What a block of instants adds to `X^T V^-1 X`: `x^T columns + outer(before, across)`, x the block of X."""

    columns: FloatArray
    """Shape (k, m)."""
    across: FloatArray
    """Noise that goes on from the block before; shape (m,)."""
    after: FloatArray
    """What the next block takes as `before`; shape (m,)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NoiseFactors:
    """The inverse covariance `V^-1 = D - r D (T + r D)^-1 D`, with `T + r D = L P L^T`."""

    share: FloatArray
    """Diagonal of D; shape (n,)."""
    ratio: float
    """r, 0 for white noise."""
    log_determinant: float
    """Logarithm of the determinant of V."""
    pivots: FloatArray = field(default_factory=lambda: np.zeros(0))
    """Diagonal of P; shape (n,)."""
    multipliers: FloatArray = field(default_factory=lambda: np.zeros(0))
    """Side diagonal of L; shape (n - 1,)."""

    def solve(self, columns: FloatArray, rows: slice, before: FloatArray | None = None) -> SolvedBlock:
        """Solve a block of instants, the blocks before it eliminated.

        Args:
            columns: Signals X at these instants; shape (k, m).
            rows: Which k instants.
            before: `after` of the block before; shape (m,); None for the first.

        Returns:
            The block.

        Raises:
            FitError: If instants are too close to each other.
        """
        from scipy.linalg.lapack import dpttrs  # here because importing it takes longer than most commands

        share, none = self.share[rows, None], np.zeros(columns.shape[1])
        weighted = columns * share
        if not self.ratio or not len(columns):
            return SolvedBlock(columns=weighted, across=none, after=none)
        left, link = weighted, 0.0
        if before is not None:
            left, link = weighted.copy(order="K"), float(self.multipliers[rows.start - 1])
            left[0] -= link * before
        pivots = self.pivots[rows]
        if len(columns) == 1:  # LAPACK wants a side diagonal
            inner, wrong = left / pivots[:, None], 0
        else:
            inner, wrong = dpttrs(pivots, self.multipliers[rows.start : rows.start + len(columns) - 1], left)
        if wrong:
            raise FitError(_TOO_CLOSE)
        return SolvedBlock(
            columns=weighted - self.ratio * share * inner,
            across=self.ratio * link * inner[0],
            after=pivots[-1] * inner[-1],
        )


CONFIDENCE = 0.95
"""Probability with which an interval holds what is sought."""

SHAPES = (
    SlowNoise(time_constant_s=0.0, ratio=0.0),
    *(
        SlowNoise(time_constant_s=time, ratio=ratio)
        for time, ratio in product(
            (1.0, 2.0, 5.0, 15.0, 50.0, 200.0), (0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e3, 1e4)
        )
    ),
)
"""Shapes that are tried for coefficients of one record. The white part of means over a hundred samples can be as small
as 1e-4 of the slow one: with less choice, a drift that is smooth is taken for one that soon forgets itself."""

_SLOW_WEIGHT, _SLOW_POWER = 0.03, -0.5
"""Weight of a slow shape before the record is seen, where white noise has 1: `.03 (time constant / s)^-.5` (chosen
by simulation of records of 60 to 300 s: more weight makes intervals under white noise needlessly wide, less makes them
too narrow where a record is too short to show its drift)."""

_ROUNDING = 1e-13
"""Residuals below this part of the values are rounding."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Regression(ArrayRecord):
    """Coefficients of k columns of values on one design of p columns."""

    coefficients: FloatArray = field(metadata=array("k", "p"))
    """Mean of the mixture; shape (k, p)."""
    covariance: FloatArray = field(metadata=array("k", "p", "p"))
    """Their covariance, scatter of the mixture included; shape (k, p, p); infinite without a degree of freedom."""
    degrees_of_freedom: FloatArray = field(metadata=array("k", "p"))
    """Of Student's t of every coefficient; shape (k, p); 0 where nothing is left to estimate the noise."""
    noise: FloatArray = field(metadata=array("k"))
    """Standard deviation of the white part of a full mean; shape (k,)."""

    @property
    def standard_error(self) -> FloatArray:
        """Standard errors of the coefficients; shape (k, p)."""
        return np.sqrt(np.diagonal(self.covariance, axis1=1, axis2=2))

    @property
    def half_width(self) -> FloatArray:
        """Half-widths of the 95 % intervals of the coefficients; shape (k, p)."""
        return half_width(self.standard_error, self.degrees_of_freedom)


def half_width(standard_error: FloatArray, degrees_of_freedom: FloatArray) -> FloatArray:
    """Give half of a 95 % interval.

    Args:
        standard_error: Standard errors; any shape.
        degrees_of_freedom: Degrees of freedom of Student's t; the same shape; 0 for none.

    Returns:
        Half-widths; infinite where there is no degree of freedom.
    """
    from scipy.special import stdtrit  # here because importing it takes longer than most commands

    known = degrees_of_freedom > 0.0
    quantile = stdtrit(np.where(known, degrees_of_freedom, 1.0), 0.5 + 0.5 * CONFIDENCE)
    return np.where(known, quantile * np.where(known, standard_error, 0.0), np.inf)


def regress(
    line: Timeline,
    design: FloatArray,
    values: FloatArray,
    *,
    about: FloatArray | None = None,
    shapes: Sequence[SlowNoise] = SHAPES,
) -> Regression:
    """Regress values on a design under white and slow noise.

    Every column of values has noise of its own shape and size. The degrees of freedom are one less per coefficient than
    there are independent values, counted by what the slow part leaves of them.

    Args:
        line: When the values were taken; n of them.
        design: Design of full rank p; shape (n, p).
        values: Values; shape (n, k).
        about: Coefficients that are given in advance, such as plain means; shape (k, p). The covariance is
            then about them.
        shapes: Shapes of noise that are tried.

    Returns:
        Coefficients and their covariance.

    Raises:
        ShapeError: If the shapes differ.
    """
    n, p = design.shape
    require_shape(design, name="design", shape=(len(line), None))
    require_shape(values, name="values", shape=(n, None))
    start = np.asarray(np.linalg.lstsq(design, values, rcond=None)[0], dtype=np.float64)
    residual = values - design @ start
    residual[:, np.abs(residual).max(axis=0, initial=0.0) <= _ROUNDING * np.abs(values).max(axis=0, initial=0.0)] = 0.0
    if n <= p:
        return _undetermined(start.T if about is None else about)
    columns = np.asfortranarray(np.column_stack([design, residual]))
    fits = _Fits.of(line, columns, p, shapes)
    log_weight = fits.log_evidence + np.array([log_prior(noise) for noise in shapes])[:, None]
    weight = np.exp(log_weight - log_weight.max(axis=0))
    weight /= weight.sum(axis=0)  # (shapes, k)
    mean = np.einsum("sk,skp->kp", weight, fits.coefficients)
    centre = mean if about is None else about - start.T
    apart = fits.coefficients - centre
    within = fits.variance[:, :, None, None] * fits.inverse[:, None]
    covariance = weight[:, :, None, None] * (within + apart[..., :, None] * apart[..., None, :])
    alone = np.diag(np.linalg.inv(design.T @ (design * line.share[:, None])))  # were there no slow noise
    ratio = np.array([noise.ratio for noise in shapes])[:, None]
    worth = np.diagonal(fits.inverse, axis1=1, axis2=2)
    counts = np.clip((1.0 + ratio) * n * alone / worth, p + 1.0, n)
    return Regression(
        coefficients=centre + start.T,
        covariance=covariance.sum(axis=0),
        degrees_of_freedom=1.0 / np.einsum("sk,sp->kp", weight, 1.0 / counts) - p,
        noise=np.sqrt(np.einsum("sk,sk->k", weight, fits.variance)),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Fits:
    """Coefficients were the noise of each of s shapes."""

    coefficients: FloatArray  # (s, k, p)
    inverse: FloatArray  # (X' V^-1 X)^-1, shape (s, p, p)
    variance: FloatArray  # of the white part; (s, k)
    log_evidence: FloatArray  # restricted; (s, k)

    @classmethod
    def of(cls, line: Timeline, columns: FloatArray, p: int, shapes: Sequence[SlowNoise]) -> _Fits:
        n = len(line)
        products = [line.product(columns, noise) for noise in shapes]
        moments = np.array([product for product, _ in products])
        log_determinant = np.array([logarithm for _, logarithm in products])
        inverse = np.asarray(np.linalg.inv(moments[:, :p, :p]), dtype=np.float64)
        shared = moments[:, p:, :p]
        coefficients = shared @ inverse
        squares = np.diagonal(moments, axis1=1, axis2=2)[:, p:] - np.einsum("skp,skp->sk", coefficients, shared)
        squares = np.maximum(squares, 0.0)
        changing = np.where(squares > 0.0, squares, 1.0)  # of what never changes every shape has the same likelihood
        constant = log_determinant - np.linalg.slogdet(inverse)[1]
        return cls(
            coefficients=coefficients,
            inverse=inverse,
            variance=squares / (n - p),
            log_evidence=-0.5 * ((n - p) * np.log(changing) + constant[:, None]),
        )


def log_prior(noise: SlowNoise) -> float:
    """Give how usual a shape of noise is before the record is seen.

    Args:
        noise: The shape.

    Returns:
        Logarithm of its weight, where that of white noise is 1.
    """
    return 0.0 if noise.is_white else float(np.log(_SLOW_WEIGHT) + _SLOW_POWER * np.log(noise.time_constant_s))


def _undetermined(coefficients: FloatArray) -> Regression:
    k, p = coefficients.shape
    return Regression(
        coefficients=coefficients,
        covariance=np.full((k, p, p), np.inf),
        degrees_of_freedom=np.zeros((k, p)),
        noise=np.full(k, np.nan),
    )
