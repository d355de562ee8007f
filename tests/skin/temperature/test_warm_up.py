# SPDX-License-Identifier: BSD-3-Clause
"""Gains of a warm-up are those of the simulation, and what is no warm-up without contact is refused by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SkinError
from forcetorque.skin.temperature.taxel_temperature_drift import HeatGains, WarmUp
from forcetorque.skin.temperature.warm_up_calibration import (
    _beyond_noise,
    _refuse_unexplained,
    _taxel_heat,
    fit_warm_up,
    warm_up_row,
)
from tests.scenes.warmed import WARM_UP, WarmShank, counts_of

SHANK = WarmShank.drawn()
LAYOUT = SHANK.layout
SECONDS, COUNTS = counts_of(SHANK.recorded(WARM_UP))
PADS = LAYOUT.thermal_pads
RATE_TOLERANCE = 5.0 * 0.071 * np.sqrt(2.0) / 60.0
"""Five deviations of a difference of two means of a hundred messages over a minute; noise and rounding; counts/s."""


def _learned(counts: FloatArray) -> WarmUp:
    return fit_warm_up("warm", SECONDS, counts, LAYOUT)


def _true_gains() -> FloatArray:
    """Counts of each taxel by count of each pad of its module; shape (n, 2)."""
    own = np.stack([np.flatnonzero(LAYOUT.thermal_modules == module) for module in LAYOUT.modules])
    gains: FloatArray = SHANK.heat.taxels[:, None] / SHANK.heat.pads[own]
    return gains


def test_gains_are_the_true_ones() -> None:
    """Both pads of each taxel, within what is predicted of them; the mean is far from the firmware's 1."""
    heat = _learned(COUNTS).taxels
    gains = np.array([[gain.gain for gain in one.gains] for one in heat])
    sd = np.array([[gain.sd for gain in one.gains] for one in heat])
    off = np.abs(gains - _true_gains()) / sd
    assert gains.shape == (len(LAYOUT), 2)
    assert 0.90 <= np.mean(off <= 2.0) <= 0.99
    assert np.mean(off <= 1.0) < 0.80  # negative control: half the deviation does not hold
    assert np.abs(gains - 1.0).mean() > 10.0 * np.abs(gains - _true_gains()).mean()


def test_rates_are_those_of_the_first_minute() -> None:
    """Ten degrees with a time constant of 150 s go 3.3 degrees in a minute; means of ten seconds blur that a little."""
    rates = np.array([one.rate_counts_per_s for one in _learned(COUNTS).taxels])
    in_a_minute = 10.0 * SHANK.heat.taxels * (1.0 - np.exp(-60.0 / 150.0))
    over_tens = (1.0 - np.exp(-10.0 / 150.0)) / (10.0 / 150.0)
    steepest = in_a_minute * over_tens / 60.0
    np.testing.assert_allclose(rates, steepest, atol=RATE_TOLERANCE)
    assert steepest.max() > 5.0 * RATE_TOLERANCE


def test_a_warm_up_is_the_same_whenever_its_log_begins() -> None:
    """An hour later nothing changes but times of day; its length is that of the messages."""
    first, later = (fit_warm_up("warm", SECONDS + begin, COUNTS, LAYOUT) for begin in (0.0, 4096.0))
    assert first.seconds == SECONDS[-1] - SECONDS[0] == pytest.approx(later.seconds)
    np.testing.assert_allclose(
        [gain.gain for one in later.taxels for gain in one.gains],
        [gain.gain for one in first.taxels for gain in one.gains],
        rtol=1e-9,
    )
    for name in ("rate_counts_per_s", "misfit_counts", "unexplained_counts"):
        values = [[getattr(one, name) or 0.0 for one in learned.taxels] for learned in (first, later)]
        np.testing.assert_allclose(values[1], values[0], rtol=1e-6, err_msg=name)
    assert later.pad_change_counts == pytest.approx(first.pad_change_counts)


def test_the_row_of_a_warm_up_is_in_its_units() -> None:
    """Minutes, counts by minute, medians of the taxels' means over their pads."""
    learned = _learned(COUNTS)
    row = warm_up_row(learned)
    gains = [np.mean([gain.gain for gain in one.gains]) for one in learned.taxels]
    rates = np.array([one.rate_counts_per_s for one in learned.taxels], dtype=float)
    assert row.minutes == pytest.approx(float(SECONDS[-1] - SECONDS[0]) / 60.0)
    assert (row.taxels, row.pads, row.dead_pads) == (len(LAYOUT), len(PADS), 0)
    assert (row.gain, row.gain_sd) == (pytest.approx(np.median(gains)), pytest.approx(np.std(gains)))
    assert row.rate_counts_per_min == pytest.approx(60.0 * np.median(rates))
    pads = COUNTS[: len(COUNTS) // 100 * 100, PADS].reshape(-1, 100, len(PADS)).mean(axis=1)
    assert row.pad_change_counts == pytest.approx(np.median(np.ptp(pads, axis=0)), rel=0.01)
    assert row.misfit_counts == pytest.approx(np.median([one.misfit_counts for one in learned.taxels]))
    assert row.unexplained_counts == max(one.unexplained_counts for one in learned.taxels)


def _railed(counts: FloatArray, pads: slice) -> None:
    counts[:, PADS[pads]] = 255.0


def _stuck(counts: FloatArray, pads: slice) -> None:
    counts[:, PADS[pads]] = 240.0


@pytest.mark.parametrize("kill", [_railed, _stuck])
def test_a_dead_pad_is_named_and_not_followed(kill: Callable[[FloatArray, slice], None]) -> None:
    """With one dead the other is followed; with both, those of a neighbouring module, whose gains are learned anew."""
    counts = COUNTS.copy()
    kill(counts, slice(0, 3))
    learned = _learned(counts)
    assert learned.dead_pads == tuple(PADS[:3].tolist())
    followed = [{gain.pad for gain in heat.gains} for heat in learned.taxels]
    assert all(not pads & set(PADS[:3].tolist()) for pads in followed)
    module, alone = LAYOUT.thermal_modules[0], LAYOUT.thermal_modules[2]
    for taxel in np.flatnonzero(LAYOUT.modules == alone):
        assert followed[taxel] == {PADS[3]}
    heat = HeatGains.learned(learned.taxels)
    fall, _ = heat.fall(10.0 * SHANK.heat.pads[np.searchsorted(PADS, heat.pads)])
    lent = LAYOUT.modules == module
    np.testing.assert_allclose(fall[lent], 10.0 * SHANK.heat.taxels[lent], rtol=0.05)


def test_a_sick_taxel_has_no_gain() -> None:
    """One at its rail is no contact either."""
    counts = COUNTS.copy()
    counts[3000:, LAYOUT.taxels[8]] = 255.0
    learned = _learned(counts)
    assert learned.taxels[8].gains == ()
    assert not HeatGains.learned(learned.taxels).has_pad[8]
    assert HeatGains.learned(learned.taxels).has_pad.sum() == len(LAYOUT) - 1


def test_a_contact_is_refused_with_taxel_and_time() -> None:
    """An object is put on at 200 s and taken off at 260 s."""
    counts = COUNTS.copy()
    pressed = np.rint(SHANK.taxels.fall(SHANK.truth.pressures))
    counts[np.ix_((SECONDS >= 200.0) & (SECONDS < 260.0), LAYOUT.taxels)] -= pressed
    hit = r"without contact, got \d+ taxels .* at (198|199|200) s, taxel \d+ by -\d+\.\d: something touches the patch"
    with pytest.raises(SkinError, match=hit):
        _learned(counts)


def test_a_contact_that_comes_slowly_is_refused() -> None:
    """Within two minutes, so that no step is seen; what the pads leave tells it."""
    counts = COUNTS.copy()
    share = np.clip(np.minimum(SECONDS - 200.0, 450.0 - SECONDS) / 120.0, 0.0, 1.0)
    pressed = SHANK.taxels.fall(SHANK.truth.pressures)
    counts[:, LAYOUT.taxels] -= np.rint(0.25 * share[:, None] * pressed)
    with pytest.raises(SkinError, match=r"follow the thermal pads, got \d+ that differ by over 2.5 counts, taxel"):
        _learned(counts)


def test_pads_that_never_warm_are_refused() -> None:
    """The robot was warm already, or its motors were off."""
    cold = counts_of(SHANK.recorded(replace(WARM_UP, inside_K=1.0)))[1]
    with pytest.raises(SkinError, match=r"change by at least 4 counts, got 1\.\d .*never warm; record from"):
        _learned(cold)


def test_all_pads_dead_is_refused() -> None:
    """There is nothing to learn from."""
    counts = COUNTS.copy()
    counts[:, PADS] = 0.0
    with pytest.raises(SkinError, match=r"expected one that is alive, got none of 56"):
        _learned(counts)


def test_a_patch_without_pads_is_refused() -> None:
    """Its layout says so."""
    none = np.zeros(0, dtype=np.int64)
    with pytest.raises(SkinError, match="thermal_pads: expected at least one, got none in its layout"):
        fit_warm_up("warm", SECONDS, COUNTS, replace(LAYOUT, thermal_pads=none, thermal_modules=none))


def test_a_short_warm_up_is_refused() -> None:
    """Two minutes tell no rate of a minute."""
    with pytest.raises(SkinError, match="at least 180 s, got 120 s"):
        fit_warm_up("warm", SECONDS[:1201], COUNTS[:1201], LAYOUT)


def test_gains_of_a_taxel_are_those_of_regressions_on_each_pad() -> None:
    """Slope, what the mean of both leaves, its deviation by the correlation from one mean to the next, and the rate."""
    rng = np.random.default_rng(8)
    instants = 10.0 * np.arange(60.0)
    heat = 12.0 * (1.0 - np.exp(-instants / 150.0))
    pads = heat[:, None] * [1.0, 0.7] + 0.05 * rng.normal(size=(60, 2)) + [3.0, -2.0]
    taxel = 1.4 * heat + np.cumsum(0.05 * rng.normal(size=60)) + 7.0
    late = np.column_stack([taxel, np.roll(taxel, 1)])
    late[0, 1] = taxel[0]
    learned, left = _taxel_heat(instants, taxel, late, pads, np.array([6, 10]), np.array([0.0, 12.0]))
    slopes = [np.polyfit(pads[:, k], late[:, k], 1) for k in range(2)]
    residual = np.mean([late[:, k] - np.polyval(slopes[k], pads[:, k]) for k in range(2)], axis=0)
    np.testing.assert_allclose(left, residual, atol=1e-12)
    np.testing.assert_allclose([gain.gain for gain in learned.gains], [slope[0] for slope in slopes], rtol=1e-9)
    assert [(gain.pad, gain.lag_s) for gain in learned.gains] == [(6, 0.0), (10, 12.0)]
    assert learned.misfit_counts == pytest.approx(np.sqrt((residual**2).mean()))
    likeness = (residual[1:] * residual[:-1]).sum() / (residual**2).sum()
    assert 0.3 < likeness < 0.99
    # n (1 - r) / (1 + r) of n means are independent
    spread = np.sqrt(((pads - pads.mean(axis=0)) ** 2).sum(axis=0))
    wanted = learned.misfit_counts * np.sqrt((1.0 + likeness) / (1.0 - likeness)) / spread
    np.testing.assert_allclose([gain.sd for gain in learned.gains], wanted, rtol=1e-9)
    assert learned.rate_counts_per_s == pytest.approx(np.abs(taxel[6:] - taxel[:-6]).max() / 60.0)


@pytest.mark.parametrize(("counts", "taxels", "refused"), [(2.45, 2, False), (2.55, 1, False), (2.55, 2, True)])
def test_two_taxels_that_pads_leave_by_two_and_a_half_counts_are_a_contact(
    counts: float, taxels: int, refused: bool
) -> None:
    """One alone is none, nor is less; the worst is named with its instant."""
    residuals = [np.zeros(30) for _ in range(4)]
    for k in range(taxels):
        residuals[k + 1][12] = -counts - 0.01 * k
    columns, instants = np.array([4, 5, 7, 8]), 10.0 * np.arange(30.0)
    if not refused:
        _refuse_unexplained(columns, instants, [*residuals[:3], None])
        return
    with pytest.raises(SkinError, match=r"got 2 that differ by over 2.5 counts, taxel 7 by 2.6 at 120 s"):
        _refuse_unexplained(columns, instants, [*residuals[:3], None])


def test_what_is_left_beyond_noise_is_by_the_median_of_steps() -> None:
    """Two and a half deviations of a difference of two rows are noise; a peak is counted by its square beyond that."""
    rng = np.random.default_rng(9)
    left = 0.2 * rng.normal(size=(4001, 3))
    left[2000] = [0.0, 1.0, -3.0]
    noise = 2.5 * 0.2 * np.sqrt(2.0)
    largest = np.abs(left).max(axis=0)
    found = _beyond_noise(left)
    np.testing.assert_allclose(found[1:], np.sqrt(largest**2 - noise**2)[1:], rtol=0.03)
    assert found[0] < 0.5 * largest[0]
    assert _beyond_noise(np.zeros((5, 1))) == 0.0
