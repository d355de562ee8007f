# SPDX-License-Identifier: BSD-3-Clause
"""Where the surface through the taxels ends: pieces that nothing joins, and holes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.base.arrays import IntArray
from forcetorque.skin.layout.findings.finding import Defect, LayoutFinding, counted, finding_of
from forcetorque.skin.layout.findings.shape import PatchShape
from forcetorque.skin.surface.surface import SkinSurface
from forcetorque.skin.surface.triangulation import LONGEST_EDGE_M

LEAST_HOLE_M = 4.0 * LONGEST_EDGE_M
"""Length of the line around a hole; m. A shorter one is room between modules, a missing module leaves more."""
_REMEDY = "look whether modules are missing there; pressure in a gap is not felt, and forces on it are too small"


def gaps(shape: PatchShape) -> Iterator[LayoutFinding]:
    """Find pieces of a patch that are apart from the largest one, and holes in it.

    Args:
        shape: Patch.

    Yields:
        A finding of the pieces, and one of the holes.
    """
    patch, surface = shape.patch, shape.surface
    if surface is None:
        yield finding_of(
            patch,
            patch.taxels,
            defect=Defect.GAP,
            message=f"no three taxels within {1e3 * LONGEST_EDGE_M:g} mm of each other make a surface with two sides",
            remedy="look whether positions are in m, and modules where they belong",
        )
        return
    piece = _pieces(surface)
    main = int(np.bincount(piece).argmax())
    count = int(piece.max())
    if count:
        apart = patch.taxels[piece[shape.place] != main]
        message = (
            f"{counted(len(apart), 'taxel')} in {counted(count, 'piece')} are more than {1e3 * LONGEST_EDGE_M:g} mm "
            f"from the other {len(patch) - len(apart)}"
        )
        yield finding_of(patch, apart, defect=Defect.GAP, message=message, remedy=_REMEDY)
    holes = _holes(surface, piece)
    if holes:
        around = patch.taxels[np.isin(shape.place, np.concatenate(holes))]
        sizes = ", ".join(f"{1e3 * _length(surface, hole):.0f}" for hole in holes)
        message = f"{counted(len(holes), 'hole')}, {sizes} mm around"
        yield finding_of(patch, around, defect=Defect.GAP, message=message, remedy=_REMEDY)


def _pieces(surface: SkinSurface) -> IntArray:
    """Connected piece of each taxel; shape (n,)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    start, end = surface.edges.T
    joined = coo_array((np.ones(len(start)), (start, end)), shape=(len(surface), len(surface)))
    return connected_components(joined, directed=False)[1].astype(np.int64)


def _holes(surface: SkinSurface, piece: IntArray) -> list[IntArray]:
    """Taxels around each hole, the smallest first: loops of the boundary of a piece but its longest."""
    loops = sorted(_loops(surface), key=lambda loop: _length(surface, loop))
    longest = {int(piece[loop[0]]): k for k, loop in enumerate(loops)}
    return [loop for k, loop in enumerate(loops) if k not in longest.values() and _length(surface, loop) > LEAST_HOLE_M]


def _loops(surface: SkinSurface) -> list[IntArray]:
    """Taxels of each closed line of the boundary, in its order."""
    after: dict[int, list[int]] = {}
    for start, end in surface.boundary.tolist():
        after.setdefault(start, []).append(end)
    loops = []
    while after:
        taxel = next(iter(after))
        loop = []
        while taxel in after:
            loop.append(taxel)
            following = after[taxel].pop()
            if not after[taxel]:
                del after[taxel]
            taxel = following
        loops.append(np.array(loop))
    return loops


def _length(surface: SkinSurface, loop: IntArray) -> float:
    steps = surface.positions[np.roll(loop, -1)] - surface.positions[loop]
    return float(np.linalg.norm(steps, axis=1).sum())
