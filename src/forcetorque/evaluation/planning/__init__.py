# SPDX-License-Identifier: BSD-3-Clause
"""What recordings to come would teach of a sensor, and which of them to make: optimal design for the loads of a use."""

from forcetorque.evaluation.planning.before import (
    ASSUMED_DRIFT,
    ASSUMED_NOISE,
    blank_posterior,
    unfitted_posterior,
)
from forcetorque.evaluation.planning.criterion import HELPS, Aim, Criterion, Volume
from forcetorque.evaluation.planning.lesson import Knowledge, Lesson, Nuisance
from forcetorque.evaluation.planning.picking import Choices, pick
from forcetorque.evaluation.planning.search import picked_orders, search

__all__ = [
    "ASSUMED_DRIFT",
    "ASSUMED_NOISE",
    "HELPS",
    "Aim",
    "Choices",
    "Criterion",
    "Knowledge",
    "Lesson",
    "Nuisance",
    "Volume",
    "blank_posterior",
    "pick",
    "picked_orders",
    "search",
    "unfitted_posterior",
]
