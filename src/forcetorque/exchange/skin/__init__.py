# SPDX-License-Identifier: BSD-3-Clause
"""Layouts of skin in others' forms."""

from forcetorque.exchange.skin.formats import LAYOUT_FORMATS, LayoutFormat, describe_patch, read_layout

__all__ = ["LAYOUT_FORMATS", "LayoutFormat", "describe_patch", "read_layout"]
