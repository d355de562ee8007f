# SPDX-License-Identifier: BSD-3-Clause
"""One ellipsoid through several clouds, each about a centre of its own: trials between which the offset changed.

All clouds share the shape, and each has its centre: 6 + 3 t unknowns for t trials. The start is the direct fit with the
linear and the constant terms of the quadric apart for each trial, which leaves size as well as centre to each;
the geometric fit then gives all the same size.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.evaluation.sphere.algebraic import direct_shape_with_own_centres
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid
from forcetorque.evaluation.sphere.moments import monomials
from forcetorque.evaluation.sphere.orthogonal import (
    NormalEquations,
    ellipsoid_equations,
    ellipsoid_of_parameters,
    ellipsoid_parameters,
)
from forcetorque.evaluation.sphere.refinement import descend


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OwnCentres:
    """An ellipsoid that is fitted to several clouds at once."""

    parameters: FloatArray
    """Centre of each cloud, then the lower triangle of L as in `orthogonal`; shape (3 t + 6,)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "parameters", read_only(self.parameters, name="parameters", shape=(None,)))

    @property
    def centres(self) -> FloatArray:
        """Centre for each cloud; shape (t, 3)."""
        return self.parameters[:-6].reshape(-1, 3)

    @property
    def ellipsoid(self) -> Ellipsoid:
        """The shape, about the origin."""
        return ellipsoid_of_parameters(np.concatenate([np.zeros(3), self.parameters[-6:]]))


def fit_with_own_centres(clouds: Sequence[FloatArray], start: OwnCentres | None = None) -> OwnCentres | None:
    """Fit one shape and a centre for each cloud, by orthogonal distances.

    Args:
        clouds: Points; shapes (n, 3).
        start: Where to start; the direct fit if None.

    Returns:
        The fit; None where it is no minimum, because the clouds determine no ellipsoid.
    """
    begun = _direct(clouds) if start is None else start
    if begun is None:
        return None
    means = np.array([cloud.mean(axis=0) for cloud in clouds])
    moved = [cloud - mean for cloud, mean in zip(clouds, means, strict=True)]
    size = max(float(np.ptp(cloud, axis=0).max()) for cloud in clouds)
    offset = np.append(means.ravel(), np.zeros(6))
    descent = descend(
        lambda parameters: _equations(moved, parameters), begun.parameters - offset, size, sum(map(len, clouds))
    )
    return OwnCentres(parameters=descent.parameters + offset) if descent.converged else None


def _equations(clouds: Sequence[FloatArray], parameters: FloatArray) -> NormalEquations | None:
    """Normal equations of all clouds: those of each reach its own centre and the common shape."""
    count = len(parameters)
    cost, gradient, hessian = 0.0, np.zeros(count), np.zeros((count, count))
    for k, cloud in enumerate(clouds):
        mine = np.r_[3 * k : 3 * k + 3, count - 6 : count]
        part = ellipsoid_equations(cloud, parameters[mine])
        if part is None:
            return None
        cost += part.cost
        gradient[mine] += part.gradient
        hessian[np.ix_(mine, mine)] += part.hessian
    return NormalEquations(cost=cost, gradient=gradient, hessian=hessian)


def _direct(clouds: Sequence[FloatArray]) -> OwnCentres | None:
    shifts = [cloud.mean(axis=0) for cloud in clouds]
    scale = max(float(np.sqrt(((cloud - s) ** 2).sum(axis=1).mean())) for cloud, s in zip(clouds, shifts, strict=True))
    if scale == 0.0:
        return None
    monomial_rows = [monomials((cloud - shift) / scale) for cloud, shift in zip(clouds, shifts, strict=True)]
    solution = direct_shape_with_own_centres(np.array([rows.T @ rows for rows in monomial_rows]))
    if solution is None:
        return None
    shape, centres = solution
    common = Ellipsoid(centre=np.zeros(3), shape=shape / scale**2)
    return OwnCentres(
        parameters=np.append((np.array(shifts) + scale * centres).ravel(), ellipsoid_parameters(common)[3:])
    )
