# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches: force, then moment, along the axes of a frame and about its origin."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_last_axis
from forcetorque.spatial.pose import split_pose
from forcetorque.spatial.rotation import skew

WRENCH_COMPONENTS = ("fx", "fy", "fz", "tx", "ty", "tz")
"""Names of the components of a wrench in their order: force, then moment."""
WRENCH_UNITS = ("N", "N", "N", "N m", "N m", "N m")
"""Their units."""
FORCE = slice(0, 3)
"""Components of a wrench that are its force; N."""
MOMENT = slice(3, 6)
"""Components that are its moment; N m."""
FORCE_AND_MOMENT = (FORCE, MOMENT)
"""The two, as they are never averaged over each other: their units differ."""


def wrench_matrix(a_H_b: Any) -> FloatArray:
    """Build the matrix that expresses wrenches of frame b in frame a.

    It is `[[R, 0], [hat(p) R, R]]`: the inverse transpose of the twist matrix [1].

    Args:
        a_H_b: Pose of b in a; shape (..., 4, 4); translation in m.

    Returns:
        `a_X_b`; shape (..., 6, 6).

    References:
        [1] Thesis notation, 6D transform; the printed form lacks the hat on the offset.
    """
    rotation, position = split_pose(a_H_b)
    matrix = np.zeros((*rotation.shape[:-2], 6, 6))
    matrix[..., :3, :3] = matrix[..., 3:, 3:] = rotation
    matrix[..., 3:, :3] = skew(position) @ rotation
    return matrix


def transform_wrench(a_H_b: Any, b_wrench: Any) -> FloatArray:
    """Express wrenches in another frame and about that frame's origin.

    Wrenches map with the inverse transpose of the twist map, so power is kept.

    Args:
        a_H_b: Pose of b in a, `p_a = a_H_b p_b`; shape (..., 4, 4); translation in m.
        b_wrench: Wrenches in b, about the origin of b; shape (..., 6); N, N m.

    Returns:
        The same wrenches in a, about the origin of a; shape (..., 6); N, N m.

    Raises:
        ShapeError: If the last axis of `b_wrench` is not 6.
    """
    wrench = np.asarray(b_wrench, dtype=np.float64)
    require_last_axis(wrench, name="b_wrench", length=6)
    transformed: FloatArray = np.einsum("...ij,...j->...i", wrench_matrix(a_H_b), wrench)
    return transformed
