# SPDX-License-Identifier: BSD-3-Clause
"""Corrected wrenches while the robot runs: a monitor of what a calibration gives, sample by sample."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.live.bias_tracking_and_tare import Tracking as Tracking
    from forcetorque.live.corrector import (
        Corrected as Corrected,
        Corrector as Corrector,
        CorrectorOptions as CorrectorOptions,
    )
    from forcetorque.live.gravity_and_tool_weight import Tool as Tool
    from forcetorque.live.option_values import FaultPolicy as FaultPolicy, OffsetSource as OffsetSource
    from forcetorque.live.sample_status import Status as Status

CAPABILITY = Capability(
    page="live.md",
    needs=("calibration", "payload"),
    commands=("forcetorque.live.commands:live",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    Corrected="forcetorque.live.corrector",
    Corrector="forcetorque.live.corrector",
    CorrectorOptions="forcetorque.live.corrector",
    FaultPolicy="forcetorque.live.option_values",
    OffsetSource="forcetorque.live.option_values",
    Status="forcetorque.live.sample_status",
    Tool="forcetorque.live.gravity_and_tool_weight",
    Tracking="forcetorque.live.bias_tracking_and_tare",
)
