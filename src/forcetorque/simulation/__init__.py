# SPDX-License-Identifier: BSD-3-Clause
"""Robots, motions and sensors with known truth, for users as much as for tests."""

from forcetorque.results.capability import Capability

CAPABILITY = Capability(
    page="simulation.md",
    needs=("sensor",),
    commands=("forcetorque.simulation.commands:simulate",),
)
