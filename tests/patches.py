# SPDX-License-Identifier: BSD-3-Clause
"""Patches of skin with known normals: real modules on a cylinder, sound in all that `skin check` looks at."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.skin import (
    MODULE_COLUMNS,
    MODULE_TAXELS,
    MODULE_THERMAL,
    PatchDescription,
    placed_pads,
)

RADIUS_M = 0.06
"""Of a shank; m."""
PITCH_M = 0.0325
"""Side of the triangles that neighbouring modules stand on; m, as on iCub's legs."""
HEAD_LINES = 4
"""Lines of a position file above its rows."""


def cylinder_patch(*, across: int = 7, along: int = 3, radius_m: float = RADIUS_M) -> PatchDescription:
    """Modules on a cylinder about the z axis of the link `shank`, with true normals.

    Args:
        across: Modules of a row, which go around it.
        along: Rows.
        radius_m: Radius at the centres of the modules; m.

    Returns:
        A patch of `across * along` modules.
    """
    poses = [
        _link_H_module(u, v, turned=turned, radius_m=radius_m) for u, v, turned in _tiling(across=across, along=along)
    ]
    pads = np.array([placed_pads(pose) for pose in poses])
    positions = pads[:, MODULE_TAXELS].reshape(-1, 3)
    normals = positions * [1.0, 1.0, 0.0]
    numbers = np.arange(len(poses))
    return PatchDescription(
        source="patch.txt",
        name="patch",
        frame="shank",
        columns=len(poses) * MODULE_COLUMNS,
        lines=_columns(numbers, MODULE_TAXELS) + HEAD_LINES + 1,
        taxels=_columns(numbers, MODULE_TAXELS),
        modules=np.repeat(numbers, len(MODULE_TAXELS)),
        positions=positions,
        normals=normals / np.linalg.norm(normals, axis=1, keepdims=True),
        thermal_pads=_columns(numbers, MODULE_THERMAL),
        thermal_modules=np.repeat(numbers, len(MODULE_THERMAL)),
        representatives=_representatives(len(poses)),
    )


def _tiling(*, across: int, along: int) -> list[tuple[float, float, bool]]:
    """Centres of triangles that share sides, and which are turned by 180 degrees."""
    height = PITCH_M * np.sqrt(3.0) / 2.0
    return [
        (PITCH_M / 2.0 * k, height * row + (height / 3.0 if turned else 0.0), bool(turned))
        for row in range(along)
        for k in range(across)
        for turned in [(row + k) % 2]
    ]


def _link_H_module(u: float, v: float, *, turned: bool, radius_m: float) -> FloatArray:
    angle, sign = u / radius_m, -1.0 if turned else 1.0
    out = np.array([np.cos(angle), np.sin(angle), 0.0])
    around = np.array([-np.sin(angle), np.cos(angle), 0.0])
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([sign * around, [0.0, 0.0, sign], out])
    pose[:3, 3] = radius_m * out + [0.0, 0.0, v]
    return pose


def _columns(modules: np.ndarray, pads: np.ndarray) -> np.ndarray:
    return (modules[:, None] * MODULE_COLUMNS + pads).ravel()


def _representatives(modules: int) -> np.ndarray:
    entries = np.repeat(np.arange(modules) * MODULE_COLUMNS + 3, MODULE_COLUMNS)
    entries[_columns(np.arange(modules), MODULE_THERMAL)] = -2
    return entries


def position_text(patch: PatchDescription, *, digits: int = 6) -> str:
    """Write a patch as position files of iCub are.

    Args:
        patch: Patch with normals and `taxel2Repr`.
        digits: Digits behind the point.

    Returns:
        The text.
    """
    assert patch.normals is not None
    assert patch.representatives is not None
    rows = np.zeros((patch.columns, 6))
    rows[patch.taxels] = np.hstack([patch.positions, patch.normals])
    entries = " ".join(map(str, patch.representatives))
    lines = [" ".join(f"{number:.{digits}f}" for number in row) for row in rows]
    head = [f"name\t{patch.frame}", "spatial_sampling\ttaxel", f"taxel2Repr ( {entries} )", "[calibration]"]
    return "\n".join([*head, *lines]) + "\n"


def collapsed(patch: PatchDescription, module: int) -> PatchDescription:
    """The patch with all taxels of a module at its centre.

    Args:
        patch: Sound patch.
        module: Module.

    Returns:
        A patch with one defect.
    """
    positions = patch.positions.copy()
    positions[patch.modules == module] = positions[patch.modules == module].mean(axis=0)
    return replace(patch, positions=positions)
