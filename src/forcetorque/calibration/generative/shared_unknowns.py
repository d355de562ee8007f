# SPDX-License-Identifier: BSD-3-Clause
"""All unknowns of all rows, given their sizes and the noise.

Unknowns that come in blocks without products between the blocks are eliminated block by block: terms that single cells
have, or, where there are none, the unknowns that every row has for itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.calibration.generative.whitening import Border, Whitened


def in_unknowns(data: Whitened, basis: FloatArray, row: int, own: int) -> Whitened:
    """Change products of columns to products of unknowns: of those in no block, and, as its border, those of blocks.

    Args:
        data: Products of the columns of a row.
        basis: What the columns without those of terms are worth in unknowns; shape (a, b).
        row: Number of the row.
        own: Number of unknowns that the row has for itself, which are its first and are a block where no single cell
            has terms.

    Returns:
        The products; of blocks in the form of terms of cells.
    """
    a, border = len(basis), data.border
    half = np.hstack([data.columns[:, :a] @ basis, data.columns[:, a:]])
    columns = np.vstack([basis.T @ half[:a], half[a:]])
    shared = np.r_[basis.T @ data.shared[:a], data.shared[a:]]
    if border.own.size:
        worth = np.hstack([border.columns[:, :a] @ basis, border.columns[:, a:]])
        return replace(data, columns=columns, shared=shared, border=replace(border, columns=worth))
    blocks = Border(
        own=columns[None, :own, :own],
        columns=columns[:own, own:],
        free=np.zeros((own, 0)),
        response=shared[:own],
        first=row,
    )
    return replace(data, columns=columns[own:, own:], shared=shared[own:], free=np.zeros((0, 0)), border=blocks)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SharedSolution:
    """The u unknowns of all rows."""

    coefficients: FloatArray
    """Means; shape (u,)."""
    variances: FloatArray
    """Their variances; shape (u,)."""
    left: list[float]
    """Sum of squares that is left of the response of every row; none where rows share no unknown."""
    determined: list[float]
    """Number of unknowns that the data of every row determine; none where rows share no unknown."""
    log_determinant: float
    """Of the products of unknowns over those before any data, without that of the free columns."""
    explained: float
    """By how much the unknowns reduce the sum of squares over the variance of the noise."""
    everywhere: IntArray
    """Places of the g unknowns that are in no block; shape (g,)."""
    inner: FloatArray
    """Covariance of these, and of f free unknowns; shape (g + f, g + f)."""
    local: IntArray
    """Places of the unknowns of blocks, -1 for none; shape (blocks w,)."""
    border: FloatArray
    """How they change with those in no block and the free ones; shape (blocks w, g + f)."""
    own: FloatArray
    """Covariance of those of every block, were the others known; shape (blocks, w, w)."""

    def covariance(self) -> FloatArray:
        """Put the covariance of all unknowns together; shape (u, u)."""
        size, (cells, width, _) = len(self.coefficients), self.own.shape
        used = self.local >= 0
        places, worth = self.local[used], self.border[used]
        whole = np.zeros((size, size))
        known = len(self.everywhere)
        whole[np.ix_(self.everywhere, self.everywhere)] = self.inner[:known, :known]
        across = worth @ self.inner
        whole[np.ix_(places, self.everywhere)] = across[:, :known]
        whole[np.ix_(self.everywhere, places)] = across[:, :known].T
        of_cells = across @ worth.T
        alone = np.zeros((cells * width, cells * width))
        for cell, own in enumerate(self.own):
            here = slice(cell * width, (cell + 1) * width)
            alone[here, here] = own
        whole[np.ix_(places, places)] = 0.5 * (of_cells + of_cells.T) + alone[np.ix_(used, used)]
        return whole


def solve_together(
    rows: Sequence[Whitened],
    places: Sequence[IntArray],
    local: IntArray,
    deviations: FloatArray,
    variances: FloatArray,
) -> SharedSolution:
    """Infer all unknowns.

    Args:
        rows: The data of every row in unknowns.
        places: Places among all u unknowns of those of every row that are in no block; shape (q,) each.
        local: Places of the unknowns of blocks, -1 for none; shape (blocks w,).
        deviations: Standard deviation of every unknown before any data; shape (u,).
        variances: Variance of the noise of every row; shape (rows,).

    Returns:
        The unknowns.
    """
    from scipy.linalg.lapack import dtrtri  # here because importing it takes longer than most commands

    everywhere = np.unique(np.concatenate(places))
    known, free = len(everywhere), len(rows[0].free)
    own_places = [np.searchsorted(everywhere, own) for own in places]
    free_places = [np.arange(known + k * free, known + (k + 1) * free) for k in range(len(rows))]
    size, width = known + free * len(rows), rows[0].border.own.shape[1]
    cells = len(local) // width if width else len(rows[0].border.own)
    products, shared = np.zeros((size, size)), np.zeros(size)
    border, response = np.zeros((cells * width, size)), np.zeros(cells * width)
    own = np.zeros((cells, width, width))
    for row, at, at_free, variance in zip(rows, own_places, free_places, variances, strict=True):
        products[np.ix_(at, at)] += row.columns / variance
        products[np.ix_(at_free, at_free)] += row.free / variance
        shared[at] += row.shared / variance
        here, of_row = _cells_of(row.border)
        border[of_row, at] += row.border.columns / variance
        border[of_row, at_free] += row.border.free / variance
        response[of_row] += row.border.response / variance
        own[here] += row.border.own / variance
    scale = np.r_[deviations[everywhere], np.ones(size - known)]
    local_scale = np.where(local >= 0, deviations[local], 0.0)
    of_cell = local_scale.reshape(cells, width)
    alone = own * (of_cell[:, :, None] * of_cell[:, None, :]) + np.eye(width)
    alone_root = np.linalg.cholesky(alone)
    half_inverse = np.linalg.inv(alone_root)  # of a triangle it loses no digits, as that of the product would
    alone_inverse = half_inverse.transpose(0, 2, 1) @ half_inverse
    border *= local_scale[:, None] * scale
    response *= local_scale
    half = half_inverse @ border.reshape(cells, width, size)
    worth = (half_inverse.transpose(0, 2, 1) @ half).reshape(cells * width, size)
    half = half.reshape(cells * width, size)
    left = products * np.outer(scale, scale) - half.T @ half
    left[np.arange(known), np.arange(known)] += 1.0
    factor = np.linalg.cholesky(left)
    inverse = dtrtri(factor, lower=1)[0] if size else factor
    half_response = (half_inverse @ response.reshape(cells, width, 1)).ravel()
    reduced = shared * scale - half.T @ half_response
    along = inverse @ reduced
    solved, covariance = along @ inverse, inverse.T @ inverse
    of_response = (half_inverse.transpose(0, 2, 1) @ half_response.reshape(cells, width, 1)).ravel()
    pivots = np.diagonal(alone_root, axis1=1, axis2=2)
    log_determinant = 2.0 * float(np.log(np.diag(factor)).sum() + np.log(pivots).sum())
    if free:
        log_determinant += sum(
            free * float(np.log(variance)) - float(np.linalg.slogdet(row.free)[1])
            for row, variance in zip(rows, variances, strict=True)
        )
    across = worth @ covariance
    of_cells = across.reshape(cells, width, size) @ worth.reshape(cells, width, size).transpose(0, 2, 1)
    local_covariance = (alone_inverse + of_cells) * (of_cell[:, :, None] * of_cell[:, None, :])
    used = local >= 0
    coefficients, spread = np.zeros(len(deviations)), np.zeros(len(deviations))
    values, local_values = solved * scale, (of_response - worth @ solved) * local_scale
    covariance *= np.outer(scale, scale)
    across *= -local_scale[:, None] * scale
    coefficients[everywhere], coefficients[local[used]] = values[:known], local_values[used]
    spread[everywhere] = np.diag(covariance)[:known]
    spread[local[used]] = np.diagonal(local_covariance, axis1=1, axis2=2).ravel()[used]
    sums = [
        _of_row(row, at, at_free, values, local_values, covariance, across, local_covariance)
        for row, at, at_free in zip(rows, own_places, free_places, strict=True)
        if size
    ]
    return SharedSolution(
        coefficients=coefficients,
        variances=spread,
        left=[of_row for of_row, _ in sums],
        determined=[of_row / variance - free for (_, of_row), variance in zip(sums, variances, strict=False)],
        log_determinant=log_determinant,
        explained=float(along @ along + half_response @ half_response),
        everywhere=everywhere,
        inner=covariance,
        local=local,
        border=-(worth * local_scale[:, None] / scale),
        own=alone_inverse * (of_cell[:, :, None] * of_cell[:, None, :]),
    )


def _cells_of(border: Border) -> tuple[slice, slice]:
    """Cells that a row has among all that are solved together, and their unknowns."""
    cells, width, _ = border.own.shape
    return slice(border.first, border.first + cells), slice(border.first * width, (border.first + cells) * width)


def _of_row(
    row: Whitened,
    at: IntArray,
    at_free: IntArray,
    values: FloatArray,
    local: FloatArray,
    covariance: FloatArray,
    across: FloatArray,
    of_cells: FloatArray,
) -> tuple[float, float]:
    """Sum of squares that is left of the response of a row, and the trace of its products and the covariance."""
    border = row.border
    here, of_row = _cells_of(border)
    local, across, of_cells = local[of_row], across[of_row], of_cells[here]
    own, free = values[at], values[at_free]
    by_cell = local.reshape(of_cells.shape[:2])
    left = row.response - 2.0 * float(own @ row.shared + local @ border.response)
    left += float(own @ row.columns @ own + free @ row.free @ free)
    left += 2.0 * float(local @ (border.columns @ own + border.free @ free))
    left += float(np.einsum("ci,cij,cj->", by_cell, border.own, by_cell))
    trace = float((row.columns * covariance[np.ix_(at, at)]).sum())
    trace += float((row.free * covariance[np.ix_(at_free, at_free)]).sum())
    trace += 2.0 * float((border.columns * across[:, at]).sum() + (border.free * across[:, at_free]).sum())
    trace += float((border.own * of_cells).sum())
    return left, trace
