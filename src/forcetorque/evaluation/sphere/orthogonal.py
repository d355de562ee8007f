# SPDX-License-Identifier: BSD-3-Clause
"""Orthogonal distances to a sphere or an ellipsoid, and the normal equations of making them small.

A surface is described by parameters that leave it a sphere or an ellipsoid: centre and radius, or centre and
the lower triangle L of a map that makes it of the unit sphere, `shape = (L L^T)^-1`. The distance from
a point to its foot changes with the parameters as the foot moves along the normal, so the Jacobian needs the
normal n and, for L, the point u of the unit sphere that goes to the foot.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
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

    Args:
        ellipsoid: The ellipsoid.

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
    step: FloatArray = level * (np.sqrt(level) - 1.0) / np.where(fall > 0.0, fall, 1.0)
    return step
