# SPDX-License-Identifier: BSD-3-Clause
"""What a motion does: whether it swings, how long it takes to settle, how far it is from what was wanted."""

from forcetorque.evaluation.oscillation.evened import EvenedSignal, evened
from forcetorque.evaluation.oscillation.oscillation import Oscillation
from forcetorque.evaluation.oscillation.search import OscillationSearch, find_oscillations
from forcetorque.evaluation.oscillation.settling import Settling, command_steps, settlings
from forcetorque.evaluation.oscillation.tracking import TrackingError, tracking_error

__all__ = [
    "EvenedSignal",
    "Oscillation",
    "OscillationSearch",
    "Settling",
    "TrackingError",
    "command_steps",
    "evened",
    "find_oscillations",
    "settlings",
    "tracking_error",
]
