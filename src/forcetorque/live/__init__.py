# SPDX-License-Identifier: BSD-3-Clause
"""Corrected wrenches while the robot runs: a monitor of what a calibration gives, sample by sample."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.live.bias_tracking import Tracking
    from forcetorque.live.choices import FaultPolicy, OffsetSource
    from forcetorque.live.corrector import Corrected, Corrector, CorrectorOptions
    from forcetorque.live.sample_status import Status
    from forcetorque.live.tool import Tool

CAPABILITY = Capability(
    page="live.md",
    needs=("calibration", "payload"),
    commands=("forcetorque.live.command:live",),
)

__all__ = [
    "Corrected",
    "Corrector",
    "CorrectorOptions",
    "FaultPolicy",
    "OffsetSource",
    "Status",
    "Tool",
    "Tracking",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Corrected": "forcetorque.live.corrector",
        "Corrector": "forcetorque.live.corrector",
        "CorrectorOptions": "forcetorque.live.corrector",
        "FaultPolicy": "forcetorque.live.choices",
        "OffsetSource": "forcetorque.live.choices",
        "Status": "forcetorque.live.sample_status",
        "Tool": "forcetorque.live.tool",
        "Tracking": "forcetorque.live.bias_tracking",
    },
)
