# SPDX-License-Identifier: BSD-3-Clause
"""Modules that are not the triangle of ten taxels, or lie on each other."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.skin.layout.findings.finding import Defect, LayoutFinding, counted, finding_of
from forcetorque.skin.layout.findings.shape import PatchShape
from forcetorque.skin.layout.modules import (
    MODULE_CENTRE,
    MODULE_COLUMNS,
    MODULE_SIDE_M,
    TEMPLATE_M,
    are_boards,
    has_ten,
    template_misfit,
)

NEAREST_CENTRES_M = 0.8 * MODULE_SIDE_M / np.sqrt(3.0)
"""Distance of the centres of two modules that share a side, with room for what covers bend; m."""


def off_template(shape: PatchShape) -> Iterator[LayoutFinding]:
    """Find modules of twelve columns that do not have the ten taxels of the triangle where it has them.

    Args:
        shape: Patch; of other skins, whose modules are not twelve columns each, nothing is asked.

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


def overlaps(shape: PatchShape) -> Iterator[LayoutFinding]:
    """Find modules whose centres are nearer than two triangles side by side can be.

    Args:
        shape: Patch; of other skins, whose modules are not twelve columns each, nothing is asked.

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
