# SPDX-License-Identifier: BSD-3-Clause
"""What recordings to come would teach of a sensor, and which of them to make: optimal design for the loads of a use."""

from forcetorque.evaluation.planning.before import ASSUMED_DRIFT, ASSUMED_NOISE, unfitted_posterior
from forcetorque.evaluation.planning.criterion import Criterion
from forcetorque.evaluation.planning.lesson import Knowledge, Lesson, Nuisance
from forcetorque.evaluation.planning.picking import Choices, pick

__all__ = [
    "ASSUMED_DRIFT",
    "ASSUMED_NOISE",
    "Choices",
    "Criterion",
    "Knowledge",
    "Lesson",
    "Nuisance",
    "pick",
    "unfitted_posterior",
]
