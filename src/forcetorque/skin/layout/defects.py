# SPDX-License-Identifier: BSD-3-Clause
"""Defects of a layout: of positions, modules, normals and the surface through the taxels."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.results.number_text import counted
from forcetorque.skin.layout.finding import Defect, LayoutFindingRow, PatchShape, Side, finding_of
from forcetorque.skin.layout.layout import UNIT_DIGITS, PatchDescription
from forcetorque.skin.layout.triangular_modules import (
    MODULE_CENTRE,
    MODULE_COLUMNS,
    MODULE_SIDE_M,
    TEMPLATE_M,
    are_boards,
    has_ten,
    template_misfit,
)
from forcetorque.skin.surface import LONGEST_EDGE_M, SkinSurface


def duplicates(shape: PatchShape) -> Iterator[LayoutFindingRow]:
    """Find taxels that have the position of another one.

    Args:
        shape: Patch.

    Yields:
        One finding of them all.
    """
    patch, count = shape.patch, np.bincount(shape.place)
    shared = count[shape.place] > 1
    if shared.any():
        places = counted(int(np.count_nonzero(count > 1)), "place")
        yield finding_of(
            patch,
            patch.taxels[shared],
            defect=Defect.DUPLICATE,
            message=f"{np.count_nonzero(shared)} taxels share {places}: {len(count)} distinct places of {len(patch)}",
            remedy="place their modules anew, from the frames of the modules' centres",
        )


_THERMAL = -2
"""Entry of a thermal pad; -1 is a missing taxel."""


def representatives(shape: PatchShape) -> Iterator[LayoutFindingRow]:
    """Find what rows and `taxel2Repr` say differently.

    Args:
        shape: Patch.

    Yields:
        A finding for each way in which they differ.
    """
    patch, entries = shape.patch, shape.patch.representatives
    if entries is None:
        return
    if len(entries) != patch.columns:
        yield _finding(
            patch,
            np.empty(0, dtype=np.int64),
            f"{len(entries)} entries for {patch.columns} rows",
            "write an entry for each row; rows are believed, entries beyond them are not used",
        )
    for columns, noun, what, remedy in _contradictions(patch, entries):
        if len(columns):
            yield _finding(patch, columns, f"{counted(len(columns), noun)} {what}", remedy)


def _contradictions(patch: PatchDescription, entries: IntArray) -> Iterator[tuple[IntArray, str, str, str]]:
    """Columns whose row and entry differ, what they are and how, and what to do."""
    length = min(len(entries), patch.columns)
    entries = entries[:length]
    placed = np.isin(np.arange(length), patch.taxels if patch.placed is None else patch.placed)
    yield (
        np.flatnonzero(placed & (entries == _THERMAL)),
        "thermal pad",
        "with a place",
        "write rows of zeros, or other entries if they are taxels; they are read as thermal pads",
    )
    yield (
        np.flatnonzero(placed & (entries < 0) & (entries != _THERMAL)),
        "row",
        "with a place, where the entry says that there is no taxel",
        "write the representative of each, or rows of zeros; they are read as taxels",
    )
    yield (
        np.flatnonzero(~placed & (entries >= 0)),
        "row",
        "of zeros, where the entry names a representative",
        "write where these taxels are, or entries of -1; they are read as none",
    )
    yield (
        _misled(entries, placed),
        "taxel",
        "with a representative that is none, or that another one represents",
        "write a taxel that represents itself",
    )


def _misled(entries: IntArray, placed: BoolArray) -> IntArray:
    """Taxels whose representative is beyond the message, no taxel, or does not represent itself."""
    taxels = np.flatnonzero(placed & (entries >= 0))
    chosen = entries[taxels]
    inside = np.minimum(chosen, len(entries) - 1)
    valid = (chosen < len(entries)) & placed[inside] & (entries[inside] == chosen)
    return taxels[~valid]


def _finding(patch: PatchDescription, columns: IntArray, message: str, remedy: str) -> LayoutFindingRow:
    return finding_of(patch, columns, defect=Defect.REPRESENTATIVES, message=message, remedy=remedy)


NEAREST_CENTRES_M = 0.8 * MODULE_SIDE_M / np.sqrt(3.0)
"""Distance of the centres of two modules that share a side, with room for what covers bend; m."""


def off_template(shape: PatchShape) -> Iterator[LayoutFindingRow]:
    """Find modules of twelve columns that do not have the ten taxels of the triangle where it has them.

    Args:
        shape: Patch; of other skins, whose modules are not twelve columns each, nothing is checked.

    Yields:
        A finding of those with other taxels, and one of those with taxels at other places.
    """
    patch = shape.patch
    if not are_boards(patch.taxels, patch.modules):
        return
    other, bent, worst = [], [], 0.0
    for module in np.unique(patch.modules):
        own = patch.modules == module
        if not has_ten(patch.taxels[own]):
            other.append(module)
            continue
        distance = template_misfit(patch.positions[own])
        if distance > TEMPLATE_M:
            bent.append(module)
            worst = max(worst, distance)
    if other:
        counts = " or ".join(sorted({str(np.count_nonzero(patch.modules == module)) for module in other}))
        yield finding_of(
            patch,
            patch.taxels[np.isin(patch.modules, other)],
            defect=Defect.TEMPLATE,
            message=f"{counted(len(other), 'module')} of {counts} taxels, which are not the ten of the triangle",
            remedy="give the ten taxels of each if it is a triangle; a palm, a fingertip or an older board is none",
        )
    if bent:
        yield finding_of(
            patch,
            patch.taxels[np.isin(patch.modules, bent)],
            defect=Defect.TEMPLATE,
            message=f"taxels of {counted(len(bent), 'module')} are off the triangle, at the worst by {1e3 * worst:.1f} "
            "mm (root mean square)",
            remedy="place these modules anew, from the frames of their centres",
        )


def overlaps(shape: PatchShape) -> Iterator[LayoutFindingRow]:
    """Find modules whose centres are nearer than two triangles side by side can be.

    Args:
        shape: Patch; of other skins, whose modules are not twelve columns each, nothing is checked.

    Yields:
        One finding of them all.
    """
    patch = shape.patch
    if not are_boards(patch.taxels, patch.modules):
        return
    modules = np.array(
        [module for module in np.unique(patch.modules) if has_ten(patch.taxels[patch.modules == module])],
        dtype=np.int64,
    )
    centres = patch.positions[np.isin(patch.taxels, modules * MODULE_COLUMNS + MODULE_CENTRE)]
    distance = np.linalg.norm(centres[:, None] - centres, axis=2)
    pairs = [(i, j) for i, j in np.argwhere(distance < NEAREST_CENTRES_M).tolist() if i < j]
    if pairs:
        names = ", ".join(f"{modules[i]} and {modules[j]} ({1e3 * distance[i, j]:.1f} mm)" for i, j in pairs)
        yield finding_of(
            patch,
            patch.taxels[np.isin(patch.modules, modules[np.unique(pairs)])],
            defect=Defect.OVERLAP,
            message=f"centres of modules are nearer than two triangles can be: {names}",
            remedy="look in the CAD file which of each two is where it says",
        )


REBUILD = "rebuild the normals from the positions (`rebuild_normals` of `read_layout`)"
"""What to do about wrong normals where positions are right."""


def normal_lengths(shape: PatchShape) -> Iterator[LayoutFindingRow]:
    """Find normals of length 0, and of another one than 1.

    Args:
        shape: Patch.

    Yields:
        A finding for each.
    """
    patch = shape.patch
    if patch.normals is None:
        return
    length = np.linalg.norm(patch.normals, axis=1)
    zero = length == 0.0
    if zero.any():
        yield finding_of(
            patch,
            patch.taxels[zero],
            defect=Defect.ZERO,
            message=f"{np.count_nonzero(zero)} of {len(patch)} normals are 0 0 0",
            remedy=REBUILD,
        )
    other = ~zero & ~np.isclose(length, 1.0, rtol=0.0, atol=UNIT_DIGITS)
    if other.any():
        yield finding_of(
            patch,
            patch.taxels[other],
            defect=Defect.NOT_UNIT,
            message=f"{np.count_nonzero(other)} of {len(patch)} normals have a length of {length[other].min():.3f} to "
            f"{length[other].max():.3f}",
            remedy=f"divide them by their lengths if they are directions, else {REBUILD}",
        )


OBLIQUE_DEG = 30.0
"""Angle to the surface from which a normal is not that of a flat module either; degrees."""
FACETED_DEG = 2.0
"""Mean angle within modules from which one normal per module is a coarse one; degrees."""
_SAME = 1e-3
"""Difference of components of normals that are one; of the rounding of three digits."""


def normal_directions(shape: PatchShape) -> Iterator[LayoutFindingRow]:
    """Find one direction for all taxels, directions into the link or across the surface, and one for each module.

    Args:
        shape: Patch.

    Yields:
        A finding for each; where one direction stands for all, only that.
    """
    patch = shape.patch
    if patch.normals is None or shape.normals is None:
        return
    length = np.linalg.norm(patch.normals, axis=1)
    stated = length > 0.0
    if not stated.any():
        return
    unit = patch.normals / np.where(stated, length, 1.0)[:, None]
    cosine = (unit * shape.normals).sum(axis=1)
    if shape.side is Side.NOTHING:
        cosine = np.abs(cosine)
    angle = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    off = stated & (angle > OBLIQUE_DEG)
    if _is_placeholder(unit[stated], angle[stated]):
        yield _placeholder(patch, unit, stated, angle)
        return
    inward = off & (angle > 90.0)
    if inward.any():
        yield _off(patch, inward, Defect.INWARD, "point into the link", _remedy_of_inward(shape, inward, stated))
    if (off & ~inward).any():
        yield _off(patch, off & ~inward, Defect.OBLIQUE, f"are more than {OBLIQUE_DEG:g} degrees off", REBUILD)
    if not off.any() and stated.all():
        yield from _faceted(patch, unit, shape.normals)


def _is_placeholder(unit: FloatArray, angle: FloatArray) -> bool:
    """Whether all directions are one, and not that of the surface or its back."""
    return bool(np.ptp(unit, axis=0).max() < _SAME and np.minimum(angle, 180.0 - angle).max() > OBLIQUE_DEG)


def _placeholder(patch: PatchDescription, unit: FloatArray, stated: BoolArray, angle: FloatArray) -> LayoutFindingRow:
    direction = " ".join(f"{component:g}" for component in unit[stated][0].round(3) + 0.0)
    return finding_of(
        patch,
        patch.taxels[stated],
        defect=Defect.PLACEHOLDER,
        message=f"all {np.count_nonzero(stated)} normals are {direction}, up to {angle[stated].max():.0f} degrees from "
        "the surface through the taxels",
        remedy=REBUILD,
    )


def _off(patch: PatchDescription, off: BoolArray, defect: Defect, what: str, remedy: str) -> LayoutFindingRow:
    message = f"{np.count_nonzero(off)} of {len(patch)} normals {what}"
    return finding_of(patch, patch.taxels[off], defect=defect, message=message, remedy=remedy)


def _remedy_of_inward(shape: PatchShape, inward: BoolArray, stated: BoolArray) -> str:
    if inward[stated].all() and shape.side is Side.SHAPE:
        return "reverse them all, unless the skin lines the inside of a link"
    if inward[stated].all():
        return "reverse them all, unless its boards are mirror images of those of iCub"
    return f"reverse them, or {REBUILD}"


def _faceted(patch: PatchDescription, unit: FloatArray, surface: FloatArray) -> Iterator[LayoutFindingRow]:
    """One normal for each module, where the normals of the surface turn within modules."""
    modules = np.unique(patch.modules)
    own = [patch.modules == module for module in modules]
    turned = sum(np.degrees(np.arccos(np.clip(surface[k] @ _mean(surface[k]), -1.0, 1.0))).sum() for k in own)
    if len(modules) < 2 or turned / len(patch) < FACETED_DEG:
        return
    if all(np.ptp(unit[k], axis=0).max() < _SAME for k in own):
        yield finding_of(
            patch,
            patch.taxels,
            defect=Defect.FACETED,
            message=f"all taxels of a module have one normal, while the surface turns within modules by "
            f"{turned / len(patch):.1f} degrees in the mean",
            remedy=REBUILD,
        )


def _mean(directions: FloatArray) -> FloatArray:
    total = directions.sum(axis=0)
    return total / np.linalg.norm(total)


LEAST_HOLE_M = 4.0 * LONGEST_EDGE_M
"""Length of the line around a hole; m. A shorter one is room between modules, a missing module leaves more."""
_REMEDY = "look whether modules are missing there; pressure in a gap is not felt, and forces on it are too small"


def gaps(shape: PatchShape) -> Iterator[LayoutFindingRow]:
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
