# SPDX-License-Identifier: BSD-3-Clause
"""A calibration may not make a sensor worse for loads that were not recorded."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from forcetorque.arrays import FloatArray
from tests.calibration.push_error import Case, cases

ALONE: dict[str, Sequence[str]] = {"grid": ["grid"], "tz": ["tz"], "bsl": ["bsl"]}
POOLED = ["grid", "grid_2", "tz", "tz_2", "bsl", "bsl_2", "bnsl", "bnsl_2"]
WORSE = 1.05
"""Error after over error before, from which on a calibration made the sensor worse."""


def _ratios(case: Case) -> tuple[FloatArray, FloatArray]:
    """Error after over error before, of force and moment: with lambda as chosen, and without its floor."""
    choice = case.fitted()
    return case.ratio(choice.fit.matrix), case.ratio(case.unfloored(choice).fit.matrix)


def test_a_push_that_was_not_recorded_reads_no_worse_than_before() -> None:
    """Two new specimens of four sensors in the motions that move them: none of 16 cases is above 1.05.

    With other seeds one run in five to ten would have a case above it, by some .1: one or two of 20 feet in z-torque
    alone. It cannot pass without the floor: every foot in z-torque alone is then several times worse.
    """
    every = [*ALONE]
    moved = {"l_leg_ft": every, "l_foot_ft": every, "r_leg_ft": ["bsl"], "l_arm_ft": ["bsl"]}
    chosen, unfloored = np.swapaxes([_ratios(case) for case in cases(ALONE, moved, range(201, 203))], 0, 1)
    assert chosen.shape == (16, 2)
    assert chosen.max() < WORSE
    assert np.median(chosen, axis=0).max() < 0.6
    # negative control: the same rule without its floor
    assert np.count_nonzero(unfloored.max(axis=1) > WORSE) >= 3
    assert unfloored.max() > 4.0


@pytest.mark.long
def test_hardly_any_of_240_calibrations_makes_a_push_read_worse() -> None:
    """Over 20 specimens at most 3 in force and 3 in moment, the worst below 2.7, and medians below 0.3.

    Measured: force .26 median, 1.00 at 95 %, 1.16 worst, 1 above 1.05; moment .23, 1.00, 1.05, none. Without the floor:
    .28, 4.8, 13.1, 53 and .23, 7.5, 14.9, 54.
    """
    every = [*ALONE, "all"]
    moved = {"l_leg_ft": every, "l_foot_ft": every, "r_leg_ft": ["bsl", "all"], "l_arm_ft": ["bsl", "all"]}
    drawn = cases({**ALONE, "all": POOLED}, moved, range(101, 121))
    chosen, unfloored = np.swapaxes([_ratios(case) for case in drawn], 0, 1)
    assert chosen.shape == (240, 2)
    assert np.count_nonzero(chosen > WORSE, axis=0).max() <= 3
    assert chosen.max() < 2.7
    assert np.median(chosen, axis=0).max() < 0.3
    # negative control: the same rule without its floor
    assert np.count_nonzero(unfloored > WORSE, axis=0).min() > 40
    assert unfloored.max() > 10.0
