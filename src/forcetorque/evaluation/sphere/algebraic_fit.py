# SPDX-License-Identifier: BSD-3-Clause
"""Algebraic fits of quadrics and of spheres to the moments of clouds, many at a time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.evaluation.sphere.cloud import QuadricMoments

_K = (1000.0, 100.0, 30.0, 10.0, 6.0, 4.0)
"""Values of k that are tried; the last one always gives an ellipsoid."""

_ROUNDING = 1e-13
"""Eigenvalues below this part of the largest are rounding."""

_ENTRIES = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
"""Row and column of A that each of the first six coefficients is."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Quadrics:
    """m quadrics `(x - centre)^T shape (x - centre) = 1`; an open one has a shape that is not positive definite."""

    centre: FloatArray
    """Centres; shape (m, 3)."""
    shape: FloatArray
    """Shapes; shape (m, 3, 3)."""

    @property
    def closed(self) -> BoolArray:
        """Whether each is an ellipsoid; shape (m,)."""
        finite = np.isfinite(self.shape).all(axis=(1, 2))
        closed = np.zeros(len(self.shape), dtype=bool)
        closed[finite] = np.linalg.eigvalsh(self.shape[finite])[:, 0] > 0.0
        return closed

    @property
    def inverse_lengths(self) -> FloatArray:
        """One over the axis intersections, then one over the half-widths, 0 for open surfaces; shape (m, 6)."""
        closed = self.closed
        lengths = np.zeros((len(closed), 6))
        lengths[closed] = inverse_lengths(np.linalg.inv(self.shape[closed]))
        return lengths


def inverse_lengths(squares: Any) -> FloatArray:
    """Measure ellipsoids along the axes.

    Args:
        squares: Inverses of the shapes; shape (m, 3, 3).

    Returns:
        One over the axis intersections, then one over the half-widths; shape (m, 6).
    """
    intersections = np.diagonal(np.linalg.inv(squares), axis1=1, axis2=2)
    half_widths = 1.0 / np.diagonal(squares, axis1=1, axis2=2)
    # a shape that is positive to rounding may lose that when it is turned over twice
    return np.sqrt(np.maximum(np.concatenate([intersections, half_widths], axis=1), 0.0))


def direct_fit(mean: FloatArray, moments: QuadricMoments) -> Quadrics:
    """Fit ellipsoids by the direct method.

    Args:
        mean: Mean products of monomials; shape (m, 10, 10).
        moments: The moments that they are of, for shift and scale.

    Returns:
        An ellipsoid for each, unless a cloud is flat to rounding.
    """
    reduced, rest = _without_linear_part(mean)
    coefficients = np.full((len(mean), 6), np.nan)
    wanting = np.arange(len(mean))
    for k in _K:
        ellipsoids = _constrained(reduced[wanting], k)
        good = _definite(ellipsoids)
        coefficients[wanting[good]] = ellipsoids[good]
        wanting = wanting[~good]
    linear = -np.einsum("mij,mj->mi", rest, coefficients)
    return _quadrics(np.concatenate([coefficients, linear], axis=1), moments)


def gradient_weighted_fit(mean: FloatArray, moments: QuadricMoments) -> Quadrics:
    """Fit quadrics by the gradient-weighted method.

    Args:
        mean: Mean products of monomials; shape (m, 10, 10).
        moments: The moments that they are of, for shift and scale.

    Returns:
        A quadric for each, which may be open.
    """
    means = mean[:, :9, 9]
    centred = mean[:, :9, :9] - means[:, :, None] * means[:, None, :]
    smallest = smallest_generalised(centred, _gradient_moments(mean))
    constant = -np.einsum("mi,mi->m", means, smallest)
    return _quadrics(np.concatenate([smallest, constant[:, None]], axis=1), moments)


def direct_shape_with_own_centres(sums: FloatArray) -> tuple[FloatArray, FloatArray] | None:
    """Fit one shape to several clouds by the direct method, each about its own centre and of its own size.

    Args:
        sums: Sums of products of monomials of each cloud, all divided by the same scale; shape (t, 10, 10).

    Returns:
        Shape of the mean size, shape (3, 3), and centres, shape (t, 3), in units of the scale; None where the clouds
        are flat to rounding.
    """
    reduced, rest = _without_linear_part(sums)
    total = reduced.sum(axis=0, keepdims=True)
    tried = (_constrained(total, k) for k in _K)
    ellipsoid = next((coefficients for coefficients in tried if _definite(coefficients)[0]), None)
    if ellipsoid is None:
        return None
    (matrix,) = _matrices(ellipsoid)
    linear = -rest @ ellipsoid[0]  # (t, 4): 2x, 2y, 2z and 1 of each cloud
    centres = -np.linalg.solve(matrix, linear[:, :3].T).T
    level = float(np.average(-(linear[:, :3] * centres).sum(axis=1) - linear[:, 3], weights=sums[:, 9, 9]))
    shape = matrix / level if level else np.full((3, 3), np.nan)
    if not (np.isfinite(shape).all() and np.linalg.eigvalsh(shape)[0] > 0.0):
        return None
    return shape, centres


def smallest_generalised(second: FloatArray, weight: FloatArray) -> FloatArray:
    """Minimise `v^T second v` over `v^T weight v = 1`, for many symmetric pairs at once.

    Directions in which the weight is zero to rounding are left out: nothing moves there.

    Args:
        second: Symmetric, not negative; shape (m, k, k).
        weight: Likewise; shape (m, k, k).

    Returns:
        The minimisers, up to their sign; shape (m, k).
    """
    values, vectors = np.linalg.eigh(weight)
    kept = values > _ROUNDING * values[:, -1:]
    root = vectors * np.where(kept, 1.0 / np.sqrt(np.where(kept, values, 1.0)), 0.0)[:, None, :]
    reduced = root.transpose(0, 2, 1) @ second @ root
    # what was left out must not come out as the smallest
    size = np.trace(reduced, axis1=1, axis2=2)[:, None]
    reduced += np.where(kept, 0.0, 1.0 + size)[:, :, None] * np.eye(weight.shape[1])
    best = np.linalg.eigh(reduced).eigenvectors[:, :, 0]
    return np.einsum("mki,mi->mk", root, best)


def _without_linear_part(mean: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Second moments of the quadratic monomials with the best linear part taken off, and that part."""
    rest = np.linalg.pinv(mean[:, 6:, 6:], rcond=_ROUNDING, hermitian=True) @ mean[:, 6:, :6]  # (m, 4, 6)
    return mean[:, :6, :6] - mean[:, :6, 6:] @ rest, rest


def _constrained(reduced: FloatArray, k: float) -> FloatArray:
    """Minimisers of `a^T reduced a` over `k J - I^2 = 1`; shape (m, 6)."""
    constraint = np.zeros((6, 6))
    constraint[:3, :3] = 0.5 * k - 1.0
    constraint[:3, :3][np.diag_indices(3)] = -1.0
    constraint[3:, 3:] = -k * np.eye(3)
    # of the six eigenvalues of constraint^-1 reduced one is positive, since the constraint has one positive direction
    values, vectors = np.linalg.eig(np.linalg.solve(constraint[None], reduced))
    best = np.argmax(values.real, axis=1)
    return np.take_along_axis(vectors.real, best[:, None, None], axis=2)[:, :, 0]


def _definite(coefficients: FloatArray) -> BoolArray:
    values = np.linalg.eigvalsh(_matrices(coefficients))
    return (values[:, 0] > 0.0) | (values[:, -1] < 0.0)


def _matrices(coefficients: FloatArray) -> FloatArray:
    """A of each quadric; shape (m, 3, 3)."""
    matrices = np.empty((len(coefficients), 3, 3))
    for column, (i, j) in enumerate(_ENTRIES):
        matrices[:, i, j] = matrices[:, j, i] = coefficients[:, column]
    return matrices


def _gradient_moments(mean: FloatArray) -> FloatArray:
    """Mean products of the gradients of the first nine monomials, over 4; shape (m, 9, 9)."""
    # gradient of monomial a along axis i is 2 * sum_j slope[a, i, j] h_j with h = (x, y, z, 1)
    slope = np.zeros((9, 3, 4))
    for a, (i, j) in enumerate(_ENTRIES):
        slope[a, i, j] = slope[a, j, i] = 1.0
    slope[6:, :, 3] = np.eye(3)
    h = np.empty((len(mean), 4, 4))
    for column, (i, j) in enumerate(_ENTRIES):
        h[:, i, j] = h[:, j, i] = mean[:, column, 9] * (1.0 if i == j else 0.5)
    h[:, 3, :3] = h[:, :3, 3] = 0.5 * mean[:, 6:9, 9]
    h[:, 3, 3] = 1.0
    return (slope @ h[:, None]).reshape(-1, 9, 12) @ slope.reshape(9, 12).T


def _quadrics(coefficients: FloatArray, moments: QuadricMoments) -> Quadrics:
    """Centres and shapes in the unit of the cloud."""
    b, d = coefficients[:, 6:9], coefficients[:, 9]
    finite = np.asarray(np.isfinite(coefficients).all(axis=1))
    matrices = np.where(finite[:, None, None], _matrices(coefficients), np.eye(3))
    values, vectors = np.linalg.eigh(matrices)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        across = np.einsum("mji,mj->mi", vectors, b) / values
        centre = -np.einsum("mij,mj->mi", vectors, across)
        level = -np.einsum("mi,mi->m", b, centre) - d
        shape = matrices / level[:, None, None] / moments.scale**2
        moved = moments.shift + moments.scale * centre
    shape[~finite] = np.nan
    return Quadrics(centre=moved, shape=shape)


_SPHERE = np.zeros((5, 10))
_SPHERE[0, :3] = 1.0
_SPHERE[[1, 2, 3, 4], [6, 7, 8, 9]] = 1.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Spheres:
    """m spheres, of which some may be so large that they are planes."""

    centre: FloatArray
    """Centres; shape (m, 3); not finite for planes."""
    bend: FloatArray
    """Vectors from the cloud towards the centre, as long as one over the radius; shape (m, 3)."""

    @property
    def radius(self) -> FloatArray:
        """Radii; shape (m,); infinite for planes."""
        with np.errstate(divide="ignore"):
            radius: FloatArray = 1.0 / np.linalg.norm(self.bend, axis=1)
        return radius


def least_squares_spheres(mean: FloatArray, moments: QuadricMoments) -> Spheres:
    """Fit spheres by linear least squares.

    Args:
        mean: Mean products of monomials; shape (m, 10, 10).
        moments: The moments that they are of, for shift and scale.

    Returns:
        A sphere for each; planes where the points lie on one to rounding.
    """
    products = _SPHERE @ mean @ _SPHERE.T
    # a plane to rounding is left to the smallest of all solutions, which lies in it
    inverse = np.linalg.pinv(products[:, 1:, 1:], rcond=1e-13, hermitian=True)
    solved = -np.einsum("mij,mj->mi", inverse, products[:, 1:, 0])
    return _spheres(np.concatenate([np.ones((len(mean), 1)), solved[:, :3]], axis=1), products, moments)


def gradient_weighted_spheres(mean: FloatArray, moments: QuadricMoments) -> Spheres:
    """Fit spheres by the gradient-weighted method.

    Args:
        mean: Mean products of monomials; shape (m, 10, 10).
        moments: The moments that they are of, for shift and scale.

    Returns:
        A sphere for each.
    """
    products = _SPHERE @ mean @ _SPHERE.T
    means = products[:, :4, 4]
    centred = products[:, :4, :4] - means[:, :, None] * means[:, None, :]
    # half the gradient is s x + b; its mean square is s2 x^2 + 2 s b x + b^2
    weight = np.zeros((len(mean), 4, 4))
    weight[:, 0, 0] = products[:, 0, 4]
    weight[:, 0, 1:] = weight[:, 1:, 0] = 0.5 * products[:, 1:4, 4]
    weight[:, 1:, 1:] = np.eye(3)
    return _spheres(smallest_generalised(centred, weight), products, moments)


def _spheres(coefficients: FloatArray, products: FloatArray, moments: QuadricMoments) -> Spheres:
    """Spheres from s and b; d follows from F having mean zero."""
    s, b = coefficients[:, 0], coefficients[:, 1:]
    d = -np.einsum("mi,mi->m", products[:, :4, 4], coefficients)
    size = np.sqrt(np.maximum((b**2).sum(axis=1) - s * d, 0.0))
    mean_point = 0.5 * products[:, 1:4, 4]
    with np.errstate(divide="ignore", invalid="ignore"):
        curvature = s / size
        centre = -b / s[:, None]
        # from the middle of the cloud towards the centre; F is a plane with the normal b where s is zero
        towards = -(b + s[:, None] * mean_point) * np.where(s < 0.0, -1.0, 1.0)[:, None]
        bend = np.abs(curvature)[:, None] * towards / np.linalg.norm(towards, axis=1)[:, None]
    bend = np.where(np.isfinite(bend), bend, 0.0)
    return Spheres(centre=moments.shift + moments.scale * centre, bend=bend / moments.scale)
