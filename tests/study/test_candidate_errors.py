# SPDX-License-Identifier: BSD-3-Clause
"""Many candidates at once are judged as one at a time, by both evaluators."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.experiment.calibrations_under_test import wrench_errors
from forcetorque.robot.mechanics.estimate import Evaluator
from forcetorque.study.candidate_errors import BlockErrors, PooledErrors, candidate_errors
from tests.cases import some_cases

EPS = float(np.finfo(np.float64).eps)

ROUNDINGS = 20.0
"""Roundings of an error, per unit of the largest sum of magnitudes in a component: one for each of 13 terms, which
do not all have the same sign."""

OFFSET_COUNTS = 24000.0
"""Usual offset of a raw channel."""

BOTH = pytest.mark.parametrize("evaluator", list(Evaluator))

FIELDS = ("mean_absolute", "force_mean", "moment_mean")


@dataclass(frozen=True, kw_only=True)
class Problem:
    """Candidates near a true calibration, and samples."""

    raw: FloatArray
    reference: FloatArray
    matrices: FloatArray
    offsets: FloatArray
    variables: FloatArray
    coefficients: FloatArray

    def judge(self, evaluator: Evaluator, **options: object) -> BlockErrors:
        """Judge all candidates."""
        options = {"variables": self.variables, "coefficients": self.coefficients} | options
        return candidate_errors(self.raw, self.reference, self.matrices, self.offsets, evaluator=evaluator, **options)  # type: ignore[arg-type]

    def wrenches(self, k: int) -> FloatArray:
        """What candidate k reads."""
        return self.raw @ self.matrices[k].T + self.variables @ self.coefficients[k].T + self.offsets[k]

    @property
    def rounding(self) -> float:
        """Largest difference of two ways to work out an error; N, N m."""
        terms = np.abs(self.matrices) @ np.abs(self.raw).max(axis=0) + np.abs(self.offsets)
        terms += np.abs(self.coefficients) @ np.abs(self.variables).max(axis=0) + np.abs(self.reference).max()
        return ROUNDINGS * EPS * float(terms.max())


def _problem(samples: int, candidates: int, channels: int = 6, variables: int = 1, seed: int = 1) -> Problem:
    rng = np.random.default_rng(seed)
    raw = np.round(OFFSET_COUNTS + 3000.0 * rng.normal(size=(samples, channels)))
    extra = 30.0 + 5.0 * rng.normal(size=(samples, variables))
    matrix, coefficient = 0.01 * rng.normal(size=(6, channels)), rng.normal(size=(6, variables))
    reference = raw @ matrix.T + extra @ coefficient.T + rng.normal(scale=2.0, size=(samples, 6))
    return Problem(
        raw=raw,
        reference=reference - reference.mean(axis=0),
        matrices=matrix + 1e-4 * rng.normal(size=(candidates, 6, channels)),
        offsets=rng.normal(size=(candidates, 6)) - reference.mean(axis=0),
        variables=extra,
        coefficients=coefficient + 0.1 * rng.normal(size=(candidates, 6, variables)),
    )


def _largest_difference(one: BlockErrors | PooledErrors, other: BlockErrors | PooledErrors) -> float:
    return max(float(np.abs(getattr(one, field) - getattr(other, field)).max()) for field in FIELDS)


@BOTH
def test_by_hand(evaluator: Evaluator) -> None:
    """Two samples, two candidates: the identity, and it with an offset of 1 N along x and 2 N m about z."""
    raw = np.array([[3.0, 4.0, 0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0, 0.0, -1.0]])
    matrices, offsets = np.stack([np.eye(6), np.eye(6)]), np.array([[0.0] * 6, [-3.0, 0, 0, 0, 0, 1.0]])
    errors = candidate_errors(raw, np.zeros((2, 6)), matrices, offsets, evaluator=evaluator)
    np.testing.assert_array_equal(errors.count, [1, 1])
    np.testing.assert_allclose(errors.force_mean, [[5.0, 0.0], [4.0, 3.0]], atol=1e-15)
    np.testing.assert_allclose(errors.moment_mean, [[1.0, 1.0], [2.0, 0.0]], atol=1e-15)
    np.testing.assert_allclose(errors.mean_absolute[1], [[0, 4, 0, 0, 0, 2], [3, 0, 0, 0, 0, 0]], atol=1e-15)
    pooled, scatter = errors.pooled(), errors.standard_error()
    np.testing.assert_allclose(pooled.force_mean, [2.5, 3.5])
    np.testing.assert_allclose(pooled.mean_absolute[0], [1.5, 2.0, 0, 0, 0, 1.0], atol=1e-15)
    # two blocks of one sample: means 5 and 0, standard deviation 5 / sqrt 2, over sqrt 2
    np.testing.assert_allclose(scatter.force_mean, [2.5, 0.5])


def _scatter_of_blocks(values: FloatArray) -> float:
    means = [block.mean() for block in np.array_split(values, min(10, len(values)))]
    return float(np.std(means, ddof=1) / np.sqrt(len(means))) if len(means) > 1 else np.nan


def _assert_as_one_at_a_time(problem: Problem, errors: BlockErrors) -> None:
    pooled, scatter = errors.pooled(), errors.standard_error()
    assert len(problem.matrices) == len(pooled.force_mean) > 0
    for k in range(len(problem.matrices)):
        wrenches = problem.wrenches(k)
        alone = wrench_errors(wrenches, problem.reference, np.arange(float(len(wrenches))))
        absolute = np.abs(wrenches - problem.reference).mean(axis=0)
        np.testing.assert_allclose(pooled.mean_absolute[k], absolute, rtol=0, atol=problem.rounding)
        found = (pooled.force_mean[k], pooled.moment_mean[k], scatter.force_mean[k], scatter.moment_mean[k])
        norms = (np.linalg.norm((wrenches - problem.reference)[:, axes], axis=1) for axes in (slice(3), slice(3, 6)))
        expected = (alone.force_mean, alone.moment_mean, *(_scatter_of_blocks(norm) for norm in norms))
        np.testing.assert_allclose(found, expected, rtol=0, atol=problem.rounding, equal_nan=True)


@BOTH
@some_cases("samples", [11, 2561, 1, 2, 256, 2560, 5119], quick=2)
@pytest.mark.parametrize("candidates", [1, 5])
def test_as_one_candidate_at_a_time(evaluator: Evaluator, samples: int, candidates: int) -> None:
    """The means that `wrench_errors` gives, and the scatter of ten blocks; blocks of time of 256 samples and around."""
    problem = _problem(samples, candidates)
    _assert_as_one_at_a_time(problem, problem.judge(evaluator))


@BOTH
def test_another_candidate_is_noticed(evaluator: Evaluator) -> None:
    """Negative control: a change of one element by a part in 1e10 is more than the comparison allows."""
    problem = _problem(500, 3)
    errors = problem.judge(evaluator)
    matrices = problem.matrices.copy()
    matrices[1, 2, 3] *= 1.0 + 1e-10
    with pytest.raises(AssertionError, match="Not equal to tolerance"):
        _assert_as_one_at_a_time(replace(problem, matrices=matrices), errors)


SHAPES = [(6, 1), (1, 0), (30, 3)]
"""Channels and variables."""


@some_cases(("channels", "variables"), SHAPES)
@pytest.mark.parametrize(("samples", "candidates"), [(1, 1), (1, 700), (17000, 2), (900, 530)])
def test_both_evaluators_agree(channels: int, variables: int, samples: int, candidates: int) -> None:
    """In every block, for any number of channels and variables, with one task and with many."""
    problem = _problem(samples, candidates, channels, variables)
    readable, compiled = problem.judge(Evaluator.READABLE, blocks=3), problem.judge(Evaluator.COMPILED, blocks=3)
    assert compiled.mean_absolute.shape == (candidates, min(3, samples), 6)
    assert _largest_difference(readable, compiled) < problem.rounding
    moved = replace(problem, offsets=problem.offsets + 1e-9)
    assert _largest_difference(moved.judge(Evaluator.READABLE, blocks=3), compiled) > problem.rounding


@BOTH
def test_offsets_of_the_counts_cost_no_digits(evaluator: Evaluator) -> None:
    """Counts and offset moved against each other change an error by the rounding of the offset alone."""
    problem = _problem(3000, 4)
    still = replace(
        problem,
        raw=problem.raw - OFFSET_COUNTS,
        offsets=problem.offsets + OFFSET_COUNTS * problem.matrices.sum(axis=2),
    )
    assert (
        _largest_difference(problem.judge(evaluator), still.judge(evaluator))
        < 8.0 * EPS * np.abs(problem.offsets).max()
    )


@BOTH
def test_the_order_of_candidates_does_not_matter(evaluator: Evaluator) -> None:
    """Each candidate gets its own numbers, bit by bit, wherever it stands among others."""
    problem = _problem(600, 530)
    order = np.random.default_rng(3).permutation(530)
    mixed = replace(
        problem,
        matrices=problem.matrices[order],
        offsets=problem.offsets[order],
        coefficients=problem.coefficients[order],
    )
    one, other = problem.judge(evaluator), mixed.judge(evaluator)
    for field in FIELDS:
        np.testing.assert_array_equal(getattr(one, field)[order], getattr(other, field))


@BOTH
def test_a_block_is_a_stretch_judged_alone(evaluator: Evaluator) -> None:
    """The blocks are those of `numpy.array_split`; no sample is left out or taken twice."""
    problem = _problem(1003, 3)
    errors = problem.judge(evaluator, blocks=4)
    stretches = np.array_split(np.arange(1003), 4)
    np.testing.assert_array_equal(errors.count, [len(stretch) for stretch in stretches])
    for b, stretch in enumerate(stretches):
        part = replace(
            problem,
            raw=problem.raw[stretch],
            reference=problem.reference[stretch],
            variables=problem.variables[stretch],
        )
        alone = part.judge(evaluator, blocks=1)
        for field in FIELDS:
            found = getattr(errors, field)[:, b]
            np.testing.assert_allclose(found, getattr(alone, field)[:, 0], rtol=0, atol=problem.rounding)


@BOTH
def test_pooled_means_do_not_depend_on_the_blocks(evaluator: Evaluator) -> None:
    """Blocks of different lengths weigh by their samples; the plain mean of the blocks would be another number."""
    problem = _problem(19, 3)
    one, seven = problem.judge(evaluator, blocks=1), problem.judge(evaluator, blocks=7)
    assert _largest_difference(one.pooled(), seven.pooled()) < problem.rounding
    assert np.abs(seven.force_mean.mean(axis=1) - one.pooled().force_mean).max() > 1e-3
    assert all(np.isnan(getattr(one.standard_error(), field)).all() for field in FIELDS)


@BOTH
def test_a_variable_is_a_column_like_a_channel(evaluator: Evaluator) -> None:
    """The same columns as channels or as variables give the same errors; without them, others."""
    problem = _problem(700, 3, channels=4, variables=3)
    joined = candidate_errors(
        np.hstack([problem.raw, problem.variables]),
        problem.reference,
        np.concatenate([problem.matrices, problem.coefficients], axis=2),
        problem.offsets,
        evaluator=evaluator,
    )
    errors = problem.judge(evaluator)
    assert _largest_difference(errors, joined) < problem.rounding
    assert _largest_difference(errors, problem.judge(evaluator, variables=None, coefficients=None)) > 1.0


def test_threads_change_nothing_and_progress_is_told() -> None:
    """The same bits on one thread and on three; samples are counted up to the last."""
    problem = _problem(40000, 530)
    counted: list[int] = []
    one = problem.judge(Evaluator.COMPILED, threads=1, blocks=2, progress=counted.append)
    three = problem.judge(Evaluator.COMPILED, threads=3, blocks=2)
    for field in FIELDS:
        np.testing.assert_array_equal(getattr(one, field), getattr(three, field))
    assert counted == [16384, 20000, 36384, 40000]
    counted.clear()
    _problem(3000, 2).judge(Evaluator.READABLE, blocks=2, progress=counted.append)
    assert counted == [1500, 3000]


@pytest.mark.long
def test_little_work_does_not_load_the_compiler() -> None:
    """It would take longer than the work; asked for, it is there."""
    code = (
        "import sys, numpy as np; from forcetorque.study.candidate_errors import candidate_errors as judge\n"
        "problem = np.ones((9, 6)), np.ones((9, 6)), np.ones((2, 6, 6)), np.ones((2, 6))\n"
        "judge(*problem); assert 'numba' not in sys.modules\n"
        "judge(*problem, evaluator='compiled'); assert 'numba' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_much_work_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beyond some number of samples times candidates the compiled evaluator is chosen."""
    problem = _problem(100, 2)
    monkeypatch.setattr(sys.modules["forcetorque.study.candidate_errors"], "_FEW", 200)
    monkeypatch.setattr(sys.modules["forcetorque.study.candidate_errors"], "_run_readable", None)
    chosen = candidate_errors(problem.raw, problem.reference, problem.matrices, problem.offsets)
    assert chosen.force_mean.shape == (2, 10)


def test_inputs_stay_and_results_are_read_only() -> None:
    """Integers and other layouts are taken, no input is changed, and neither can be what comes back."""
    problem = _problem(300, 2)
    kept = problem.raw.copy()
    errors = problem.judge(Evaluator.COMPILED)
    np.testing.assert_array_equal(problem.raw, kept)
    other = replace(problem, raw=np.asfortranarray(problem.raw.astype(np.int32)))
    assert _largest_difference(errors, other.judge(Evaluator.COMPILED)) == 0.0
    for field in ("count", *FIELDS):
        with pytest.raises(ValueError, match="read-only"):
            getattr(errors, field)[0] = 0


GOOD: Mapping[str, FloatArray] = {
    "raw": np.ones((5, 3)),
    "reference": np.ones((5, 6)),
    "matrices": np.ones((2, 6, 3)),
    "offsets": np.ones((2, 6)),
    "variables": np.ones((5, 2)),
    "coefficients": np.ones((2, 6, 2)),
}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"raw": np.ones(5)}, r"raw: expected an array of shape \(n, n\), got \(5,\)"),
        ({"raw": np.ones((5, 4))}, r"matrices: expected an array of shape \(2, 6, 4\), got \(2, 6, 3\)"),
        ({"matrices": np.ones((6, 3))}, "matrices: expected an array of shape"),
        ({"reference": np.ones((4, 6))}, r"reference: expected an array of shape \(5, 6\), got \(4, 6\)"),
        ({"offsets": np.ones(6)}, r"offsets: expected an array of shape \(2, 6\)"),
        ({"variables": np.ones((4, 2))}, r"variables: expected an array of shape \(5, n\)"),
        ({"coefficients": np.ones((2, 6, 1))}, r"coefficients: expected an array of shape \(2, 6, 2\)"),
        ({"coefficients": None}, "expected variables and their coefficients, or neither"),
        ({"variables": None}, "expected variables and their coefficients, or neither"),
        ({"raw": np.ones((0, 3)), "reference": np.ones((0, 6)), "variables": np.ones((0, 2))}, "got 0 samples"),
        ({"raw": np.ones((5, 0)), "matrices": np.ones((2, 6, 0))}, "of 0 channels"),
        ({"matrices": np.ones((0, 6, 3)), "offsets": np.ones((0, 6))}, "0 candidates"),
        ({"blocks": 0}, "and 0 blocks"),
    ],
)
def test_shapes_are_checked(change: dict[str, object], message: str) -> None:
    """What does not fit is refused by name; control: unchanged, it is judged."""
    assert candidate_errors(**GOOD).force_mean.shape == (2, 5)
    with pytest.raises(ShapeError, match=message):
        candidate_errors(**(dict(GOOD) | change))  # type: ignore[arg-type]


@pytest.mark.parametrize("name", GOOD)
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_gaps_are_refused(name: str, value: float) -> None:
    """A value that is not finite would spoil all means without a word; the message says where it is."""
    values = np.array(GOOD[name])
    values[(1,) * values.ndim] = value
    with pytest.raises(ShapeError, match=rf"{name}: expected finite values only, got {value} at \(1, 1"):
        candidate_errors(**(dict(GOOD) | {name: values}))
