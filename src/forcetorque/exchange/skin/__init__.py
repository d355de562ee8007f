# SPDX-License-Identifier: BSD-3-Clause
"""Layouts of skin in others' forms."""

from forcetorque.exchange.skin.formats import LAYOUT_FORMATS, LayoutFormat, describe_patch, read_layout
from forcetorque.exchange.skin.layout_table import write_layout_table
from forcetorque.exchange.skin.skin_gui import read_plan
from forcetorque.exchange.skin.urdf_frames import ModuleFrames

__all__ = [
    "LAYOUT_FORMATS",
    "LayoutFormat",
    "ModuleFrames",
    "describe_patch",
    "read_layout",
    "read_plan",
    "write_layout_table",
]
