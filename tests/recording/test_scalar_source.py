# SPDX-License-Identifier: BSD-3-Clause
"""One number per instant out of a recording: its unit, its values over time, its gaps."""

from __future__ import annotations

import re

import numpy as np
import pytest

from forcetorque.base.errors import RecordingError
from forcetorque.recording.named_columns import ScalarSource
from forcetorque.recording.stream import Signal
from tests.recording.recordings import EPOCH_NS, recording, refused, signal, stream

SECOND = 1_000_000_000
TEMPERATURES = [20.0, 30.0, 20.0, 20.0, 40.0]
"""A value that comes back, and one that stays."""


def _at(*seconds: float, values: list[float] = TEMPERATURES, gap_s: int = 0) -> list[float]:
    count = len(values)
    stamps = EPOCH_NS + SECOND * (np.arange(count) + gap_s * (np.arange(count) >= 3))
    held = recording(stream(stamps, signal("temperature", [[v] for v in values]), name="board"))
    source = ScalarSource(stream="board", quantity="temperature", column="temperature")
    return source.at(held, EPOCH_NS + np.rint(SECOND * np.array(seconds)).astype(np.int64)).tolist()


def test_values_are_interpolated_over_time() -> None:
    """By hand: half-way between samples is the mean of the two, also where a value comes back or stays."""
    assert _at(0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0) == [20, 25, 30, 25, 20, 20, 20, 30, 40]


def test_nothing_is_made_up() -> None:
    """Before and after the stream, across a gap and beside a missing value there is no number."""
    assert np.isnan(_at(-0.1, 4.1)).all()
    assert np.isnan(_at(2.5, 5.0, gap_s=10)).all()
    assert _at(2.0, 13.0, gap_s=10) == [20.0, 20.0]
    missing = _at(0.5, 1.5, 2.5, 3.5, values=[20.0, float("nan"), 20.0, 20.0, 40.0])
    np.testing.assert_array_equal(missing, [np.nan, np.nan, 20.0, 30.0])


def test_other_columns_have_no_say() -> None:
    """Unit and values are those of the column alone."""
    values = np.column_stack([[1.0, 3.0], [np.nan, np.nan]])
    scalars = Signal(quantity="scalar", values=values, columns=("supply", "current"), units=("V", "mA"))
    held = recording(stream([0, 10], scalars, name="board"))
    supply, current = (ScalarSource(stream="board", quantity="scalar", column=name) for name in scalars.columns)
    assert (supply.unit(held), current.unit(held)) == ("V", "mA")
    assert supply.at(held, np.array([5])).tolist() == [2.0]
    assert np.isnan(current.at(held, np.array([5]))).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"stream": "bord"}, "the recording has no stream 'bord'; did you mean \"board\"? known: board"),
        ({"quantity": "temperature"}, "stream 'board' has no temperature; known: scalar"),
        ({"column": "suply"}, "scalar: no column 'suply'; did you mean \"supply\"? known: current, supply"),
    ],
)
def test_what_is_not_there_is_named(change: dict[str, str], message: str) -> None:
    """With what there is, and the likeliest first."""
    scalars = signal("scalar", np.zeros((2, 2)), ("supply", "current"))
    held = recording(stream([0, 10], scalars, name="board"))
    source = ScalarSource(**{"stream": "board", "quantity": "scalar", "column": "supply", **change})
    with refused(RecordingError, re.escape(message)):
        source.unit(held)
