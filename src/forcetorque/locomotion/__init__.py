# SPDX-License-Identifier: BSD-3-Clause
"""Standing and moving robots: balance, coherence of contact forces, oscillations, torque control."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.locomotion.commands import (
        balance as balance,
        coherence as coherence,
        oscillation_causes as oscillation_causes,
        torque_loop as torque_loop,
    )
    from forcetorque.locomotion.logged_signals import (
        motion_signals as motion_signals,
        motion_signals_of_arrays as motion_signals_of_arrays,
    )
    from forcetorque.locomotion.motion_quality import motion as motion
    from forcetorque.locomotion.standing.foot_wrenches import load_foot_forces as load_foot_forces
    from forcetorque.locomotion.torque_control.file import read_torque_loop as read_torque_loop

CAPABILITY = Capability(
    page="locomotion/balance.md",
    needs=(
        "sensor",
        "simulation",
        "estimation",
        "calibration",
    ),
    commands=(
        "forcetorque.locomotion.commands:balance",
        "forcetorque.locomotion.commands:coherence",
        "forcetorque.locomotion.commands:motion",
        "forcetorque.locomotion.commands:torque_loop",
        "forcetorque.locomotion.commands:oscillation_causes",
    ),
    sections=("forcetorque.locomotion.section:SOLES",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    balance="forcetorque.locomotion.commands",
    coherence="forcetorque.locomotion.commands",
    load_foot_forces="forcetorque.locomotion.standing.foot_wrenches",
    motion="forcetorque.locomotion.motion_quality",
    motion_signals="forcetorque.locomotion.logged_signals",
    motion_signals_of_arrays="forcetorque.locomotion.logged_signals",
    oscillation_causes="forcetorque.locomotion.commands",
    read_torque_loop="forcetorque.locomotion.torque_control.file",
    torque_loop="forcetorque.locomotion.commands",
)
