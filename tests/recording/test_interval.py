# SPDX-License-Identifier: BSD-3-Clause
"""Intervals have a length, a use and a support; the direction of gravity is a unit vector."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import RecordingError, ShapeError
from forcetorque.recording.recording import Interval, Support, Use
from tests.recording.recordings import refused

UNIT = 4 * np.finfo(np.float64).eps
"""A quotient of rounded numbers by a rounded norm: a few units in the last place."""

LEVEL = Support(frame="base", gravity_direction=[0.0, 0.0, -1.0])


def _interval(**change: Any) -> Interval:
    fields = {"label": "i", "start_ns": 10, "end_ns": 20, "use": Use.CALIBRATION, "support": LEVEL}
    return Interval(**fields | change)  # type: ignore[arg-type]


@given(st.lists(st.floats(-1e100, 1e100), min_size=3, max_size=3).filter(lambda v: np.linalg.norm(v) > 1e-100))
@settings(derandomize=True, deadline=None)
def test_directions_are_normalised_once(direction: list[float]) -> None:
    """Any length gives a unit vector along the same line, and a unit vector stays as it is bit by bit."""
    unit = Support(frame="f", gravity_direction=direction).gravity_direction
    assert abs(np.linalg.norm(unit) - 1.0) <= UNIT
    norm = np.linalg.norm(direction)
    np.testing.assert_allclose(unit * norm, direction, rtol=0.0, atol=UNIT * float(norm))
    again = Support(frame="f", gravity_direction=unit).gravity_direction
    assert again.tobytes() == unit.tobytes()


@pytest.mark.parametrize("direction", [[0.0, 0.0, 0.0], [np.nan, 0.0, 1.0], [0.0, np.inf, 0.0]])
def test_what_is_no_direction_is_refused(direction: list[float]) -> None:
    """Zero and numbers that are not finite point nowhere; the frame is named."""
    with refused(RecordingError, "support frame 'f': expected a gravity_direction other than zero"):
        Support(frame="f", gravity_direction=direction)


def test_a_direction_has_three_components() -> None:
    """Another shape is refused."""
    with refused(ShapeError, r"gravity_direction: expected an array of shape \(3\), got \(2,\)"):
        Support(frame="f", gravity_direction=[0.0, 1.0])


@pytest.mark.parametrize("end_ns", [10, 9])
def test_an_interval_ends_after_its_start(end_ns: int) -> None:
    """An empty or reversed span is refused with its length."""
    with refused(RecordingError, "interval 'i': expected an end after its start, got a length of (0|-1e-09) s"):
        _interval(end_ns=end_ns)
    assert _interval(end_ns=11).end_ns == 11


@pytest.mark.parametrize("use", list(Use))
def test_only_ignored_intervals_need_no_support(use: Use) -> None:
    """Samples that are fitted or judged need a support frame."""
    assert _interval(use=use).support is LEVEL
    if use is Use.IGNORE:
        assert _interval(use=use, support=None).support is None
        return
    with refused(RecordingError, f"interval 'i': its use is {use}, which needs a support frame"):
        _interval(use=use, support=None)


def test_the_text_of_a_use_is_the_use() -> None:
    """The text `ignore` ignores, also with a support; a text that is no use is refused with the known ones."""
    assert _interval(use="ignore").use is Use.IGNORE
    with refused(RecordingError, "no use is called 'ignored'; did you mean \"ignore\""):
        _interval(use="ignored")


def test_stamps_are_whole_numbers() -> None:
    """NumPy integers become plain ones, as stamps of a stream are handed on; fractions are refused."""
    interval = _interval(start_ns=np.int64(10), end_ns=np.int64(20))
    assert (type(interval.start_ns), type(interval.end_ns)) == (int, int)
    with refused(RecordingError, r"interval 'i': expected whole nanoseconds, got 10 to 20\.5"):
        _interval(end_ns=20.5)
