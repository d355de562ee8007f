# SPDX-License-Identifier: BSD-3-Clause
"""Triangles between points of a curved surface, and which side of them is the outer one."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import SkinError

LONGEST_EDGE_M: Final = 0.015
"""Longest edge between neighbours: twice the pitch of a module, less than a gap that a missing module leaves."""
_SURROUNDINGS: Final = 1.5
"""Radius of what a point sees, in longest edges: no emptier circle can hold a triangle that short."""
_GOLDEN: Final = (np.sqrt(5.0) - 1.0) / 2.0
"""Multiples of it are spread evenly."""
_TIE: Final = 1e-8
"""By how much points on one circle are told apart, over the square of the longest edge: else rounding would decide
which diagonal is taken, and a layout that is turned would get another surface."""
_SAME_LENGTH_M: Final = 1e-9
"""Difference between lengths that is rounding."""
_PATCHES: Final = 16
"""Patches whose triangles are remembered: normals and pressures ask for them, with every hint at an outer side, and
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
"""Mean outward cosine below which a surface does not tell by its shape which side is out."""


def outward_triangles(positions: FloatArray, triangles: IntArray, outward: FloatArray | None) -> IntArray:
    """Turn triangles so that their corners run counterclockwise where they are seen from outside.

    Neighbours are turned alike; which way, every connected piece is told by rough directions, or by its shape: a piece
    of skin bulges outwards.

    Args:
        positions: Points; shape (n, 3); m.
        triangles: Triangles, of which at most two share an edge; shape (m, 3).
        outward: Rough outward direction at every point, of which only the mean matters; shape (n, 3); None to go by
            the shape.

    Returns:
        The triangles, turned; shape (m, 3).

    Raises:
        SkinError: If the surface has only one side, or neither directions nor shape tell which one is outer.
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
                f"outward: expected directions that tell the outer side of the skin about taxel {turned[own][0, 0]}, "
                f"got a mean cosine of {cosine:.3f}; state rough outward directions of the taxels"
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
