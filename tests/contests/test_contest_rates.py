# SPDX-License-Identifier: BSD-3-Clause
"""How often a contest finds the better one, calls equals equal, and neither wrongly; loads nobody was fitted on.

One contest of each kind is in `test_contest.py`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.contests.commands import contest
from forcetorque.contests.contest_file import Contestant, Entries, Method
from forcetorque.contests.contest_scores import Contest
from forcetorque.recording.recording import Use
from tests.device.device_contest import DEVICE, maker, planted, run_of

SEEDS = 50
JUDGED, FITTED = (10.0, 15.0, 20.0, 30.0), (5.0, 25.0)
"""Steps of 5 kg; no load of the second judges."""
ERROR = 0.02
"""Of the loads; the winner has two thirds of it."""
LEAST = 0.9
"""Share of seeds that the better one, and equals, must be found in."""
MOST_WRONG = 0.1
"""Share of seeds in which nobody may be ranked wrongly: 5 % and what 50 seeds scatter by."""
BOUGHT, OURS, MORE = DEVICE.sensor_names


def _stacked(seed: int) -> Contest:
    """Two stacks, each with a bought sensor beside the same two of ours, of which one errs a third less than all."""
    rng = np.random.default_rng(seed)
    sizes = {BOUGHT: ERROR, OURS: ERROR / 1.5, MORE: ERROR}
    priors = {name: planted(name, size, JUDGED, rng) for name, size in sizes.items()}
    other = priors | {BOUGHT: planted(BOUGHT, ERROR, JUDGED, rng)}
    runs = [
        run_of(f"{stack} {load:g} kg", load, rng, priors=matrices, serial=stack)
        for load in JUDGED
        for stack, matrices in (("A", priors), ("B", other))
    ]
    contestants = [replace(maker(BOUGHT), name=f"bought {stack}", serial=stack) for stack in "AB"]
    ours = [replace(maker(name), serial="A") for name in (OURS, MORE)]
    return contest(Entries(name="planted", runs=tuple(runs), contestants=(*contestants, *ours)))


def _methods(seed: int) -> Contest:
    """One sensor by fits to either half of the data, and by its prior; equal but for noise."""
    rng = np.random.default_rng([seed, 1])
    priors = {name: planted(name, ERROR, JUDGED, rng) for name in DEVICE.sensor_names}
    fitted = [
        run_of(f"{half} {load:g} kg", load, rng, priors=priors, use=Use.CALIBRATION) for half in "ab" for load in FITTED
    ]
    judged = [run_of(f"{load:g} kg", load, rng, priors=priors) for load in JUDGED]
    halves = [
        Contestant(
            name=half,
            sensor=OURS,
            method=Method.IN_SITU,
            fitted_on=tuple(run.name for run in fitted if run.name.startswith(half)),
        )
        for half in "ab"
    ]
    return contest(Entries(name="equal", runs=(*fitted, *judged), contestants=(*halves, maker(OURS))))


def _conclusion(result: Contest, one: str, other: str) -> str:
    (pair,) = (p for p in result.pairs if p.error_of == "wrench" and {p.contestant, p.other} == {one, other})
    return pair.conclusion


def _ranked_wrongly(result: Contest) -> bool:
    """Whether any of the three whose errors are equal is ranked before another."""
    equal = ("bought A", "bought B", MORE)
    pairs = [(one, other) for k, one in enumerate(equal) for other in equal[k + 1 :]]
    return any(_conclusion(result, *pair) in ("better", "worse") for pair in pairs)


@pytest.mark.long
def test_the_planted_winner_is_found() -> None:
    """Of two bought sensors and two of ours, one errs a third less; the three others are not ranked."""
    results = [_stacked(seed) for seed in range(SEEDS)]
    won = np.mean([result.winner == OURS for result in results])
    wrong = np.mean([_ranked_wrongly(result) for result in results])
    assert won >= LEAST
    assert wrong <= MOST_WRONG


@pytest.mark.long
def test_equal_methods_are_called_equal() -> None:
    """Fits to different recordings of one sensor; both are better than its prior."""
    results = [_methods(seed) for seed in range(SEEDS)]
    equal = np.mean([_conclusion(result, "a", "b") == "no difference" for result in results])
    better = np.mean([_conclusion(result, "a", OURS) == "better" for result in results])
    assert equal >= LEAST
    assert better >= LEAST
