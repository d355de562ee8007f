# SPDX-License-Identifier: BSD-3-Clause
"""The triangular module of ten taxels, patches made of modules, and which side of a board is its outer one."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, read_only, read_only_integers
from forcetorque.base.pose import split_pose
from forcetorque.skin.layout.layout import PatchDescription

MODULE_COLUMNS = 12
"""Numbers of a module in a message of counts: ten taxels and two thermal pads."""
MODULE_CENTRE = 3
"""Taxel at the centre of a module."""
MODULE_SIDE_M = 0.030
"""Side of the triangular board; m. Neighbours are farther apart where they need room."""
MODULE_THERMAL: IntArray = read_only_integers([6, 10], name="MODULE_THERMAL", shape=(2,))
"""Columns of a module that are thermal pads; shape (2,)."""
MODULE_TAXELS: IntArray = read_only_integers([0, 1, 2, 3, 4, 5, 7, 8, 9, 11], name="MODULE_TAXELS", shape=(10,))
"""Columns of a module that are taxels; shape (10,)."""

_MM = [
    (6.533, 0.0),
    (9.8, -5.66),
    (3.267, -5.66),
    (0.0, 0.0),
    (-3.267, -5.66),
    (-9.8, -5.66),
    (-6.533, -3.75),
    (-6.533, 0.0),
    (-3.267, 5.66),
    (0.0, 11.317),
    (0.0, 7.507),
    (3.267, 5.66),
]
MODULE_PADS: FloatArray = read_only(
    1e-3 * np.column_stack([np.array(_MM), np.zeros(MODULE_COLUMNS)]), name="MODULE_PADS", shape=(MODULE_COLUMNS, 3)
)
"""Centres of all pads in the module's frame, by column; shape (12, 3); m."""


def placed_pads(a_H_module: FloatArray, *, mirrored: bool = False) -> FloatArray:
    """Put the pads of a module where it is.

    Args:
        a_H_module: Pose of the module in a frame; shape (4, 4); m.
        mirrored: Whether its board is the mirror image, as boards of the other side of a robot may be: x is reversed.

    Returns:
        Centres of its pads in that frame, by column; shape (12, 3); m.
    """
    rotation, centre = split_pose(a_H_module)
    pads = MODULE_PADS * [-1.0, 1.0, 1.0] if mirrored else MODULE_PADS
    return pads @ rotation.T + centre


LARGEST_MESSAGE = 1_000_000
"""Numbers that a message of a patch may have; more are a mistake of the file, not a skin."""
BOARD_MODULES = 16
"""Modules of a message of one micro-controller; a patch sends whole ones."""


def message_columns(modules: Sequence[int]) -> int:
    """Count the numbers that a patch sends.

    Args:
        modules: Its modules.

    Returns:
        Those of as many micro-controllers as it takes to have them all.
    """
    return math.ceil((max(modules) + 1) / BOARD_MODULES) * BOARD_MODULES * MODULE_COLUMNS


def modular_patch(
    *,
    source: str,
    name: str,
    frame: str,
    modules: Sequence[int],
    poses: FloatArray,
    lines: Sequence[int],
    mirrored: Sequence[bool],
    columns: int | None = None,
) -> PatchDescription:
    """Put the pads of modules where the modules are.

    Args:
        source: File that says so.
        name: Patch.
        frame: Frame of the poses.
        modules: Modules, each once.
        poses: Pose of each, z outwards; shape (k, 4, 4); m.
        lines: Line of the file that states each, from 1; 0 for none.
        mirrored: Which boards are mirror images.
        columns: Numbers in one message of counts, enough for the last module; by default those of whole
            micro-controllers.

    Returns:
        The patch. Its normals are those of the modules, one for each: the surface is curved, and `rebuilt_normals` has
        the normals of that.
    """
    order = np.argsort(modules)
    numbers = np.asarray(modules, dtype=np.int64)[order]
    pads = np.array([placed_pads(poses[k], mirrored=bool(mirrored[k])) for k in order])
    count = message_columns(modules) if columns is None else columns
    stated = np.zeros(count, dtype=np.int64)
    stated[_columns(numbers, np.arange(MODULE_COLUMNS))] = np.repeat(np.asarray(lines)[order], MODULE_COLUMNS)
    return PatchDescription(
        source=source,
        name=name,
        frame=frame,
        columns=count,
        lines=stated,
        taxels=_columns(numbers, MODULE_TAXELS),
        modules=np.repeat(numbers, len(MODULE_TAXELS)),
        positions=pads[:, MODULE_TAXELS].reshape(-1, 3),
        normals=np.repeat(poses[order, :3, 2], len(MODULE_TAXELS), axis=0),
        thermal_pads=_columns(numbers, MODULE_THERMAL),
        thermal_modules=np.repeat(numbers, len(MODULE_THERMAL)),
    )


def _columns(modules: IntArray, pads: IntArray) -> IntArray:
    return (modules[:, None] * MODULE_COLUMNS + pads).ravel()


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
