# SPDX-License-Identifier: BSD-3-Clause
"""How wrenches are told from a patch of skin, as somebody chose, and the patch that does so."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.analysis.skin.frames import FrameChoice
from forcetorque.arrays import FloatArray
from forcetorque.errors import SkinError
from forcetorque.exchange.skin import describe_patch
from forcetorque.skin import SkinLayout, rebuilt_normals
from forcetorque.skin.wrench import SkinPatch, WrenchMethod


@dataclass(frozen=True, kw_only=True)
class WrenchChoice(FrameChoice):
    """How the wrench is told, and of which messages."""

    method: str = WrenchMethod.KRIGING
    """One of `WrenchMethod`."""
    taxel_area_mm2: float | None = None
    """Area of a taxel: the simple method needs it; beside another one it is drawn for comparison."""
    plan: Path | None = None
    """Drawing of the patch, for the method of the thesis."""
    written_normals: bool = False
    """Whether to take the normals that the layout has, and not those of the surface through its taxels."""


def chosen_layout(file: Path, choice: WrenchChoice) -> SkinLayout:
    """Read where the taxels are.

    Args:
        file: File with the layout.
        choice: Whether its normals are taken as they are written.

    Returns:
        The layout.
    """
    described = describe_patch(file)
    normals = None if choice.written_normals else rebuilt_normals(described.positions, described.modules)
    return described.layout(normals)


def chosen_patch(layout: SkinLayout, choice: WrenchChoice) -> SkinPatch:
    """Prepare a patch, with what its method needs.

    Args:
        layout: Where its taxels are.
        choice: Its method.

    Returns:
        The patch.
    """
    if choice.method == WrenchMethod.SIMPLE and choice.taxel_area_mm2 is not None:
        return SkinPatch.of(layout, choice.method, taxel_area_m2=1e-6 * choice.taxel_area_mm2)
    return SkinPatch.of(layout, choice.method, plane=None if choice.plan is None else _places(choice.plan, layout))


def _places(plan: Path, layout: SkinLayout) -> FloatArray:
    """Places of the taxels in a drawing; m."""
    drawn = describe_patch(plan)
    missing = np.setdiff1d(layout.taxels, drawn.taxels)
    if len(missing):
        raise SkinError(
            f"{plan}: expected a drawing of all {len(layout)} taxels of {layout.name!r}, got none of taxel "
            f"{missing[0]} ({len(missing)} such); it is of another patch"
        )
    order = np.argsort(drawn.taxels)
    return drawn.positions[order[np.searchsorted(drawn.taxels, layout.taxels, sorter=order)], :2]
