# SPDX-License-Identifier: BSD-3-Clause
"""Artificial skin: where its taxels are and what may be wrong with that, and what they say about contacts."""

from forcetorque.skin.description import PatchDescription
from forcetorque.skin.findings import Defect, LayoutFinding, layout_findings
from forcetorque.skin.layout import SAME_PLACE_M, UNIT_TOLERANCE, SkinLayout
from forcetorque.skin.modular import LARGEST_MESSAGE, modular_patch
from forcetorque.skin.module import (
    MODULE_CENTRE,
    MODULE_COLUMNS,
    MODULE_PADS,
    MODULE_SIDE_M,
    MODULE_TAXELS,
    MODULE_THERMAL,
    placed_pads,
)
from forcetorque.skin.normals import patch_normals, rebuilt_normals
from forcetorque.skin.patch_calibration import PatchCalibration, read_patch_calibration
from forcetorque.skin.plan import PlannedModule, module_poses, placed_on_paper
from forcetorque.skin.pressure_clock import PressureClock, match_pressure
from forcetorque.skin.pressure_table import PressureTable

__all__ = [
    "LARGEST_MESSAGE",
    "MODULE_CENTRE",
    "MODULE_COLUMNS",
    "MODULE_PADS",
    "MODULE_SIDE_M",
    "MODULE_TAXELS",
    "MODULE_THERMAL",
    "SAME_PLACE_M",
    "UNIT_TOLERANCE",
    "Defect",
    "LayoutFinding",
    "PatchCalibration",
    "PatchDescription",
    "PlannedModule",
    "PressureClock",
    "PressureTable",
    "SkinLayout",
    "layout_findings",
    "match_pressure",
    "modular_patch",
    "module_poses",
    "patch_normals",
    "placed_on_paper",
    "placed_pads",
    "read_patch_calibration",
    "rebuilt_normals",
]
