# SPDX-License-Identifier: BSD-3-Clause
"""All parameters at once under noise of unknown shape, force and moment axes by the size of their noise.

References:
[1] M. G. Kenward, J. H. Roger, Small sample inference for fixed effects from restricted maximum likelihood,
    Biometrics 53, 1997; of a mean of several means: P. Meier, Variance of a weighted mean, Biometrics 9, 1953.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.noise.slow_noise import CONFIDENCE, SlowNoise, Timeline, half_width, log_prior
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.payload.identification.estimation_problem import LoadRows
from forcetorque.payload.identification.measurement_model import instants


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Group:
    """Three axes under noise of one shape, stacked; 3 n values."""

    line: Timeline
    """When each was taken; every axis of every session is a recording of its own."""
    design: FloatArray
    """Change with every unknown, over the size of the axis; shape (3 n, p)."""
    values: FloatArray
    """Reading less what is expected, over the size of the axis; shape (3 n,)."""
    order: IntArray
    """Row that each value is of; shape (3 n,)."""


_WIDE = 6.0
"""Deviations within which everything is."""
_HALVINGS = 40
"""Halvings of an interval that is sought: to rounding."""
_LEAST_WEIGHT = 1e-3
"""Shapes with less than this part of the weight of the best are left out of the mixture."""
_SEEN = 1e-6
"""Directions that change the readings of a group by less than this part of the strongest one are not told by it."""
_LEAST_INFORMATION = 1e-14
"""Less, over that of unit directions, is rounding."""
_ROUNDING = 1e-10
"""Noise is at least this part of the size of an axis, so that exact rows have a covariance."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Estimate:
    """Unknowns in r directions that the rows determine."""

    mean: FloatArray
    """Shape (r,)."""
    covariance: FloatArray
    """Shape (r, r)."""
    degrees_of_freedom: FloatArray
    """Of each direction of a basis of parameters; shape (p,)."""
    shapes: tuple[SlowNoise, ...]
    """Best shape of each group."""
    variances: tuple[float, ...]
    """Variance of the white part of each group in that shape, over the squared size of the axis."""

    weights: FloatArray
    """Of each pair of shapes; shape (k,)."""
    apart: FloatArray
    """Mean of each pair less that of the mixture; shape (k, r)."""
    spreads: FloatArray
    """Covariance of each pair; shape (k, r, r)."""
    of_best_shapes: FloatArray
    """Covariance in the best shapes with these variances, as if they were known; shape (r, r)."""

    def half_widths(self, basis: FloatArray) -> FloatArray:
        """Give half-widths of 95 % intervals of the parameters.

        They are those of the mixture itself: a rare shape with a large variance widens its covariance, yet hardly what
        holds the truth in 95 %.

        Args:
            basis: Parameters of the directions; shape (p, r).

        Returns:
            Shape (p,); infinite without a degree of freedom.
        """
        from scipy.special import ndtr  # here because importing it takes longer than most commands

        variances = np.einsum("pr,krs,ps->kp", basis, self.spreads, basis, optimize=True)
        deviation, shift = np.sqrt(np.maximum(variances, 1e-300)), self.apart @ basis.T
        low, high = np.zeros(len(basis)), (np.abs(shift) + _WIDE * deviation).max(axis=0)
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            inside = ndtr((middle - shift) / deviation) - ndtr((-middle - shift) / deviation)
            enough = self.weights @ inside >= CONFIDENCE
            low, high = np.where(enough, low, middle), np.where(enough, middle, high)
        quantile = half_width(np.ones(len(basis)), self.degrees_of_freedom)
        return np.asarray(high * quantile / NORMAL_95, dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Shape:
    """One group under noise of one shape."""

    noise: SlowNoise
    axes: FloatArray  # X' V^-1 X of all r directions over the variance, by axis; shape (3, r, r)
    sides: FloatArray  # X' V^-1 y over the variance, shape (r,)
    variance: float  # of the white part
    log_weight: float
    worth: FloatArray  # independent values that each direction of the parameters has of this group, (p,)

    @property
    def products(self) -> FloatArray:
        """X' V^-1 X of all r directions over the variance; shape (r, r)."""
        return np.asarray(self.axes.sum(axis=0))


def estimate(
    groups: Sequence[Group], basis: FloatArray, prior: tuple[FloatArray, FloatArray], shapes: Sequence[SlowNoise]
) -> Estimate:
    """Estimate what the rows determine.

    Args:
        groups: Forces, and moments.
        basis: Parameters of the directions that are estimated; shape (p, r).
        prior: Prior precision of these directions, shape (r, r), and that times their prior mean, shape (r,).
        shapes: Shapes of noise that are tried.

    Returns:
        Mean and covariance of the directions.
    """
    precision, expected = prior
    tried = [_tried(group, basis, shapes) for group in groups]
    pairs = list(product(*tried))
    weight = np.array([np.exp(sum(one.log_weight for one in pair)) for pair in pairs])
    weight /= weight.sum()
    spread = np.linalg.inv(precision + np.array([sum(one.products for one in pair) for pair in pairs]))
    sides = expected + np.array([sum(one.sides for one in pair) for pair in pairs])
    mean = np.einsum("krs,ks->kr", spread, sides)
    of_best_shapes = spread[0]
    spread = spread + _by_estimated_sizes(groups, tried, precision)
    centre = weight @ mean
    apart = mean - centre
    total = np.einsum("k,krs->rs", weight, spread) + np.einsum("k,kr,ks->rs", weight, apart, apart)
    return Estimate(
        mean=centre,
        covariance=0.5 * (total + total.T),
        degrees_of_freedom=_together(tried, basis),
        weights=weight,
        apart=apart,
        spreads=spread,
        of_best_shapes=of_best_shapes,
        shapes=tuple(group[0].noise for group in tried),
        variances=tuple(group[0].variance for group in tried),
    )


def _together(tried: list[list[_Shape]], basis: FloatArray) -> FloatArray:
    """Degrees of freedom, where a parameter has its error of both groups (Satterthwaite); shape (p,)."""
    precisions = [sum(np.exp(one.log_weight) * one.products for one in group) for group in tried]
    information = np.array([np.einsum("pr,rs,ps->p", basis, precision, basis) for precision in precisions])
    whole = information.sum(axis=0)
    part = information / np.where(whole > 0.0, whole, 1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        rarity = np.array([sum(np.exp(one.log_weight) / one.worth for one in group) for group in tried])
        degrees: FloatArray = 1.0 / np.where(part > 0.0, part**2 * rarity, 0.0).sum(axis=0)
    return np.where(np.isfinite(degrees), degrees, 0.0)


def _by_estimated_sizes(groups: Sequence[Group], tried: list[list[_Shape]], precision: FloatArray) -> FloatArray:
    """Covariance that is added because the sizes of the axes, by which they count, are estimated [1]; shape (r, r)."""
    # sum of 4 C (P - P C P) C / degrees of freedom: C the covariance, P what an axis adds to its inverse
    axes = np.concatenate([sum(np.exp(one.log_weight) * one.axes for one in group) for group in tried])  # (6, r, r)
    information = precision + axes.sum(axis=0)
    scale = 1.0 / np.sqrt(np.diag(information))
    squares, directions = np.linalg.eigh(scale[:, None] * information * scale)
    root = scale[:, None] * directions / np.sqrt(np.maximum(squares, _LEAST_INFORMATION))
    share, turned = np.linalg.eigh(root.T @ axes @ root)  # of what is known in each direction; (6, r)
    share = np.clip(share, 0.0, 1.0)
    degrees = np.repeat([len(group.values) / 3.0 for group in groups], 3) - share.sum(axis=1)
    size = root @ turned * np.sqrt(4.0 * share * (1.0 - share) / np.maximum(degrees, 1.0)[:, None])[:, None]
    return np.asarray((size @ size.transpose(0, 2, 1)).sum(axis=0))


def _tried(group: Group, basis: FloatArray, shapes: Sequence[SlowNoise]) -> list[_Shape]:
    """What a group says under every shape that counts, the best first; weights add up to 1."""
    own = _own_directions(group.design @ basis)
    reach = basis @ own  # parameters of the directions that the group determines by itself, (p, own)
    columns = np.asfortranarray(np.column_stack([group.design @ reach, group.values]))
    n, r = len(columns), own.shape[1]
    floor = _ROUNDING**2 * n
    white = (columns[:, :r].T * group.line.share) @ columns[:, :r]
    alone = _variances(reach, np.asarray(np.linalg.inv(white), dtype=np.float64))
    fits = []
    for noise in shapes if n > r else shapes[:1]:
        solved, log_determinant = group.line.solve(columns, noise)
        axes = columns.reshape(3, -1, r + 1).transpose(0, 2, 1) @ solved.reshape(3, -1, r + 1)
        axes = 0.5 * (axes + axes.transpose(0, 2, 1))
        moments = axes.sum(axis=0)
        inverse = np.asarray(np.linalg.inv(moments[:r, :r]), dtype=np.float64)
        sides = moments[:r, r]
        left = max(float(moments[r, r] - sides @ inverse @ sides), floor)
        evidence = -0.5 * ((n - r) * np.log(left) + log_determinant - np.linalg.slogdet(inverse)[1])
        variance = left / max(n - r, 1)
        worth = (1.0 + noise.ratio) * n * alone / _variances(reach, inverse)
        fits.append(
            _Shape(
                noise=noise,
                axes=own @ axes[:, :r, :r] @ own.T / variance,
                sides=own @ sides / variance,
                variance=variance,
                log_weight=float(evidence) + log_prior(noise),
                worth=np.clip(worth, r + 1.0, n) - r if n > r else np.zeros(len(basis)),
            )
        )
    return _weighed(fits)


def _variances(reach: FloatArray, inverse: FloatArray) -> FloatArray:
    """Variances of the parameters by one group alone; shape (p,); 1 of those that it says nothing of."""
    variance = np.einsum("pr,rs,ps->p", reach, inverse, reach)
    return np.where(variance > 0.0, variance, 1.0)


def _weighed(fits: list[_Shape]) -> list[_Shape]:
    best = max(fit.log_weight for fit in fits)
    kept = [fit for fit in fits if fit.log_weight > best + np.log(_LEAST_WEIGHT)]
    total = np.log(sum(np.exp(fit.log_weight - best) for fit in kept)) + best
    weighed = [replace(fit, log_weight=fit.log_weight - total) for fit in kept]
    return sorted(weighed, key=lambda fit: -fit.log_weight)


def _own_directions(design: FloatArray) -> FloatArray:
    """Directions that a group determines by itself; shape (r, own)."""
    squares, directions = np.linalg.eigh(design.T @ design)
    return directions[:, squares > _SEEN**2 * squares.max(initial=0.0)]


_LEAST_SIZE = 0.1
"""Noise of an axis counts as at least this part of that of the noisiest: three axes do not tell it from few rows."""


def groups_of(
    rows: LoadRows, design: FloatArray, values: FloatArray, sizes: FloatArray, weight: FloatArray
) -> tuple[Group, Group]:
    """Stack forces and moments.

    Args:
        rows: The rows.
        design: Change with every unknown; shape (n, 6, p).
        values: Reading less what is expected; shape (n, 6).
        sizes: Size of the noise of each axis; shape (6,).
        weight: What each row counts; shape (n,).

    Returns:
        Forces, and moments.
    """
    sorted_rows = np.argsort(rows.session, kind="stable")
    time = instants(rows)[sorted_rows]
    steps = np.diff(time)[np.diff(rows.session[sorted_rows]) == 0]
    unit = float(np.median(steps[steps > 0.0])) if (steps > 0.0).any() else 1.0
    count = len(rows)
    line = Timeline.of(
        np.tile(time / unit, 3),
        np.repeat(np.arange(3), count) * (int(rows.session.max(initial=0)) + 1) + np.tile(rows.session[sorted_rows], 3),
        np.tile((rows.share * weight)[sorted_rows], 3),
    )
    forces, moments = (
        Group(
            line=line,
            design=(design[sorted_rows][:, axes].transpose(1, 0, 2) / sizes[axes][:, None, None]).reshape(
                3 * count, design.shape[2]
            ),
            values=(values[sorted_rows][:, axes].T / sizes[axes][:, None]).reshape(3 * count),
            order=np.tile(sorted_rows, 3),
        )
        for axes in (np.arange(3), np.arange(3, 6))
    )
    return forces, moments


def noise_sizes(residual: FloatArray) -> FloatArray:
    """Give the size of the noise of each axis, forces and moments apart.

    Args:
        residual: Residuals; shape (n, 6); N, N m.

    Returns:
        Shape (6,); N, N m; those of exact rows are 1.
    """
    size = np.sqrt((residual**2).mean(axis=0)) if len(residual) else np.ones(6)
    for axes in FORCE_AND_MOMENT:
        largest = float(size[axes].max())
        size[axes] = np.maximum(size[axes], _LEAST_SIZE * largest) if largest > 0.0 else 1.0
    return size


def sizes_under(groups: tuple[Group, Group], estimate: Estimate, sizes: FloatArray, rounding: FloatArray) -> FloatArray:
    """Give the size of the noise of each axis as it is where slow noise counts as little as it is worth.

    Args:
        groups: Forces and moments, with what is left as values.
        estimate: Shape of the noise.
        sizes: Sizes that the groups are over; shape (6,); N, N m.
        rounding: Noise that exact rows have of rounding; shape (6,); N, N m.

    Returns:
        Shape (6,); N, N m.
    """
    squares = []
    for group, noise in zip(groups, estimate.shapes, strict=True):
        solved, _ = group.line.solve(group.values[:, None], noise)
        squares.append((group.values * solved[:, 0]).reshape(3, -1).mean(axis=1))
    return noise_sizes(np.hypot(np.sqrt(np.maximum(np.concatenate(squares), 0.0)) * sizes, rounding)[None])
