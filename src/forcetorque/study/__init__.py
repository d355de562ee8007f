# SPDX-License-Identifier: BSD-3-Clause
"""Studies of the thesis: estimation types, lambdas and data sets compared (5.3), and torques by skin (7.3)."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.study.command import study_skin as study_skin
    from forcetorque.study.result import Studies as Studies
    from forcetorque.study.study import study_sensor as study_sensor
    from forcetorque.study.study_data import read_study_data as read_study_data

CAPABILITY = Capability(
    page="study.md",
    needs=(
        "simulation",
        "skin",
        "estimation",
        "inspection",
        "calibration",
        "evaluation",
    ),
    commands=("forcetorque.study.command:study", "forcetorque.study.command:study_skin"),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    Studies="forcetorque.study.result",
    read_study_data="forcetorque.study.study_data",
    study_sensor="forcetorque.study.study",
    study_skin="forcetorque.study.command",
)
