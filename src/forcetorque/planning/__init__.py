# SPDX-License-Identifier: BSD-3-Clause
"""What to record next: recordings, postures and motions that lower the error at the loads to come."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.planning.joint_calibration_plan import plan_jointly as plan_jointly
    from forcetorque.planning.planning import plan as plan
    from forcetorque.planning.trajectory_files import write_plan as write_plan

CAPABILITY = Capability(
    page="planning.md",
    needs=(
        "simulation",
        "calibration",
        "evaluation",
    ),
    commands=("forcetorque.planning.command:plan",),
    sections=("forcetorque.planning.section:PLAN",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    plan="forcetorque.planning.planning",
    plan_jointly="forcetorque.planning.joint_calibration_plan",
    write_plan="forcetorque.planning.trajectory_files",
)
