# SPDX-License-Identifier: BSD-3-Clause
"""Patches of skin with known normals: real modules on a cylinder, sound in all that `skin check` looks at."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.triangular_modules import MODULE_COLUMNS, MODULE_TAXELS, MODULE_THERMAL, placed_pads

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
    _, poses = cylinder_modules(across=across, along=along, radius_m=radius_m)
    return _patch(poses, lambda positions: positions * [1.0, 1.0, 0.0])


def cylinder_modules(
    *, across: int, along: int, radius_m: float = RADIUS_M
) -> tuple[list[tuple[float, float, bool]], list[FloatArray]]:
    """The modules of `cylinder_patch`.

    Args:
        across: Modules of a row.
        along: Rows.
        radius_m: Radius; m.

    Returns:
        Centre on paper (m) and whether it is turned by 180 degrees, and pose in the link, of each.
    """
    tiles = _tiling(across, along)
    return tiles, [_on_cylinder(u, v, turned=turned, radius_m=radius_m) for u, v, turned in tiles]


def ellipsoid_patch(
    *, across: int = 9, along: int = 6, semi_axes_m: tuple[float, float, float] = (0.05, 0.07, 0.15)
) -> PatchDescription:
    """Modules on an ellipsoid about the axes of the link `shank`, with true normals.

    Args:
        across: Modules of a row, which go around its z axis.
        along: Rows.
        semi_axes_m: Semi-axes; m.

    Returns:
        A patch of `across * along` modules about the end of its x axis.
    """
    axes = np.array(semi_axes_m)
    tiles = _tiling(across, along)
    middle = np.mean([tile[:2] for tile in tiles], axis=0)
    poses = [_on_ellipsoid(u - middle[0], v - middle[1], turned=turned, axes=axes) for u, v, turned in tiles]
    return _patch(poses, lambda positions: positions / axes**2)


def _patch(poses: list[FloatArray], gradient: Callable[[FloatArray], FloatArray]) -> PatchDescription:
    """Modules at poses, on a level set of a function with that gradient."""
    positions = np.array([placed_pads(pose)[MODULE_TAXELS] for pose in poses]).reshape(-1, 3)
    normals = gradient(positions)
    numbers = np.arange(len(poses))
    return PatchDescription(
        source="patch.txt",
        name="patch",
        frame="shank",
        columns=len(poses) * MODULE_COLUMNS,
        lines=np.arange(len(poses) * MODULE_COLUMNS) + HEAD_LINES + 1,
        taxels=_columns(numbers, MODULE_TAXELS),
        modules=np.repeat(numbers, len(MODULE_TAXELS)),
        positions=positions,
        normals=normals / np.linalg.norm(normals, axis=1, keepdims=True),
        thermal_pads=_columns(numbers, MODULE_THERMAL),
        thermal_modules=np.repeat(numbers, len(MODULE_THERMAL)),
        representatives=_representatives(len(poses)),
    )


def _tiling(across: int, along: int) -> list[tuple[float, float, bool]]:
    """Centres of triangles that share sides, and which are turned by 180 degrees."""
    height = PITCH_M * np.sqrt(3.0) / 2.0
    return [
        (PITCH_M / 2.0 * k, height * row + (height / 3.0 if turned else 0.0), bool(turned))
        for row in range(along)
        for k in range(across)
        for turned in [(row + k) % 2]
    ]


def _on_cylinder(u: float, v: float, *, turned: bool, radius_m: float) -> FloatArray:
    """Pose of a module that touches a cylinder at the arc u and the height v; m."""
    angle = u / radius_m
    out = np.array([np.cos(angle), np.sin(angle), 0.0])
    return _touching(radius_m * out + [0.0, 0.0, v], out, turned=turned)


def _on_ellipsoid(u: float, v: float, *, turned: bool, axes: FloatArray) -> FloatArray:
    """Pose of a module that touches an ellipsoid at the arc u of its section at the height v; m."""
    angles = np.linspace(-2.0, 2.0, 4001)
    section = np.sqrt(1.0 - (v / axes[2]) ** 2) * axes[:2] * np.column_stack([np.cos(angles), np.sin(angles)])
    arc = np.concatenate([[0.0], np.linalg.norm(np.diff(section, axis=0), axis=1).cumsum()])
    x, y = (np.interp(u, arc - arc[2000], section[:, k]) for k in range(2))
    point = np.array([x, y, v])
    out = point / axes**2
    return _touching(point, out / np.linalg.norm(out), turned=turned)


def _touching(point: FloatArray, out: FloatArray, *, turned: bool) -> FloatArray:
    """Pose of a module at a point: z out, y up or, where it is turned, down."""
    up = np.array([0.0, 0.0, -1.0 if turned else 1.0])
    up -= (up @ out) * out
    up /= np.linalg.norm(up)
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([np.cross(up, out), up, out])
    pose[:3, 3] = point
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


def moved_module(patch: PatchDescription, module: int, shift: FloatArray) -> PatchDescription:
    """The patch with a module elsewhere.

    Args:
        patch: Sound patch.
        module: Module.
        shift: By how much; shape (3,); m.

    Returns:
        A patch with one defect.
    """
    positions = patch.positions + np.outer(patch.modules == module, shift)
    return replace(patch, positions=positions)


def without_modules(patch: PatchDescription, *modules: int) -> PatchDescription:
    """The patch without some modules, whose rows are zero and whose entries say so.

    Args:
        patch: Sound patch.
        modules: Modules.

    Returns:
        What is left, in the same message.
    """
    assert patch.normals is not None
    assert patch.representatives is not None
    left, pads = ~np.isin(patch.modules, modules), ~np.isin(patch.thermal_modules, modules)
    gone = np.isin(np.arange(patch.columns) // MODULE_COLUMNS, modules)
    return replace(
        patch,
        taxels=patch.taxels[left],
        modules=patch.modules[left],
        positions=patch.positions[left],
        normals=patch.normals[left],
        thermal_pads=patch.thermal_pads[pads],
        thermal_modules=patch.thermal_modules[pads],
        representatives=np.where(gone, -1, patch.representatives),
    )
