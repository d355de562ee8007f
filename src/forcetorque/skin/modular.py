# SPDX-License-Identifier: BSD-3-Clause
"""Patches that are written down by the poses of their modules."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.skin.description import PatchDescription
from forcetorque.skin.module import MODULE_COLUMNS, MODULE_TAXELS, MODULE_THERMAL, placed_pads

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
