# SPDX-License-Identifier: BSD-3-Clause
"""Progress: lines with the time left, not more often than stated."""

from __future__ import annotations

import pytest

from forcetorque.base.progress import TimeLeft, duration_text


def _lines(step_s: float, total: int) -> list[str]:
    """What a loop of steps of one duration reports."""
    clock = [0.0]
    said: list[str] = []
    left = TimeLeft(said.append, "reading", total, every_s=3.0, now=lambda: clock[0])
    for done in range(total + 1):
        left.at(done)
        clock[0] += step_s
    return said


def test_the_time_left_is_in_proportion() -> None:
    """Of ten steps of 4 s every step but the last is reported."""
    said = _lines(4.0, 10)
    assert said[0] == "reading: 10 %, 36 s left"
    assert said[-1] == "reading: 90 %, 4 s left"
    assert len(said) == 9


def test_quick_loops_are_silent_and_long_ones_do_not_flood() -> None:
    """Nothing within 3 s, then a line in 3 s."""
    assert _lines(0.001, 1000) == []
    assert len(_lines(0.01, 10_000)) == 33


def test_the_first_steps_predict_no_time() -> None:
    """Below a hundredth of the steps only the share is reported."""
    said = _lines(3.0, 400)
    assert said[:4] == ["reading: 0 %", "reading: 0 %", "reading: 1 %", "reading: 1 %, 20 min left"]


@pytest.mark.parametrize(
    ("seconds", "text"), [(0.2, "1 s"), (89.0, "89 s"), (91.0, "2 min"), (5300.0, "89 min"), (7500.0, "2 h 5 min")]
)
def test_durations_are_rounded_up(seconds: float, text: str) -> None:
    """In the unit that people use."""
    assert duration_text(seconds) == text
