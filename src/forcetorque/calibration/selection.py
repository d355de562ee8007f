# SPDX-License-Identifier: BSD-3-Clause
"""How the lambda of a fit was chosen."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, PlainSerializer, WithJsonSchema

from forcetorque.calibration.provenance import FittedInterval
from forcetorque.part import Part


def _lambda_from_file(value: Any) -> Any:
    return math.inf if value == "infinite" else value


Lambda = Annotated[
    float,
    BeforeValidator(_lambda_from_file),
    Field(ge=0.0),
    PlainSerializer(lambda value: "infinite" if math.isinf(value) else value, return_type=float | str),
    WithJsonSchema({"anyOf": [{"type": "number", "minimum": 0}, {"const": "infinite"}]}),
]
"""Lambda in counts2; `infinite`, which JSON has no number for, means that the prior was kept."""


class Selection(Part):
    """How lambda came about."""

    rule: str
    """The rule, in words; `given` where the caller chose."""
    lambda_counts2: tuple[Lambda, ...] = ()
    """Candidates."""
    held_out_rmse: tuple[float, ...] = ()
    """Held-out error of every candidate; 1 N counted like 1 N m."""
    worst_ratio_to_prior: tuple[float, ...] = ()
    """Largest ratio over the blocks of held-out squared error to that of the prior."""
    chosen_on: tuple[FittedInterval, ...] = ()
    """Intervals that were not fitted but that the choice was made on: a verdict on them flatters."""
