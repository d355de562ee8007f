# SPDX-License-Identifier: BSD-3-Clause
"""A bent patch laid flat, to be drawn."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.skin.surface.surface import SkinSurface


def unrolled(surface: SkinSurface) -> FloatArray:
    """Lay a patch flat, along the axis that its normals turn about.

    An arc whose normal has turned by a stands out by R sin(a) to the side, and is R a long: what stands out is drawn
    a / sin(a) longer. A flat patch stays as it is.

    Args:
        surface: The patch.

    Returns:
        Places in a plane, across and along; shape (n, 2); m.
    """
    normals = surface.vertex_normals
    _, _, directions = np.linalg.svd(normals, full_matrices=False)
    axis = directions[2]
    ahead = normals.mean(axis=0) - (normals.mean(axis=0) @ axis) * axis
    ahead /= np.linalg.norm(ahead)
    side = np.cross(axis, ahead)
    turn = np.arctan2(normals @ side, normals @ ahead)
    out = surface.positions @ side
    # the place from which it stands out is where the normal looks straight ahead
    slope = np.column_stack([np.ones(len(out)), np.sin(turn)])
    out = out - np.linalg.lstsq(slope, out, rcond=None)[0][0]
    return np.column_stack([out / np.sinc(turn / np.pi), surface.positions @ axis])
