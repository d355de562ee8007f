# SPDX-License-Identifier: BSD-3-Clause
"""Ratios of paired errors: by hand, how often equal candidates are told apart, and how often unequal ones."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.special import stdtrit

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.noise.paired_comparison import ErrorRatio, PairedErrors, compare_errors, ratio_over
from tests.cases import some_cases

EXACT = 1e-12
"""Ratios of some 1 by two ways."""

COUNT, STEP_S = 1000, 0.01

Pair = tuple[FloatArray, FloatArray]
Recordings = list[Pair]
Draw = Callable[[np.random.Generator], Recordings]


def _process(part: float, rng: np.random.Generator) -> FloatArray:
    """Force errors of deviation 1 that forget themselves after this part of the recording; 0 for white noise."""
    noise = rng.normal(size=(COUNT, 3))
    phi = math.exp(-1.0 / (part * COUNT)) if part else 0.0
    noise[0] /= math.sqrt(1.0 - phi**2)
    return np.asarray(lfilter([math.sqrt(1.0 - phi**2)], [1.0, -phi], noise, axis=0))


def _alike(part: float, white: float = 0.0, common: float = 0.0, recordings: int = 1, constant: float = 0.0) -> Draw:
    """Two candidates whose errors are drawn in one way: slow, white, and what both have in common."""

    def draw(rng: np.random.Generator) -> Recordings:
        pairs = []
        for _ in range(recordings):
            shared = common * _process(part, rng) + [constant, 0.0, 0.0]
            first, second = (shared + _process(part, rng) + white * _process(0.0, rng) for _ in range(2))
            pairs.append((first, second))
        return pairs

    return draw


def _by(ratio: float, draw: Draw) -> Draw:
    """The same with the first candidate's errors this times as large."""
    return lambda rng: [(ratio * first, second) for first, second in draw(rng)]


def _motions(ratio: float, count: int) -> Draw:
    """Recordings of white errors, each with a ratio of its own that scatters by .4."""

    def draw(rng: np.random.Generator) -> Recordings:
        factors = ratio * np.exp(0.4 * rng.normal(size=count))
        return [(factor * rng.normal(size=(100, 3)), rng.normal(size=(100, 3))) for factor in factors]

    return draw


def _judged(recordings: Recordings) -> ErrorRatio:
    """Judge by force errors alone; the moments are the same."""
    return compare_errors(
        [
            PairedErrors.of(*(np.pad(errors, ((0, 0), (0, 3))) for errors in pair), np.zeros((len(pair[0]), 6)))
            for pair in recordings
        ]
    ).force


def _shares(draw: Draw, campaigns: int, seed: int = 1) -> dict[str, float]:
    """Share of campaigns by what is said of the first candidate."""
    rng = np.random.default_rng(seed)
    said = Counter(_judged(draw(rng)).conclusion for _ in range(campaigns))
    return {conclusion: count / campaigns for conclusion, count in said.items()}


def _most(share: float, campaigns: int) -> float:
    """Largest share that is counted where the true one is this: two standard deviations above."""
    return share + 2.0 * math.sqrt(share * (1.0 - share) / campaigns)


NULLS: dict[str, Draw] = {
    "white": _alike(0.0),
    **{f"slow {part}": _alike(part) for part in (0.01, 0.02, 0.05, 0.1, 0.2)},
    **{f"slow {part} and {white} white": _alike(part, white) for part in (0.05, 0.1, 0.2) for white in (0.3, 1.0, 3.0)},
    **{f"slow {part} and common": _alike(part, common=2.0) for part in (0.05, 0.2)},
    **{f"slow {part} and constant": _alike(part, constant=3.0) for part in (0.05, 0.2)},
    **{f"slow {part}, {n} recordings": _alike(part, recordings=n) for part in (0.05, 0.2) for n in (2, 5)},
}
"""Candidates of equal errors."""

QUICK = ("white", "slow 0.05", "slow 0.2", "slow 0.2 and 1.0 white", "slow 0.2 and common", "slow 0.05, 5 recordings")


def _require_seldom_wrong(name: str, campaigns: int) -> None:
    shares = _shares(NULLS[name], campaigns)
    for conclusion in ("better", "worse"):
        assert shares.get(conclusion, 0.0) <= _most(0.05, campaigns), (name, shares)


@some_cases("name", QUICK)
def test_equal_candidates_are_seldom_called_better(name: str) -> None:
    """At most 5 % of campaigns, and as few worse, but for what 200 of them count by chance."""
    _require_seldom_wrong(name, 200)


@pytest.mark.long
@pytest.mark.parametrize("name", NULLS)
def test_equal_candidates_are_seldom_called_better_in_2000_campaigns(name: str) -> None:
    """The same where chance counts at most 1 % more."""
    _require_seldom_wrong(name, 2000)


def test_ten_stretches_taken_for_independent_err_far_more_often() -> None:
    """Negative control: Student's t over ten stretches, whatever they have in common."""
    rng = np.random.default_rng(2)
    wrong = 0
    for _ in range(300):
        ((first, second),) = NULLS["slow 0.2 and constant"](rng)
        logs = 0.5 * np.log(
            [
                (a**2).sum() / (b**2).sum()
                for a, b in zip(*(np.array_split(e, 10) for e in (first, second)), strict=True)
            ]
        )
        wrong += logs.mean() + stdtrit(9, 0.975) * logs.std(ddof=1) / math.sqrt(10) < 0.0
    assert wrong / 300 > 0.1


@pytest.mark.long
def test_an_improvement_by_a_third_is_mostly_found() -> None:
    """Ten stretches whose log ratio scatters by .4, given or as recordings, and errors that soon forget themselves."""
    rng = np.random.default_rng(3)
    logs = math.log(2.0 / 3.0) + 0.4 * rng.normal(size=(2000, 10))
    better = [ratio_over([ten], [0.0], pooled=-1.0).conclusion == "better" for ten in logs]
    assert np.mean(better) >= 0.8
    assert _shares(_motions(2.0 / 3.0, 10), 200)["better"] >= 0.8
    for part in (0.02, 0.03):
        assert _shares(_by(2.0 / 3.0, _alike(part)), 200)["better"] >= 0.85


@some_cases("stretches", [4, 5, 6])
def test_a_large_improvement_is_found_in_few_stretches(stretches: int) -> None:
    """By a factor of 3, with a scatter of .4; never the wrong way round."""
    rng = np.random.default_rng(stretches)
    logs = -math.log(3.0) + 0.4 * rng.normal(size=(1000, stretches))
    judgements = [ratio_over([few], [0.0], pooled=-1.0).conclusion for few in logs]
    assert np.mean([conclusion == "better" for conclusion in judgements]) > 0.85
    assert "worse" not in judgements
    assert _shares(_motions(1.0 / 3.0, stretches), 100)["better"] > 0.85


@pytest.mark.long
def test_slow_errors_that_are_much_smaller_are_found() -> None:
    """By a factor of 3, where errors last for a tenth and a fifth of the recording."""
    assert _shares(_by(1.0 / 3.0, _alike(0.1)), 200)["better"] > 0.85
    assert _shares(_by(1.0 / 3.0, _alike(0.2)), 200)["better"] > 0.6


@pytest.mark.long
def test_equal_candidates_that_are_known_well_are_no_different() -> None:
    """White errors are; of slow ones the recording does not tell; a third less is neither."""
    assert _shares(NULLS["white"], 100)["no difference"] > 0.9
    assert _shares(NULLS["slow 0.2"], 100)["inconclusive"] > 0.85
    assert _shares(_by(2.0 / 3.0, _alike(0.0)), 100)["better"] == 1.0


def test_by_hand() -> None:
    """White errors, ten stretches: geometric mean of the ratios and Student's interval; exchanged it is inverse."""
    rng = np.random.default_rng(5)
    reference, first, second = rng.normal(size=(3, COUNT, 6))
    first[:, 3:] *= 2.0
    one = compare_errors([PairedErrors.of(first + reference, second + reference, reference)])
    other = compare_errors([PairedErrors.of(second, first, np.zeros_like(reference))])
    for axes, ratio, inverse in ((slice(0, 3), one.force, other.force), (slice(3, 6), one.moment, other.moment)):
        squares = [(errors[:, axes] ** 2).sum(axis=1).reshape(10, 100).mean(axis=1) for errors in (first, second)]
        logs = 0.5 * np.log(squares[0] / squares[1])
        assert ratio.segments == 10
        assert ratio.ratio == pytest.approx(math.exp(logs.mean()), abs=EXACT)
        half = math.log(ratio.high / ratio.ratio)
        assert half >= stdtrit(9, 0.975) * logs.std(ddof=1) / math.sqrt(10) - EXACT
        assert math.log(ratio.ratio / ratio.low) == pytest.approx(half, abs=EXACT)
        assert (1 / inverse.high, 1 / inverse.ratio, 1 / inverse.low) == pytest.approx(
            (ratio.low, ratio.ratio, ratio.high), abs=EXACT
        )
    assert one.count == COUNT
    assert (one.force.conclusion, one.moment.conclusion, other.moment.conclusion) == (
        "no difference",
        "worse",
        "better",
    )


def test_a_better_mean_ratio_does_not_outvote_larger_errors() -> None:
    """Smaller in every stretch but one in which it is far larger: the root mean square is larger, so not better."""
    logs = np.array([-1.0, -1.1, -0.9, -1.05, -0.95, -1.0, -1.1, -0.9, -1.0, -0.6])
    assert ratio_over([logs], [0.0], pooled=-0.5).conclusion == "better"
    assert ratio_over([logs], [0.0], pooled=0.1).conclusion == "inconclusive"


def test_samples_with_a_gap_in_either_are_left_out() -> None:
    """As if they had not been recorded; so is a recording that has no other."""
    rng = np.random.default_rng(6)
    first, second, reference = rng.normal(size=(3, COUNT, 6))
    kept = np.ones(COUNT, dtype=bool)
    kept[[3, 500, 501, 900]] = False
    expected = compare_errors([PairedErrors.of(first[kept], second[kept], reference[kept])])
    first[3, 0] = second[500:502, 4] = reference[900, 2] = np.nan
    gaps = PairedErrors.of(first, np.full_like(first, np.nan), reference)
    assert compare_errors([PairedErrors.of(first, second, reference), gaps]) == expected
    assert expected.count == COUNT - 4


@pytest.mark.parametrize("count", [1, 2, 300])
def test_what_never_changes_is_seen_once(count: int) -> None:
    """A single sample, and constant errors: the ratio, and no interval; the same errors are no different."""
    ratio = _judged([(np.full((count, 3), 1.0), np.full((count, 3), 3.0))])
    assert ratio.ratio == pytest.approx(1.0 / 3.0, abs=EXACT)
    assert (ratio.low, ratio.high, ratio.segments) == (0.0, math.inf, 1)
    assert ratio.conclusion == "inconclusive"
    for level in (0.0, 2.0):
        same = _judged([(np.full((count, 3), level), np.full((count, 3), -level))])
        assert (same.ratio, same.low, same.high, same.conclusion) == (1.0, 1.0, 1.0, "no difference")


def test_identical_candidates_are_exactly_no_different() -> None:
    """Whatever their errors are."""
    errors = _process(0.2, np.random.default_rng(7))
    same = _judged([(errors, errors.copy())])
    assert (same.ratio, same.low, same.high, same.conclusion) == (1.0, 1.0, 1.0, "no difference")


def test_errors_of_zero_have_a_ratio() -> None:
    """Throughout, in some samples, and in a half; nothing is divided by zero."""
    errors = _process(0.0, np.random.default_rng(8))
    assert _judged([(np.zeros_like(errors), errors)]).conclusion == "better"
    assert _judged([(errors, np.zeros_like(errors))]).conclusion == "worse"
    some, half = errors.copy(), errors.copy()
    some[::2] = half[: COUNT // 2] = 0.0
    assert _judged([(some, errors)]).conclusion == "better"
    ratio = _judged([(half, errors)])
    assert ratio.conclusion == "inconclusive"
    assert math.isfinite(ratio.ratio)


def test_a_level_of_a_recording_counts_once_however_long_it_is() -> None:
    """Four recordings, two better and two worse by as much: not told apart, though each is clear in itself."""
    rng = np.random.default_rng(9)
    pairs = [(factor * _process(0.0, rng), _process(0.0, rng)) for factor in (0.5, 0.6, 1.4, 1.6)]
    assert {_judged([pair]).conclusion for pair in pairs} == {"better", "worse"}
    together = _judged(pairs)
    assert (together.conclusion, together.segments) == ("inconclusive", 40)
    assert together.high / together.low > 2.0


def test_bad_input_is_refused() -> None:
    """Other shapes, and nothing that is whole."""
    good = np.zeros((5, 6))
    with pytest.raises(ShapeError, match="reference: expected an array of shape"):
        PairedErrors.of(good, good, np.zeros(6))
    with pytest.raises(ShapeError, match="second: expected an array of shape"):
        PairedErrors.of(good, good[:4], good)
    with pytest.raises(ShapeError, match="expected at least one sample in which everything is finite, got none"):
        compare_errors([PairedErrors.of(good, np.full((5, 6), np.nan), good)])
    with pytest.raises(ShapeError, match="got none"):
        compare_errors([])
