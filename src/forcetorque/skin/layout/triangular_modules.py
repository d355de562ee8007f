# SPDX-License-Identifier: BSD-3-Clause
"""The triangular module of ten taxels, patches made of modules, and poses of modules from a plan.

A plan says where modules are beside each other and how each is turned, on paper; the centres say where they are.
About every module the way from paper to link is taken as a quadratic, fitted to the centres of its neighbours: its
derivative gives the plane of the module and the directions of the plan's axes in it. Where a piece of the plan is drawn
as seen from behind, its modules are marked as mirrored. On the link every board is the same, so that its handedness
determines which side is out.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, read_only, read_only_integers
from forcetorque.base.errors import SkinError
from forcetorque.base.pose import make_pose, split_pose
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
    """Check whether a patch consists of triangular modules, which have twelve columns each.

    Args:
        taxels: Column of each taxel; shape (n,).
        modules: Module of each; shape (n,).

    Returns:
        Whether it is.
    """
    return bool((modules == taxels // MODULE_COLUMNS).all())


def has_ten(taxels: IntArray) -> bool:
    """Check whether a module has the ten taxels of the triangle.

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


_FARTHEST_M: Final = 0.05
"""Distance of centres that are neighbours, on paper and on the link; m: three modules."""
_BESIDE: Final = 1.3
"""Modules are drawn beside one if they are at most so much farther than the nearest."""
_REACH_M: Final = 0.02
"""Standard deviation of their weights; m."""
_STRETCH: Final = 1.3
"""Greatest ratio of a distance on the link to that on paper, or the reverse; beyond it a cut of the plan is between."""
_ROUNDING_M: Final = 0.002
"""What the whole millimetres of plans add to it; m."""
_STIFFNESS_M: Final = 0.003
"""Weight of no curvature; m: few neighbours do not show how the surface bends."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedModule:
    """A module as the plan of a patch has it."""

    number: int
    """Module."""
    u_m: float
    """First coordinate of its centre on paper; m."""
    v_m: float
    """Second coordinate; m."""
    angle_rad: float
    """By how much it is turned, from the first axis to the second; rad."""
    mirrored: bool
    """Whether it is drawn as seen from behind."""
    line: int = 0
    """Line of the file that states it, from 1; 0 for none."""


def module_poses(plan: Sequence[PlannedModule], centres: FloatArray) -> FloatArray:
    """Find how modules lie on their link.

    Args:
        plan: Modules.
        centres: Where their centres (taxel 3) are in the link; shape (k, 3); m.

    Returns:
        Pose of each module in the link, z outwards; shape (k, 4, 4); m.

    Raises:
        SkinError: If a module has no two neighbours that show how it lies, or none of those that are drawn next to it
            is near it on the link.
    """
    paper = np.array([(module.u_m, module.v_m) for module in plan])
    mirrored = np.array([module.mirrored for module in plan])
    for k, module in enumerate(plan):
        _require_place(module, plan, paper - paper[k], centres - centres[k])
    return np.array(
        [
            _pose(module, centres[k], _axes(module, paper - paper[k], centres - centres[k], mirrored))
            for k, module in enumerate(plan)
        ]
    )


def _require_place(module: PlannedModule, plan: Sequence[PlannedModule], paper: FloatArray, link: FloatArray) -> None:
    """Refuse a module whose neighbours on the plan are all elsewhere on the link."""
    drawn = np.linalg.norm(paper, axis=1)
    others = drawn > 0.0
    if not others.any():
        return
    beside = others & (drawn < _BESIDE * drawn[others].min()) & (drawn < _FARTHEST_M)
    joined = _neighbours(paper, link)
    if beside.sum() > 1 and joined.any() and not joined[beside].any():
        names = ", ".join(str(other.number) for other, drawn_beside in zip(plan, beside, strict=True) if drawn_beside)
        nearest_mm = 1e3 * np.linalg.norm(link[beside], axis=1).min()
        raise SkinError(
            f"module {module.number}: expected the modules that the plan draws {1e3 * drawn[beside].min():.1f} mm from "
            f"it, {names}, to be near it on the link, got {nearest_mm:.1f} mm or more; does a frame have the number of "
            "another module?"
        )


def _axes(module: PlannedModule, paper: FloatArray, link: FloatArray, mirrored: BoolArray) -> FloatArray:
    """Unit vectors in the link along the axes of the plan, at a module; shape (2, 3)."""
    near = _neighbours(paper, link) & (mirrored == module.mirrored)
    offsets, root = paper[near], np.exp(-0.25 * (np.linalg.norm(link[near], axis=1) / _REACH_M) ** 2)[:, None]
    u, v = offsets.T / _REACH_M
    terms = np.vstack([root * np.column_stack([u, v, u**2, u * v, v**2]), np.zeros((3, 5))])
    terms[-3:, 2:] = _STIFFNESS_M / _REACH_M * np.eye(3)
    wanted = np.vstack([root * link[near], np.zeros((3, 3))])
    if np.linalg.matrix_rank(offsets, tol=_ROUNDING_M) < 2:
        raise SkinError(
            f"module {module.number}: expected at least two neighbours within {1e3 * _FARTHEST_M:g} mm, not in a line "
            f"with it, that the plan and the centres of modules agree on, got {np.count_nonzero(near)}; give its frame "
            "axes of its own"
        )
    left, _, right = np.linalg.svd(np.linalg.lstsq(terms, wanted, rcond=None)[0][:2], full_matrices=False)
    return left @ right


def _neighbours(paper: FloatArray, link: FloatArray) -> BoolArray:
    """Modules about the one at the origin that are as far on paper as on the link; it is none itself."""
    drawn, real = np.linalg.norm(paper, axis=1), np.linalg.norm(link, axis=1)
    joined = (real < _STRETCH * drawn + _ROUNDING_M) & (drawn < _STRETCH * real + _ROUNDING_M)
    return joined & (drawn > 0.0) & (np.maximum(drawn, real) < _FARTHEST_M)


def _pose(module: PlannedModule, centre: FloatArray, axes: FloatArray) -> FloatArray:
    cosine, sine = np.cos(module.angle_rad), np.sin(module.angle_rad)
    x, y = np.array([[cosine, sine], [-sine, cosine]]) @ axes
    if module.mirrored:
        x = -x
    return make_pose(np.column_stack([x, y, np.cross(x, y)]), centre)


def placed_on_paper(plan: Sequence[PlannedModule]) -> FloatArray:
    """Give the poses of modules in the plane of their plan.

    Args:
        plan: Modules.

    Returns:
        Pose of each, z towards the reader, or away where it is drawn as seen from behind; shape (k, 4, 4); m.
    """
    axes = np.eye(3)[:2]
    return np.array([_pose(module, np.array([module.u_m, module.v_m, 0.0]), axes) for module in plan])
