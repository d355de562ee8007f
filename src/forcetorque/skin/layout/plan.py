# SPDX-License-Identifier: BSD-3-Clause
"""From the centres of modules to their poses: how the plan of a patch is bent over its link.

The plan says where modules are beside each other and how each is turned, on paper; the centres say where they are.
About every module the way from paper to link is taken as a quadratic, fitted to the centres of its neighbours: its
derivative gives the plane of the module and the directions of the plan's axes in it. Where a piece of the plan is drawn
as seen from behind, its modules are marked as mirrored. On the link every board is the same, so that its handedness
tells which side is out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import SkinError
from forcetorque.base.pose import make_pose

_FARTHEST_M: Final = 0.05
"""Distance of centres that are neighbours, on paper and on the link; m: three modules."""
_REACH_M: Final = 0.02
"""Standard deviation of their weights; m."""
_STRETCH: Final = 1.3
"""Greatest ratio of a distance on the link to that on paper, or the reverse; beyond it a cut of the plan is between."""
_ROUNDING_M: Final = 0.002
"""What the whole millimetres of plans add to it; m."""
_STIFFNESS_M: Final = 0.003
"""Weight of no curvature; m: few neighbours do not tell how the surface bends."""


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
        SkinError: If a module has no two neighbours that tell how it lies.
    """
    paper = np.array([(module.u_m, module.v_m) for module in plan])
    mirrored = np.array([module.mirrored for module in plan])
    return np.array(
        [
            _pose(module, centres[k], _axes(module, paper - paper[k], centres - centres[k], mirrored))
            for k, module in enumerate(plan)
        ]
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
