# SPDX-License-Identifier: BSD-3-Clause
"""A taxel that is broken is named with what is wrong, and a sound one is not."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.skin.taxels.taxel_faults import TaxelFault, taxel_faults

RNG = np.random.default_rng(2)
COUNTS = np.rint(240.0 - 40.0 * np.sin(np.linspace(0.0, np.pi, 2000)) + RNG.normal(0.0, 0.65, 2000))
"""A sound taxel."""
FALL = 40.0


def _changed(place: int, value: float) -> np.ndarray:
    counts = COUNTS.copy()
    counts[place:] = value
    return counts


ONCE = COUNTS.copy()
ONCE[700] -= 21.0
CASES = {
    TaxelFault.WRAPS: (np.rint(240.0 - 300.0 * np.sin(np.linspace(0.0, np.pi, 2000))) % 256.0, 300.0),
    TaxelFault.RAILS: (_changed(900, 255.0), FALL),
    TaxelFault.JUMPS: (ONCE, FALL),
    TaxelFault.NOISE: (np.clip(COUNTS + np.random.default_rng(3).normal(0.0, 3.5, 2000), 1.0, 254.0), FALL),
    TaxelFault.NEVER_MOVES: (np.full(2000, 240.0), 0.0),
    TaxelFault.RISES: (480.0 - COUNTS - 30.0, -FALL),
}


@pytest.mark.parametrize("fault", list(TaxelFault))
def test_each_is_named(fault: TaxelFault) -> None:
    """The first reason is what was planted."""
    counts, fall = CASES[fault]
    ((first, *_), sound) = taxel_faults(np.column_stack([counts, COUNTS]), np.array([fall, FALL]))
    assert first is fault
    assert sound == ()


def test_limits_are_as_stated() -> None:
    """A step of exactly the limit is no jump, one count more is; the same of a fall that is too small."""
    counts = np.column_stack([np.where(np.arange(100) < 50, 200.0, 200.0 - step) for step in (20.0, 21.0)])
    still, jumps = taxel_faults(counts, np.array([20.0, 21.0]))
    assert still == ()
    assert jumps == (TaxelFault.JUMPS,)
    quiet = np.full((100, 2), 200.0)
    assert taxel_faults(quiet, np.array([4.9, 5.0])) == ((TaxelFault.NEVER_MOVES,), ())
