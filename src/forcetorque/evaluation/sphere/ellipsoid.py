# SPDX-License-Identifier: BSD-3-Clause
"""An ellipsoid, and the three lengths that are all called its radius along an axis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FitError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Ellipsoid:
    """Points x with `(x - centre)^T shape (x - centre) = 1`; lengths in the unit of x."""

    centre: FloatArray
    """Centre; shape (3,)."""
    shape: FloatArray
    """Symmetric and positive definite; shape (3, 3); one over the square of a length."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", read_only(self.centre, name="centre", shape=(3,)))
        given = read_only(self.shape, name="shape", shape=(3, 3))
        even = read_only(0.5 * (given + given.T), name="shape", shape=(3, 3))
        if not (np.isfinite(even).all() and np.linalg.eigvalsh(even)[0] > 0.0):
            raise FitError("ellipsoid: expected a positive definite shape, got that of an open surface")
        object.__setattr__(self, "shape", even)

    @property
    def axis_intersections(self) -> FloatArray:
        """Where the axes through the centre leave it, `1 / sqrt(shape_ii)`; shape (3,).

        What the sensor reads along an axis while it reads nothing along the two others.
        """
        return 1.0 / np.sqrt(np.diag(self.shape))

    @property
    def half_widths(self) -> FloatArray:
        """Half of its extent along each axis, `sqrt((shape^-1)_ii)`; shape (3,).

        The most that the sensor reads along an axis, whatever it reads along the others.
        """
        return np.sqrt(np.diag(np.linalg.inv(self.shape)))

    @property
    def principal_radii(self) -> FloatArray:
        """Half of its own axes, `1 / sqrt(eigenvalue)`, the longest first; shape (3,)."""
        return 1.0 / np.sqrt(np.linalg.eigvalsh(self.shape))

    @property
    def principal_axes(self) -> FloatArray:
        """Directions of the principal radii, a column each in their order; shape (3, 3)."""
        return np.linalg.eigh(self.shape).eigenvectors


def ellipsoid_of_map(matrix: Any, *, centre: Any, radius: float) -> Ellipsoid:
    """Give what a linear map makes of a sphere.

    Args:
        matrix: The map; shape (3, 3).
        centre: Where the centre of the sphere goes; shape (3,).
        radius: Radius of the sphere.

    Returns:
        The image of the sphere.

    Raises:
        FitError: If the map is singular, so that the image is flat.
    """
    spread = np.asarray(matrix, dtype=np.float64) * radius
    if np.linalg.matrix_rank(spread) < 3:
        raise FitError("ellipsoid: expected a map onto space, got one onto a plane or a line")
    inverse = np.linalg.inv(spread)
    return Ellipsoid(centre=centre, shape=inverse.T @ inverse)
