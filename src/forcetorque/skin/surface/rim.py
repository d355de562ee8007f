# SPDX-License-Identifier: BSD-3-Clause
"""The strip of skin outside the outermost taxels, which feels pressure that no triangle between taxels holds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.skin.surface.surface import SkinSurface

HALF_PITCH_M: Final = 0.0033
"""Width of the strip: half the distance between taxels of a module."""
_HOLE: Final = 4
"""Most edges around a hole that the strip fills."""
_LONGEST_MITRE: Final = 2.0
"""Length of the strip at a sharp corner, in widths."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Rim:
    """Facets outside the boundary of a surface."""

    positions: FloatArray
    """Outer points; shape (k, 3); m."""
    taxels: IntArray
    """Taxel from which each outer point was taken outwards; shape (k,)."""
    triangles: IntArray
    """Corners, counterclockwise seen from outside: a taxel below n, an outer point from n on; shape (m, 3)."""


def rim_strip(surface: SkinSurface) -> Rim:
    """Lay a strip of facets around a surface, in the plane of the facets at its boundary: as wide as half a pitch.

    Args:
        surface: Surface.

    Returns:
        The strip: two facets for every edge of the boundary.
    """
    boundary = surface.boundary
    along = surface.positions[boundary[:, 1]] - surface.positions[boundary[:, 0]]
    outwards = np.cross(along, _normals_at(surface))
    outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
    before = _edge_before(surface)
    mitre = outwards + outwards[before]
    # (a + b) / (1 + a.b) has unit component along both
    mitre /= np.maximum(1.0 + (outwards * outwards[before]).sum(axis=1), 2.0 / _LONGEST_MITRE**2)[:, None]
    start, end = boundary.T
    first = len(surface) + np.arange(len(boundary))
    second = np.empty_like(first)
    second[before] = first
    triangles = np.concatenate([np.stack([start, first, second], axis=1), np.stack([start, second, end], axis=1)])
    return Rim(positions=surface.positions[start] + HALF_PITCH_M * mitre, taxels=start, triangles=triangles)


def edge_taxels(surface: SkinSurface) -> BoolArray:
    """Tell the taxels at the edge of a patch, beyond which pressure is not felt.

    A hole between four taxels is none: the strip fills it where corners of modules meet.

    Args:
        surface: The patch.

    Returns:
        Whether each taxel is at the edge; shape (n,).
    """
    before = _edge_before(surface)
    at_edge = np.zeros(len(surface), dtype=np.bool_)
    for loop in _loops(before):
        if len(loop) > _HOLE:
            at_edge[surface.boundary[loop]] = True
    return at_edge


def _loops(before: IntArray) -> list[list[int]]:
    """Edges of every closed line of the boundary."""
    loops, open_edges = [], set(range(len(before)))
    while open_edges:
        loop = [open_edges.pop()]
        while (edge := int(before[loop[-1]])) != loop[0]:
            open_edges.remove(edge)
            loop.append(edge)
        loops.append(loop)
    return loops


def _normals_at(surface: SkinSurface) -> FloatArray:
    """Normal of the facet at every edge of the boundary; shape (b, 3)."""
    directed = np.stack([surface.triangles, np.roll(surface.triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    codes = directed[:, 0] * len(surface) + directed[:, 1]
    order = np.argsort(codes)
    wanted = surface.boundary[:, 0] * len(surface) + surface.boundary[:, 1]
    return surface.facet_normals[order[np.searchsorted(codes, wanted, sorter=order)] // 3]


def _edge_before(surface: SkinSurface) -> IntArray:
    """Edge of the boundary that ends where each begins; where two loops meet in a taxel, the one of the same fan."""
    fans = {}
    for corners in surface.triangles.tolist():
        for k in range(3):
            fans[corners[k - 1], corners[k]] = corners[k - 2]
    number = {tuple(edge): k for k, edge in enumerate(surface.boundary.tolist())}
    before = np.empty(len(number), dtype=np.int64)
    for (start, end), k in number.items():
        # turn about the taxel from facet to facet, away from this edge, until no facet is left
        spoke = fans[start, end]
        while (start, spoke) in fans:
            spoke = fans[start, spoke]
        before[k] = number[spoke, start]
    return before
