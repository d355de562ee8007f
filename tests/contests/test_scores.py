# SPDX-License-Identifier: BSD-3-Clause
"""Precision and drift come from what differs between runs with one load, and from nothing else."""

from __future__ import annotations

import numpy as np

from forcetorque.contests.phases_and_runs_by_load import Trial, by_load, changes, repeatability

PHASES = 200
COMMON = np.ones(PHASES, dtype=np.bool_)
PER_HOUR, PER_DEGREE = np.array([2.0, 0, 0, 0.1, 0, 0]), np.array([0, 0.3, 0, 0, 0.02, 0])


def _trials(rng: np.random.Generator, *, turns: int = 3, warm: bool = True, clock: bool = True) -> list[Trial]:
    """Runs under two loads, with a pattern of each load that is the same in all."""
    patterns = {load: load * rng.standard_normal((PHASES, 6)) for load in (10.0, 20.0)}
    trials = []
    for turn in range(turns):
        for k, (load, pattern) in enumerate(patterns.items()):
            hours, degrees = turn + 0.5 * k, 25.0 + 8.0 * ((2 * turn + k) % 3)
            level = load * 0.1 + PER_HOUR * hours + PER_DEGREE * degrees + 0.001 * rng.standard_normal(6)
            trials.append(
                Trial(
                    load_kg=load,
                    error=pattern + 0.5 * rng.standard_normal((PHASES, 6)),
                    level=level,
                    reference=pattern,
                    time_s=3600.0 * hours if clock else np.nan,
                    temperature_degC=degrees if warm else np.nan,
                )
            )
    return trials


def test_precision_is_the_scatter_between_runs() -> None:
    """Not the pattern, which every run repeats; none where no load was hung twice."""
    precision = repeatability(by_load(_trials(np.random.default_rng(1))), COMMON)
    assert precision is not None
    np.testing.assert_allclose(precision, 0.5, rtol=0.15)  # 800 differences: 2.5 %
    assert repeatability(by_load(_trials(np.random.default_rng(1), turns=1)), COMMON) is None


def test_drift_by_time_and_temperature_apart() -> None:
    """Both at once, whatever the loads; with intervals that hold the truth."""
    change = changes(by_load(_trials(np.random.default_rng(2), turns=4)))
    assert set(change) == {"per hour", "per degC"}
    for name, truth in (("per hour", PER_HOUR), ("per degC", PER_DEGREE)):
        slope, width = change[name]
        assert width is not None
        assert (np.abs(slope - truth) < 2.0 * width).all()
        assert (width < 0.05).all()


def test_what_nobody_recorded_is_not_told() -> None:
    """Without a clock no drift per hour, without a thermometer none per degree, without repeats neither."""
    rng = np.random.default_rng(3)
    assert set(changes(by_load(_trials(rng, warm=False)))) == {"per hour"}
    assert set(changes(by_load(_trials(rng, clock=False)))) == {"per degC"}
    assert changes(by_load(_trials(rng, turns=1))) == {}
