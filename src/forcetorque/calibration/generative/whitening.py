# SPDX-License-Identifier: BSD-3-Clause
"""Products of the columns of a design under every shape of the noise, with the free columns projected out.

Noise is independent between cells, so that their products add up. What one cell has for itself is multiplied by its own
means only.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.slow_noise import CANDIDATES, SlowNoise
from forcetorque.base.rows_on_disk import forget_pages, rows_for
from forcetorque.calibration.generative.design_matrix import Design
from forcetorque.experiment.calibration.moments import symmetric_pseudo_inverse


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Border:
    """Products of the columns of terms that one cell alone has, w of each of them, and 0 where it has fewer."""

    own: FloatArray
    """Products with each other; shape (cells, w, w)."""
    columns: FloatArray
    """Products with the columns that all cells have; shape (cells w, a)."""
    free: FloatArray
    """Products with the h free columns that several cells have; shape (cells w, h)."""
    response: FloatArray
    """Products with the response; shape (cells w,)."""
    first: int = 0
    """Number of the first of these cells among all that are solved together."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Whitened:
    """All that a fit needs of the data of one row under one shape of the noise; free columns are projected out.

    The terms that one cell alone has are not projected on free columns that several cells have.
    """

    noise: SlowNoise
    """The shape."""
    log_determinant: float
    """Of the noise and of what the free columns take."""
    columns: FloatArray
    """Products of the columns that all cells have, those of the model last; shape (a, a)."""
    shared: FloatArray
    """Products of columns and response; shape (a,)."""
    response: float
    """Product of the response with itself."""
    free: FloatArray
    """Products of the free columns that several cells have, less what those of single cells take; shape (h, h)."""
    border: Border
    """Terms of single cells."""


def whiten(design: Design, candidates: Sequence[SlowNoise] = CANDIDATES) -> list[list[Whitened]]:
    """Reduce the data under every shape of the noise.

    Args:
        design: The columns.
        candidates: Shapes of the noise.

    Returns:
        What is left of the data of every row, one per shape.
    """
    stacked = _Stacked(design)
    of_shapes = [_whitened(stacked, stacked.products(noise), noise) for noise in candidates]
    return [list(of_row) for of_row in zip(*of_shapes, strict=True)]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Products:
    """Products of m columns that all cells have and of l that single ones have."""

    everywhere: FloatArray
    """Of all cells; shape (m, m)."""
    border: FloatArray
    """Of columns of single cells and those of all; shape (cells, l, m)."""
    own: FloatArray
    """Of columns of single cells; shape (cells, l, l)."""
    log_determinant: float
    """Of the noise."""


class _Stacked:
    """All columns of a design side by side, each divided by its largest value, in blocks of means."""

    def __init__(self, design: Design) -> None:
        rows, terms = len(design.reading), int(design.acting.sum())
        width, self._width_free = design.local_places.shape[1], design.free_places.shape[1]
        self.rows, self.cells, self._design = rows, len(design.free_places), design
        widths = (design.columns.shape[1], terms, rows, len(design.shared_free), rows * width, self._width_free)
        ends = np.cumsum(widths).tolist()
        self._total, self._everywhere = ends[-1], ends[3]
        self.response, self.free = np.arange(ends[1], ends[2]), np.arange(ends[2], ends[3])
        of_model = np.split(np.arange(ends[0], ends[1]), np.cumsum(design.acting.sum(axis=1))[:-1])
        self.columns = [np.r_[: ends[0], own] for own in of_model]
        self.local = np.arange(rows * width).reshape(rows, width)
        self.own_free = rows * width + np.arange(self._width_free)
        self._size = np.zeros(self._total)
        for means in design.blocks:
            block = self._block(means)
            np.maximum(self._size, np.abs(block).max(axis=0, initial=0.0), out=self._size)
        self._size[self._size == 0.0] = 1.0
        self._sizes = np.outer(self._size[: self._everywhere], self._size[: self._everywhere])
        count = len(design.member) * self._total
        (scaled,) = rows_for(count, [((), np.float64)])
        for means in design.blocks:
            scaled.append((self._block(means) / self._size).ravel(order="F"))
        self._scaled = scaled.mapped()

    def _block(self, means: slice) -> FloatArray:
        """The columns of some means; shape (k, total)."""
        design, count = self._design, means.stop - means.start
        own = np.zeros((count, self._width_free))
        for cell, start, end in self._cells(means):
            used = design.free_places[cell] >= 0
            own[start:end, used] = design.free[means][start:end, design.free_places[cell][used]]
        parts = (
            design.columns[means],
            design.model(means)[:, design.acting],
            design.response[means],
            design.free[means][:, design.shared_free],
            design.local[means].reshape(count, -1),
            own,
        )
        return np.asfortranarray(np.hstack(parts))

    def _cells(self, means: slice) -> Iterator[tuple[int, int, int]]:
        """Cells that have some of a block of means: number, first mean and end within the block."""
        ends = np.clip(self._design.cell_ends - means.start, 0, means.stop - means.start)
        for cell in np.flatnonzero(np.diff(ends)).tolist():
            yield cell, int(ends[cell]), int(ends[cell + 1])

    def products(self, noise: SlowNoise) -> _Products:
        """Multiply columns, each mean counted by what it is worth."""
        m, total = self._everywhere, self._total
        product, of_cells = np.zeros((m, m)), np.zeros((self.cells, total - m, total))
        factors, before = self._design.timeline.factors(noise), None
        for means in self._design.blocks:
            own = self._scaled[means.start * total : means.stop * total]
            values = own.reshape((means.stop - means.start, total), order="F")
            solved = factors.solve(values, means, before)
            product += values[:, :m].T @ solved.columns[:, :m]
            cells = list(self._cells(means))
            for cell, start, end in cells:
                of_cells[cell] += values[start:end, m:].T @ solved.columns[start:end]
            if before is not None:
                product += np.outer(before[:m], solved.across[:m])
                of_cells[cells[0][0]] += np.outer(before[m:], solved.across)
            before = solved.after
            forget_pages([self._scaled])
        product *= self._sizes
        of_cells *= np.outer(self._size[m:], self._size)
        own = of_cells[:, :, m:]
        return _Products(
            everywhere=0.5 * (product + product.T),
            border=of_cells[:, :, :m],
            own=0.5 * (own + own.transpose(0, 2, 1)),
            log_determinant=factors.log_determinant,
        )


def _whitened(stacked: _Stacked, products: _Products, noise: SlowNoise) -> list[Whitened]:
    """What is left of every row under a shape of the noise."""
    e, local = stacked.own_free, stacked.local.size
    own_free = products.own[:, e[:, None], e]
    inverse = symmetric_pseudo_inverse(own_free)
    in_border, in_own = products.border[:, e], products.own[:, e, :local]
    worth = inverse @ in_border
    m = worth.shape[2]
    everywhere = products.everywhere - in_border.reshape(-1, m).T @ worth.reshape(-1, m)
    of_local = in_own.transpose(0, 2, 1)
    border = products.border[:, :local] - of_local @ worth
    own = products.own[:, :local, :local] - of_local @ (inverse @ in_own)
    several = everywhere[np.ix_(stacked.free, stacked.free)]
    log_determinant = products.log_determinant + _log_determinant(own_free) + _log_determinant(several)
    # columns and response are projected on the free columns of several cells, terms of one cell are not
    projected = border
    if len(several):
        by_free = symmetric_pseudo_inverse(several) @ everywhere[stacked.free]
        everywhere = everywhere - everywhere[:, stacked.free] @ by_free
        projected = border - border[:, :, stacked.free] @ by_free
    return [
        Whitened(
            noise=noise,
            log_determinant=log_determinant,
            columns=everywhere[np.ix_(columns, columns)],
            shared=everywhere[columns, response],
            response=max(float(everywhere[response, response]), 0.0),
            free=several,
            border=Border(
                own=own[:, places[:, None], places],
                columns=_rows(projected[:, places[:, None], columns]),
                free=_rows(border[:, places[:, None], stacked.free]),
                response=projected[:, places, response].ravel(),
            ),
        )
        for columns, places, response in zip(stacked.columns, stacked.local, stacked.response.tolist(), strict=True)
    ]


def _rows(border: FloatArray) -> FloatArray:
    """One row per column of a single cell."""
    return border.reshape(border.shape[0] * border.shape[1], border.shape[2])


def _log_determinant(matrices: FloatArray) -> float:
    """Of the directions of symmetric matrices that are not zero; shape (..., k, k)."""
    size = np.sqrt(np.maximum(np.diagonal(matrices, axis1=-2, axis2=-1), 0.0))
    moves = size > 0.0
    size = np.where(moves, size, 1.0)
    values = np.linalg.eigvalsh(matrices / (size[..., :, None] * size[..., None, :]))
    return float(np.log(values[values > 1e-10]).sum() + 2.0 * np.log(size).sum())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FreeUnknowns:
    """The f free unknowns of a row given its others, under one shape of the noise."""

    covariance: FloatArray
    """Their covariance for noise of size 1; shape (f, f)."""
    columns: FloatArray
    """How much of them each column is worth, those of all terms last; shape (f, a)."""
    response: FloatArray
    """How much of them the response is worth; shape (f,)."""


def free_unknowns(design: Design, noises: Sequence[SlowNoise]) -> list[FreeUnknowns]:
    """Regress columns and response on the free columns.

    Args:
        design: The columns.
        noises: Shape of the noise of every row.

    Returns:
        The free unknowns of every row.
    """
    stacked = _Stacked(design)
    of_shapes = {noise: stacked.products(noise) for noise in noises}
    return [_free_of_row(design, stacked, of_shapes[noise], row) for row, noise in enumerate(noises)]


def _free_of_row(design: Design, stacked: _Stacked, products: _Products, row: int) -> FreeUnknowns:
    f, a, sessions = design.free.shape[1], design.columns.shape[1], len(design.sessions)
    terms, columns, response = design.model_means.shape[2], stacked.columns[row], int(stacked.response[row])
    several, own, local = design.shared_free, stacked.own_free, stacked.local[row]
    # a row and a column beside the others take what cells have fewer of
    product, shared = np.zeros((f + 1, f + 1)), np.zeros((f + 1, a + 1 + terms + 1))
    everywhere = np.r_[:a, a + 1 + terms, a + design.derivatives.shared[design.acting[row]]]
    of_all = np.r_[columns[:a], response, columns[a:]]
    product[np.ix_(several, several)] = products.everywhere[np.ix_(stacked.free, stacked.free)]
    shared[np.ix_(several, everywhere)] = products.everywhere[np.ix_(stacked.free, of_all)]
    free = np.where(design.free_places >= 0, design.free_places, f)  # (cells, e)
    places = np.where(design.local_places >= 0, a + design.local_places, a + terms)  # (cells, w)
    product[free[:, :, None], free[:, None, :]] = products.own[:, own[:, None], own]
    product[free[:, :, None], several] = products.border[:, own[:, None], stacked.free]
    product[several[:, None], free.ravel()] = product[free.ravel()[:, None], several].T
    shared[free[:, :, None], everywhere] = products.border[:, own[:, None], of_all]
    shared[free[:, :, None], places[:, None, :]] = products.own[:, own[:, None], local]
    of_several = products.border[:, local[:, None], stacked.free].reshape(local.size * stacked.cells, len(several))
    shared[several[:, None], places.ravel()] = of_several.T
    inverse = symmetric_pseudo_inverse(product[:f, :f])
    worth = inverse @ np.delete(shared[:f], a + terms, axis=1)
    # as of columns without their means by session
    worth[:sessions, a : a + terms] -= np.where(design.centred_terms, 0.0, design.model_means[:, row])
    return FreeUnknowns(covariance=inverse, columns=worth[:, :-1], response=worth[:, -1])
