# SPDX-License-Identifier: BSD-3-Clause
"""The sign rule of force-torque sensors, written once.

`S` is the wrench that the inboard part (towards the root of the traversal) exerts on the outboard
part: the sum of the net wrenches of the outboard links. A sensor whose reading is the wrench of the
child on the parent reads `-S` where the child is outboard: a hanging limb reads (0, 0, -m g) in
world axes. Rooting the tree on the other side of the sensor swaps inboard and outboard.
"""

from __future__ import annotations

from enum import StrEnum


class MeasureDirection(StrEnum):
    """Who acts on whom in the reading of a sensor, in the words of URDF and SDF."""

    CHILD_TO_PARENT = "child_to_parent"
    """The reading is the wrench that the child link applies on the parent link."""
    PARENT_TO_CHILD = "parent_to_child"
    """The reading is the wrench that the parent link applies on the child link."""


def reading_sign(direction: MeasureDirection, *, child_is_outboard: bool) -> float:
    """Give the sign that turns S (inboard on outboard) into a sensor's reading.

    Args:
        direction: Who acts on whom in the reading.
        child_is_outboard: Whether the sensor's child link is on the far side from the root.

    Returns:
        +1.0 or -1.0.
    """
    outboard_is_acted_on = (MeasureDirection(direction) is MeasureDirection.PARENT_TO_CHILD) == child_is_outboard
    return 1.0 if outboard_is_acted_on else -1.0
