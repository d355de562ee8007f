# SPDX-License-Identifier: BSD-3-Clause
"""What the figures of acceptance and validation say above is what their answers say."""

from __future__ import annotations

from typing import Literal

import pytest
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError
from forcetorque.evaluation.acceptance.answers import acceptance_answers
from forcetorque.evaluation.acceptance.criteria import Bound
from forcetorque.evaluation.figures.acceptance_and_contact_forces import acceptance_figure, validation_figure
from forcetorque.evaluation.validation.answers import validation_answers
from forcetorque.experiment.validation_offset import Offset
from tests.evaluation.figures.drawn_figures import acceptance_of, contact_force, criterion_of, validation_of


def _headline(figure: Figure) -> str:
    return figure.get_suptitle().replace("\n", " ")


@pytest.mark.parametrize(("first", "second"), [(300.0, 7500.0), (7500.0, 300.0), (-1.0, 300.0)])
def test_the_farthest_criterion_is_that_of_the_answer(first: float, second: float) -> None:
    """Also where both are far beyond what the axis shows; a lower bound that a negative number misses is farthest."""
    bound = Bound.AT_LEAST if first < 0.0 else Bound.AT_MOST
    acceptance = acceptance_of(criterion_of("first", first, 1.5, bound=bound), criterion_of("second", second, 1.5))
    farthest = "second" if second > first > 0.0 else "first"
    assert f"farthest off: {farthest}" in _headline(acceptance_figure(acceptance))
    (answer,) = acceptance_answers(acceptance)
    assert f"farthest from its limit: {farthest}" in answer.why[0]


@pytest.mark.parametrize(
    ("conclusion", "verdict"),
    [
        ("better", "BEST: new.json"),
        ("no difference", "NONE IS BEST: NO DIFFERENCE"),
        ("inconclusive", "NONE IS BEST: TOO LITTLE DATA"),
    ],
)
def test_a_validation_says_who_is_best_of_the_worst_sensor(
    conclusion: Literal["better", "no difference", "inconclusive"], verdict: str
) -> None:
    """By the verdict, offset and number of the answer, not by the least number of all."""
    forces = [
        contact_force(name, offset, size * factor, sensor=sensor)
        for sensor, size in (("sound", 1.0), ("bad", 20.0))
        for name, factor in (("prior", 2.0), ("new.json", 1.0))
        for offset, size in ((Offset.FIRST_SECOND, 0.5 * size), (Offset.FITTED, size))
    ]
    validation = validation_of(forces, conclusion)
    words = _headline(validation_figure(validation))
    assert words.startswith(f"bad, worst of 2 sensors: {verdict}; ")
    assert words.endswith("fitted offset: new.json 20.00 N (95 %: ±0.3 N)")
    assert [answer.verdict for answer in validation_answers(validation)] == [verdict] * 2


def test_a_single_candidate_is_not_compared() -> None:
    """Its contact force is all; without any there is no figure."""
    validation = validation_of([contact_force("prior", Offset.FIRST_SECOND, 5.0, sensor="leg")], None)
    assert _headline(validation_figure(validation)).startswith(
        "leg: contact force where nothing touches, first-second offset: prior 5.00 N"
    )
    with pytest.raises(ShapeError, match="contact forces"):
        validation_figure(validation_of([], None))
