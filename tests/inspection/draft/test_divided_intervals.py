# SPDX-License-Identifier: BSD-3-Clause
"""Intervals that are proposed have loads that move, to fit and to validate."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.inspection.draft.intervals_and_clocks import MovingLoad, divided

SECOND_NS = 1_000_000_000


def _load(*, moves_from: float, moves_to: float, columns: int = 3) -> MovingLoad:
    """A load of 40 N over 90 s that sways by 10 N in a part of the time."""
    seconds = np.arange(0.0, 90.0, 0.1)
    sway = 10.0 * np.sin(seconds) * ((seconds >= moves_from) & (seconds <= moves_to))
    load = np.zeros((len(seconds), columns))
    load[:, 2] = -40.0
    load[:, 0] = sway
    if columns == 6:
        load[:, 3:5] = 2.0, 0.05
        load[:, 4] += 0.05 * sway
    return MovingLoad(stamp_ns=(seconds * 1e9).astype(np.int64), load=load)


def _spans(uses: list[tuple[int, int, str]], use: str) -> list[tuple[float, float]]:
    return [(first / SECOND_NS, last / SECOND_NS) for first, last, one in uses if one == use]


WHOLE = [(0, 90 * SECOND_NS)]


def test_a_load_that_moves_throughout_is_fitted_first() -> None:
    """Negative control: two thirds, then the rest, as without loads."""
    pieces = divided(WHOLE, [_load(moves_from=0.0, moves_to=90.0)])
    assert pieces == divided(WHOLE) == [(0, 60 * SECOND_NS, "calibration"), (60 * SECOND_NS, WHOLE[0][1], "validation")]


@pytest.mark.parametrize("columns", [3, 6])
def test_what_validates_has_the_moving_part_in_it(columns: int) -> None:
    """The robot stands still from 50 s on: the usual last third would validate nothing."""
    load = _load(moves_from=0.0, moves_to=50.0, columns=columns)
    assert not load.moves(divided(WHOLE))
    pieces = divided(WHOLE, [load])
    assert load.moves(pieces)
    assert sum(last - first for first, last, _ in pieces) == WHOLE[0][1]
    ((first, last),) = _spans(pieces, "validation")
    assert min(last, 50.0) - max(first, 0.0) > 4.0


def test_a_log_that_hardly_moves_is_divided_as_usual() -> None:
    """No order helps; who proposes it says so."""
    load = _load(moves_from=0.0, moves_to=0.0)
    pieces = divided(WHOLE, [load])
    assert pieces == divided(WHOLE)
    assert not load.moves(pieces)
