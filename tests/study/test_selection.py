# SPDX-License-Identifier: BSD-3-Clause
"""The choice among candidates: the best by brute force, rows put together, and sessions that it is scored on."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.study.candidate_errors import BlockErrors, PooledErrors
from forcetorque.study.candidate_selection import (
    assembled,
    best_by_axis,
    best_by_magnitude,
    evaluate_models,
    scored_across_sessions,
)
from tests.study.measured import JUDGED, PRIOR, TRUTH, study

EXACT = 1e-10
"""N, N m: rounding of double precision times wrenches of some 500 N."""

LESS = 1.0 - 1e-6
"""What is smaller by less than this is the same fit, reached in another way."""

BOTH = pytest.mark.parametrize("source", list(KNOWN_BEFORE))


def _errors(k: int, *, seed: int) -> PooledErrors:
    rng = np.random.default_rng(seed)
    return PooledErrors(
        mean_absolute=rng.uniform(1, 2, size=(k, 6)),
        force_mean=rng.uniform(1, 2, size=k),
        moment_mean=rng.uniform(1, 2, size=k),
    )


def test_the_best_are_those_of_a_search() -> None:
    """By magnitude one candidate, by axis one for each component; the moment has no say in the magnitude."""
    for seed in range(20):
        errors = _errors(9, seed=seed)
        best, rows = 0, [0] * 6
        for k in range(9):
            if errors.force_mean[k] < errors.force_mean[best]:
                best = k
            for axis in range(6):
                if errors.mean_absolute[k, axis] < errors.mean_absolute[rows[axis], axis]:
                    rows[axis] = k
        assert best_by_magnitude(errors) == best
        assert best_by_axis(errors) == tuple(rows)
        assert len(set(rows)) > 1


def test_rounding_does_not_choose() -> None:
    """Of fits that differ by a part in 1e9 the last is taken, whichever is smaller; one in 1e5 is a difference."""
    plain = _errors(4, seed=1)
    for change, first in ((-1e-9, False), (1e-9, False), (1e-5, True)):
        force, absolute = plain.force_mean.copy(), plain.mean_absolute.copy()
        force[[1, 3]], absolute[[1, 3]] = 0.5, 0.5
        force[3] *= 1.0 + change
        absolute[3] *= 1.0 + change
        errors = replace(plain, force_mean=force, mean_absolute=absolute)
        assert best_by_magnitude(errors) == (1 if first else 3)
        assert best_by_axis(errors) == (1 if first else 3,) * 6


@BOTH
def test_the_choice_of_a_study_is_the_smallest_of_all_351(source: Offset) -> None:
    """Its errors are no larger than those of any candidate, and the workbench is never among them."""
    choice, pooled = study().choices[source], study().errors[source].pooled()
    assert pooled.force_mean.shape == (352,)
    assert 0 <= choice.by_magnitude < 351
    assert (pooled.force_mean[:351] > LESS * pooled.force_mean[choice.by_magnitude]).all()
    for axis, index in enumerate(choice.by_axis):
        assert 0 <= index < 351
        assert (pooled.mean_absolute[:351, axis] > LESS * pooled.mean_absolute[index, axis]).all()
    assert pooled.force_mean[choice.by_magnitude] < 0.5 * pooled.force_mean[351]


MODELS = (
    TRUTH,
    WrenchModel(matrix=PRIOR, offset=np.arange(6.0)),
    replace(TRUTH, matrix=1.1 * PRIOR, coefficients=-3.0 * TRUTH.coefficients, reference_values=np.array([41.0])),
    replace(TRUTH, offset=TRUTH.offset + 5.0, reference_values=np.array([0.0])),
)
"""Counting the temperature from 29, not at all, from 41 and from 0 degC."""


@pytest.mark.parametrize("rows", [(0, 1, 2, 3, 0, 1), (1, 1, 1, 2, 1, 1), (3, 3, 0, 0, 2, 2)])
def test_assembled_rows_read_as_those_of_their_models(rows: tuple[int, ...]) -> None:
    """On any samples, whatever value the result counts its temperature from."""
    rng = np.random.default_rng(5)
    raw, temperature = 8000.0 * rng.normal(size=(50, 6)), rng.uniform(10.0, 50.0, size=(50, 1))
    wrenches = [m.wrench(raw, temperature if m.coefficients.shape[1] else None) for m in MODELS]
    for reference in (0.0, 29.0, 35.0):
        made = assembled(MODELS, rows, np.array([reference]))
        assert made.reference_values.tolist() == [reference]
        found = made.wrench(raw, temperature)
        for axis, index in enumerate(rows):
            assert np.abs(found[:, axis] - wrenches[index][:, axis]).max() < EXACT
            others = [k for k in range(len(MODELS)) if k != index]
            assert min(np.abs(found[:, axis] - wrenches[k][:, axis]).max() for k in others) > 0.1


def test_rows_without_variables_make_a_model_without() -> None:
    """Where no row has coefficients there is nothing to give a temperature for."""
    made = assembled(MODELS, (1,) * 6, np.array([29.0]))
    assert made.reference_values.shape == (0,)
    assert np.array_equal(made.matrix, PRIOR)
    assert np.array_equal(made.offset, MODELS[1].offset)
    assert assembled(MODELS, (1, 1, 1, 1, 1, 0), np.array([29.0])).reference_values.shape == (1,)


def test_rows_of_models_with_two_variables() -> None:
    """Each row's offset moves by both of its coefficients."""
    rng = np.random.default_rng(6)
    models = [
        replace(TRUTH, coefficients=rng.normal(size=(6, 2)), reference_values=values)
        for values in (np.array([29.0, 12.0]), np.array([0.0, 0.0]))
    ]
    raw, values = 8000.0 * rng.normal(size=(50, 6)), rng.normal(size=(50, 2)) + [30.0, 12.0]
    made = assembled(models, (0, 1, 0, 1, 0, 1), np.array([25.0, 11.0]))
    assert np.abs(made.wrench(raw, values)[:, ::2] - models[0].wrench(raw, values)[:, ::2]).max() < EXACT
    assert np.abs(made.wrench(raw, values)[:, 1::2] - models[1].wrench(raw, values)[:, 1::2]).max() < EXACT


@BOTH
def test_scores_are_of_a_choice_made_without_the_scored_session(source: Offset) -> None:
    """Against judging the days apart: the best of one day, and what it does on the other."""
    scores, models = study().choices[source].across_sessions, study().models
    sources = [source] * 351 + [Offset.FIRST_SECOND]
    days = {"day 1": JUDGED[:2], "day 2": JUDGED[2:]}
    assert [score.session for score in scores] == ["day 1", "day 2"]
    for score, other in zip(scores, ("day 2", "day 1"), strict=True):
        chosen_on, scored_on = (evaluate_models(models, sources, days[day]).pooled() for day in (other, score.session))
        assert (chosen_on.force_mean[:351] > LESS * chosen_on.force_mean[score.chosen]).all()
        for axis, index in enumerate(score.by_axis):
            assert (chosen_on.mean_absolute[:351, axis] > LESS * chosen_on.mean_absolute[index, axis]).all()
        assert score.samples == sum(len(one.time_s) - 100 for one in days[score.session])
        assert score.force_mean == pytest.approx(scored_on.force_mean[score.chosen], abs=EXACT)
        assert score.moment_mean == pytest.approx(scored_on.moment_mean[score.chosen], abs=EXACT)
        for axis, index in enumerate(score.by_axis):
            assert score.mean_absolute[axis] == pytest.approx(scored_on.mean_absolute[index, axis], abs=EXACT)
        assert score.workbench_force_mean == pytest.approx(scored_on.force_mean[351], abs=EXACT)


SESSIONS = ("a", "b", "a", "c", "b", "c", "c")


def _judgement(k: int, *, seed: int) -> BlockErrors:
    """Errors of k models in seven blocks of three sessions, one block after the other."""
    rng = np.random.default_rng(seed)
    b = len(SESSIONS)
    return BlockErrors(
        count=rng.integers(5, 50, size=b),
        mean_absolute=rng.uniform(1, 2, size=(k, b, 6)),
        force_mean=rng.uniform(1, 2, size=(k, b)),
        moment_mean=rng.uniform(1, 2, size=(k, b)),
        sessions=SESSIONS,
    )


def _poisoned(judgement: BlockErrors, candidate: int, session: str, factor: float) -> BlockErrors:
    """Change all errors of one candidate in one session."""
    there = np.array([of == session for of in judgement.sessions])

    def changed(values: FloatArray) -> FloatArray:
        copy = values.copy()
        copy[candidate, there] *= factor
        return copy

    return replace(
        judgement,
        mean_absolute=changed(judgement.mean_absolute),
        force_mean=changed(judgement.force_mean),
        moment_mean=changed(judgement.moment_mean),
    )


@pytest.mark.parametrize("factor", [1e-3, 1e3])
def test_the_scored_session_has_no_part_in_the_choice(factor: float) -> None:
    """A candidate that is poisoned, or flattered, in one session changes its score there and the choice elsewhere."""
    plain = _judgement(6, seed=1)
    determined = np.ones(6, dtype=bool)
    before = {score.session: score for score in scored_across_sessions(plain, determined)}
    assert list(before) == ["a", "b", "c"]
    moved = 0
    for candidate, session in product(range(6), before):
        after = {
            score.session: score
            for score in scored_across_sessions(_poisoned(plain, candidate, session, factor), determined)
        }
        assert after[session].chosen == before[session].chosen
        assert after[session].by_axis == before[session].by_axis
        ratio = after[session].force_mean / before[session].force_mean
        assert ratio == pytest.approx(factor if candidate == before[session].chosen else 1.0)
        for axis, index in enumerate(before[session].by_axis):
            ratio = after[session].mean_absolute[axis] / before[session].mean_absolute[axis]
            assert ratio == pytest.approx(factor if candidate == index else 1.0)
        for other in before.keys() - {session}:  # negative control: the poison is seen by those who may see it
            moved += after[other].chosen != before[other].chosen
            assert factor < 1.0 or after[other].chosen != candidate
    assert moved > 0


def test_poisoned_samples_of_a_session_do_not_reach_its_choice() -> None:
    """The same with samples: on one day the workbench is right, and the choice that is scored there stays."""
    spoilt = replace(JUDGED[2], reference=JUDGED[2].raw @ PRIOR.T)
    models = study().models[:351]
    source = Offset.FIRST_SECOND
    determined = np.ones(351, dtype=bool)
    plain, poisoned = (
        {
            score.session: score
            for score in scored_across_sessions(evaluate_models(models, [source] * 351, sets), determined)
        }
        for sets in (JUDGED, [*JUDGED[:2], spoilt])
    )
    assert poisoned["day 2"].chosen == plain["day 2"].chosen
    assert poisoned["day 2"].force_mean > 2.0 * plain["day 2"].force_mean
    candidates = study().fits.candidates
    assert candidates[plain["day 1"].chosen].table_lambda <= 1000.0
    assert candidates[poisoned["day 1"].chosen].table_lambda == 1e6


def test_the_workbench_is_compared_and_never_chosen() -> None:
    """Models after the candidates are the prior: with errors of zero it is still not the choice."""
    judgement = _judgement(7, seed=2)
    for session in ("a", "b", "c"):
        judgement = _poisoned(judgement, 6, session, 1e-6)
    scores = scored_across_sessions(judgement, np.ones(6, dtype=bool))
    assert len(scores) == 3
    for score in scores:
        assert score.chosen != 6
        assert 6 not in score.by_axis
        assert score.workbench_force_mean is not None
        assert score.workbench_force_mean < 1e-5
    assert {s.workbench_force_mean for s in scored_across_sessions(judgement, np.ones(7, dtype=bool))} == {None}


def test_what_is_not_determined_is_not_chosen_for_any_session() -> None:
    """The best candidate of every session is left out where the data do not determine it."""
    judgement = _poisoned(_judgement(6, seed=3), 4, "a", 1e-6)
    determined = np.ones(6, dtype=bool)
    assert 4 in {score.chosen for score in scored_across_sessions(judgement, determined)}
    determined[4] = False
    scores = scored_across_sessions(judgement, determined)
    assert len(scores) == 3
    assert all(score.chosen != 4 and 4 not in score.by_axis for score in scores)


def test_one_session_gives_no_score() -> None:
    """There is no other session to choose on, however many blocks there are; the same blocks of three give three."""
    judgement, determined = _judgement(3, seed=4), np.ones(3, dtype=bool)
    alone = replace(judgement, sessions=("day",) * len(SESSIONS))
    assert scored_across_sessions(alone, determined) == []
    assert len(scored_across_sessions(judgement, determined)) == 3
