# SPDX-License-Identifier: BSD-3-Clause
"""Which side of a board is its outer one, by the way in which its taxels are numbered.

Boards are alike: seen from outside, the taxels of each run the same way round. On the curved patches of iCub, whose
shape says which side is out, all 282 boards do; so a flat patch, as of a sole, tells it by its boards.
"""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.skin.module import MODULE_COLUMNS, MODULE_PADS, MODULE_TAXELS

TEMPLATE_M = 5e-4
"""Root of the mean square distance to the template from which a module is none; m: a twelfth of the pitch."""


def are_boards(taxels: IntArray, modules: IntArray) -> bool:
    """Tell whether a patch is of triangular modules, which have twelve columns each.

    Args:
        taxels: Column of each taxel; shape (n,).
        modules: Module of each; shape (n,).

    Returns:
        Whether it is.
    """
    return bool((modules == taxels // MODULE_COLUMNS).all())


def has_ten(taxels: IntArray) -> bool:
    """Tell whether a module has the ten taxels of the triangle.

    Args:
        taxels: Columns of its taxels, increasing; shape (k,).

    Returns:
        Whether it has.
    """
    return np.array_equal(taxels % MODULE_COLUMNS, MODULE_TAXELS)


def template_misfit(points: FloatArray) -> float:
    """Measure how far ten taxels are from the template, moved and mirrored as fits best.

    Args:
        points: Taxels of a module, in the order of their columns; shape (10, 3); m.

    Returns:
        Root of the mean square distance; m.
    """
    template = MODULE_PADS[MODULE_TAXELS]
    centred, wanted = points - points.mean(axis=0), template - template.mean(axis=0)
    # the template is flat, so its mirror image is a rotation of it: every orthogonal matrix may be taken
    left, _, right = np.linalg.svd(wanted.T @ centred)
    return float(np.sqrt(((centred - wanted @ left @ right) ** 2).sum(axis=1).mean()))


def outward_of_boards(positions: FloatArray, taxels: IntArray, modules: IntArray) -> FloatArray | None:
    """Find the outer side of boards.

    Args:
        positions: Taxels; shape (n, 3); m.
        taxels: Column of each, increasing; shape (n,).
        modules: Module of each; shape (n,).

    Returns:
        Outward unit normal of the board of each taxel, zero where its module is no triangle; shape (n, 3). None if
        no module is one.
    """
    outward = np.zeros_like(positions)
    if not are_boards(taxels, modules):
        return None
    template = MODULE_PADS[MODULE_TAXELS, :2]
    for module in np.unique(modules):
        own = modules == module
        if has_ten(taxels[own]) and template_misfit(positions[own]) < TEMPLATE_M:
            centred = positions[own] - positions[own].mean(axis=0)
            x, y = np.linalg.lstsq(template, centred, rcond=None)[0]
            normal = np.cross(x, y)
            outward[own] = normal / np.linalg.norm(normal)
    return outward if outward.any() else None
