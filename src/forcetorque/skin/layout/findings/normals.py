# SPDX-License-Identifier: BSD-3-Clause
"""Normals that are not unit vectors, or not those of the surface through the taxels."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.skin.layout.findings.finding import Defect, LayoutFinding, finding_of
from forcetorque.skin.layout.findings.shape import PatchShape, Side
from forcetorque.skin.layout.layout import UNIT_DIGITS, PatchDescription

REBUILD = "rebuild the normals from the positions (`rebuild_normals` of `read_layout`)"
"""What to do about wrong normals where positions are right."""


def normal_lengths(shape: PatchShape) -> Iterator[LayoutFinding]:
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


def normal_directions(shape: PatchShape) -> Iterator[LayoutFinding]:
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


def _placeholder(patch: PatchDescription, unit: FloatArray, stated: BoolArray, angle: FloatArray) -> LayoutFinding:
    direction = " ".join(f"{component:g}" for component in unit[stated][0].round(3) + 0.0)
    return finding_of(
        patch,
        patch.taxels[stated],
        defect=Defect.PLACEHOLDER,
        message=f"all {np.count_nonzero(stated)} normals are {direction}, up to {angle[stated].max():.0f} degrees from "
        "the surface through the taxels",
        remedy=REBUILD,
    )


def _off(patch: PatchDescription, off: BoolArray, defect: Defect, what: str, remedy: str) -> LayoutFinding:
    message = f"{np.count_nonzero(off)} of {len(patch)} normals {what}"
    return finding_of(patch, patch.taxels[off], defect=defect, message=message, remedy=remedy)


def _remedy_of_inward(shape: PatchShape, inward: BoolArray, stated: BoolArray) -> str:
    if inward[stated].all() and shape.side is Side.SHAPE:
        return "reverse them all, unless the skin lines the inside of a link"
    if inward[stated].all():
        return "reverse them all, unless its boards are mirror images of those of iCub"
    return f"reverse them, or {REBUILD}"


def _faceted(patch: PatchDescription, unit: FloatArray, surface: FloatArray) -> Iterator[LayoutFinding]:
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
