# SPDX-License-Identifier: BSD-3-Clause
"""Sensors and methods compared on one motion, under loads that none was fitted on."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.contests.command import contest as contest
    from forcetorque.contests.entries import read_entries as read_entries

CAPABILITY = Capability(
    page="contests.md",
    needs=(
        "sensor",
        "calibration",
        "workbench",
    ),
    commands=("forcetorque.contests.command:contest",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    contest="forcetorque.contests.command",
    read_entries="forcetorque.contests.entries",
)
