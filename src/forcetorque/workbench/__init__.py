# SPDX-License-Identifier: BSD-3-Clause
"""The workbench: known loads on a sensor, its matrix, held-out errors, and faults of the bench."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.workbench.calibrate import workbench as workbench
    from forcetorque.workbench.recording import read_bench as read_bench

CAPABILITY = Capability(
    page="workbench.md",
    needs=(
        "simulation",
        "inspection",
        "calibration",
        "evaluation",
    ),
    commands=("forcetorque.workbench.command:workbench",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    read_bench="forcetorque.workbench.recording",
    workbench="forcetorque.workbench.calibrate",
)
