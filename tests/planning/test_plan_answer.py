# SPDX-License-Identifier: BSD-3-Clause
"""The answer of a plan: what to record and what it brings, or that nothing helps, in the first line."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.planning.result import helps
from forcetorque.results.answer import Concern
from tests.planning.plans import plan_of, planned_recording


def test_errors_before_and_after_are_the_reason() -> None:
    """With the bound of what they fall to, and what all recordings come to."""
    (answer,) = plan_of(planned_recording(1, 2.0, 0.1), planned_recording(2, 1.0, 0.05), folder="next").answers()
    assert (answer.subject, answer.verdict) == ("arm_ft (SIM001), push", "RECORD 5 POSTURES IN 20 s")
    assert answer.why == (
        "predicted force error falls from 4 N to 2 N (95 %: 3 N), moment error from 0.2 N m to 0.1 N m "
        "(95 %: 0.15 N m); held at base, tool: none",
        "after all 2 recordings: 1 N (95 %: 1.5 N) of 1 N allowed, 0.05 N m (95 %: 0.075 N m) of 0.1 N m allowed",
    )
    assert (answer.written, answer.concern) == (("next", None), Concern.NONE)


@pytest.mark.parametrize(("force", "moment"), [(1.1, 0.05), (0.9, 0.11)])
def test_recordings_that_leave_more_than_allowed_are_not_enough(force: float, moment: float) -> None:
    """Force or moment; what else to do is said."""
    (answer,) = plan_of(planned_recording(1, 2.0, 0.1), planned_recording(2, force, moment)).answers()
    assert (answer.verdict, answer.concern) == ("RECORD 5 POSTURES IN 20 s, NOT ENOUGH", Concern.UNCERTAIN)
    assert "motion alone does not do it: hang a load on it" in answer.why[1]


def test_that_nothing_helps_is_the_verdict() -> None:
    """No step follows."""
    plan = plan_of(planned_recording(1, 3.999, 0.1999))
    (answer,) = plan.answers()
    assert (answer.verdict, answer.concern) == ("NOTHING HELPS", Concern.BAD)
    assert (answer.why, answer.step, answer.command) == ((plan.advice,), "", "")


@pytest.mark.parametrize(("limits", "expected"), [({}, True), ({"moment": np.inf}, False)])
def test_what_is_not_limited_does_not_help(limits: dict[str, float], expected: bool) -> None:
    """A moment error that falls, where only the force is limited."""
    assert helps(planned_recording(1, 3.999, 0.1, **limits)) == expected


def test_the_figure_has_typical_errors_what_they_are_at_most_and_what_is_allowed() -> None:
    """Before, and after each recording; no limit where none is stated, and on paper what the message says."""
    figure = plan_of(
        planned_recording(1, 2.0, 0.1, moment=np.inf), planned_recording(2, 1.0, 0.05, moment=np.inf)
    ).figure()
    force, moment = figure.axes
    assert [list(line.get_ydata()) for line in force.lines] == [[4.0, 2.0, 1.0], [1.0, 1.0]]
    assert [list(line.get_ydata()) for line in moment.lines] == [[0.2, 0.1, 0.05]]
    (spans,) = moment.collections
    np.testing.assert_allclose([end[1] for _, end in spans.get_segments()], [0.3, 0.15, 0.075])
    assert figure.get_suptitle() == ("arm_ft (SIM001), push: predicted force error 4 N now, 1 N after 2 recordings")
