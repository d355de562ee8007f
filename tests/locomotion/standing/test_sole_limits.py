# SPDX-License-Identifier: BSD-3-Clause
"""What the ground cannot do to a sole is an event, and what it can do is none."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import Sole, centre_of_pressure
from forcetorque.locomotion.standing.interval_balance import FootPressure, IntervalBalance
from forcetorque.locomotion.standing.sole_limits import SoleEventRow, friction_used, sole_events
from forcetorque.locomotion.standing.support_phases import ContactThresholds, support_phases

RATE_HZ, WEIGHT_N = 100.0, 300.0
SOLE = Sole(
    frame="foot",
    outline=np.array([[-0.1, -0.05], [0.1, -0.05], [0.1, 0.05], [-0.1, 0.05]]),
    friction=0.5,
    torsional_friction_m=0.02,
)
COVARIANCE = np.diag([2.0, 2.0, 2.0, 0.1, 0.1, 0.1]) ** 2


def balance_on_one_foot(
    sole: Sole,
    wrench: FloatArray,
    covariance: FloatArray | None,
    thresholds: ContactThresholds,
    *,
    least_load_N: float,
    rate_hz: float,
    weight_N: float,
) -> IntervalBalance:
    """A robot on one sole, by the wrench that it bears and its covariance; shapes (n, 6), (n, 6, 6)."""
    time_s = np.arange(len(wrench)) / rate_hz
    pressure = centre_of_pressure(wrench, least_load_N=least_load_N, covariance=covariance)
    foot = FootPressure(
        sole=sole, sensors=("ankle",), wrench=wrench, covariance=covariance, pressure=pressure, reading_alone=None
    )
    forces = {sole.frame: wrench[:, 2]}
    return IntervalBalance(
        recording="log",
        label="standing",
        stamp_ns=np.round(time_s * 1e9).astype(np.int64),
        time_s=time_s,
        weight_N=weight_N,
        forces=forces,
        net_N=wrench[:, 2],
        phases=support_phases(forces, time_s, thresholds),
        feet=(foot,),
    )


def _events(wrench: FloatArray, covariance: FloatArray | None = COVARIANCE, sole: Sole = SOLE) -> list[SoleEventRow]:
    spread = None if covariance is None else np.broadcast_to(covariance, (len(wrench), 6, 6))
    thresholds = ContactThresholds(contact_threshold_N=40.0, release_N=20.0, dwell_s=0.0)
    balance = balance_on_one_foot(
        sole, wrench, spread, thresholds, least_load_N=20.0, rate_hz=RATE_HZ, weight_N=WEIGHT_N
    )
    return list(sole_events(balance, release_N=18.0))


def _standing(change: tuple[float, ...], *, first: int = 200, last: int = 260) -> FloatArray:
    wrench = np.tile([0.0, 0.0, WEIGHT_N, 0.0, 0.0, 0.0], (500, 1))
    wrench[first:last] += change
    return wrench


@pytest.mark.parametrize(
    ("change", "kind"),
    [
        ((170.0, 0.0, 0.0, 0.0, 0.0, 0.0), "slip"),  # 170 of 150 N
        ((0.0, -149.0, 0.0, 0.0, 0.0, 0.0), "slip_risk"),  # 149 of 150 N, each ± 4 N
        ((0.0, 0.0, 0.0, 0.0, 0.0, 7.5), "slip"),  # 7.5 of 6 N m
        ((120.0, 0.0, 0.0, 0.0, 0.0, 4.8), "slip"),  # 80 % of either, 113 % together
        ((0.0, 0.0, 0.0, 0.0, -33.0, 0.0), "outside"),  # 110 mm of 100 mm
        ((0.0, 0.0, -330.0, 0.0, 0.0, 0.0), "pulls"),  # -30 ± 4 N
    ],
)
def test_what_the_ground_cannot_do_is_an_event(change: tuple[float, ...], kind: str) -> None:
    """By force, torsion, both together, place, and sign; from its first sample to its last."""
    (row,) = _events(_standing(change))
    assert row.kind == kind
    assert (row.start_s, row.end_s) == (2.0, 2.59)


@pytest.mark.parametrize(
    "change",
    [
        (140.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        (0.0, 0.0, 0.0, 0.0, 0.0, 4.0),
        (0.0, 0.0, 0.0, 0.0, -30.05, 0.0),  # outside by 0.2 mm, ± 0.7 mm
        (0.0, 0.0, -295.0, 0.0, 0.0, 0.0),
        (0.0, 0.0, -315.0, 0.0, 0.0, 0.0),  # -15 N, less than a contact has
    ],
)
def test_what_it_can_do_is_none(change: tuple[float, ...]) -> None:
    """The negative control: the same, within the limits or their intervals."""
    assert _events(_standing(change)) == []


def test_noise_of_single_samples_is_no_event() -> None:
    """Outliers of 40 ms are none; two times of 60 ms within 0.2 s are one."""
    pushed = (170.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert _events(_standing(pushed, last=204)) == []
    twice = _standing(pushed, last=206)
    twice[215:221] += pushed
    (row,) = _events(twice)
    assert (row.start_s, row.end_s) == (2.0, 2.2)


def test_without_a_covariance_numbers_alone_are_compared() -> None:
    """There is no risk then, and no interval."""
    (row,) = _events(_standing((170.0, 0.0, 0.0, 0.0, 0.0, 0.0)), None)
    assert (row.kind, row.used_half_width_95_percent) == ("slip", None)
    assert row.used_percent == pytest.approx(100.0 * 170.0 / 150.0)
    assert _events(_standing((0.0, -149.0, 0.0, 0.0, 0.0, 0.0)), None) == []


def test_without_a_friction_nothing_slips() -> None:
    """A sole of which nothing is stated has no limit but that it presses."""
    assert _events(_standing((170.0, 0.0, 0.0, 0.0, -33.0, 0.0)), sole=Sole(frame="foot")) == []


def test_torsion_is_that_about_the_centre_of_pressure() -> None:
    """A force at a point of the sole has no torsion about it, wherever the origin is."""
    force, place = np.array([20.0, -30.0, 300.0]), np.array([0.05, -0.03, 0.0])
    at_point = np.r_[force, np.cross(place, force)][None]
    only = Sole(frame="foot", torsional_friction_m=0.02)
    assert friction_used(only, at_point, None).value[0] == pytest.approx(0.0, abs=1e-12)
    twisted = at_point + [0.0, 0.0, 0.0, 0.0, 0.0, 3.0]
    assert friction_used(only, twisted, None).value[0] == pytest.approx(0.5)


def test_intervals_of_the_friction_used_hold_it() -> None:
    """Of 20 000 draws of a correlated wrench 94 to 96 % are within the 95 % interval."""
    rng = np.random.default_rng(3)
    wrench = np.array([60.0, -40.0, 250.0, 4.0, -9.0, 2.0])
    root = rng.normal(size=(6, 6)) * np.repeat([2.0, 0.1], 3)[:, None]
    known = friction_used(SOLE, wrench[None], (root @ root.T)[None])
    assert known.half_width_95 is not None
    drawn = friction_used(SOLE, wrench + rng.normal(size=(20_000, 6)) @ root.T, None)
    assert 0.94 < np.mean(np.abs(drawn.value - known.value) <= known.half_width_95) < 0.96


def test_a_friction_that_is_none_is_refused() -> None:
    """Zero holds nothing."""
    with pytest.raises(EstimationError, match="sole 'foot': friction: expected a number above 0, got 0"):
        Sole(frame="foot", friction=0.0)
