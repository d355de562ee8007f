# SPDX-License-Identifier: BSD-3-Clause
"""Collisions: contacts beyond a sensor that nobody expected, with threshold, line of action and link."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.collisions.command import joint_collisions as joint_collisions

CAPABILITY = Capability(
    page="locomotion/collisions.md",
    needs=("calibration", "inspection", "locomotion"),
    commands=("forcetorque.collisions.command:collisions", "forcetorque.collisions.command:joint_collisions"),
)

__all__, __getattr__, __dir__ = lazy_names(__name__, joint_collisions="forcetorque.collisions.command")
