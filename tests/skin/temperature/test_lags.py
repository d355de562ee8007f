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
from forcetorque.skin.taxels.patch_calibration import PressureTable
from forcetorque.skin.temperature.pad_lags import PadFilter
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
