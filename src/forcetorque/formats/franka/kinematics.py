# SPDX-License-Identifier: BSD-3-Clause
"""Where the joints and the flange of Panda and Franka Research 3 are, which have the same geometry [1].

References:
[1] Franka Robotics, Franka Control Interface documentation, Robot and interface specifications: Denavit-Hartenberg
    parameters in Craig's convention.
"""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray

_LENGTHS_A = (0.0, 0.0, 0.0, 0.0825, -0.0825, 0.0, 0.088)
_LENGTHS_D = (0.333, 0.0, 0.316, 0.0, 0.384, 0.0, 0.0)
_TWISTS = (0.0, -np.pi / 2, np.pi / 2, np.pi / 2, -np.pi / 2, np.pi / 2, np.pi / 2)
_FLANGE_M = 0.107
"""Distance of the flange from the frame of the last joint along its axis."""


def joint_frames(position: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the frames of the joints, whose z axes they turn about, and of the flange.

    Args:
        position: Angles; shape (n, 7); rad.

    Returns:
        Poses of the joints in the base, shape (n, 7, 4, 4), and of the flange, shape (n, 4, 4); m.
    """
    pose = np.broadcast_to(np.eye(4), (len(position), 4, 4))
    frames = []
    for angle, a, d, twist in zip(position.T, _LENGTHS_A, _LENGTHS_D, _TWISTS, strict=True):
        c, s, ct, st = np.cos(angle), np.sin(angle), np.cos(twist), np.sin(twist)
        zero, one = np.zeros_like(c), np.ones_like(c)
        rows = (
            (c, -s, zero, a * one),
            (s * ct, c * ct, -st * one, -st * d * one),
            (s * st, c * st, ct * one, ct * d * one),
            (zero, zero, zero, one),
        )
        pose = pose @ np.stack([np.stack(row, axis=-1) for row in rows], axis=1)
        frames.append(pose)
    flange = np.eye(4)
    flange[2, 3] = _FLANGE_M
    return np.stack(frames, axis=1), pose @ flange
