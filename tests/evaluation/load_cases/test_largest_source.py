# SPDX-License-Identifier: BSD-3-Clause
"""Advice is about the quantity that exceeds what is allowed most, and about what adds most to its error."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.evaluation.load_cases.predicted_error import ErrorMagnitude, ErrorSource, PredictedError
from forcetorque.evaluation.load_cases.verdict import ADVICE_BY_SOURCE, error_reduction_advice, largest_source


def _magnitude(at_most: float, largest: ErrorSource) -> ErrorMagnitude:
    sources: dict[ErrorSource, float] = dict.fromkeys(ADVICE_BY_SOURCE, 0.1 * at_most)
    return ErrorMagnitude(
        typical=0.5 * at_most,
        at_least=0.2 * at_most,
        at_most=at_most,
        axes=np.full(3, at_most),
        sources=sources | {largest: 0.8 * at_most},
        draws=np.full(4, at_most),
    )


@pytest.mark.parametrize(
    ("allowed", "quantity", "source"),
    [
        ((20.0, 0.5), "moment", "offset"),  # 4 of 20 N, 0.4 of 0.5 N m
        ((5.0, 2.0), "force", "noise"),  # 4 of 5 N, 0.4 of 2 N m
        ((2.0, 0.1), "moment", "offset"),  # twice and four times what is allowed
        ((2.0, np.inf), "force", "noise"),
        ((np.inf, 2.0), "moment", "offset"),
    ],
)
def test_advice_is_about_the_largest_share_of_what_is_allowed(
    allowed: tuple[float, float], quantity: str, source: ErrorSource
) -> None:
    """Newtons and newton metres are compared by what is allowed of each."""
    error = PredictedError(force=_magnitude(4.0, "noise"), moment=_magnitude(0.4, "offset"))
    assert largest_source(error, allowed) == (quantity, source)
    assert (
        error_reduction_advice(error, allowed) == f"Most of the {quantity} error comes from {ADVICE_BY_SOURCE[source]}"
    )
