# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches (force, then moment) and twists (linear, then angular), and the one sign rule of force-torque sensors."""

from __future__ import annotations

from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, require_last_axis
from forcetorque.base.pose import skew, split_pose


class MeasureDirection(StrEnum):
    """Who acts on whom in the reading of a sensor, in the terms of URDF and SDF."""

    CHILD_TO_PARENT = "child_to_parent"
    """The reading is the wrench that the child link applies on the parent link."""
    PARENT_TO_CHILD = "parent_to_child"
    """The reading is the wrench that the parent link applies on the child link."""


def reading_sign(direction: MeasureDirection, *, child_is_outboard: bool) -> float:
    """Give the sign that turns S (inboard on outboard) into a sensor's reading.

    Args:
        direction: Who acts on whom in the reading.
        child_is_outboard: Whether the sensor's child link is on the far side from the root.

    Returns:
        +1.0 or -1.0.
    """
    outboard_is_acted_on = (MeasureDirection(direction) is MeasureDirection.PARENT_TO_CHILD) == child_is_outboard
    return 1.0 if outboard_is_acted_on else -1.0


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
    return np.einsum("...ij,...j->...i", twist_matrix(a_H_b), twist)


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
    return np.einsum("...ij,...j->...i", wrench_matrix(a_H_b), wrench)
