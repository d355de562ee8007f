# SPDX-License-Identifier: BSD-3-Clause
"""Estimation types of the thesis, lambdas and data sets compared, and the best of them (thesis 5.3)."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.study.result import Studies
    from forcetorque.study.study import study_sensor
    from forcetorque.study.study_data import read_study_data

CAPABILITY = Capability(
    page="study.md",
    needs=(
        "simulation",
        "estimation",
        "inspection",
        "calibration",
        "evaluation",
    ),
    commands=("forcetorque.study.command:study",),
)

__all__ = [
    "Studies",
    "read_study_data",
    "study_sensor",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Studies": "forcetorque.study.result",
        "read_study_data": "forcetorque.study.study_data",
        "study_sensor": "forcetorque.study.study",
    },
)
