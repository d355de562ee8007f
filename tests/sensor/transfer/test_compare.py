# SPDX-License-Identifier: BSD-3-Clause
"""The comparison of kinds: held-out errors by hand, pooled, and failures kept."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.sensor.transfer.parametric import (
    Exponential,
    Linear,
    Logarithmic,
    Power,
    fit_exponential,
    fit_linear,
    fit_logarithmic,
    fit_polynomial,
    fit_power,
)
from forcetorque.sensor.transfer.static_curves import FITTERS, compare
from forcetorque.sensor.transfer.transfer_function import TransferFunction
from tests.cases import some_cases

CLOSED = {
    "linear": fit_linear,
    "logarithmic": fit_logarithmic,
    "exponential": fit_exponential,
    "power": fit_power,
}
RNG = np.random.default_rng(1)
SHUFFLED = RNG.permutation(np.linspace(1.0, 50.0, 60))


@some_cases(
    "truth",
    [
        Linear(lowest=1.0, highest=50.0, slope=-2.0, offset=240.0),
        Logarithmic(lowest=1.0, highest=50.0, slope=-25.0, offset=240.0),
        Exponential(lowest=1.0, highest=50.0, scale=240.0, rate=-0.04),
        Power(lowest=1.0, highest=50.0, slope=-0.05, exponent=2.0, offset=240.0),
    ],
    ids=lambda truth: type(truth).__name__,
)
def test_the_true_kind_comes_first(truth: TransferFunction) -> None:
    """With noise, held-out points are foretold best by the kind that made them, to within the noise."""
    noise = 0.5
    output = truth.predict(SHUFFLED) + noise * RNG.normal(size=60)
    scores, failures = compare(SHUFFLED, output, fitters=CLOSED)
    # a power can be a line, so a line may come second to it by less than the scatter of the noise
    first = {score.name for score in scores if score.rmse < 1.05 * scores[0].rmse}
    assert type(truth).__name__.lower() in first
    assert scores[0].rmse == pytest.approx(noise, rel=0.3)  # 60 points, a tenth of scatter, three times that
    assert [score.rmse for score in scores] == sorted(score.rmse for score in scores)


def test_errors_by_hand() -> None:
    """Two groups on lines that differ by 3: each fit is off by 3 on the other, so RMSE and largest are 3."""
    stimulus, groups = np.array([0.0, 1, 2, 0, 1, 2]), ["a", "a", "a", "b", "b", "b"]
    output = np.array([0.0, 1, 2, 3, 4, 5])
    (score,), _ = compare(stimulus, output, groups=groups, fitters={"linear": fit_linear})
    assert (score.count, score.beyond) == (6, 0)
    assert score.rmse == pytest.approx(3.0)
    assert score.largest == pytest.approx(3.0)
    assert score.model.predict(1.0) == pytest.approx(2.5)  # fitted to all points


def test_errors_are_pooled_not_averaged() -> None:
    """Groups of 1 and 9 points, off by 10 and by 1: the pooled RMSE is sqrt(109 / 10), not the mean of 10 and 1."""

    def off_by(stimulus: np.ndarray, output: np.ndarray) -> TransferFunction:
        constant = 10.0 if len(stimulus) == 9 else 1.0
        return Linear(lowest=0.0, highest=9.0, slope=1.0, offset=constant)

    stimulus = np.arange(10.0)
    groups = [0] + [1] * 9
    (score,), _ = compare(stimulus, stimulus, groups=groups, fitters={"off": off_by})
    assert score.rmse == pytest.approx(np.sqrt(10.9))
    assert score.rmse != pytest.approx(5.5, rel=0.1)
    assert score.largest == pytest.approx(10.0)


def test_contiguous_blocks_are_held_out() -> None:
    """Sorted points in 5 blocks: the outer two blocks, a fifth each, lie beyond the fits that did not see them."""
    stimulus = np.linspace(1.0, 50.0, 50)
    (score,), _ = compare(stimulus, 2 * stimulus, fitters={"linear": fit_linear})
    assert (score.count, score.beyond) == (50, 20)
    assert score.rmse < 1e-10  # a line goes on
    (cubic,), _ = compare(stimulus, np.sqrt(stimulus), fitters={"cubic": partial(fit_polynomial, degree=3)})
    (shuffled,), _ = compare(SHUFFLED, np.sqrt(SHUFFLED), fitters={"cubic": partial(fit_polynomial, degree=3)})
    assert shuffled.beyond < 6  # only the ends of each fit's range
    assert cubic.rmse > 3 * shuffled.rmse  # a cubic does not go on as a root does


def test_what_fails_is_kept_with_its_reason() -> None:
    """A stimulus of zero has no logarithm; the other kinds are compared all the same."""
    stimulus = np.linspace(0.0, 50.0, 60)
    scores, failures = compare(stimulus, 240.0 - 3 * stimulus**0.5, fitters=CLOSED)
    assert {score.name for score in scores} == {"linear", "exponential", "power"}
    ((name, reason),) = failures.items()
    assert name == "logarithmic"
    assert "above 0" in reason


def test_every_kind_can_be_compared() -> None:
    """The default set fits a smooth curve with every kind and forgets none."""
    stimulus = RNG.permutation(np.linspace(1.0, 50.0, 40))
    scores, failures = compare(stimulus, 240.0 * np.exp(-stimulus / 40.0) + 0.1 * RNG.normal(size=40), folds=2)
    assert {score.name for score in scores} | failures.keys() == set(FITTERS)
    assert len(scores) >= 7
    assert all(score.count == 40 for score in scores)


def test_bad_divisions_are_refused() -> None:
    """One group, one block, more blocks than points, labels that do not fit."""
    points = np.arange(6.0)
    with pytest.raises(FitError, match="at least two groups"):
        compare(points, points, groups=["a"] * 6)
    with pytest.raises(FitError, match="2 to 6 folds for 6 points, got 1"):
        compare(points, points, folds=1)
    with pytest.raises(FitError, match="got 7"):
        compare(points, points, folds=7)
    with pytest.raises(ShapeError, match=r"one label per point, shape \(6,\), got \(5,\)"):
        compare(points, points, groups=["a"] * 5)
