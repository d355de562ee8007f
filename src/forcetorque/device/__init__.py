# SPDX-License-Identifier: BSD-3-Clause
"""A calibration device (thesis 6.2 to 6.5): parts, motion, excitation, demands, and simulated recordings."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.device.design import design_device as design_device
    from forcetorque.device.simulated_recordings import write_device as write_device

CAPABILITY = Capability(
    page="device/device.md",
    needs=(
        "simulation",
        "calibration",
        "planning",
        "workbench",
    ),
    commands=("forcetorque.device.command:device",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    design_device="forcetorque.device.design",
    write_device="forcetorque.device.simulated_recordings",
)
