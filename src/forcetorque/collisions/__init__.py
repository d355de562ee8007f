# SPDX-License-Identifier: BSD-3-Clause
"""Collisions: contacts beyond a sensor that nobody expected, with threshold, line of action and link."""

from forcetorque.results.capability import Capability

CAPABILITY = Capability(
    page="locomotion/collisions.md",
    needs=("calibration",),
    commands=("forcetorque.collisions.command:collisions",),
)

__all__: list[str] = []
