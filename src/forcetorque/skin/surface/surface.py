# SPDX-License-Identifier: BSD-3-Clause
"""A triangulated skin: taxels as corners, facets that face outwards, neighbours; bent, or laid flat."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, read_only, read_only_integers
from forcetorque.base.errors import SkinError
from forcetorque.skin.surface.triangulation import LONGEST_EDGE_M, outward_triangles, surface_triangles


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinSurface:
    """Taxels and the triangles between them, in the frame of the link."""

    positions: FloatArray
    """Taxels; shape (n, 3); m."""
    triangles: IntArray
    """Taxels at the corners of each facet, counterclockwise seen from outside; shape (m, 3)."""
    edges: IntArray = field(init=False)
    """Pairs of neighbours, the smaller number first; shape (e, 2)."""
    neighbours: IntArray = field(init=False)
    """Neighbours of each taxel, filled up with the taxel itself; shape (n, d), where d is the most that one has."""
    boundary: IntArray = field(init=False)
    """Edges of one facet only, in its direction, so that the skin is on their left; shape (b, 2)."""
    facet_areas: FloatArray = field(init=False)
    """Areas; shape (m,); m²."""
    facet_normals: FloatArray = field(init=False)
    """Outward unit normals; shape (m, 3)."""
    vertex_normals: FloatArray = field(init=False)
    """Outward unit normals of the taxels, means of their facets by area; zero for one without facet; shape (n, 3)."""

    def __post_init__(self) -> None:
        positions = read_only(self.positions, name="positions", shape=(None, 3))
        triangles = read_only_integers(self.triangles, name="triangles", shape=(None, 3))
        corners = positions[triangles]
        doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        sums = np.zeros_like(positions)
        np.add.at(sums, triangles.ravel(), np.repeat(doubled, 3, axis=0))
        edges, boundary = _edges(triangles, len(positions))
        for name, array in (
            ("positions", positions),
            ("triangles", triangles),
            ("edges", edges),
            ("neighbours", _neighbours(edges, len(positions))),
            ("boundary", boundary),
            ("facet_areas", np.linalg.norm(doubled, axis=1) / 2.0),
            ("facet_normals", _unit(doubled)),
            ("vertex_normals", _unit(sums)),
        ):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def __len__(self) -> int:
        return len(self.positions)

    @property
    def area(self) -> float:
        """Area of all facets; m²."""
        return float(self.facet_areas.sum())

    def with_ring(self, taxels: BoolArray) -> BoolArray:
        """Add to some taxels all their neighbours.

        Args:
            taxels: Which taxels; shape (n,).

        Returns:
            The same taxels and one ring around them; shape (n,).
        """
        widened = taxels.copy()
        widened[self.neighbours[taxels]] = True
        return widened


def skin_surface(
    positions: FloatArray, *, outward: FloatArray | None = None, longest_edge_m: float = LONGEST_EDGE_M
) -> SkinSurface:
    """Join the taxels of a patch to a surface, by Delaunay triangles in the tangent plane of every taxel.

    Args:
        positions: Taxels, all of them distinct; shape (n, 3); m.
        outward: Rough outward direction at every taxel, such as normals of a file, of which only the mean over each
            connected piece matters; shape (n, 3). By default the patch is taken to bulge outwards.
        longest_edge_m: Longest edge between neighbours; m.

    Returns:
        The surface; taxels farther than an edge from all others stay without facet.

    Raises:
        SkinError: If two taxels share a position, no three taxels are neighbours, or it is open which side is outer.
    """
    points = read_only(positions, name="positions", shape=(None, 3))
    hints = None if outward is None else read_only(outward, name="outward", shape=(len(points), 3))
    _, first, count = np.unique(points, axis=0, return_index=True, return_counts=True)
    if (count > 1).any():
        shared = points[first[count > 1][0]]
        raise SkinError(
            f"positions: expected distinct taxels, got {np.flatnonzero((points == shared).all(axis=1)).tolist()} all "
            f"at {shared.tolist()} m; look at the layout with `forcetorque skin check`"
        )
    triangles = surface_triangles(points, longest_edge_m)
    if not len(triangles):
        raise SkinError(
            f"positions: expected taxels with neighbours within {1e3 * longest_edge_m:g} mm, got {len(points)} taxels "
            "and no triangle between them; positions are in m"
        )
    return SkinSurface(positions=points, triangles=outward_triangles(points, triangles, hints))


def _edges(triangles: IntArray, count: int) -> tuple[IntArray, IntArray]:
    """Pairs of neighbours, and the directed edges that have a facet on one side only."""
    directed = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    ordered = np.sort(directed, axis=1)
    _, first, sharing = np.unique(ordered[:, 0] * count + ordered[:, 1], return_index=True, return_counts=True)
    return ordered[first], directed[first[sharing == 1]]


def _neighbours(edges: IntArray, count: int) -> IntArray:
    both = np.concatenate([edges, edges[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    degrees = np.bincount(both[:, 0], minlength=count)
    neighbours = np.tile(np.arange(count)[:, None], (1, int(degrees.max(initial=0))))
    place = np.arange(len(both)) - np.repeat(np.cumsum(degrees) - degrees, degrees)
    neighbours[both[:, 0], place] = both[:, 1]
    return neighbours


def _unit(vectors: FloatArray) -> FloatArray:
    """Directions of vectors; zero stays zero."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0.0)


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
