# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor with its mounting does to fast forces, and a filter that undoes it."""

from forcetorque.evaluation.response.even import EvenRecord, even_record, refuse_clipped
from forcetorque.evaluation.response.events import Event, find_events
from forcetorque.evaluation.response.excitation import ExcitationKind
from forcetorque.evaluation.response.frequency_response import (
    FrequencyResponse,
    frequency_response,
    overlapping,
    require_coherence,
)
from forcetorque.evaluation.response.inverse_filter import InverseFilter, inverse_filter
from forcetorque.evaluation.response.jackknife import jackknifed
from forcetorque.evaluation.response.pooled import Pooled, pool
from forcetorque.evaluation.response.released_weight import gains, step_direction
from forcetorque.evaluation.response.ring_down import RingDown, ring_downs
from forcetorque.evaluation.response.second_order import SecondOrder

__all__ = [
    "EvenRecord",
    "Event",
    "ExcitationKind",
    "FrequencyResponse",
    "InverseFilter",
    "Pooled",
    "RingDown",
    "SecondOrder",
    "even_record",
    "find_events",
    "frequency_response",
    "gains",
    "inverse_filter",
    "jackknifed",
    "overlapping",
    "pool",
    "refuse_clipped",
    "require_coherence",
    "ring_downs",
    "step_direction",
]
