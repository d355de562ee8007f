# SPDX-License-Identifier: BSD-3-Clause
"""Twists: linear velocity of the point at a frame's origin, then angular velocity, in its axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_last_axis
from forcetorque.spatial.pose import split_pose
from forcetorque.spatial.rotation import skew


def twist_matrix(a_H_b: Any) -> FloatArray:
    """Build the matrix that expresses twists of frame b in frame a: `[[R, hat(p) R], [0, R]]`.

    Args:
        a_H_b: Pose of b in a; shape (..., 4, 4); translation in m.

    Returns:
        Matrix of shape (..., 6, 6); the inverse transpose of `wrench_matrix(a_H_b)`.
    """
    rotation, position = split_pose(a_H_b)
    matrix = np.zeros((*rotation.shape[:-2], 6, 6))
    matrix[..., :3, :3] = matrix[..., 3:, 3:] = rotation
    matrix[..., :3, 3:] = skew(position) @ rotation
    return matrix


def transform_twist(a_H_b: Any, b_twist: Any) -> FloatArray:
    """Express twists of a rigid body in another frame fixed to it.

    Args:
        a_H_b: Pose of b in a, `p_a = a_H_b p_b`; shape (..., 4, 4); translation in m.
        b_twist: Linear, then angular velocity in b, of the origin of b; shape (..., 6); m/s, rad/s.

    Returns:
        The same twists in a, of the point at the origin of a; shape (..., 6); m/s, rad/s.

    Raises:
        ShapeError: If the last axis of `b_twist` is not 6.
    """
    twist = np.asarray(b_twist, dtype=np.float64)
    require_last_axis(twist, name="b_twist", length=6)
    transformed: FloatArray = np.einsum("...ij,...j->...i", twist_matrix(a_H_b), twist)
    return transformed
