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


@pytest.mark.parametrize(
    ("low", "high", "fault"),
    [
        (250.0, 1.0, TaxelFault.JUMPS),  # 7 counts across the end are a jump by 249
        (250.0, 0.0, TaxelFault.WRAPS),  # 6 are none
        (1.0, 254.0, TaxelFault.WRAPS),
        (1.0, 20.0, None),
        (1.0, 22.0, TaxelFault.JUMPS),
    ],
)
def test_a_step_across_the_end_of_the_range_wraps(low: float, high: float, fault: TaxelFault | None) -> None:
    """By up to 6 counts, from 255 to 0 or back; what is farther is a jump."""
    counts = np.where(np.arange(400) < 200, low, high)[:, None]
    (found,) = taxel_faults(counts, np.array([FALL]))
    assert set(found) - {TaxelFault.RAILS} == ({fault} if fault else set())


@pytest.mark.parametrize(("deviation", "is_noisy"), [(2.85, False), (3.15, True)])
def test_a_taxel_is_noisy_from_three_counts(deviation: float, is_noisy: bool) -> None:
    """Standard deviation of one message from the next; of 20 000 it is known to 1 %; a slope is no noise."""
    rng = np.random.default_rng(4)
    counts = 128.0 + np.linspace(-40.0, 40.0, 20_000) + deviation * rng.normal(size=20_000)
    (found,) = taxel_faults(counts[:, None], np.array([FALL]))
    assert found == ((TaxelFault.NOISE,) if is_noisy else ())


@pytest.mark.parametrize(("value", "is_railed"), [(0.0, True), (1.0, False), (254.0, False), (255.0, True)])
def test_a_rail_is_an_end_of_the_range(value: float, is_railed: bool) -> None:
    """0 and 255, in one message alone."""
    counts = np.full((300, 1), value + (1.0 if value < 128.0 else -1.0))
    counts[17] = value
    (found,) = taxel_faults(counts, np.array([FALL]))
    assert (TaxelFault.RAILS in found) == is_railed


@pytest.mark.parametrize(("fall", "rises"), [(-4.9, False), (-5.0, True)])
def test_a_taxel_rises_from_five_counts(fall: float, rises: bool) -> None:
    """Less is none that moves."""
    (found,) = taxel_faults(np.full((100, 1), 200.0), np.array([fall]))
    assert found == ((TaxelFault.RISES,) if rises else (TaxelFault.NEVER_MOVES,))
