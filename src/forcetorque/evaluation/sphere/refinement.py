# SPDX-License-Identifier: BSD-3-Clause
"""Geometric fits: the sum of squared orthogonal distances made smallest, from an algebraic fit on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid
from forcetorque.evaluation.sphere.orthogonal import (
    NormalEquations,
    ellipsoid_equations,
    ellipsoid_of_parameters,
    ellipsoid_parameters,
    sphere_equations,
)

_FEW = 20_000
"""Samples with which a fit comes close before all are taken; some minutes of a recording."""
_ITERATIONS = 60
_CONVERGED = 1e-7
"""Step, relative to the size of the cloud, at which a fit has converged."""
_OPEN = 1e3
"""Radius, relative to the size of the cloud, beyond which nobody tells a surface from a flat one."""
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
        # what a step promises: below the rounding of the sum itself there is nothing to gain
        converged = bool(np.abs(step).max() < _CONVERGED * size or -(now.gradient @ step) <= _ROUNDING * now.cost)
        if converged:
            break
        ahead = equations(here + step)
        if ahead is not None and ahead.cost <= now.cost:
            here, now, damping = here + step, ahead, 0.1 * damping
        else:
            damping *= 10.0
    cost = np.nan if now is None else now.cost
    return GeometricFit(parameters=here, converged=converged, rms=float(np.sqrt(cost / count)))
