# SPDX-License-Identifier: BSD-3-Clause
"""What equations say of unknowns and errors: the likeliest of both, what is left of the errors, what nobody can tell.

The equations C x + G e = r hold exactly, e is normal with unit variance, nothing is known of x. What x can take up says
nothing of e; the rest, seen from outside the range of C, is M e with M = (1 - C C+) G, so that e has the mean M+ r and
the covariance 1 - M+ M. Given e, x follows as C+ (r - G e), but for what C does not see.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.estimation.reference import RANK_TOLERANCE
from forcetorque.estimation.uncertain.equations import Affine

_SEEN = 1e-6
"""An answer does not depend on what cannot be told if less than this share of it does."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Posterior:
    """What n samples of equations say; u unknowns, m errors."""

    unknowns: FloatArray
    """The likeliest unknowns, the smallest where they cannot be told; shape (n, u)."""
    by_errors: FloatArray
    """How they follow errors; shape (n, u, m)."""
    errors: FloatArray
    """The likeliest errors; shape (n, m)."""
    left: FloatArray
    """Covariance of the errors after that, a projection; shape (n, m, m)."""
    hidden: FloatArray
    """Projection on what the equations do not see of the unknowns; shape (n, u, u)."""
    rank: IntArray
    """How many directions of the unknowns they see; shape (n,)."""
    condition: FloatArray
    """Largest over smallest singular value that is not zero; shape (n,); NaN for rank 0."""
    residual: FloatArray
    """What neither unknowns nor errors explain; shape (n, r)."""

    def answers(self, rows: Affine) -> tuple[FloatArray, FloatArray]:
        """Give answers that are linear in unknowns and errors.

        Args:
            rows: The answers; shape (n, r).

        Returns:
            Means, shape (n, r), and what one standard deviation of each error leaves them wrong by, shape (n, r, m),
            whose product with its transpose is their covariance; NaN where they depend on what cannot be told.
        """
        mean = rows.constant + _times(rows.free, self.unknowns) + _times(rows.errors, self.errors)
        wrong = (rows.errors + rows.free @ self.by_errors) @ self.left
        size = np.linalg.norm(rows.free, axis=2)
        open_rows = np.linalg.norm(rows.free @ self.hidden, axis=2) > _SEEN * np.maximum(
            size, np.finfo(np.float64).tiny
        )
        return np.where(open_rows, np.nan, mean), np.where(open_rows[:, :, None], np.nan, wrong)


def posterior_of(equations: Affine) -> Posterior:
    """Solve equations.

    Args:
        equations: What acts less what is needed, which is zero; in newtons; a sample with NaN gives NaN.

    Returns:
        What they say.
    """
    whole: BoolArray = np.all(np.isfinite(equations.constant), axis=1)
    for matrix in (equations.free, equations.errors):
        whole &= np.isfinite(matrix).all(axis=(1, 2))
    right = np.where(whole[:, None], -equations.constant, 0.0)
    free, errors = (np.where(whole[:, None, None], matrix, 0.0) for matrix in (equations.free, equations.errors))
    inverse, sigma = _inverse(free, np.linalg.norm(free, axis=(1, 2)))
    outside = np.eye(right.shape[1]) - free @ inverse
    seen = outside @ errors
    telling, _ = _inverse(seen, np.linalg.norm(errors, axis=(1, 2)))
    likeliest = _times(telling, _times(outside, right))
    unknowns = _times(inverse, right - _times(errors, likeliest))
    gap = np.where(whole, 0.0, np.nan)
    rank = (sigma > 0.0).sum(axis=1)
    smallest = np.where(sigma > 0.0, sigma, np.inf).min(axis=1, initial=np.inf)
    return Posterior(
        unknowns=unknowns + gap[:, None],
        by_errors=-inverse @ errors,
        errors=likeliest + gap[:, None],
        left=np.eye(errors.shape[2]) - telling @ seen + gap[:, None, None],
        hidden=whole[:, None, None] * (np.eye(free.shape[2]) - inverse @ free),
        rank=np.where(whole, rank, 0),
        condition=np.where(whole & (rank > 0), sigma.max(axis=1, initial=0.0) / smallest, np.nan),
        residual=right - _times(free, unknowns) - _times(errors, likeliest) + gap[:, None],
    )


def _inverse(matrices: FloatArray, size: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Pseudo-inverses, and singular values with zeros for those that are rounding of numbers of some size."""
    if not matrices.size:
        return np.zeros(matrices.transpose(0, 2, 1).shape), np.zeros((len(matrices), 0))
    u, sigma, vt = np.linalg.svd(matrices, full_matrices=False)
    kept = sigma > RANK_TOLERANCE * size[:, None]
    inverse = np.where(kept, 1.0 / np.where(kept, sigma, 1.0), 0.0)
    return (vt.transpose(0, 2, 1) * inverse[:, None, :]) @ u.transpose(0, 2, 1), np.where(kept, sigma, 0.0)


def _times(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    product: FloatArray = (matrices @ vectors[:, :, None])[:, :, 0]
    return product
