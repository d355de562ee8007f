# SPDX-License-Identifier: BSD-3-Clause
"""What to record next: recordings, postures and motions that lower the error at the loads to come."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.planning.files import write_plan
    from forcetorque.planning.joint import plan_jointly
    from forcetorque.planning.planning import plan

CAPABILITY = Capability(
    needs=(
        "simulation",
        "calibration",
        "evaluation",
    ),
    commands=("forcetorque.planning.command:plan",),
    sections=("forcetorque.planning.section:PLAN",),
)

__all__ = [
    "CAPABILITY",
    "plan",
    "plan_jointly",
    "write_plan",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "plan": "forcetorque.planning.planning",
        "plan_jointly": "forcetorque.planning.joint",
        "write_plan": "forcetorque.planning.files",
    },
)
