# SPDX-License-Identifier: BSD-3-Clause
"""Loads on a sensor or on the robot: identified from measurements, given to robots, and zeroed without being lost."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.payload.export.export import export_load as export_load, robot_load as robot_load
    from forcetorque.payload.identify import weigh_load as weigh_load
    from forcetorque.payload.tare_offset import tare as tare

CAPABILITY = Capability(
    page="payload/payload.md",
    needs=("inspection",),
    commands=(
        "forcetorque.payload.commands:payload",
        "forcetorque.payload.commands:tare",
    ),
    sections=("forcetorque.payload.section:LOAD",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    export_load="forcetorque.payload.export.export",
    robot_load="forcetorque.payload.export.export",
    tare="forcetorque.payload.tare_offset",
    weigh_load="forcetorque.payload.identify",
)
