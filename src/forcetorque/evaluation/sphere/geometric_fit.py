# SPDX-License-Identifier: BSD-3-Clause
"""Geometric fits: the least sum of squared orthogonal distances to a sphere or an ellipsoid."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid

_ROWS = 8192
"""Samples per pass: what is made of them stays in the processor's cache."""
_LOWER = np.tril_indices(3)
_STEPS = 100
"""Most Newton steps towards the feet; near the surface three do."""
_MISSING = 1e-8
"""What a foot lacks in the equation of the ellipsoid beyond rounding."""
_LAST, _FOOT = 1e-8, 1e-14
"""Step after which a foot is found: relative to the way from the pole, as what is left is of the order of its square,
or to the shortest axis, which is rounding."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NormalEquations:
    """Sum of squared distances at some parameters, and how it changes with them."""

    cost: float
    """Sum of squared distances."""
    gradient: FloatArray
    """Jacobian transposed times distances; shape (p,)."""
    hessian: FloatArray
    """Jacobian transposed times Jacobian; shape (p, p)."""


def ellipsoid_parameters(ellipsoid: Ellipsoid) -> FloatArray:
    """Describe an ellipsoid.

    Returns:
        Centre, then the lower triangle of L by rows; shape (9,).
    """
    factor = np.linalg.cholesky(np.linalg.inv(ellipsoid.shape))
    return np.concatenate([ellipsoid.centre, factor[_LOWER]])


def ellipsoid_of_parameters(parameters: FloatArray) -> Ellipsoid:
    """Undo `ellipsoid_parameters`.

    Args:
        parameters: Centre and lower triangle; shape (9,).

    Returns:
        The ellipsoid.
    """
    inverse = np.linalg.inv(_factor(parameters))
    return Ellipsoid(centre=parameters[:3], shape=inverse.T @ inverse)


def ellipsoid_distances(cloud: FloatArray, ellipsoid: Ellipsoid) -> FloatArray:
    """Measure how far points lie outside an ellipsoid: which samples make the `rms` of a fit without the model.

    Args:
        cloud: Points; shape (n, 3).
        ellipsoid: The ellipsoid.

    Returns:
        Orthogonal distances, negative inside; shape (n,).
    """
    factor = _factor(ellipsoid_parameters(ellipsoid))
    parts = [_feet(rows - ellipsoid.centre, factor)[0] for rows in _passes(cloud)]
    return np.concatenate(parts)


def ellipsoid_equations(cloud: FloatArray, parameters: FloatArray) -> NormalEquations | None:
    """Form the normal equations of an ellipsoid.

    Args:
        cloud: Points; shape (n, 3).
        parameters: Centre and lower triangle; shape (9,).

    Returns:
        The equations; None where the parameters describe no ellipsoid.
    """
    factor = _factor(parameters)
    if not (np.isfinite(parameters).all() and np.abs(np.diag(factor)).min() > 1e-12 * np.abs(factor).max()):
        return None
    total = np.zeros((10, 10))
    for rows in _passes(cloud):
        distance, normal, unit = _feet(rows - parameters[:3], factor)
        equations = np.concatenate([-normal, -normal[_LOWER[0]] * unit[_LOWER[1]], distance[None]])
        total += equations @ equations.T
    return _equations(total)


def sphere_equations(cloud: FloatArray, parameters: FloatArray) -> NormalEquations | None:
    """Form the normal equations of a sphere.

    Args:
        cloud: Points; shape (n, 3).
        parameters: Centre and radius; shape (4,).

    Returns:
        The equations; None where the parameters describe no sphere.
    """
    if not (np.isfinite(parameters).all() and parameters[3] > 0.0):
        return None
    total = np.zeros((5, 5))
    for rows in _passes(cloud):
        away = rows - parameters[:3]
        length = np.sqrt((away**2).sum(axis=1))
        # a point in the very centre has no direction; any does
        normal = away / np.maximum(length, np.finfo(float).tiny)[:, None]
        equations = np.column_stack([-normal, np.full(len(rows), -1.0), length - parameters[3]])
        total += equations.T @ equations
    return _equations(total)


def _equations(total: FloatArray) -> NormalEquations | None:
    if not np.isfinite(total).all():
        return None
    return NormalEquations(cost=float(total[-1, -1]), gradient=total[:-1, -1], hessian=total[:-1, :-1])


def _passes(cloud: FloatArray) -> list[FloatArray]:
    return [cloud[start : start + _ROWS] for start in range(0, len(cloud), _ROWS)]


def _factor(parameters: FloatArray) -> FloatArray:
    factor = np.zeros((3, 3))
    factor[_LOWER] = parameters[3:]
    return factor


def _feet(points: FloatArray, factor: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Distances from an ellipsoid at the origin, normals at the feet, their points on the unit sphere; by columns."""
    squares, axes = np.linalg.eigh(factor @ factor.T)
    squares = np.maximum(squares, np.finfo(float).tiny)
    y = axes.T @ points.T  # along the principal axes
    column = squares[:, None]
    foot = column / (column + _foot_parameters(y, squares)) * y
    # near the centre a point that has nothing of the shortest axis still finds its foot along it, on either side
    missing = 1.0 - (foot**2 / column).sum(axis=0)
    lacking = missing > _MISSING
    if lacking.any():
        along = np.sqrt(foot[0, lacking] ** 2 + squares[0] * missing[lacking])
        foot[0, lacking] = np.copysign(along, y[0, lacking])
    normal = foot / column
    normal /= np.sqrt((normal**2).sum(axis=0))
    distance = ((y - foot) * normal).sum(axis=0)
    return distance, axes @ normal, np.linalg.solve(factor, axes) @ foot


def _foot_parameters(y: FloatArray, squares: FloatArray) -> FloatArray:
    """Largest root t of `f(t) = sum squares y^2 / (squares + t)^2 = 1`, where `foot = squares y / (squares + t)`."""
    column = squares[:, None]
    weighted = column * y**2
    # 1 / sqrt(f) rises and is concave to the right of its last zero: Newton from the left of the root never passes it,
    # and needs few steps, as it is nearly straight
    lowest = (np.sqrt(column) * np.abs(y) - column).max(axis=0)
    t: FloatArray = np.maximum(lowest, _step(weighted, 1.0 / column))
    # up to the pole of the shortest axis, where points without a part along it may have their feet
    t = np.maximum(t, (np.sqrt(np.finfo(float).eps) - 1.0) * squares[0])
    for _ in range(_STEPS):
        step = _step(weighted, 1.0 / (column + t)).clip(0.0)
        t += step
        if (step <= _LAST * (squares[0] + t) + _FOOT * squares[0]).all():
            break
    return t


def _step(weighted: FloatArray, over: FloatArray) -> FloatArray:
    """Newton's step of `1 / sqrt(f)` towards 1, where `over` is one over `squares + t`."""
    terms = weighted * over**2
    level, fall = terms.sum(axis=0), (terms * over).sum(axis=0)
    return level * (np.sqrt(level) - 1.0) / np.where(fall > 0.0, fall, 1.0)


_FEW = 20_000
"""Samples with which a fit comes close before all are taken; some minutes of a recording."""
_ITERATIONS = 60
_CONVERGED = 1e-7
"""Step, relative to the size of the cloud, at which a fit has converged."""
_OPEN = 1e3
"""Radius, relative to the size of the cloud, beyond which a surface cannot be distinguished from a plane."""
_ROUNDING = 1e-12
"""Decrease of the sum of squares, relative to itself, that is no decrease."""
_DAMPING, _LARGEST_DAMPING = 1e-6, 1e8


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GeometricFit:
    """Where a geometric fit ended."""

    parameters: FloatArray
    """Parameters of the surface; shape (p,)."""
    converged: bool
    """Whether it is a minimum; else the surface went on opening, or steps got lost in rounding."""
    rms: float
    """Root mean square distance, with as many degrees of freedom as samples."""


def refine_ellipsoid(cloud: FloatArray, start: Ellipsoid) -> tuple[Ellipsoid, GeometricFit]:
    """Fit an ellipsoid geometrically.

    Args:
        cloud: Points; shape (n, 3).
        start: An algebraic fit.

    Returns:
        The ellipsoid, and whether it is a minimum.
    """
    fit = _minimise(ellipsoid_equations, cloud, ellipsoid_parameters(start))
    return ellipsoid_of_parameters(fit.parameters), fit


def refine_sphere(cloud: FloatArray, centre: FloatArray, radius: float) -> GeometricFit:
    """Fit a sphere geometrically.

    Args:
        cloud: Points; shape (n, 3).
        centre: Centre of an algebraic fit; shape (3,).
        radius: Its radius.

    Returns:
        Centre and radius.
    """
    return _minimise(sphere_equations, cloud, np.append(centre, radius))


def _minimise(
    equations: Callable[[FloatArray, FloatArray], NormalEquations | None], cloud: FloatArray, start: FloatArray
) -> GeometricFit:
    """Levenberg and Marquardt's method: first on some of many points, then on all of them."""
    size = float(np.ptp(cloud, axis=0).max())
    fit = GeometricFit(parameters=start, converged=True, rms=np.nan)
    stride = -(-len(cloud) // _FEW)
    for points in (cloud[::stride], cloud) if stride > 1 else (cloud,):
        if fit.converged:
            fit = descend(partial(equations, points), fit.parameters, size, len(points))
    return fit


def descend(
    equations: Callable[[FloatArray], NormalEquations | None], start: FloatArray, size: float, count: int
) -> GeometricFit:
    """Go down from a start by the method of Levenberg and Marquardt.

    Args:
        equations: Normal equations at some parameters; None where there is no surface.
        start: Parameters, of which the first three are a centre; shape (p,).
        size: Extent of the cloud.
        count: Number of points.

    Returns:
        Where it ended.
    """
    here, damping = start, _DAMPING
    now = equations(here)
    converged = False
    for _ in range(_ITERATIONS):
        if now is None or np.abs(here[3:]).max() > _OPEN * size or damping > _LARGEST_DAMPING:
            break
        step = -np.linalg.solve(now.hessian + damping * np.diag(np.diag(now.hessian) + 1e-300), now.gradient)
        # what a step promises: below the rounding of the sum itself there is nothing to gain. A step that is short
        # because it is damped promises nothing: it counts as if it were not
        full = (1.0 + damping) * step
        converged = bool(np.abs(full).max() < _CONVERGED * size or -(now.gradient @ full) <= _ROUNDING * now.cost)
        if converged:
            break
        ahead = equations(here + step)
        if ahead is not None and ahead.cost <= now.cost:
            here, now, damping = here + step, ahead, 0.1 * damping
        else:
            damping *= 10.0
    cost = np.nan if now is None else now.cost
    return GeometricFit(parameters=here, converged=converged, rms=float(np.sqrt(cost / count)))
