# SPDX-License-Identifier: BSD-3-Clause
"""Poses as 4 x 4 matrices: `a_H_b` is the pose of b in a, `p_a = a_H_b p_b`."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_last_axis
from forcetorque.errors import ShapeError


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
