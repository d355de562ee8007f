# SPDX-License-Identifier: BSD-3-Clause
"""Advice is about the quantity that exceeds what is allowed most, and about what adds most to its error."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from forcetorque.evaluation.load_cases.predicted_error import ErrorMagnitude, ErrorSource, PredictedError
from forcetorque.evaluation.load_cases.verdict import (
    ADVICE_BY_SOURCE,
    LoadCaseAssessment,
    error_reduction_advice,
    largest_source,
)


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


@pytest.mark.parametrize(("error_N", "is_unmeasured"), [(2.7, True), (2.9, False)])
def test_an_error_is_of_the_loads_that_are_not_measured_if_half_of_its_square_is(
    error_N: float, is_unmeasured: bool
) -> None:
    """10 N m about x that nothing measures add 2 N along y: 4 of 7.3 or of 8.4 N^2, and nothing to the moment."""
    cross_talk = np.zeros((6, 6))
    cross_talk[1, 3] = 0.2
    loads = np.zeros((50, 6))
    loads[:, 3] = np.tile([10.0, -10.0], 25)
    assessment = cast("LoadCaseAssessment", SimpleNamespace(posterior=SimpleNamespace(cross_talk=cross_talk)))
    assert LoadCaseAssessment._is_unmeasured(assessment, loads, slice(3), error_N) == is_unmeasured
    assert not LoadCaseAssessment._is_unmeasured(assessment, loads, slice(3, 6), 0.1)
    unknown = cast("LoadCaseAssessment", SimpleNamespace(posterior=None))
    assert not LoadCaseAssessment._is_unmeasured(unknown, loads, slice(3), 0.1)
