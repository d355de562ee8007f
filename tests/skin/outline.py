# SPDX-License-Identifier: BSD-3-Clause
"""What a uniform pressure does to a patch, by its outline alone."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.surface import SkinSurface, rim_strip
from forcetorque.skin.wrench.patch_sensor import SkinPatch


def outline_wrench(patch: SkinPatch) -> FloatArray:
    """Wrench of a pressure of 1 Pa, by the outline of the patch and its strip: straight sides from a to b.

    By Stokes the force is -1/2 sum of a x b, and the moment 1/2 integral of |r|^2 dr around it; shape (6,); N, N m.
    """
    rim = rim_strip(patch.surface)
    whole = SkinSurface(
        positions=np.concatenate([patch.surface.positions, rim.positions]),
        triangles=np.concatenate([patch.surface.triangles, rim.triangles]),
    )
    a, b = whole.positions[whole.boundary].transpose(1, 0, 2)
    along = b - a
    squares = (a * a).sum(axis=1) + (a * along).sum(axis=1) + (along * along).sum(axis=1) / 3.0
    return np.concatenate([-0.5 * np.cross(a, b).sum(axis=0), 0.5 * (squares[:, None] * along).sum(axis=0)])
