# SPDX-License-Identifier: BSD-3-Clause
"""Ranks only where contestants differ; equals are called so; nobody else is."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.contests.contestant_errors_and_comparison import (
    ContestPairRow,
    compared_pairs,
    mean_squares,
    ranks_and_winner,
    rms_intervals,
)
from forcetorque.contests.phases_and_runs_by_load import Trial, by_load, common_phases, trial_by_phase

PHASES, LOADS = 120, (10.0, 15.0, 20.0)
ALL = np.ones(PHASES, dtype=np.bool_)
SCALE = (100.0, 10.0)
ROUNDING = 1e-12


def _parts(rng: np.random.Generator, size: float, *, slow: int = 6) -> FloatArray:
    """Errors that last for some phases, by nature alike under all loads, with noise of each."""
    knots = rng.standard_normal((PHASES // slow + 2, 6))
    wave = np.stack([np.interp(np.arange(PHASES) / slow, np.arange(len(knots)), k) for k in knots.T], axis=1)
    trials = [
        Trial(
            load_kg=load,
            error=size * np.repeat([1.0, 0.1], 3) * (wave * load / 15.0 + 0.5 * rng.standard_normal(wave.shape)),
            level=np.zeros(6),
            reference=np.zeros((PHASES, 6)),
            time_s=0.0,
        )
        for load in LOADS
        for _ in range(2)
    ]
    return mean_squares(by_load(trials), ALL)


def _judgements(pairs: list[ContestPairRow], quantity: str = "wrench") -> dict[tuple[str, str], str]:
    return {(pair.contestant, pair.other): pair.conclusion for pair in pairs if pair.error_of == quantity}


def test_the_ratio_is_that_of_root_mean_squares() -> None:
    """By hand, for force, moment and both over their scales; it is inverse for the pair the other way round."""
    rng = np.random.default_rng(1)
    one, other = _parts(rng, 1.0), _parts(rng, 2.0)
    pairs = {p.error_of: p.ratio for p in compared_pairs({"one": one, "other": other}, scale=SCALE)}
    back = {p.error_of: p.ratio for p in compared_pairs({"other": other, "one": one}, scale=SCALE)}
    force, moment = ([float(parts[..., axes].sum()) for parts in (one, other)] for axes in (slice(0, 3), slice(3, 6)))
    both = [f / SCALE[0] ** 2 + m / SCALE[1] ** 2 for f, m in zip(force, moment, strict=True)]
    wanted = {name: np.sqrt(a / b) for name, (a, b) in (("force", force), ("moment", moment), ("wrench", both))}
    assert pairs.keys() == wanted.keys()
    for name, ratio in wanted.items():
        assert pairs[name] == pytest.approx(ratio, rel=0.02)  # stretches of unlike number weigh unlike
        assert pairs[name] * back[name] == pytest.approx(1.0, rel=ROUNDING)


def test_a_winner_is_found_and_equals_share_a_rank() -> None:
    """Of four, one errs a half less than two that are alike; the last errs twice as much as they."""
    rng = np.random.default_rng(2)
    parts = {name: _parts(rng, size) for name, size in (("a", 1.0), ("best", 0.5), ("b", 1.0), ("last", 2.0))}
    pairs = compared_pairs(parts, scale=SCALE)
    ranks, winner = ranks_and_winner(list(parts), pairs)
    assert winner == "best"
    assert {name: of_wrench for name, (of_wrench, _, _) in ranks.items()} == {"best": 1, "a": 2, "b": 2, "last": 4}
    assert _judgements(pairs)["a", "b"] in ("no difference", "inconclusive")


def test_what_differs_by_little_is_equal_however_sure_it_is() -> None:
    """A copy that errs 3 % more in every phase is no different for any use, and nobody wins."""
    one = _parts(np.random.default_rng(3), 1.0)
    parts = {"one": one, "copy": 1.03**2 * one, "same": one}
    pairs = compared_pairs(parts, scale=SCALE)
    assert set(_judgements(pairs).values()) == {"no difference"}
    assert ranks_and_winner(list(parts), pairs)[1] is None
    far = compared_pairs({"one": one, "copy": 1.5**2 * one}, scale=SCALE)
    assert set(_judgements(far).values()) == {"better"}


def test_more_contestants_ask_for_more() -> None:
    """Intervals of a pair are wider among six than among two, since all hold together."""
    rng = np.random.default_rng(4)
    parts = {str(k): _parts(rng, 1.0) for k in range(6)}
    alone = compared_pairs({name: parts[name] for name in "01"}, scale=SCALE)[0]
    among = compared_pairs(parts, scale=SCALE)[0]
    assert among.ratio == alone.ratio
    ends = [among.ratio_low, alone.ratio_low, alone.ratio, alone.ratio_high, among.ratio_high]
    known = [end for end in ends if end is not None]
    assert known == ends
    assert known == sorted(set(known))


def test_a_constant_error_is_told_with_its_interval() -> None:
    """White errors over phases: the interval of the root mean square holds their deviation, nearly always."""
    held = []
    for seed in range(40):
        errors = np.random.default_rng(seed).standard_normal((PHASES, 6))
        rms, low, high = rms_intervals(errors**2)
        np.testing.assert_allclose(rms, np.sqrt((errors**2).mean(axis=0)), rtol=ROUNDING)
        held.append((low < 1.0) & (high > 1.0))
    assert np.mean(held) > 0.9  # 95 % of 240


def test_means_over_phases_and_what_is_removed() -> None:
    """Three samples of a phase count as their mean; phases without a sample are not common."""
    phase = np.array([0.05, 0.06, 0.07, 0.95])
    error = np.outer([1.0, 2.0, 3.0, 6.0], np.ones(6))
    trial = trial_by_phase(phase, error, error, None, phases=10, load_kg=5.0)
    np.testing.assert_allclose(trial.level, 4.0)
    np.testing.assert_allclose(trial.error[[0, 9]], [[-2.0] * 6, [2.0] * 6])
    own = trial_by_phase(phase, error, error, np.ones(6), phases=10, load_kg=5.0)
    np.testing.assert_allclose(own.error[0], 1.0)
    with pytest.raises(RecordingError, match="at least 50% of 10 phases, got 20%"):
        common_phases({"one": [trial]})
