# SPDX-License-Identifier: BSD-3-Clause
"""The surface through the taxels of a patch: its triangles, their outer side, and the strip around them."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any, Final, TypeVar

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, read_only
from forcetorque.base.errors import SkinError

_Array = TypeVar("_Array", bound=npt.NDArray[Any])

LONGEST_EDGE_M: Final = 0.015
"""Longest edge between neighbours: twice the pitch of a module, less than a gap that a missing module leaves."""
_SURROUNDINGS: Final = 1.5
"""Radius of what a point sees, in longest edges: no emptier circle can hold a triangle that short."""
_GOLDEN: Final = (np.sqrt(5.0) - 1.0) / 2.0
"""Multiples of it are spread evenly."""
_TIE: Final = 1e-8
"""By how much points on one circle are separated, over the square of the longest edge: else rounding would decide
which diagonal is taken, and a layout that is turned would get another surface."""
_SAME_LENGTH_M: Final = 1e-9
"""Difference between lengths that is rounding."""
_PATCHES: Final = 16
"""Patches whose triangles are remembered: normals and pressures need them, with every hint at an outer side, and
every recording again."""


def surface_triangles(positions: FloatArray, longest_edge_m: float) -> IntArray:
    """Join points of a surface to triangles whose inner edges belong to two of them.

    Args:
        positions: Points, all of them distinct; shape (n, 3); m.
        longest_edge_m: Longest edge; m.

    Returns:
        Triangles, in no particular orientation; shape (m, 3); read-only.
    """
    return _triangles_between(positions.astype(np.float64).tobytes(), longest_edge_m)


@lru_cache(maxsize=_PATCHES)
def _triangles_between(points: bytes, longest_edge_m: float) -> IntArray:
    """Those triangles, of points as their bytes."""
    positions = np.frombuffer(points).reshape(-1, 3)
    candidates, votes = _voted_triangles(positions, longest_edge_m)
    sides = np.linalg.norm(positions[candidates] - positions[np.roll(candidates, 1, axis=1)], axis=2)
    longest = sides.max(axis=1)
    # taxels on a line, as along the side of a module, make triangles of nothing but rounding
    fits = (longest <= longest_edge_m) & (_circumradius(positions[candidates], sides) <= longest_edge_m)
    order = np.lexsort((np.rint(longest[fits] / _SAME_LENGTH_M), -votes[fits]))
    triangles = _without_overlap(positions, candidates[fits][order])
    triangles.setflags(write=False)
    return triangles


def _circumradius(corners: FloatArray, sides: FloatArray) -> FloatArray:
    """Radius of the circle through three corners each; shape (m,); m."""
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return sides.prod(axis=1) / np.maximum(2.0 * doubled, np.finfo(np.float64).tiny)


def _voted_triangles(positions: FloatArray, longest_edge_m: float) -> tuple[IntArray, IntArray]:
    """Every triangle that some corner sees, and how many of its corners do."""
    from scipy.spatial import KDTree

    tree = KDTree(positions)
    nearby = tree.query_ball_point(positions, longest_edge_m)
    around = tree.query_ball_point(positions, _SURROUNDINGS * longest_edge_m)
    seen = [np.empty((0, 3), dtype=np.int64)]
    for point, (near, far) in enumerate(zip(nearby, around, strict=True)):
        plane = _tangent_plane(positions[near])
        if plane is None:
            continue
        flat = (positions[far] - positions[point]) @ plane.T / longest_edge_m
        triangles = np.array(far)[_delaunay(flat, _TIE * np.modf(_GOLDEN * np.array(far))[0])]
        seen.append(triangles[(triangles == point).any(axis=1)])
    triangles, votes = np.unique(np.sort(np.concatenate(seen), axis=1), axis=0, return_counts=True)
    return triangles, votes


def _delaunay(points: FloatArray, lift: FloatArray) -> IntArray:
    """Delaunay triangles in a plane: the lower side of the hull of points on a paraboloid, each lifted a little."""
    from scipy.spatial import ConvexHull

    if len(points) == 3:
        return np.array([[0, 1, 2]])
    hull = ConvexHull(np.column_stack([points, (points**2).sum(axis=1) + lift]))
    return hull.simplices[hull.equations[:, 2] < 0.0].astype(np.int64)


def _tangent_plane(points: FloatArray) -> FloatArray | None:
    """Two directions that span points best; shape (2, 3); None for points on a line."""
    if len(points) < 3:
        return None
    _, spread, directions = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    plane: FloatArray = directions[:2]
    return plane if spread[1] > 1e-3 * spread[0] else None


def _without_overlap(positions: FloatArray, candidates: IntArray) -> IntArray:
    """Take triangles in their order, unless one lies over another that was taken."""
    across: dict[tuple[int, int], list[int]] = {}
    taken = []
    for triangle in candidates.tolist():
        sides = [(tuple(sorted((triangle[k - 2], triangle[k - 1]))), triangle[k]) for k in range(3)]
        if all(_is_free(positions, edge, corner, across.get(edge, [])) for edge, corner in sides):
            taken.append(triangle)
            for edge, corner in sides:
                across.setdefault(edge, []).append(corner)
    return np.array(taken, dtype=np.int64).reshape(-1, 3)


def _is_free(positions: FloatArray, edge: tuple[int, int], corner: int, corners: list[int]) -> bool:
    """Whether the side of an edge on which a corner lies has no triangle yet."""
    if not corners:
        return True
    start = positions[edge[0]]
    direction = positions[edge[1]] - start
    direction = direction / np.linalg.norm(direction)
    offsets = positions[[corner, corners[0]]] - start
    offsets = offsets - np.outer(offsets @ direction, direction)
    return len(corners) == 1 and bool(offsets[0] @ offsets[1] < 0.0)


_FLAT: Final = 0.02
"""Mean outward cosine below which a surface does not show by its shape which side is out."""


def outward_triangles(positions: FloatArray, triangles: IntArray, outward: FloatArray | None) -> IntArray:
    """Turn triangles so that their corners run counterclockwise where they are seen from outside.

    Neighbours are turned alike. Rough directions decide which way for every connected piece, or its shape: a piece of
    skin bulges outwards.

    Args:
        positions: Points; shape (n, 3); m.
        triangles: Triangles, of which at most two share an edge; shape (m, 3).
        outward: Rough outward direction at every point, of which only the mean matters; shape (n, 3); None to go by
            the shape.

    Returns:
        The triangles, turned; shape (m, 3).

    Raises:
        SkinError: If the surface has only one side, or neither directions nor shape determine which one is outer.
    """
    turned, pieces = _turned_alike(triangles)
    corners = positions[turned]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])  # (m, 3), twice the area
    if outward is None:
        directions = corners.mean(axis=1) - positions[np.unique(turned)].mean(axis=0)
    else:
        directions = outward[turned].mean(axis=1)
    agreement = (normals * directions).sum(axis=1)
    full = np.linalg.norm(normals, axis=1) * np.linalg.norm(directions, axis=1)
    for piece in range(int(pieces.max(initial=-1)) + 1):
        own = pieces == piece
        cosine = agreement[own].sum() / full[own].sum() if full[own].any() else 0.0
        if not abs(cosine) > _FLAT:
            raise SkinError(
                f"outward: expected directions that determine the outer side of the skin about taxel "
                f"{turned[own][0, 0]}, got a mean cosine of {cosine:.3f}; state rough outward directions of the taxels"
            )
        if cosine < 0.0:
            turned[own] = turned[own][:, ::-1]
    return turned


def _turned_alike(triangles: IntArray) -> tuple[IntArray, IntArray]:
    """Triangles turned like their neighbours, and the connected piece of each."""
    beside = _sharing(triangles)
    turned = triangles.copy()
    pieces = np.full(len(triangles), -1)
    for seed in range(len(triangles)):
        if pieces[seed] >= 0:
            continue
        pieces[seed] = pieces.max() + 1
        open_ended = [seed]
        while open_ended:
            one = open_ended.pop()
            for other in beside[one]:
                runs_alike = not _runs_against(turned[one], turned[other])
                if pieces[other] < 0:
                    pieces[other] = pieces[seed]
                    turned[other] = turned[other][::-1] if runs_alike else turned[other]
                    open_ended.append(other)
                elif runs_alike:
                    raise SkinError(
                        f"positions: expected a skin with two sides, got one whose sides meet at taxels {turned[one]}; "
                        "look at the layout with `forcetorque skin check`"
                    )
    return turned, pieces


def _sharing(triangles: IntArray) -> list[list[int]]:
    """Triangles that share an edge with each."""
    owners: dict[tuple[int, int], list[int]] = {}
    for number, corners in enumerate(triangles.tolist()):
        for k in range(3):
            owners.setdefault((min(corners[k - 1], corners[k]), max(corners[k - 1], corners[k])), []).append(number)
    beside: list[list[int]] = [[] for _ in range(len(triangles))]
    for pair in owners.values():
        if len(pair) == 2:
            beside[pair[0]].append(pair[1])
            beside[pair[1]].append(pair[0])
    return beside


def _runs_against(one: IntArray, other: IntArray) -> bool:
    """Whether two triangles run along the edge that they share in opposite directions."""
    forward = {(one[k - 1], one[k]) for k in range(3)}
    return any((other[k], other[k - 1]) in forward for k in range(3))


@dataclass(frozen=True, kw_only=True, eq=False)
class SkinSurface(ArrayRecord):
    """Taxels and the triangles between them, in the frame of the link."""

    positions: FloatArray = field(metadata=array("n", 3))
    """Taxels; shape (n, 3); m."""
    triangles: IntArray = field(metadata=array("m", 3, dtype="int"))
    """Taxels at the corners of each facet, counterclockwise seen from outside; shape (m, 3)."""

    def __len__(self) -> int:
        return len(self.positions)

    @cached_property
    def edges(self) -> IntArray:
        """Pairs of neighbours, the smaller number first; shape (e, 2); read-only."""
        return self._edges_and_boundary[0]

    @cached_property
    def boundary(self) -> IntArray:
        """Edges of one facet only, in its direction, so that the skin is on their left; shape (b, 2); read-only."""
        return self._edges_and_boundary[1]

    @cached_property
    def neighbours(self) -> IntArray:
        """Neighbours of each taxel, filled up with the taxel itself; shape (n, d), d the most of one; read-only."""
        return _read_only(_neighbours(self.edges, len(self)))

    @cached_property
    def facet_areas(self) -> FloatArray:
        """Areas; shape (m,); m²; read-only."""
        return _read_only(np.linalg.norm(self._doubled_areas, axis=1) / 2.0)

    @cached_property
    def facet_normals(self) -> FloatArray:
        """Outward unit normals; shape (m, 3); read-only."""
        return _read_only(_unit(self._doubled_areas))

    @cached_property
    def vertex_normals(self) -> FloatArray:
        """Outward unit normals of the taxels, area-weighted means of their facets; 0 without facet; shape (n, 3)."""
        sums = np.zeros_like(self.positions)
        np.add.at(sums, self.triangles.ravel(), np.repeat(self._doubled_areas, 3, axis=0))
        return _read_only(_unit(sums))

    @cached_property
    def _edges_and_boundary(self) -> tuple[IntArray, IntArray]:
        edges, boundary = _edges(self.triangles, len(self))
        return _read_only(edges), _read_only(boundary)

    @cached_property
    def _doubled_areas(self) -> FloatArray:
        """Outward normal of each facet, twice as long as its area; shape (m, 3); m²."""
        corners = self.positions[self.triangles]
        return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])

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
        SkinError: If two taxels share a position, no three taxels are neighbours, or the outer side is undetermined.
    """
    points = read_only(positions, name="positions", shape=(None, 3))
    hints = None if outward is None else read_only(outward, name="outward", shape=(len(points), 3))
    _, first, count = np.unique(points, axis=0, return_index=True, return_counts=True)
    if (count > 1).any():
        shared = points[first[count > 1][0]]
        raise SkinError(
            f"positions: expected distinct taxels, got {np.flatnonzero((points == shared).all(axis=1)).tolist()} all "
            f"at {shared.tolist()} m; correct the file of the layout"
        )
    triangles = surface_triangles(points, longest_edge_m)
    if not len(triangles):
        raise SkinError(
            f"positions: expected taxels with neighbours within {1e3 * longest_edge_m:g} mm, got {len(points)} taxels "
            "and no triangle between them; positions are in m"
        )
    return SkinSurface(positions=points, triangles=outward_triangles(points, triangles, hints))


def _read_only(values: _Array) -> _Array:
    values.setflags(write=False)
    return values


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


HALF_PITCH_M: Final = 0.0033
"""Width of the strip: half the distance between taxels of a module."""
_HOLE: Final = 4
"""Most edges around a hole that the strip fills."""
_LONGEST_MITRE: Final = 2.0
"""Length of the strip at a sharp corner, in widths."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Rim(ArrayRecord):
    """Facets outside the boundary of a surface."""

    positions: FloatArray = field(metadata=array("k", 3))
    """Outer points; shape (k, 3); m."""
    taxels: IntArray = field(metadata=array("k", dtype="int"))
    """Taxel from which each outer point was taken outwards; shape (k,)."""
    triangles: IntArray = field(metadata=array("m", 3, dtype="int"))
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
    """Find the taxels at the edge of a patch, beyond which pressure is not measured.

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
