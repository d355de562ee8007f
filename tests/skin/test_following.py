# SPDX-License-Identifier: BSD-3-Clause
"""A patch is followed through heat: contacts stay, idle taxels are followed, and what no pad tells is bounded."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.contact.contact_clusters import SkinContacts
from forcetorque.skin.contact.contact_tracking import PatchFollower
from forcetorque.skin.contact.pressure_frame import PatchReader
from forcetorque.skin.simulation.temperature import Warmth
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PressureTable
from forcetorque.skin.temperature.taxel_temperature_drift import HeatGains
from forcetorque.skin.temperature.warm_up_calibration import fit_warm_up
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from forcetorque.skin.wrench.pressures_over_recording import _short_noise, touched_at_rest
from tests.scenes.warmed import HAND, HELD, WARM_UP, WarmShank, counts_of
from tests.skin.contact_trials import chamber_table

SHANK = WarmShank.drawn()
PATCH = SkinPatch.of(SHANK.layout)
TRUE_N = float(np.linalg.norm(SHANK.truth.wrench[:3]))
LEAST_N = 0.7
"""Error of this object without heat, by its taxels and their tables; it has 9.8 N."""
HEAT_N = 0.5
"""What heat may change, noise of a frame included, of which there is 0.1."""


@pytest.fixture(scope="module", name="table")
def calibrated_table() -> PressureTable:
    """Pressures by counts, fitted in a chamber."""
    table = chamber_table(SHANK.taxels, np.random.default_rng(1), both_ways=False)
    return replace(table, columns=SHANK.layout.columns, taxels=SHANK.layout.taxels)


@pytest.fixture(scope="module", name="learned")
def learned_gains() -> HeatGains:
    """Gains of a warm-up."""
    return HeatGains.learned(fit_warm_up("warm", *counts_of(SHANK.recorded(WARM_UP)), SHANK.layout).taxels)


@pytest.mark.parametrize("rate_hz", [10.0, 50.0])
def test_a_touch_within_the_rest_is_seen_at_any_rate(table: PressureTable, rate_hz: float) -> None:
    """Two taxels are pushed after 3 s and stay so: seen in a rest of 6 s, and no part of one of 2 s."""
    seconds = np.arange(round(20.0 * rate_hz)) / rate_hz
    counts = np.rint(240.0 + 0.4 * np.random.default_rng(5).normal(size=(len(seconds), table.columns)))
    pushed = table.taxels[table.live][[4, 5]]
    counts[np.ix_(seconds >= 3.0, pushed)] -= 8.0
    for rest_s, expected in ((6.0, pushed), (2.0, [])):
        reader = PatchReader.at_rest(table, counts[seconds < rest_s])
        np.testing.assert_array_equal(touched_at_rest(reader, seconds, counts, rest_s=rest_s), expected)


def _followed(
    table: PressureTable, heat: HeatGains, warmth: Warmth, *, re_tare: bool = False, touched: bool = True
) -> tuple[PatchFollower, dict[float, SkinContacts]]:
    """Contacts by time, in frames of a second."""
    seconds, counts = counts_of(SHANK.recorded(warmth, touched=touched))
    reader = PatchReader.at_rest(table, counts[seconds < warmth.rest_s])
    follower = PatchFollower(PATCH, reader, heat, re_tare=re_tare)
    starts = range(0, len(seconds) - 9, 10)
    told = {float(seconds[k]): follower.frame(float(seconds[k]), counts[k : k + 10])[1] for k in starts}
    return follower, told


def _forces(told: dict[float, SkinContacts], begin_s: float, end_s: float) -> FloatArray:
    """Norm of the force of all contacts of the frames of a time."""
    forces = [np.linalg.norm(c.wrench[:, :3].sum(axis=0)) for time, c in told.items() if begin_s <= time < end_s]
    assert forces
    return np.array(forces)


def _without_gains(heat: HeatGains) -> HeatGains:
    return replace(heat, gains=np.zeros(heat.gains.shape))


@pytest.mark.long
def test_heat_from_inside_is_no_force(table: PressureTable, learned: HeatGains) -> None:
    """The object stays as heavy as it is, for five minutes; without gains it weighs many times that.

    It is compared with what it weighs cold: what its few taxels tell of it then is another matter.
    """
    _, cold = _followed(table, learned, replace(HELD, inside_K=0.0))
    forces = _forces(cold, 12.0, 309.0)
    assert abs(forces.mean() - TRUE_N) < LEAST_N
    _, told = _followed(table, learned, HELD)
    np.testing.assert_allclose(_forces(told, 12.0, 309.0), forces.mean(), atol=HEAT_N)
    _, wrong = _followed(table, _without_gains(learned), HELD)
    assert _forces(wrong, 300.0, 309.0).min() > 2.0 * TRUE_N


@pytest.mark.long
def test_nothing_is_felt_where_nothing_touches(table: PressureTable, learned: HeatGains) -> None:
    """No contact in five minutes of warming; the firmware's rule sees some."""
    _, told = _followed(table, learned, HELD, touched=False)
    assert sum(len(contacts) > 0 for contacts in told.values()) <= 0.01 * len(told)
    firmware = replace(HeatGains.of_firmware(SHANK.layout), rates=learned.rates)
    _, wrong = _followed(table, firmware, HELD, touched=False)
    assert sum(len(contacts) > 0 for contacts in wrong.values()) > 0.5 * len(wrong)


@pytest.mark.long
def test_the_limit_is_time_times_rate(table: PressureTable, learned: HeatGains) -> None:
    """It grows evenly while the object lies there, in proportion to the rate, and falls as evenly afterwards."""
    follower, told = _followed(table, learned, HELD)
    limits = {time: float(contacts.drift_limit_N.sum()) for time, contacts in told.items()}
    assert limits[110.0] == pytest.approx(0.5 * limits[210.0], rel=0.1)
    double = replace(learned, rates=2.0 * learned.rates)
    _, other = _followed(table, double, HELD)
    assert float(other[210.0].drift_limit_N.sum()) == pytest.approx(2.0 * limits[210.0], rel=0.01)
    # thirty seconds after five minutes
    assert follower.touched_s.max() == pytest.approx(270.0, abs=3.0)


def test_heat_through_the_contact_is_bounded_and_not_hidden(table: PressureTable, learned: HeatGains) -> None:
    """Half its weight again is told after five minutes, inside the limit from the first minute on."""
    follower, told = _followed(table, learned, HAND)
    errors = {time: abs(float(_forces(told, time, time + 0.5)[0]) - TRUE_N) for time in (70.0, 130.0, 305.0)}
    assert errors[305.0] > 0.5 * TRUE_N
    for time, error in errors.items():
        assert error < told[time].drift_limit_N.sum()
    (release,) = follower.releases
    assert release.time_s == pytest.approx(311.0, abs=2.0)
    assert release.held_s == pytest.approx(300.0, abs=3.0)
    assert release.left_N == pytest.approx(errors[305.0], rel=0.2)
    assert release.re_tare == "offered"
    assert _forces(told, 315.0, 325.0).min() > 0.3 * TRUE_N


def test_rest_is_taken_anew_where_that_is_asked_for(table: PressureTable, learned: HeatGains) -> None:
    """Nothing is left after the release, and the limit begins anew."""
    follower, told = _followed(table, learned, HAND, re_tare=True)
    assert [release.re_tare for release in follower.releases] == ["done"]
    assert _forces(told, 315.0, 325.0).max() < 0.1 * TRUE_N
    assert follower.touched_s.max() < 30.0


def test_what_heat_cannot_explain_is_not_taken_as_rest(table: PressureTable, learned: HeatGains) -> None:
    """With a rate near nothing, what is left must be something that touches."""
    slow = replace(learned, rates=1e-3 * learned.rates)
    follower, told = _followed(table, slow, HAND, re_tare=True)
    assert [release.re_tare for release in follower.releases] == ["no"]
    assert _forces(told, 315.0, 325.0).min() > 0.3 * TRUE_N


def test_the_noise_from_one_message_to_the_next_is_its_standard_deviation() -> None:
    """Of white noise of less than two counts, to four standard errors; one large step among 4000 changes it by 1 %."""
    rng = np.random.default_rng(12)
    counts = rng.normal(size=(4000, 2)) * [0.4, 1.2]
    noise = _short_noise(counts)
    np.testing.assert_allclose(noise, [0.4, 1.2], rtol=4.0 * np.sqrt(0.75 / 4000))
    counts[2000:] += 80.0
    np.testing.assert_allclose(_short_noise(counts), noise, rtol=0.02)


@pytest.mark.parametrize(("step", "seen"), [(2.4, False), (2.6, True)])
@pytest.mark.parametrize("when_s", [3.0, 12.0])
def test_a_change_of_two_and_a_half_counts_is_a_touch(
    table: PressureTable, when_s: float, step: float, seen: bool
) -> None:
    """Down within the rest, or up after it by as much beyond the rest, of two taxels of a quiet patch."""
    seconds = np.arange(500) / 25.0
    counts = np.full((len(seconds), table.columns), 240.0)
    pushed = table.taxels[table.live][[4, 5]]
    counts[np.ix_(seconds >= when_s, pushed)] += step * (1.0 if when_s > 6.0 else -1.0)
    reader = replace(PatchReader.at_rest(table, counts[seconds < 6.0]), rest=np.full(table.columns, 240.0))
    found = touched_at_rest(reader, seconds, counts, rest_s=6.0)
    np.testing.assert_array_equal(found, pushed if seen else [])


def test_idle_taxels_are_followed_in_half_a_minute_and_touched_ones_counted() -> None:
    """By the exponential of 30 s, but for a contact and one ring; time falls again as fast as it grew."""
    follower = object.__new__(PatchFollower)
    surface = SimpleNamespace(with_ring=lambda touched: touched | np.roll(touched, 1))
    follower.patch = SimpleNamespace(surface=surface)  # type: ignore[assignment]
    follower.baseline, follower.touched_s = np.zeros(4), np.array([0.0, 0.0, 0.0, 5.0])
    touched = np.array([True, False, False, False])
    follower._keep(3.0, touched, np.full(4, 2.0))
    np.testing.assert_allclose(follower.baseline, 2.0 * (1.0 - np.exp(-0.1)) * np.array([0.0, 0.0, 1.0, 1.0]))
    np.testing.assert_allclose(follower.touched_s, [3.0, 0.0, 0.0, 2.0])
    follower._keep(4.0, ~touched, np.zeros(4))
    np.testing.assert_allclose(follower.touched_s, [0.0, 4.0, 4.0, 6.0])


def test_heating_is_the_steepest_minute_over_that_of_the_warm_up() -> None:
    """Of the median taxel, by what is compared every ten seconds; taxels without a rate, or not live, do not count."""
    follower = object.__new__(PatchFollower)
    follower.heating, follower._heats = 0.0, deque()
    rates = np.array([0.05, 0.1, 0.2, 0.0, 0.1])
    follower.reader = SimpleNamespace(live=np.array([True, True, True, True, False]))  # type: ignore[assignment]
    follower.heat = SimpleNamespace(rates=rates)  # type: ignore[assignment]
    share = np.array([0.5, 1.5, 3.0, 7.0, 9.0])
    for seconds in np.arange(0.0, 55.0, 5.0):
        follower._take_rate(float(seconds), -share * rates * seconds)
    assert follower.heating == 0.0  # no minute has passed
    for seconds in np.arange(55.0, 125.0, 5.0):
        follower._take_rate(float(seconds), -share * rates * seconds)
    assert follower.heating == pytest.approx(1.5)
    # it stays where the heat goes on more slowly
    for seconds in np.arange(125.0, 300.0, 5.0):
        follower._take_rate(float(seconds), -share * rates * 125.0)
    assert follower.heating == pytest.approx(1.5)
