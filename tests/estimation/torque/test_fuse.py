# SPDX-License-Identifier: BSD-3-Clause
"""Fused torques are those of least squares, intervals hold, and the source in conflict is named at the stated rate."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from forcetorque.base.errors import EstimationError
from forcetorque.estimation.section import FusionTable
from forcetorque.estimation.torque.covariance_fusion import (
    FALSE_ALARM as DEFAULT_FALSE_ALARM,
    WINDOW_S,
    Disagreement,
    Innovation,
    WindowMeans,
    combined,
    disagreement,
    fuse,
    inverse_of_known,
    means_in_windows,
)
from forcetorque.estimation.torque.torque_source import TorqueSource
from tests.estimation.torque.sources import JOINTS, SAMPLES, shifted, source, stamps, three, truth

EXACT = 1e-9
"""Rounding of sums over some hundred samples whose variances differ by a factor of 40."""
SEEDS = range(100, 160)
SHORT = 160
"""Samples of one of many recordings."""
FALSE_ALARM = 0.1
"""A rate that sixty recordings tell."""


def _single(name: str, values: list[float], variance: float) -> TorqueSource:
    n = len(values)
    return TorqueSource(
        name=name,
        joints=("knee",),
        stamp_ns=np.arange(n),
        torque=np.array(values)[:, None],
        noise=np.full((n, 1, 1), variance),
        lasting=np.zeros((n, 1, 0)),
    )


def test_two_numbers_by_hand() -> None:
    """Weights 1 and 1/4: (1 + 3/4) / (5/4) = 1.4, of variance 4/5; where one says nothing, the other is it."""
    fusion = fuse([_single("a", [1.0, 2.0], 1.0), _single("b", [3.0, np.nan], 4.0)])
    np.testing.assert_allclose(fusion.torque[:, 0], [1.4, 2.0], atol=EXACT)
    np.testing.assert_allclose(fusion.covariance[:, 0, 0], [0.8, 1.0], atol=EXACT)
    assert fusion.half_width[0, 0] == pytest.approx(1.96 * np.sqrt(0.8), rel=1e-3)


@pytest.mark.parametrize("eigenvalue", [0.01, 0.95, 1.05, 100.0])
def test_parts_of_an_innovation_by_the_eigenvalue_of_what_lasts(eigenvalue: float) -> None:
    """Two sources of one torque over 20 windows, a lasting error of one: its square by hand, in one part or two.

    With d the differences, l the lasting error over the noise of d and h = l.l, below h = 1 all of
    `d (1 + l l')^-1 d` passes; above, `(l.d)^2 / (h (h + 1))` lasts and `d.d - (l.d)^2 / h` passes.
    """
    rng = np.random.default_rng(6)
    lasting = rng.uniform(1.0, 2.0, 20)
    lasting *= np.sqrt(eigenvalue / (lasting @ lasting))
    difference = rng.normal(size=20) + lasting
    noise = np.full((20, 1, 1), 0.5)
    first = WindowMeans(torque=difference[:, None], noise=noise, lasting=lasting[:, None, None])
    second = WindowMeans(torque=np.zeros((20, 1)), noise=noise, lasting=np.zeros((20, 1, 0)))
    found, h = disagreement([first, second]), lasting @ lasting
    together = difference @ np.linalg.solve(np.eye(20) + np.outer(lasting, lasting), difference)
    if h < 1.0:
        parts = (0.0, 0, together, 20)
    else:
        share = (lasting @ difference) ** 2 / h
        parts = (share / (h + 1.0), 1, difference @ difference - share, 19)
    lasts, passes = found.lasting, found.passing
    assert (lasts.degrees_of_freedom, passes.degrees_of_freedom) == (parts[1], parts[3])
    np.testing.assert_allclose([lasts.chi2, passes.chi2], [parts[0], parts[2]], rtol=1e-9)
    assert lasts.chi2 + passes.chi2 == pytest.approx(together)


def test_where_nobody_knows_there_is_nothing() -> None:
    """A gap of all sources is a gap."""
    fusion = fuse([_single("a", [1.0, np.nan], 1.0), _single("b", [3.0, np.nan], 4.0)])
    assert np.isnan(fusion.torque[1, 0])
    assert np.isfinite(fusion.torque[0, 0])


def test_sources_in_any_order_and_unit_give_the_same() -> None:
    """Order does not matter, and N mm instead of N m changes nothing but the numbers."""
    sources = three(1)
    fusion, turned = fuse(sources), fuse(sources[::-1])
    np.testing.assert_allclose(turned.torque, fusion.torque, atol=EXACT)
    small = [replace(one, torque=1e3 * one.torque, noise=1e6 * one.noise, lasting=1e3 * one.lasting) for one in sources]
    np.testing.assert_allclose(fuse(small).torque, 1e3 * fusion.torque, atol=1e3 * EXACT)
    assert fuse(small).conflict.everyone.total.chi2 == pytest.approx(fusion.conflict.everyone.total.chi2)


def test_means_of_windows_are_over_what_all_sources_know() -> None:
    """By hand: 10 and 30 of a window in which another source lacks the middle; noise and lasting errors likewise."""
    first = replace(
        _single("a", [10.0, 20.0, 30.0, 7.0, np.nan], 6.0),
        stamp_ns=np.arange(5) * 100_000_000,
        lasting=np.array([1.0, 5.0, 2.0, 4.0, 9.0])[:, None, None],
    )
    second = replace(_single("b", [1.0, np.nan, 3.0, 5.0, 6.0], 4.0), stamp_ns=first.stamp_ns)
    mine, other = means_in_windows([first, second], 0.3)
    np.testing.assert_allclose(mine.torque[:, 0], [20.0, 7.0], rtol=EXACT)
    np.testing.assert_allclose(other.torque[:, 0], [2.0, 5.0], rtol=EXACT)
    np.testing.assert_allclose(mine.noise[:, 0, 0], [6.0 / 2.0, 6.0], rtol=EXACT)
    np.testing.assert_allclose(mine.lasting[:, 0, 0], [1.5, 4.0], rtol=EXACT)
    # noise that repeats itself for half a period makes two samples as good as one, and never more than there are
    slow = replace(second, noise_time_s=0.05)
    np.testing.assert_allclose(means_in_windows([first, slow], 0.3)[1].noise[:, 0, 0], [4.0, 4.0], rtol=EXACT)
    slower = replace(second, torque=np.arange(5.0)[:, None], noise_time_s=0.05)
    np.testing.assert_allclose(means_in_windows([slower], 0.3)[0].noise[:, 0, 0], [8.0 / 3.0, 4.0], rtol=EXACT)
    # two samples have a period too: 1 + 2 * 0.02 / 0.1 of them are as good as one
    pair = replace(_single("b", [1.0, 3.0], 4.0), stamp_ns=first.stamp_ns[:2], noise_time_s=0.02)
    np.testing.assert_allclose(means_in_windows([pair], 0.3)[0].noise[:, 0, 0], [1.4 * 4.0 / 2.0], rtol=EXACT)


def test_a_source_that_knows_less_than_half_of_a_window_has_no_mean_in_it() -> None:
    """One of three samples: no mean, and the mean of the other is over all three; of two of three both have one."""
    first = replace(_single("a", [1.0, 2.0, 6.0], 1.0), stamp_ns=np.arange(3) * 100_000_000)
    for torque, means in (([np.nan, 4.0, np.nan], (3.0, np.nan)), ([3.0, np.nan, 5.0], (3.5, 4.0))):
        second = replace(first, name="b", torque=np.array(torque)[:, None])
        got = [one.torque[:, 0] for one in means_in_windows([first, second], 0.3)]
        np.testing.assert_allclose(got, np.array(means)[:, None], rtol=EXACT)


def test_the_time_of_day_changes_nothing() -> None:
    """Stamps since 1970 give the windows of stamps since the start of the recording."""
    sources = three(1)
    late = [replace(one, stamp_ns=one.stamp_ns + 1_700_000_000_123_456_789) for one in sources]
    for mine, other in zip(means_in_windows(sources, 1.0), means_in_windows(late, 1.0), strict=True):
        np.testing.assert_array_equal(mine.torque, other.torque)


def test_a_window_is_judged_as_a_recording_of_that_window_alone() -> None:
    """Its innovations are those of its own samples and of no others."""
    sources = three(3)
    windows = fuse(sources).windows
    rows_of = np.arange(SAMPLES) // 20
    assert len(windows) == rows_of.max() + 1
    for k, window in enumerate(windows):
        rows = rows_of == k
        alone = fuse(
            [
                replace(one, **{name: getattr(one, name)[rows] for name in ("stamp_ns", "torque", "noise", "lasting")})
                for one in sources
            ]
        )
        assert window.everyone.total.chi2 == pytest.approx(alone.conflict.everyone.total.chi2)
        assert window.everyone.total.degrees_of_freedom == alone.conflict.everyone.total.degrees_of_freedom == 4


def test_fused_torques_are_those_of_generalised_least_squares() -> None:
    """Sample by sample from one covariance of all that is known: noise of each source and errors that all share."""
    rng = np.random.default_rng(12)
    n, joints, errors = 4, 3, 2
    roots = rng.normal(size=(3, n, joints, joints))
    covariances = roots @ roots.swapaxes(2, 3) + 0.2 * np.eye(joints)
    values, shared = rng.normal(size=(3, n, joints)), rng.normal(size=(3, n, joints, errors))
    values[0, 1, 2] = values[:, 2, 0] = values[1, 3] = np.nan
    torque, covariance = combined(list(values), list(covariances), list(shared))
    for k in range(n):
        known = np.isfinite(values[:, k])
        design = np.concatenate([np.eye(joints)[mask] for mask in known])
        common = np.concatenate([columns[k][mask] for columns, mask in zip(shared, known, strict=True)])
        whole = common @ common.T
        ends = np.cumsum([0, *known.sum(axis=1)])
        for first, last, one, mask in zip(ends, ends[1:], covariances[:, k], known, strict=False):
            whole[first:last, first:last] += one[np.ix_(mask, mask)]
        some = known.any(axis=0)
        gain = design[:, some].T @ np.linalg.inv(whole)
        expected = np.linalg.inv(gain @ design[:, some])
        np.testing.assert_allclose(covariance[k][np.ix_(some, some)], expected, rtol=EXACT, atol=EXACT)
        np.testing.assert_allclose(torque[k, some], expected @ gain @ values[:, k][known], rtol=EXACT, atol=EXACT)
        assert np.isnan(torque[k, ~some]).all()
        assert np.isnan(covariance[k][~some]).all()


def test_the_options_of_a_file_are_those_of_the_function() -> None:
    """Rate of false alarms and length of windows are the same where neither states them."""
    table = FusionTable(model_deviation=0.1)
    assert (table.false_alarm, table.window_s) == (DEFAULT_FALSE_ALARM, WINDOW_S)


def test_weights_are_inverted_where_something_is_known() -> None:
    """The inverse of the block that is known, and zero elsewhere."""
    block = np.array([[2.0, 0.5], [0.5, 1.0]])
    weights = np.zeros((2, 3, 3))
    weights[0, 1:, 1:] = block
    unknown = np.array([[True, False, False], [True, True, True]])
    expected = np.zeros((2, 3, 3))
    expected[0, 1:, 1:] = np.linalg.inv(block)
    np.testing.assert_allclose(inverse_of_known(weights, unknown), expected, atol=EXACT)


def test_a_source_need_not_say_how_far_off_nothing_is() -> None:
    """Noise of a joint that it does not know may be anything; negative control: of one that it knows it may not."""
    known = three(2, samples=4)[0]
    torque, noise = known.torque.copy(), known.noise.copy()
    torque[1, 0] = np.nan
    noise[1, 0] = noise[1, :, 0] = np.nan
    assert np.isnan(replace(known, torque=torque, noise=noise).torque[1, 0])
    with pytest.raises(EstimationError, match="sample 1: noise: expected a symmetric covariance"):
        replace(known, noise=noise)


def _dense(sources: list[TorqueSource], window_s: float = 1.0) -> tuple[float, int]:
    """The same sum from one large covariance of all means, torques eliminated by the sources' differences."""
    means = means_in_windows(sources, window_s)
    windows = len(means[0].torque)
    blocks = []
    for one in means:
        lasting = one.lasting.reshape(windows * 2, -1)
        covariance = lasting @ lasting.T
        for k in range(windows):
            covariance[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] += one.noise[k]
        blocks.append(covariance)
    first = means[0].torque.ravel()
    apart = np.concatenate([one.torque.ravel() - first for one in means[1:]])
    size = windows * 2
    whole = np.kron(np.ones((len(means) - 1, len(means) - 1)), blocks[0])
    for k, block in enumerate(blocks[1:]):
        whole[k * size : (k + 1) * size, k * size : (k + 1) * size] += block
    return float(apart @ np.linalg.solve(whole, apart)), len(apart)


def test_innovations_are_those_of_the_whole_covariance() -> None:
    """Elimination of torques and lasting errors gives what one large covariance gives; the parts are its whole."""
    sources = three(2)
    told = disagreement(means_in_windows(sources, 1.0)).total
    square, count = _dense(sources)
    assert told.degrees_of_freedom == count
    assert told.chi2 == pytest.approx(square, rel=1e-6)
    # negative control: another sign of one source is another sum
    turned = [replace(sources[0], torque=-sources[0].torque), *sources[1:]]
    assert disagreement(means_in_windows(turned, 1.0)).total.chi2 != pytest.approx(square, rel=1e-2)


def test_the_innovation_of_a_source_is_what_the_whole_covariance_has_more_with_it() -> None:
    """Sum and degrees of freedom, from one large covariance with the source and one without it."""
    sources = three(4)
    conflict = fuse(sources).conflict
    square, count = _dense(sources)
    for one in sources:
        rest, fewer = _dense([other for other in sources if other is not one])
        innovation = conflict.innovation(one.name)
        assert innovation.chi2 == pytest.approx(square - rest, rel=1e-6)
        assert innovation.degrees_of_freedom == count - fewer == 2 * SAMPLES // 20


def _held(fault: str | None) -> tuple[float, int]:
    """Share of intervals that hold the truth, and how often the broken source was named."""
    inside, named = [], 0
    for seed in SEEDS:
        fusion = fuse([shifted(one, 1.5) if one.name == fault else one for one in three(seed, SHORT)])
        inside.append(np.abs(fusion.torque - truth(SHORT)) <= fusion.half_width)
        named += fusion.conflict.source == fault
    return float(np.mean(inside)), named


@pytest.mark.long
@pytest.mark.parametrize("fault", [None, "ft"])
def test_intervals_hold_the_truth(fault: str | None) -> None:
    """60 recordings with two offsets that hardly change: 95 %, of which 2 % are the standard error."""
    share, named = _held(fault)
    assert 0.90 < share < 0.98
    # of those without a false alarm among the others, all
    assert named >= 0.9 * len(SEEDS)


@pytest.mark.long
def test_the_rate_of_false_alarms_is_as_stated() -> None:
    """Lasting innovations are those of chi-squared, and conflicts are no more frequent than asked for."""
    squares, degrees, alarms = [], [], 0
    for seed in SEEDS:
        conflict = fuse(three(seed, SHORT), false_alarm=FALSE_ALARM).conflict
        squares.append(conflict.everyone.lasting.chi2)
        degrees.append(conflict.everyone.lasting.degrees_of_freedom)
        alarms += conflict.is_there
    low, high = chi2.ppf([0.001, 0.999], sum(degrees))
    assert low < sum(squares) < high
    # 6 expected at most, 13 or more have a probability below 0.005
    assert alarms <= 12


@pytest.mark.parametrize("name", ["ft", "skin", "current"])
def test_a_broken_source_is_named_and_left_out(name: str) -> None:
    """An error of five standard deviations and more; the others are fused as if it were not there."""
    sources = three(7)
    broken = [shifted(one, 1.5) if one.name == name else one for one in sources]
    fusion = fuse(broken)
    assert fusion.conflict.source == name
    others = fuse([one for one in sources if one.name != name])
    np.testing.assert_allclose(fusion.torque, others.torque, atol=EXACT)
    innovations = {one.name: fusion.conflict.innovation(one.name).chi2 for one in sources}
    assert max(innovations, key=lambda source: innovations[source]) == name


def test_a_sound_recording_has_no_conflict() -> None:
    """Negative control, and all sources are used."""
    fusion = fuse(three(7))
    assert not fusion.conflict.is_there
    assert fusion.used == ("ft", "skin", "current")


def test_windows_tell_when() -> None:
    """An error in the second half is named there and not before."""
    sources = three(8)
    late = np.arange(SAMPLES)[:, None] >= SAMPLES // 2
    sources[0] = replace(sources[0], torque=sources[0].torque + 3.0 * late)
    named = [window.source for window in fuse(sources).windows]
    half = len(named) // 2
    assert half == 10
    assert named[:half].count("ft") == 0
    assert named[half:].count("ft") > half // 2


def test_of_two_sources_nobody_is_named() -> None:
    """They disagree, both are suspected and used, and the intervals grow by what they disagree."""
    ft, skin, _ = three(9)
    agreed, fusion = fuse([ft, skin]), fuse([shifted(ft, 3.0), skin])
    assert fusion.conflict.is_there
    assert fusion.conflict.source is None
    assert fusion.conflict.suspects == ("ft", "skin")
    assert fusion.used == ("ft", "skin")
    assert (fusion.half_width > agreed.half_width).all()


@pytest.mark.parametrize(("noise", "widens"), [(1.0, True), (16.0, False)])
def test_a_conflict_widens_the_covariance_by_the_mean_squared_innovation(noise: float, widens: bool) -> None:
    """And never narrows it: an offset beside noise that is less than specified leaves less than 1 on average."""
    ft, skin = (replace(one, noise=noise * one.noise) for one in three(9)[:2])
    agreed, fusion = fuse([ft, skin]), fuse([shifted(ft, 1.2), skin])
    assert (agreed.conflict.is_there, fusion.conflict.is_there, fusion.conflict.source) == (False, True, None)
    ratio = fusion.conflict.everyone.total.ratio
    assert (ratio > 1.0) == widens
    np.testing.assert_allclose(fusion.covariance, agreed.covariance * (ratio if widens else 1.0), rtol=EXACT)


def _with_model_error(seed: int, deviation: float, by_model: tuple[str, ...]) -> list[TorqueSource]:
    """Sources of which some use a robot model that is off by one error per joint."""
    rng = np.random.default_rng(seed)
    shared = np.broadcast_to(deviation * np.eye(2), (SHORT, 2, 2))
    error = shared @ rng.standard_normal(2)
    return [
        replace(one, torque=one.torque + error, shared=shared) if one.name in by_model else one
        for one in three(seed, SHORT)
    ]


@pytest.mark.long
@pytest.mark.parametrize("deviation", [pytest.param(0.05, marks=pytest.mark.long), 1.0])
@pytest.mark.parametrize("by_model", [pytest.param(("ft", "skin"), marks=pytest.mark.long), ("ft", "skin", "current")])
def test_intervals_hold_where_sources_share_the_error_of_the_model(deviation: float, by_model: tuple[str, ...]) -> None:
    """120 draws of two joints, errors small and large against the sources' own; 90 to 99 % of intervals."""
    inside, squares, apart = [], [], []
    for seed in range(300, 420):
        sources = _with_model_error(seed, deviation, by_model)
        fusion = fuse(sources)
        inside.append(np.abs(fusion.torque - truth(SHORT)) <= fusion.half_width)
        squares.append(np.mean((fusion.torque - truth(SHORT)) ** 2))
        apart.append(np.mean((fuse([one.independent for one in sources]).torque - truth(SHORT)) ** 2))
    assert 0.90 < np.mean(inside) < 0.99
    # the point is no worse than that of the same sources taken as independent
    assert np.mean(squares) < 1.02 * np.mean(apart)


def test_a_shared_error_is_not_averaged_and_own_errors_are() -> None:
    """By hand: of two sources with variance 1 each the mean has 1/2, and a shared variance of 4 stays 4."""
    first, second = _single("a", [1.0], 1.0), _single("b", [3.0], 1.0)
    shared = np.full((1, 1, 1), 2.0)
    fusion = fuse([replace(first, shared=shared), replace(second, shared=shared)])
    assert fusion.torque[0, 0] == pytest.approx(2.0)
    assert fusion.covariance[0, 0, 0] == pytest.approx(4.5)
    # negative control: errors that sources have alone average out
    assert fuse([first, second]).covariance[0, 0, 0] == pytest.approx(0.5)
    assert fuse([_single("a", [1.0], 5.0), _single("b", [3.0], 5.0)]).covariance[0, 0, 0] == pytest.approx(2.5)
    # a third source without that error is worth more than both: 1 / (1 / 4.5 + 1)
    assert fuse([replace(first, shared=shared), replace(second, shared=shared), _single("c", [2.0], 1.0)]).covariance[
        0, 0, 0
    ] == pytest.approx(1.0 / (1.0 / 4.5 + 1.0))
    with pytest.raises(EstimationError, match="shared: expected the same errors in all sources"):
        fuse([replace(first, shared=shared), replace(second, shared=np.ones((1, 1, 2)))])


def test_one_source_is_itself() -> None:
    """Nothing to compare: its torques, and its covariance."""
    (ft, *_) = three(1)
    fusion = fuse([ft])
    np.testing.assert_allclose(fusion.torque, ft.torque, atol=EXACT)
    np.testing.assert_allclose(fusion.covariance, ft.covariance, atol=EXACT)
    assert not fusion.conflict.is_there
    assert fusion.conflict.everyone.total.probability == 1.0


def test_a_covariance_without_parts_stays_what_it_is() -> None:
    """Noise and what lasts add up to it."""
    rng = np.random.default_rng(4)
    roots = rng.standard_normal((SAMPLES, 2, 2))
    covariance = roots @ roots.transpose(0, 2, 1) + 0.1 * np.eye(2)
    one = TorqueSource.of_covariance("skin", JOINTS, stamps(), truth(), covariance, noise_share=0.25)
    np.testing.assert_allclose(one.covariance, covariance, atol=EXACT)
    np.testing.assert_allclose(one.noise, 0.25 * covariance)
    for share in (0.0, 1.01):
        with pytest.raises(EstimationError, match="noise_share: expected above 0"):
            TorqueSource.of_covariance("skin", JOINTS, stamps(), truth(), covariance, noise_share=share)


def test_noise_that_repeats_itself_is_no_conflict() -> None:
    """Noise of half a second averages out less; said so, it is none, and unsaid it is one."""
    rng = np.random.default_rng(5)
    ft = source("ft", rng, noise=0.05, offset=0.0)
    slow = source("current", rng, noise=0.3, offset=0.0)
    held = np.repeat((slow.torque - truth())[::10], 10, axis=0)
    slow = replace(slow, torque=truth() + held)
    assert fuse([ft, slow]).conflict.is_there
    assert not fuse([ft, replace(slow, noise_time_s=0.25)]).conflict.is_there


@pytest.mark.parametrize("variance", [0.0, -1.0, np.nan])
def test_a_variance_that_is_none_is_refused(variance: float) -> None:
    """With the source and the sample."""
    ft, *_ = three(1)
    noise = np.array(ft.noise)
    noise[3] = np.diag([1.0, variance])
    with pytest.raises(EstimationError, match="source 'ft', sample 3: noise: expected a symmetric covariance"):
        replace(ft, noise=noise)
    # where it says nothing, it need not say how far off that is
    torque = np.array(ft.torque)
    torque[3, 1] = np.nan
    assert len(replace(ft, noise=noise, torque=torque)) == SAMPLES


def test_sources_at_different_instants_are_refused() -> None:
    """With both names, where, and how far apart."""
    ft, skin, _ = three(1)
    late = replace(skin, stamp_ns=skin.stamp_ns + 2_000_000)
    with pytest.raises(EstimationError, match="'ft' and 'skin', sample 0: expected the same instants, .* 0.002000 s"):
        fuse([ft, late])
    with pytest.raises(EstimationError, match="expected the same instants, got 400 and 200"):
        fuse([ft, three(1, samples=200)[1]])


def test_other_joints_names_and_options_are_refused() -> None:
    """Each says what was expected."""
    ft, skin, _ = three(1)
    with pytest.raises(EstimationError, match="expected the same joints"):
        fuse([ft, replace(skin, joints=("hip", "knee"))])
    with pytest.raises(EstimationError, match="different names"):
        fuse([ft, replace(skin, name="ft")])
    with pytest.raises(EstimationError, match="false_alarm"):
        fuse([ft, skin], false_alarm=0.0)
    with pytest.raises(EstimationError, match="false_alarm"):
        fuse([ft, skin], false_alarm=1.0)
    with pytest.raises(EstimationError, match="instants that increase"):
        replace(ft, stamp_ns=ft.stamp_ns[::-1])
    with pytest.raises(EstimationError, match="noise_time_s"):
        replace(ft, noise_time_s=np.inf)


@pytest.mark.parametrize(("lasting", "passing", "alarm"), [(0.99, 0.99, False), (1.01, 0.99, True), (0.99, 1.01, True)])
def test_an_alarm_is_at_the_quantile_of_each_part(lasting: float, passing: float, alarm: bool) -> None:
    """Of two independent parts together 1 %; what passes may be larger by a quarter, which lags of sources make."""
    quantile = chi2.ppf(np.sqrt(0.99), [3, 40])
    parts = Disagreement(
        lasting=Innovation(chi2=float(lasting * quantile[0]), degrees_of_freedom=3),
        passing=Innovation(chi2=float(1.25 * passing * quantile[1]), degrees_of_freedom=40),
    )
    assert parts.alarms(0.01) == alarm
