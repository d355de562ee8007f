# SPDX-License-Identifier: BSD-3-Clause
"""The evidence of rows as a function of the variance of the noise of each.

With the unknowns in units of their deviations the data have the products M with each other and s with the response, and
under noise of the variance v everything follows from `(M + v)^-1`. Terms that one cell of the data alone has are
eliminated cell by cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.generative.shared_unknowns import in_unknowns, solve_together
from forcetorque.calibration.generative.whitening import Whitened


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvidenceTerms:
    """What the evidence of k rows or shapes of the noise is made of, with v the variance of each."""

    log_determinant: FloatArray
    """Of `1 + M / v`; shape (k,)."""
    explained: FloatArray
    """`s^T (M + v)^-1 s`; shape (k,)."""
    squares: FloatArray
    """`s^T (M + v)^-2 s`, the sum of squares of the unknowns; shape (k,)."""
    determined: FloatArray
    """Trace of `M (M + v)^-1`, the number of unknowns that the data determine; shape (k,)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowPrior:
    """What is known of the unknowns of a row before any data."""

    root: FloatArray
    """L, with L L^T the covariance of what the columns that all cells have are multiplied by; shape (a, b)."""
    local: FloatArray
    """Standard deviations of the terms of single cells, 0 where a cell has fewer; shape (cells w,)."""

    @classmethod
    def of(cls, basis: FloatArray, terms: FloatArray, local: FloatArray) -> RowPrior:
        """Put the parts together.

        Args:
            basis: L of the columns without those of terms; shape (c, q).
            terms: Standard deviations of the terms that all cells have; shape (s,).
            local: As of the class.

        Returns:
            The prior distribution, with no more unknowns than columns.
        """
        own = np.asarray(np.linalg.qr(basis.T, mode="r"), dtype=np.float64).T
        a, b = own.shape
        root = np.zeros((a + len(terms), b + len(terms)))
        root[:a, :b], root[a:, b:] = own, np.diag(terms)
        return cls(root=root, local=local)


def evidence_of(data: Sequence[tuple[Whitened, RowPrior]]) -> _Tridiagonal | _Bordered:
    """Prepare the evidence of rows.

    Args:
        data: The data of k rows or shapes of the noise, each with the prior distribution of the row.

    Returns:
        The evidence, whose `at` evaluates it at variances of the noise.
    """
    if data[0][0].border.own.size:
        return _Bordered(data)
    products = [prior.root.T @ one.columns @ prior.root for one, prior in data]
    return _Tridiagonal(products, [prior.root.T @ one.shared for one, prior in data])


class _Tridiagonal:
    """M in a basis in which it is tridiagonal and s has one component: `(M + v)^-1` is then a recurrence."""

    def __init__(self, products: Sequence[FloatArray], shared: Sequence[FloatArray]) -> None:
        from scipy.linalg.lapack import dsytrd  # here because importing it takes longer than most commands

        size = len(shared[0])
        diagonals, besides = [], []
        for product, along in zip(products, shared, strict=True):
            # the first reflection turns the first column, which is s, to its second component
            bordered = np.zeros((size + 1, size + 1), order="F")
            bordered[1:, 0], bordered[1:, 1:] = along, product
            _, diagonal, beside, _, _ = dsytrd(bordered, lower=1, overwrite_a=1)
            diagonals.append(diagonal)
            besides.append(beside)
        self._diagonal = np.stack(diagonals, axis=1)[1:]  # (size, k)
        self._square = np.stack(besides, axis=1) ** 2

    def at(self, variance: FloatArray) -> EvidenceTerms:
        """Evaluate the evidence."""
        # pivots of M + v from the end, and their derivatives by v; none is less than v but by rounding
        pivots, slopes = np.empty_like(self._diagonal), np.ones_like(self._diagonal)
        pivots[-1] = np.maximum(self._diagonal[-1] + variance, variance)
        for k in range(len(pivots) - 2, -1, -1):
            share = self._square[k + 1] / pivots[k + 1]
            np.maximum(self._diagonal[k] + variance - share, variance, out=pivots[k])
            slopes[k] += share / pivots[k + 1] * slopes[k + 1]
        explained = self._square[0] / pivots[0]
        return EvidenceTerms(
            log_determinant=np.log(pivots / variance).sum(axis=0),
            explained=explained,
            squares=explained * slopes[0] / pivots[0],
            determined=len(pivots) - variance * (slopes / pivots).sum(axis=0),
        )


class _Bordered:
    """The evidence where there are terms of single cells, which `solve_together` eliminates."""

    def __init__(self, data: Sequence[tuple[Whitened, RowPrior]]) -> None:
        self._rows = [(in_unknowns(one, prior.root, 0, 0), prior.local) for one, prior in data]

    def at(self, variance: FloatArray) -> EvidenceTerms:
        """Evaluate the evidence."""
        terms = []
        for (row, local), own in zip(self._rows, variance, strict=True):
            known = np.arange(len(row.columns))
            deviations = np.r_[np.ones(len(known)), local[local > 0.0]]
            places = np.full(len(local), -1)
            places[local > 0.0] = np.arange(len(known), len(deviations))
            found = solve_together([row], [known], places, deviations, np.array([own]))
            square = ((found.coefficients / deviations) ** 2).sum()
            terms.append((found.log_determinant, own * found.explained, square, found.determined[0]))
        log_determinant, explained, squares, determined = np.array(terms).T
        return EvidenceTerms(
            log_determinant=log_determinant, explained=explained, squares=squares, determined=determined
        )
