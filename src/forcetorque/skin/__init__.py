# SPDX-License-Identifier: BSD-3-Clause
"""Artificial skin: where its taxels are, the surface that they lie on, and what they say about contacts."""

from forcetorque.skin.layout import SAME_PLACE_M, UNIT_TOLERANCE, SkinLayout

__all__ = ["SAME_PLACE_M", "UNIT_TOLERANCE", "SkinLayout"]
