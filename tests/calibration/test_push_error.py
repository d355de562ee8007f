# SPDX-License-Identifier: BSD-3-Clause
"""A calibration may not make a sensor worse for loads that were not recorded, and knows how well it reads them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.calibration.generative import REPEATABILITY
from forcetorque.simulation.scenario import LINEAR_ONLY
from tests.calibration.other_sensors import FAMILIES, with_eight_channels, with_error
from tests.calibration.push_error import Case, cases

ALONE: dict[str, Sequence[str]] = {"grid": ["grid"], "tz": ["tz"], "bsl": ["bsl"]}
POOLED = ["grid", "grid_2", "tz", "tz_2", "bsl", "bsl_2", "bnsl", "bnsl_2"]
MOTIONS = {**ALONE, "all": POOLED}
EVERY = [*ALONE, "all"]
MOVED = {"l_leg_ft": EVERY, "l_foot_ft": EVERY, "r_leg_ft": ["bsl", "all"], "l_arm_ft": ["bsl", "all"]}
"""The sensors, and the motions in which their load changes: 12 cases for every seed."""
NEW_SEEDS = range(301, 321)
"""Specimens that nobody looked at while the default estimator was made."""
WORSE = 1.05
"""Error after over error before, from which on a calibration made the sensor worse."""

Fitted = tuple[str, FloatArray, FloatArray]
"""Motion, ratio of the errors, and coverage of one sensor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What became of n sensors."""

    motion: NDArray[np.str_]
    """Names of the motions; shape (n,)."""
    ratio: FloatArray
    """Error of a push after over before, force and moment; shape (n, 2)."""
    covered: FloatArray
    """Share of nominal 95 % intervals that hold the truth: coefficients, push forces and moments; shape (n, 3)."""

    @classmethod
    def of(cls, fitted: Iterable[Fitted]) -> Outcome:
        """Gather what became of each."""
        motion, ratio, covered = zip(*fitted, strict=True)
        return cls(motion=np.array(motion), ratio=np.array(ratio), covered=np.array(covered))

    @property
    def worse(self) -> FloatArray:
        """How many were made worse, in force and in moment; shape (2,)."""
        return np.count_nonzero(self.ratio > WORSE, axis=0)

    def percentile(self, percent: float, motion: str | None = None) -> FloatArray:
        """Percentile of the ratios, of all or of one motion; shape (2,)."""
        values: FloatArray = np.percentile(self.ratio[self._of(motion)], percent, axis=0)
        return values

    def coverage(self, motion: str | None = None) -> FloatArray:
        """Mean coverage, of all or of one motion; shape (3,)."""
        mean: FloatArray = self.covered[self._of(motion)].mean(axis=0)
        return mean

    def _of(self, motion: str | None) -> BoolArray:
        return np.ones(len(self.motion), dtype=bool) if motion is None else self.motion == motion


def _fitted(case: Case, *, repeatability: float = REPEATABILITY) -> Fitted:
    """Fit a sensor with the default estimator."""
    fit = case.generative(repeatability=repeatability)
    return case.motion, case.ratio(fit.model.matrix), case.covered(fit)


@pytest.fixture(scope="module")
def alone() -> list[Case]:
    """Two new specimens of four sensors in the motions that move them: 16 cases."""
    moved = {sensor: [name for name in names if name in ALONE] for sensor, names in MOVED.items()}
    return list(cases(ALONE, moved, range(201, 203)))


def _ratios(case: Case) -> tuple[FloatArray, FloatArray]:
    """Error after over error before, of force and moment: with lambda as chosen, and without its floor."""
    choice = case.fitted()
    return case.ratio(choice.fit.matrix), case.ratio(case.unfloored(choice).fit.matrix)


def test_a_push_that_was_not_recorded_reads_no_worse_than_before(alone: list[Case]) -> None:
    """With the thesis' type none of 16 cases is above 1.05.

    With other seeds one run in five to ten would have a case above it, by some .1: one or two of 20 feet in z-torque
    alone. It cannot pass without the floor: every foot in z-torque alone is then several times worse.
    """
    chosen, unfloored = np.swapaxes([_ratios(case) for case in alone], 0, 1)
    assert chosen.shape == (16, 2)
    assert chosen.max() < WORSE
    assert np.median(chosen, axis=0).max() < 0.6
    # negative control: the same rule without its floor
    assert np.count_nonzero(unfloored.max(axis=1) > WORSE) >= 3
    assert unfloored.max() > 4.0


def test_the_default_reads_such_a_push_better_and_knows_how_well(alone: list[Case]) -> None:
    """None of the same 16 is above 1.05, half of them err by less than a quarter, and nine of ten intervals hold.

    With other seeds one run in nine would have a case above 1.05: 5 of 720 are, all of 60 left legs in a grid alone.
    """
    outcome = Outcome.of(_fitted(case) for case in alone)
    assert outcome.ratio.shape == (16, 2)
    assert not outcome.worse.any()
    assert outcome.percentile(50.0).max() < 0.4
    assert (outcome.coverage() > 0.9).all()


@pytest.mark.long
def test_hardly_any_of_240_calibrations_makes_a_push_read_worse() -> None:
    """Over 20 specimens at most 3 in force and 3 in moment, the worst below 2.7, and medians below 0.3.

    Measured: force .26 median, 1.00 at 95 %, 1.16 worst, 1 above 1.05; moment .23, 1.00, 1.05, none. Without the floor:
    .28, 4.8, 13.1, 53 and .23, 7.5, 14.9, 54.
    """
    drawn = cases(MOTIONS, MOVED, range(101, 121))
    chosen, unfloored = np.swapaxes([_ratios(case) for case in drawn], 0, 1)
    assert chosen.shape == (240, 2)
    assert np.count_nonzero(chosen > WORSE, axis=0).max() <= 3
    assert chosen.max() < 2.7
    assert np.median(chosen, axis=0).max() < 0.3
    # negative control: the same rule without its floor
    assert np.count_nonzero(unfloored > WORSE, axis=0).min() > 40
    assert unfloored.max() > 10.0


@pytest.fixture(scope="module")
def outcomes() -> dict[str, Outcome]:
    """Outcome of 240 new sensors by what is wrong with their priors: mounting, as the scenario has it, or a family."""
    fitted: dict[str, list[Fitted]] = {kind: [] for kind in ("mounting", *FAMILIES)}
    for case in cases(MOTIONS, MOVED, NEW_SEEDS):
        fitted["mounting"].append(_fitted(case))
        for family in FAMILIES:
            fitted[family].append(_fitted(with_error(case, family)))
    return {kind: Outcome.of(each) for kind, each in fitted.items()}


@pytest.mark.long
def test_the_default_hardly_ever_makes_a_push_read_worse(outcomes: dict[str, Outcome]) -> None:
    """X."""
    for kind, outcome in outcomes.items():
        for motion in (*MOTIONS, None):
            print(
                kind,
                motion,
                outcome.percentile(50.0, motion).round(3),
                outcome.percentile(95.0, motion).round(3),
                outcome.percentile(100.0, motion).round(3),
                outcome.worse,
                outcome.coverage(motion).round(3),
            )
