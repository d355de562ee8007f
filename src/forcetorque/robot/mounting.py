# SPDX-License-Identifier: BSD-3-Clause
"""Rotations of a mount: the 24 that bring axes to axes, the nearest one to a response, and their names."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np

from forcetorque.base.arrays import FloatArray

_AXES = ("x", "y", "z")
_ALONG = 0.9995
"""Least component of a unit vector that is said to lie along an axis: 1.8 degrees."""


def quarter_turns() -> list[FloatArray]:
    """List the 24 rotations that bring axes to axes.

    Returns:
        Rotations, none first; shape (3, 3) each.
    """
    turns = []
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            turn = np.eye(3)[list(order)] * np.array(signs)[:, None]
            if np.linalg.det(turn) > 0.0:
                turns.append(turn)
    return sorted(turns, key=lambda turn: -float(np.trace(turn)))


def nearest_rotation(response: FloatArray) -> FloatArray:
    """Find the rotation that is nearest to a matrix up to its size (Procrustes).

    Args:
        response: Forces over what they are expected to be, `force = response @ expected`; shape (3, 3).

    Returns:
        The rotation; shape (3, 3).
    """
    left, _, right = np.linalg.svd(response)
    flip = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(left @ right))) or 1.0])
    return left @ flip @ right


def rotation_vector(rotation: FloatArray) -> FloatArray:
    """Give axis times angle of a rotation.

    Args:
        rotation: The rotation; shape (3, 3).

    Returns:
        Shape (3,); rad, of a size from 0 to pi.
    """
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    return np.asarray(Rotation.from_matrix(rotation).as_rotvec(), dtype=np.float64)


def rotation_words(vector: FloatArray) -> str:
    """Name a rotation.

    Args:
        vector: Axis times angle; shape (3,); rad.

    Returns:
        Text such as `17.2 deg about z`, or `-5.0 deg about (0.60, 0.00, 0.80)`.
    """
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return "0.0 deg"
    axis = vector / angle
    k = int(np.abs(axis).argmax())
    sign = float(np.sign(axis[k]))
    about = _AXES[k] if abs(axis[k]) > _ALONG else "({:.2f}, {:.2f}, {:.2f})".format(*(sign * axis + 0.0))
    return f"{sign * np.rad2deg(angle):.1f} deg about {about}"
