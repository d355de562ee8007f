# SPDX-License-Identifier: BSD-3-Clause
"""Spheres fitted to the moments of clouds, many at a time: what a perfect sensor would read has one radius.

`F(x) = s x^T x + 2 b^T x + d` is made small over the cloud. With s = 1 that is linear least squares
[1], which makes radii too small where noise meets a small part of a sphere. With a mean square gradient
of 1 it comes close to the geometric fit [2].

References:
    [1] I. Kasa, A circle fitting procedure and its error analysis, IEEE Trans. Instrum. Meas. 25 (1976), 8-14.
    [2] G. Taubin, Estimation of planar curves, surfaces, and nonplanar space curves defined by implicit equations,
        IEEE Trans. PAMI 13 (1991), 1115-1138.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.evaluation.sphere.algebraic import smallest_generalised
from forcetorque.evaluation.sphere.moments import QuadricMoments

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
