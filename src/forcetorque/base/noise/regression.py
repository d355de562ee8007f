# SPDX-License-Identifier: BSD-3-Clause
"""Least squares under white noise plus a slowly wandering offset, and what the coefficients are worth.

The shape of the noise is not known, and a short record hardly tells it: one that is white may wander too slowly to
show. So the answer is a mixture over shapes, weighed by restricted evidence and by how usual they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_shape
from forcetorque.base.noise.slow_noise import SlowNoise, Timeline

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
class Regression:
    """Coefficients of k columns of values on one design of p columns."""

    coefficients: FloatArray
    """Mean of the mixture; shape (k, p)."""
    covariance: FloatArray
    """Their covariance, spread of the mixture included; shape (k, p, p); infinite without a degree of freedom."""
    degrees_of_freedom: FloatArray
    """Of Student's t of every coefficient; shape (k, p); 0 where nothing is left to tell the noise."""
    noise: FloatArray
    """Standard deviation of the white part of a full mean; shape (k,)."""

    def __post_init__(self) -> None:
        k, p = np.shape(self.coefficients)
        shapes = {"coefficients": (k, p), "covariance": (k, p, p), "degrees_of_freedom": (k, p), "noise": (k,)}
        for field, shape in shapes.items():
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

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
        about: Coefficients that are stated whatever comes out, such as plain means; shape (k, p). The covariance is
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
        changing = np.where(squares > 0.0, squares, 1.0)  # of what never changes every shape says the same
        constant = log_determinant - np.linalg.slogdet(inverse)[1]
        return cls(
            coefficients=coefficients,
            inverse=inverse,
            variance=squares / (n - p),
            log_evidence=-0.5 * ((n - p) * np.log(changing) + constant[:, None]),
        )


def log_prior(noise: SlowNoise) -> float:
    """Say how usual a shape of noise is before the record is seen.

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
