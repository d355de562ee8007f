# SPDX-License-Identifier: BSD-3-Clause
"""Thermal pads that follow heat later or sooner than their taxels: the lag is found, made up for, or refused."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import TYPE_CHECKING, cast

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SkinError
from forcetorque.skin.contact.contact_tracking import PatchFollower
from forcetorque.skin.contact.pressure_frame import PatchReader
from forcetorque.skin.simulation.temperature import Warmth
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PressureTable
from forcetorque.skin.temperature.pad_lags import LAGS_S, PadFilter, _lag, _squares, lagged, pad_lags
from forcetorque.skin.temperature.taxel_temperature_drift import HeatGains, WarmUp
from forcetorque.skin.temperature.warm_up_calibration import _warnings, fit_warm_up
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from tests.scenes.warmed import WARM_UP, WarmShank, counts_of, late_pads
from tests.skin.contact_trials import chamber_table

if TYPE_CHECKING:
    from forcetorque.skin.patches_of_experiment import ExperimentPatch

SHANK = WarmShank.drawn()
LAYOUT = SHANK.layout
PATCH = SkinPatch.of(LAYOUT)
HELD = replace(WARM_UP, hold_s=120.0)
"""Heat as in the warm-up."""
HEAT_N = 0.5
"""A contact of two taxels just awake."""
TRUE_N = float(np.linalg.norm(SHANK.truth.wrench[:3]))
LAG_S = 15.0
RATE_HZ = 10


def _learned(lag_s: float) -> WarmUp:
    return fit_warm_up("warm", *counts_of(late_pads(SHANK, WARM_UP, lag_s)), LAYOUT)


def _shifted(rows: int) -> tuple[FloatArray, FloatArray]:
    """The warm-up with pads that are so many messages late."""
    seconds, counts = counts_of(SHANK.recorded(replace(WARM_UP, rest_s=60.0)))
    pads = counts[:, LAYOUT.thermal_pads]
    counts[:, LAYOUT.thermal_pads] = pads[np.clip(np.arange(len(pads)) - rows, 0, len(pads) - 1)]
    return seconds, counts


def _contacts(table: PressureTable, heat: HeatGains, lag_s: float, *, touched: bool) -> FloatArray:
    """Norm of the force of every frame of a second in the two minutes of heat."""
    seconds, counts = counts_of(late_pads(SHANK, HELD, lag_s, touched=touched, seed=11))
    follower = PatchFollower(PATCH, PatchReader.at_rest(table, counts[seconds < HELD.rest_s]), heat)
    starts = range(0, len(seconds) - 9, RATE_HZ)
    found = [follower.frame(float(seconds[k]), counts[k : k + RATE_HZ])[1] for k in starts]
    return np.array([np.linalg.norm(contacts.wrench[:, :3].sum(axis=0)) for contacts in found])


@pytest.fixture(scope="module", name="table")
def calibrated_table() -> PressureTable:
    """Pressures by counts, fitted in a chamber."""
    table = chamber_table(SHANK.taxels, np.random.default_rng(1), both_ways=False)
    return replace(table, columns=LAYOUT.columns, taxels=LAYOUT.taxels)


@pytest.fixture(scope="module", name="late")
def learned_late() -> WarmUp:
    """Learned from pads that lag."""
    return _learned(LAG_S)


def test_the_lag_is_found_and_gains_are_true(late: WarmUp) -> None:
    """Within a second and a half for each pad, and 2 % in the median; gains without a lag would be 8 % too small."""
    gains = HeatGains.learned(late.taxels)
    np.testing.assert_allclose(gains.lags, LAG_S, atol=1.5)
    own = np.stack([np.flatnonzero(LAYOUT.thermal_modules == module) for module in LAYOUT.modules])
    true = SHANK.heat.taxels[:, None] / SHANK.heat.pads[own]
    told = np.array([[gain.gain for gain in one.gains] for one in late.taxels])
    assert np.median(told / true) == pytest.approx(1.0, abs=0.02)


def test_pads_that_do_not_lag_have_no_lag() -> None:
    """Not one of them."""
    assert not HeatGains.learned(_learned(0.0).taxels).lags.any()


def test_one_late_pad_is_told_from_the_others() -> None:
    """It has its own lag, the others none."""
    seconds, counts = counts_of(SHANK.recorded(WARM_UP))
    pad = LAYOUT.thermal_pads[4]
    counts[:, pad] = counts_of(late_pads(SHANK, WARM_UP, 30.0))[1][:, pad]
    lags = HeatGains.learned(fit_warm_up("warm", seconds, counts, LAYOUT).taxels).lags
    assert lags[4] == pytest.approx(30.0, abs=6.0)
    assert not np.delete(lags, 4).any()


def test_pads_that_lead_are_held_back() -> None:
    """They feel heat before the taxels do, which is said in number and in seconds."""
    learned = fit_warm_up("warm", *_shifted(-15 * RATE_HZ), LAYOUT)
    lags = HeatGains.learned(learned.taxels).lags
    assert np.median(lags) == pytest.approx(-LAG_S, abs=4.0)
    assert (lags < 0.0).all()
    patch = cast("ExperimentPatch", SimpleNamespace(taxels=range(len(learned.taxels))))
    (words,) = (one for one in _warnings(learned, patch) if "feel heat" in one)
    assert f"0 of {len(lags)} thermal pads feel heat later than their taxels and {len(lags)} sooner, by -" in words


def test_a_delay_that_no_trend_makes_up_for_is_refused() -> None:
    """Pads that say nothing for 40 s."""
    with pytest.raises(SkinError, match=r"got pads that leave over 2.5 counts of \d+ taxels, .* with a lag of \d\d s"):
        fit_warm_up("warm", *_shifted(40 * RATE_HZ), LAYOUT)


def test_late_pads_make_no_contacts(table: PressureTable, late: WarmUp) -> None:
    """Negative control: with gains of the same pads and no lag, heat reads as force from its first seconds on."""
    heat = HeatGains.learned(late.taxels)
    none = np.zeros(len(heat.lags))
    without = replace(heat, lags=none, unexplained=np.zeros(len(LAYOUT)))
    assert np.count_nonzero(_contacts(table, without, LAG_S, touched=False)) > 60
    with_lag = _contacts(table, heat, LAG_S, touched=False)
    assert np.count_nonzero(with_lag) <= 3
    assert with_lag.max() < HEAT_N


def test_a_contact_is_found_all_the_same(table: PressureTable, late: WarmUp) -> None:
    """Its force is right but for its first half minute, in which the heat begins too."""
    forces = _contacts(table, HeatGains.learned(late.taxels), LAG_S, touched=True)
    held = forces[int(HELD.rest_s) + 1 :]
    assert (held > 0.8 * TRUE_N).all()
    assert np.abs(held[30:] - TRUE_N).max() < 1.2
    assert not forces[: int(HELD.rest_s)].any()


@pytest.mark.parametrize("lag", [5.0, 15.0, 40.0])
def test_the_filter_makes_up_for_a_ramp(lag: float) -> None:
    """Frames of a quarter of a second and of four; a pad that leads is held back by as much."""
    for passed in (0.25, 4.0):
        times = np.arange(0.0, 600.0, passed)
        pads = PadFilter(np.array([lag, -lag]))
        told = np.array([pads.follow(passed, 0.1 * (time - np.array([lag, -lag]))) for time in times])
        np.testing.assert_allclose(told[-1], 0.1 * times[-1], atol=0.1 * passed)


@pytest.mark.parametrize("passed", [0.2, 1.0])
def test_the_noise_of_the_filter_is_predicted(passed: float) -> None:
    """White noise leaves a linear filter with the root of the sum of its squared impulse response."""
    lags = np.array([0.0, 5.0, 15.0, 40.0])
    pads = PadFilter(lags)
    pads.follow(passed, np.zeros(4))
    impulse = (np.ones(4), *np.zeros((2000, 4)))
    response = np.array([pads.follow(passed, reading) for reading in impulse])
    predicted = pads.noise(passed, np.full(4, 0.3))
    assert predicted[0] == 0.0
    np.testing.assert_allclose(predicted[1:], 0.3 * np.sqrt((response**2).sum(axis=0))[1:], rtol=1e-9)


def test_an_old_calibration_has_no_lags() -> None:
    """What was written before lags were learned is read as if there were none."""
    heat = {"gains": ({"pad": 3, "gain": 1.0, "sd": 0.1},), "misfit_counts": 0.1, "rate_counts_per_s": 0.1}
    old = WarmUp.model_validate({"experiment": "w", "seconds": 300.0, "pad_change_counts": 9.0, "taxels": (heat,)})
    gains = HeatGains.learned(old.taxels)
    assert gains.lags.tolist() == [0.0]
    assert gains.unexplained.tolist() == [0.0]


def test_warmth_is_that_of_the_scene() -> None:
    """Late pads reach what prompt ones do."""
    warm = Warmth(hold_s=600.0, inside_s=60.0)
    ends = [counts_of(late_pads(SHANK, warm, lag))[1][-50:, LAYOUT.thermal_pads].mean(axis=0) for lag in (0.0, 15.0)]
    np.testing.assert_allclose(ends[0], ends[1], atol=0.7)


@pytest.mark.parametrize("lag", [-30.0, -10.0, 0.0])
def test_pads_that_do_not_lag_are_averaged_by_a_first_order_lag(lag: float) -> None:
    """Of 2 s, or of as long as they lead: a step follows the exponential."""
    constant = max(2.0, -lag)
    pads = PadFilter(np.array([lag]))
    pads.follow(0.5, np.zeros(1))
    told = np.array([pads.follow(0.5, np.ones(1))[0] for _ in range(100)])
    np.testing.assert_allclose(told, 1.0 - np.exp(-0.5 * np.arange(1, 101) / constant), rtol=1e-9)


def test_pads_that_lag_are_averaged_and_continued() -> None:
    """Twice over 1.25 sqrt(lag), and the trend makes up for the lag: a filter of two equal poles, by its first step."""
    lags, passed = np.array([4.0, 16.0, 64.0]), 0.1
    constants = 1.25 * np.sqrt(lags)
    pads = PadFilter(lags)
    pads.follow(passed, np.zeros(3))
    share = 1.0 - np.exp(-passed / constants)
    behind = passed * (1.0 - share) / share
    expected = share + (1.0 + lags / behind) * share * (1.0 - share)
    np.testing.assert_allclose(pads.follow(passed, np.ones(3)), expected, rtol=1e-9)


@pytest.mark.parametrize("constant", [3.0, 40.0])
def test_a_lag_of_a_ramp_is_that_of_the_differential_equation(constant: float) -> None:
    """`c y' = x - y` from equilibrium: behind a ramp by c, less what the start has left; with no lag the values."""
    seconds = np.concatenate([np.arange(0.0, 50.0, 0.5), np.arange(50.0, 200.0, 1.0)])
    ramp = 3.0 + 0.2 * seconds[:, None] * [1.0, -2.0]
    exact = ramp - 0.2 * constant * (1.0 - np.exp(-seconds / constant))[:, None] * [1.0, -2.0]
    # a ramp over a step counts as its mean: an error of a share of the step squared
    np.testing.assert_allclose(lagged(seconds, ramp, constant), exact, atol=0.4 * 1.0**2 / (6.0 * constant))
    np.testing.assert_array_equal(lagged(seconds, ramp, 0.0), ramp)


def test_the_best_lag_is_that_of_the_parabola_with_its_deviation() -> None:
    """Through the three lags about the least: `sqrt(left / number / bend)`; at an end of the grid it is that end."""
    grid = np.array(LAGS_S)
    for truth, bend in ((7.3, 0.02), (-22.0, 0.5), (0.8, 1e-3)):
        more = bend * (grid - truth) ** 2 - 0.3
        lag, sd = _lag(more + 1.0, more, 50)
        assert lag == pytest.approx(truth, rel=1e-6)
        assert sd == pytest.approx(np.sqrt((more.min() + 1.0) / 50.0 / bend), rel=1e-6)
    assert _lag(grid + 100.0, grid, 50) == (-90.0, 0.0)
    assert _lag(100.0 - grid, -grid, 50) == (90.0, 0.0)


def test_what_is_left_beyond_noise_is_nothing_where_taxels_follow() -> None:
    """White noise of both is taken off what pads leave, with and without a lag: of 400 draws within 4 standard errors.

    Without a lag it is the noise of means of ten of taxels, and of pads times the square of the gain.
    """
    rng, count, averaged, gain = np.random.default_rng(61), 400, 10, 1.5
    instants = np.arange(600.0)
    heat = 10.0 * (1.0 - np.exp(-instants / 150.0))
    for lag in (0.0, 15.0, -15.0):
        late = lagged(instants, heat, abs(lag))
        pad, taxel = (late, heat) if lag > 0.0 else (heat, late)
        pads = pad[:, None] + 0.4 * rng.normal(size=(600, count))
        taxels = gain * taxel[:, None] + 0.8 * rng.normal(size=(600, count))
        left, more = _squares(instants, taxels, pads, np.eye(count, dtype=bool), lag, averaged).T
        noise = (0.8**2 + (gain * 0.4) ** 2) / averaged
        # heat that changes from one mean to the next counts as noise; a mean and a gain are fitted to sixty of them
        heats = 0.5 * gain**2 * (np.mean(np.diff(pad) ** 2) + np.mean(np.diff(taxel) ** 2)) / averaged
        near = 4.0 * more.std() / 20.0
        assert -heats - noise * 2.0 / 60.0 - near < more.mean() < near
        assert lag != 0.0 or left.mean() == pytest.approx(noise * 58.0 / 60.0, rel=0.03)
        assert lag == 0.0 or 0.4 * noise < left.mean() < 0.9 * noise


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_smallest_and_common_lags(sign: float) -> None:
    """Pads that lag by 8 s have their median, few differ by chance; those that lag by 1 s have no lag."""
    rng = np.random.default_rng(62)
    instants = np.arange(900.0)
    heat = 10.0 * (1.0 - np.exp(-instants / 120.0))
    for lag, has_one in ((1.0, False), (8.0, True)):
        late = lagged(instants, heat, lag)
        pads, taxels = (heat, late) if sign < 0.0 else (late, heat)
        found = pad_lags(
            instants,
            taxels[:, None] + 0.1 * rng.normal(size=(900, 12)),
            pads[:, None] + 0.1 * rng.normal(size=(900, 12)),
            np.eye(12, dtype=bool),
            averaged=10,
        )
        assert found.any() == has_one
        if has_one:
            assert np.median(found) == pytest.approx(sign * lag, abs=1.0)
            assert np.count_nonzero(found == np.median(found)) >= 10


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        ([(2.05, 0.01)] * 4, [2.05] * 4),  # 2 s is a lag
        ([(1.95, 0.01)] * 4, [0.0] * 4),
        ([(-1.95, 0.01), (-2.05, 0.01)] * 2, [0.0, -2.05] * 2),
        # one that differs from the median by more than four deviations is its own
        ([(10.0, 1.0), (10.0, 1.0), (10.0, 1.0), (14.1, 1.0)], [10.0, 10.0, 10.0, 14.1]),
        ([(10.0, 1.0), (10.0, 1.0), (10.0, 1.0), (13.9, 1.0)], [10.0] * 4),
        # a median counts from four of its deviations on, 1.2533 times those of a mean of four
        ([(4.0 * 1.2533 * 2.0 / 2.0 + 0.01, 2.0)] * 4, [4.0 * 1.2533 + 0.01] * 4),
        ([(4.0 * 1.2533 * 2.0 / 2.0 - 0.01, 2.0)] * 4, [0.0] * 4),
    ],
)
def test_a_lag_is_its_own_or_that_of_all_pads(
    monkeypatch: pytest.MonkeyPatch, found: list[tuple[float, float]], expected: list[float]
) -> None:
    """By the lag and deviation of each pad; a pad that no taxel follows has none."""
    estimates = iter([*found, (50.0, 1.0)])
    monkeypatch.setattr("forcetorque.skin.temperature.pad_lags._lag", lambda *_: next(estimates))
    values = np.random.default_rng(4).normal(size=(60, 5))
    follows = np.eye(5, dtype=bool)
    follows[4, 4] = False
    lags = pad_lags(np.arange(60.0), values, values, follows, averaged=10)
    np.testing.assert_allclose(lags, [*expected, 0.0])
