# SPDX-License-Identifier: BSD-3-Clause
"""The surface that the taxels of a patch lie on: triangles between them, their normals, and the strip around them."""

from forcetorque.skin.surface.rim import HALF_PITCH_M, Rim, edge_taxels, rim_strip
from forcetorque.skin.surface.surface import SkinSurface, skin_surface
from forcetorque.skin.surface.triangulation import LONGEST_EDGE_M
from forcetorque.skin.surface.unrolled import unrolled

__all__ = [
    "HALF_PITCH_M",
    "LONGEST_EDGE_M",
    "Rim",
    "SkinSurface",
    "edge_taxels",
    "rim_strip",
    "skin_surface",
    "unrolled",
]
