# SPDX-License-Identifier: BSD-3-Clause
"""Poses as 4 x 4 matrices, `a_H_b` with `p_a = a_H_b p_b`, and rotation matrices in a few lines each.

SciPy's rotations take longer to import than most commands run.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_last_axis
from forcetorque.base.errors import ShapeError


def make_pose(a_R_b: Any, a_p_b: Any) -> FloatArray:
    """Join a rotation and a position to a pose.

    Args:
        a_R_b: Rotation of b in a; shape (..., 3, 3).
        a_p_b: Origin of b in a; shape (..., 3); m.

    Returns:
        `a_H_b`; shape (..., 4, 4); translation in m.

    Raises:
        ShapeError: If the rotation does not end in (3, 3), or the position not in 3.
    """
    rotation = np.asarray(a_R_b, dtype=np.float64)
    position = np.asarray(a_p_b, dtype=np.float64)
    if rotation.shape[-2:] != (3, 3):
        raise ShapeError(f"a_R_b: expected shape (..., 3, 3), got {rotation.shape}")
    require_last_axis(position, name="a_p_b", length=3)
    batch = np.broadcast_shapes(rotation.shape[:-2], position.shape[:-1])
    pose = np.zeros((*batch, 4, 4))
    pose[..., :3, :3] = rotation
    pose[..., :3, 3] = position
    pose[..., 3, 3] = 1.0
    return pose


def invert_pose(a_H_b: Any) -> FloatArray:
    """Give the pose of a in b.

    Args:
        a_H_b: Pose of b in a; shape (..., 4, 4); translation in m.

    Returns:
        `b_H_a`; shape (..., 4, 4).
    """
    rotation, position = split_pose(a_H_b)
    b_R_a = np.swapaxes(rotation, -1, -2)
    return make_pose(b_R_a, -np.einsum("...ij,...j->...i", b_R_a, position))


def split_pose(a_H_b: Any) -> tuple[FloatArray, FloatArray]:
    """Split a pose into rotation and position.

    Args:
        a_H_b: Pose of b in a; shape (..., 4, 4); translation in m.

    Returns:
        `a_R_b` of shape (..., 3, 3) and `a_p_b` of shape (..., 3) in m.

    Raises:
        ShapeError: If the last two axes are not (4, 4).
    """
    pose = np.asarray(a_H_b, dtype=np.float64)
    if pose.shape[-2:] != (4, 4):
        raise ShapeError(f"a_H_b: expected shape (..., 4, 4), got {pose.shape}")
    return pose[..., :3, :3], pose[..., :3, 3]


_EXACT_ZERO = 1e-15
"""Entries below this are rounding of sin(pi), cos(pi/2): 1e-15 rad turns 1 kN by 1e-12 N."""


def rotation_from_rpy(rpy: Any) -> FloatArray:
    """Build rotation matrices from roll, pitch and yaw about the fixed x, y, z axes, as URDF does.

    Args:
        rpy: Roll, pitch, yaw; shape (..., 3); rad.

    Returns:
        `parent_R_child`; shape (..., 3, 3).

    Raises:
        ShapeError: If the last axis of `rpy` is not 3.
    """
    angles = np.asarray(rpy, dtype=np.float64)
    require_last_axis(angles, name="rpy", length=3)
    (cr, cp, cy), (sr, sp, sy) = np.moveaxis(np.cos(angles), -1, 0), np.moveaxis(np.sin(angles), -1, 0)
    matrix = np.empty((*angles.shape, 3))
    # about x, then y, then z
    matrix[..., 0, 0], matrix[..., 0, 1], matrix[..., 0, 2] = cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr
    matrix[..., 1, 0], matrix[..., 1, 1], matrix[..., 1, 2] = sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr
    matrix[..., 2, 0], matrix[..., 2, 1], matrix[..., 2, 2] = -sp, cp * sr, cp * cr
    matrix[np.abs(matrix) < _EXACT_ZERO] = 0.0
    return matrix


def rpy_from_rotation(parent_R_child: Any) -> FloatArray:
    """Give roll, pitch and yaw of a rotation, so that `rotation_from_rpy` builds it again.

    Roll is taken of what is left when the yaw is undone, so that the three fit each other to rounding near a pitch of
    90 degrees too, where one of them alone is badly determined.

    Args:
        parent_R_child: Rotation matrix; shape (3, 3).

    Returns:
        Roll, pitch, yaw about the fixed x, y, z axes; shape (3,); rad.
    """
    matrix = read_only(parent_R_child, name="parent_R_child", shape=(3, 3))
    yaw = np.arctan2(matrix[1, 0], matrix[0, 0])
    cosine, sine = np.cos(yaw), np.sin(yaw)
    along = cosine * matrix[0] + sine * matrix[1]  # first and second row of what is left
    across = cosine * matrix[1] - sine * matrix[0]
    return np.array([np.arctan2(-across[2], across[1]), np.arctan2(-matrix[2, 0], along[0]), yaw])


def rotation_about_z(angle: FloatArray) -> FloatArray:
    """Build rotation matrices about the z axis.

    Args:
        angle: Angles; shape (...); rad.

    Returns:
        Rotation matrices; shape (..., 3, 3).
    """
    cosine, sine = np.cos(angle), np.sin(angle)
    matrix = np.zeros((*np.shape(angle), 3, 3))
    matrix[..., 0, 0] = matrix[..., 1, 1] = cosine
    matrix[..., 0, 1] = -sine
    matrix[..., 1, 0] = sine
    matrix[..., 2, 2] = 1.0
    return matrix


def rotation_with_z_along(axis: Any) -> FloatArray:
    """Choose a rotation whose third column is the given direction.

    A direction along a coordinate axis gives a signed permutation, so that no rounding enters.

    Args:
        axis: Direction, need not be of unit length; shape (3,).

    Returns:
        Rotation matrix `R` with `R @ [0, 0, 1]` along `axis`; shape (3, 3).
    """
    z = np.asarray(axis, dtype=np.float64) / np.linalg.norm(axis)
    x = np.zeros(3)
    x[(int(np.argmax(np.abs(z))) + 1) % 3] = 1.0
    x -= z * (z @ x)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def cross(first: FloatArray, second: FloatArray) -> FloatArray:
    """Give the cross product of vectors, as `numpy.cross` does, which takes three times as long for a few.

    Args:
        first: Vectors; shape (..., 3).
        second: Vectors; shape (..., 3), of a shape that broadcasts with that of the first.

    Returns:
        Their products; shape (..., 3).
    """
    x, y, z = first[..., 0], first[..., 1], first[..., 2]
    u, v, w = second[..., 0], second[..., 1], second[..., 2]
    product = np.empty(np.broadcast(first, second).shape)
    product[..., 0] = y * w - z * v
    product[..., 1] = z * u - x * w
    product[..., 2] = x * v - y * u
    return product


def skew(vector: Any) -> FloatArray:
    """Build the matrices of the cross product: `skew(a) @ b == cross(a, b)`.

    Args:
        vector: Vectors; shape (..., 3).

    Returns:
        Skew-symmetric matrices; shape (..., 3, 3).

    Raises:
        ShapeError: If the last axis of `vector` is not 3.
    """
    a = np.asarray(vector, dtype=np.float64)
    require_last_axis(a, name="vector", length=3)
    matrix = np.zeros((*a.shape, 3))
    matrix[..., 0, 1], matrix[..., 0, 2], matrix[..., 1, 2] = -a[..., 2], a[..., 1], -a[..., 0]
    matrix[..., 1, 0], matrix[..., 2, 0], matrix[..., 2, 1] = a[..., 2], -a[..., 1], a[..., 0]
    return matrix
