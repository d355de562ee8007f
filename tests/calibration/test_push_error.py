# SPDX-License-Identifier: BSD-3-Clause
"""A calibration may not make a sensor worse for loads that were not recorded, and knows how well it reads them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.experiment.calibration.expected_sensor_errors import ACCURACY_SHARE, REPEATABILITY
from forcetorque.simulation.scenario.scenario_file import LINEAR_ONLY
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
EXACT_COUNTS = {**LINEAR_ONLY, "noise_counts": 0.0, "noise_corner_hz": 0.0}
"""Changes of the scenario after which counts follow the loads but for rounding."""
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


@pytest.mark.long
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


@pytest.mark.long
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
    """Of 240 new sensors 2 are made worse, in force: by 2.05 and 1.22; the prior is halved tenfold in the median.

    Measured, force and moment: median .073 .065, at 95 % .66 .85, worst 2.05 .92; all recordings pooled .032 .034, at
    95 % .086 .115. With seeds 101-120 none is above 1.05, with 321-340 3 are, by 1.12 at most: 5 of 720, all of them
    among 60 left legs in a grid alone, whose one posture moves forces and moments only together. Their priors err by
    5 to 7 N where the median is 17 N; with loads known exactly the same ones are worse.
    """
    outcome = outcomes["mounting"]
    assert outcome.ratio.shape == (240, 2)
    assert (outcome.worse <= [2, 0]).all()
    assert (outcome.percentile(100.0) < [2.1, 0.95]).all()
    assert (outcome.percentile(50.0) < 0.08).all()
    assert (outcome.percentile(95.0) < [0.80, 0.85]).all()
    assert (outcome.percentile(50.0, "all") < 0.04).all()
    assert (outcome.percentile(95.0, "all") < 0.12).all()
    for motion in ("tz", "bsl", "all"):
        assert (outcome.percentile(100.0, motion) < 1.0).all()


@pytest.mark.long
def test_nominal_intervals_hold_the_truth_as_often_as_they_say(outcomes: dict[str, Outcome]) -> None:
    """Nominal 95 % of coefficients, push forces and push moments: .957 .977 .978 of 240 sensors.

    By motion at least .93, coefficients with all recordings; of feet alone these are .88. Pushes go where no load went
    too.
    """
    outcome = outcomes["mounting"]
    assert ((outcome.coverage() > 0.90) & (outcome.coverage() < 0.98)).all()
    for motion in MOTIONS:
        assert (outcome.coverage(motion) > 0.92).all()


@pytest.mark.long
def test_errors_of_other_families_are_repaired_where_the_motions_tell_them(outcomes: dict[str, Outcome]) -> None:
    """Gains of channels (6 %) and of the response (5 %) are; a turned and shifted frame takes all motions.

    Measured over 240 each: gains median .075 .092, one above 1.05, by 1.08 in force; response .044 .049, one, by 1.10.
    A frame that is turned by 2.3 degrees and shifted by 4 mm errs by 1.6 N only: median .72 .10, 84 are above 1.05 in
    force, 39 of 40 in a grid and the worst by 6.5, of 80 with all motions one by 1.13. Never worse does not hold there.
    """
    for family in ("gains", "relative"):
        assert (outcomes[family].worse <= [1, 0]).all()
        assert (outcomes[family].percentile(100.0) < [1.15, 1.0]).all()
        assert (outcomes[family].percentile(50.0) < 0.1).all()
    frame = outcomes["frame"]
    assert frame.worse[0] > 60
    assert (frame.percentile(100.0, "all") < 1.2).all()
    assert (frame.percentile(50.0, "all") < [0.4, 0.05]).all()


@pytest.mark.long
def test_intervals_hold_in_other_families_too(outcomes: dict[str, Outcome]) -> None:
    """What does not hold there is never worse; the predicted error does.

    Coverage: gains .959 .971 .979, frame .964 .989 .986, response .927 .947 .958 (a grid alone .88 .88 .88).
    """
    for family in FAMILIES:
        assert (outcomes[family].coverage() > 0.92).all()
        for motion in MOTIONS:
            assert (outcomes[family].coverage(motion) > 0.87).all()


@pytest.mark.long
def test_intervals_hold_for_sensors_that_a_matrix_tells_all_of() -> None:
    """White noise, no creep, cross-talk or hysteresis, and a repeatability of 0: .976 .969 .974 of 240 sensors.

    By motion at least .91; medians of the ratios .027 .030, pooled .006 .007; 2 above 1.05, by 1.83 and 1.44, the same
    left legs as above.
    """
    drawn = cases(MOTIONS, MOVED, NEW_SEEDS, {**LINEAR_ONLY, "noise_corner_hz": 0.0})
    outcome = Outcome.of(_fitted(case, repeatability=0.0) for case in drawn)
    assert ((outcome.coverage() > 0.90) & (outcome.coverage() < 0.98)).all()
    for motion in MOTIONS:
        assert (outcome.coverage(motion) > 0.90).all()
    assert (outcome.worse <= [2, 0]).all()
    assert (outcome.percentile(50.0) < 0.04).all()
    assert (outcome.percentile(50.0, "all") < 0.01).all()


@pytest.mark.long
def test_eight_channels_are_calibrated_with_a_prior_and_without() -> None:
    """Legs, all recordings: medians .0014 .0025 with a prior, .0022 .0054 without; feet .024 .065, arms .032 .036.

    Feet and arms read no better with six channels: what the derivative windows and the encoders leave in the reference
    is more to them, whose loads move less.
    """
    drawn = cases({"all": POOLED}, dict.fromkeys(MOVED, ["all"]), range(301, 306), EXACT_COUNTS)
    sensors = [with_eight_channels(case) for case in drawn]
    legs = np.array([case.sensor.endswith("leg_ft") for case in sensors])
    for with_prior in (True, False):
        fits = [case.generative(repeatability=0.0, with_prior=with_prior) for case in sensors]
        ratios = np.array([case.ratio(fit.model.matrix) for case, fit in zip(sensors, fits, strict=True)])
        assert (np.median(ratios[legs], axis=0) < 0.012).all()
        assert (np.median(ratios[~legs], axis=0) < 0.08).all()
        assert (ratios[legs] < 0.025).all()
        assert (ratios < 0.15).all()


@pytest.mark.long
def test_a_foot_that_hung_free_knows_how_badly_it_reads_the_robot() -> None:
    """Of 60 force errors under 320 N, all but one are within 2.6 predicted standard deviations; that one is at 3.3.

    As for a normal distribution, of which 0.9 % lie outside.
    """
    moved = {"l_leg_ft": ["bsl"], "l_foot_ft": ["grid", "bsl"]}  # the scenario wants the leg, whose error it sets
    pairs: dict[int, dict[str, Case]] = {}
    for case in cases(ALONE, moved, NEW_SEEDS):
        if case.sensor == "l_foot_ft":
            pairs.setdefault(case.seed, {})[case.motion] = case
    ratios = np.array([_of_stance(pair["grid"], pair["bsl"]) for pair in pairs.values()])
    assert ratios.shape == (20, 3)
    assert np.count_nonzero(ratios > 2.6) <= 1
    assert ratios.max() < 3.5


def _of_stance(free: Case, stood: Case) -> FloatArray:
    """Force errors when the robot stands on a foot that was fitted while free, over predicted; shape (3,)."""
    fit = free.generative(accuracy=ACCURACY_SHARE)
    (before,), (after,) = free.data, stood.data
    load, counts, warmer = (
        getattr(after, name).mean(axis=0) - getattr(before, name).mean(axis=0)
        for name in ("reference", "raw", "variables")
    )
    error = fit.model.matrix @ counts + fit.model.coefficients @ warmer - load
    predicted = np.sqrt(np.diag(fit.posterior.error_covariance(load, variables=warmer)))
    ratio: FloatArray = np.abs(error / predicted)[:3]
    return ratio
