# SPDX-License-Identifier: BSD-3-Clause
"""Fused torques of a pushed arm over fifty seeds: how good they are, what is named, and what their intervals hold.

`tests/estimation/torque/fusion_trials.py` prints what these tests hold.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from forcetorque.estimation.torque.covariance_fusion import FALSE_ALARM
from tests.estimation import model_error_trials
from tests.estimation.torque.fusion_trials import (
    FAULTS,
    SEEDS,
    Trial,
    alarms,
    best_single,
    figures,
    pooled,
    sound_rmse,
    trials,
)

pytestmark = pytest.mark.long

Trials = Mapping[str, Sequence[Trial]]


@pytest.fixture(scope="module", name="tried")
def tried_arms() -> Trials:
    """Fifty arms, with everything that may be broken."""
    return {what: list(trials(faults)) for what, faults in FAULTS.items()}


def test_fused_torques_are_no_worse_than_the_best_source(tried: Trials) -> None:
    """Pooled over seeds and joints: below 1.05 of the best single source; it is about a half."""
    told = figures(tried["sound"])
    assert len(tried["sound"]) == SEEDS
    assert pooled(told.rmse["fused"]) < 0.6 * best_single(told.rmse)
    for joint, error in enumerate(told.rmse["fused"]):
        assert error < 1.05 * min(told.rmse[name][joint] for name in ("ft", "skin", "current"))


@pytest.mark.parametrize("what", ["hot skin", "FT offset", "friction"])
def test_the_broken_source_is_named(tried: Trials, what: str) -> None:
    """In nine of ten, and torques are as good as those of the sound sources by themselves."""
    broken = FAULTS[what].source
    told = figures(tried[what])
    assert told.named[broken] >= 0.9 * SEEDS
    assert pooled(told.rmse["fused"]) < 1.5 * pooled(sound_rmse(tried[what], broken))
    assert broken is not None
    # negative control: by itself it is far worse
    assert pooled(told.rmse[broken]) > 2.0 * pooled(told.rmse["fused"])


def test_intervals_hold_the_truth_where_variances_are_right(tried: Trials) -> None:
    """And not where they are wrong; conflicts that nobody alone explains widen them."""
    for what in ("sound", "hot skin", "FT offset", "friction"):
        assert 0.90 < figures(tried[what]).covered < 0.98
    assert figures(tried["variances 4 times too large"]).covered > 0.99
    small = figures(tried["variances 4 times too small"])
    assert small.conflicts > 0.9 * SEEDS
    assert small.named.keys() == {None}


def test_false_alarms_are_as_rare_as_stated(tried: Trials) -> None:
    """Of arms and of drawn sources, whose errors are exactly what they say."""
    assert figures(tried["sound"]).conflicts <= 3  # 0.5 expected, 4 have a probability of 0.002
    assert figures(tried["sound"]).windows < FALSE_ALARM
    for rate in (0.01, 0.05):
        count, of = alarms(rate)
        assert count <= of * rate + 3.0 * np.sqrt(of * rate)
        assert count > 0


@pytest.mark.parametrize("name", model_error_trials.SIZES)
def test_intervals_hold_where_the_robot_differs_from_its_model(name: str) -> None:
    """Masses, centres of mass and joint zeros, small and large, with the deviation stated by joint; forty arms each."""
    size = model_error_trials.SIZES[name]
    some = model_error_trials.trials(size, model_error_trials.deviations(size), 40)
    told = figures(some)
    assert told.covered > 0.95  # independent errors in each source, as they were counted before, hold 65 % of the large
    assert told.conflicts <= 4
    assert pooled(told.rmse["fused"]) < best_single(told.rmse)
