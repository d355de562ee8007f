# SPDX-License-Identifier: BSD-3-Clause
"""Contacts and support phases are those that forces, thresholds and time make, and no others."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError, ShapeError
from forcetorque.locomotion.standing.support_phases import (
    NO_FOOT,
    ContactThresholds,
    contact_state,
    require_support,
    support_phases,
)

PERIOD_S = 0.01
THRESHOLDS = ContactThresholds(contact_threshold_N=50.0, release_N=20.0)


def _times(count: int) -> FloatArray:
    return PERIOD_S * np.arange(count)


def test_a_contact_lasts_above_release_and_reaches_touch() -> None:
    """A foot that never bears the touch threshold is in the air, one that does is down from release to release."""
    force = np.array([0, 30, 40, 0, 25, 60, 30, 19, 45, 0], dtype=float)
    down = contact_state(force, _times(10), THRESHOLDS)
    assert down.tolist() == [False, False, False, False, True, True, True, False, False, False]


def test_without_hysteresis_a_noisy_force_rattles() -> None:
    """The negative control: equal thresholds part one step into many."""
    rng = np.random.default_rng(1)
    force = np.r_[np.zeros(100), np.linspace(0, 100, 100), np.full(100, 100.0)] + rng.normal(0.0, 5.0, 300)
    rattling = contact_state(force, _times(300), ContactThresholds(contact_threshold_N=50.0, release_N=50.0))
    still = contact_state(force, _times(300), ContactThresholds(contact_threshold_N=80.0, release_N=30.0))
    assert np.count_nonzero(np.diff(rattling)) > 1
    assert np.count_nonzero(np.diff(still)) == 1


@given(st.lists(st.floats(-50.0, 200.0), min_size=2, max_size=60), st.sampled_from([0.0, 0.025, 0.1]))
def test_a_recording_played_backwards_has_the_same_contacts(forces: list[float], dwell_s: float) -> None:
    """The rule does not look at the past alone."""
    thresholds = ContactThresholds(contact_threshold_N=50.0, release_N=20.0, dwell_s=dwell_s)
    # whole numbers, so that the same stretch lasts as long both ways
    forwards = contact_state(forces, np.arange(len(forces)), _slower(thresholds))
    backwards = contact_state(forces[::-1], np.arange(len(forces)), _slower(thresholds))
    assert forwards.tolist() == backwards[::-1].tolist()


def _slower(thresholds: ContactThresholds) -> ContactThresholds:
    return ContactThresholds(
        contact_threshold_N=thresholds.contact_threshold_N,
        release_N=thresholds.release_N,
        dwell_s=thresholds.dwell_s / PERIOD_S,
    )


def test_short_pauses_are_filled_and_short_contacts_dropped() -> None:
    """A bounce is one contact; a knock of the foot in the air is none."""
    force = np.r_[np.full(10, 100.0), np.zeros(3), np.full(10, 100.0), np.zeros(30), np.full(3, 100.0), np.zeros(20)]
    down = contact_state(
        force, _times(len(force)), ContactThresholds(contact_threshold_N=50.0, release_N=20.0, dwell_s=0.05)
    )
    assert down[:23].all()
    assert not down[23:].any()


def test_a_gap_in_the_log_ends_a_phase() -> None:
    """Nobody knows what happened in a pause: two phases, and no pause is filled across it."""
    time = np.r_[_times(50), 10.0 + _times(50)]
    phases = support_phases({"left": np.full(100, 100.0)}, time, THRESHOLDS).phases
    assert [(phase.name, phase.samples) for phase in phases] == [("left", slice(0, 50)), ("left", slice(50, 100))]


def test_phases_name_the_feet_that_are_down() -> None:
    """Single and double support, and a jump, in the order of time; unknown forces belong to no phase."""
    left = np.repeat([200.0, 100.0, 0.0, 0.0], 20)
    right = np.repeat([0.0, 100.0, 200.0, 0.0], 20)
    right[5] = np.nan
    phases = support_phases({"left": left, "right": right}, _times(80), THRESHOLDS)
    assert [phase.name for phase in phases.phases] == ["left", "left + right", "right", "no foot"]
    assert phases.phases[1].start_s == pytest.approx(0.2)
    assert phases.holds("left").sum() == 19
    assert not phases.known[5]


def test_what_cannot_be_a_phase_is_refused() -> None:
    """Thresholds that cross, a foot in the air all along, forces of the wrong sign, times that do not rise."""
    with pytest.raises(EstimationError, match="where they cross"):
        ContactThresholds(contact_threshold_N=20.0, release_N=50.0)
    with pytest.raises(EstimationError, match="dwell time"):
        ContactThresholds(contact_threshold_N=50.0, release_N=20.0, dwell_s=-1.0)
    with pytest.raises(EstimationError, match="got none"):
        support_phases({}, _times(9), THRESHOLDS)
    with pytest.raises(ShapeError, match="instants that rise"):
        contact_state([1.0, 2.0], [0.0, 0.0], THRESHOLDS)


def test_a_robot_may_hang_but_not_all_the_time() -> None:
    """No foot down in one recording is a phase, in all of them a refusal that says what was borne at most."""
    forces = [{"left": np.full(9, force)} for force in (30.0, -300.0, np.nan, 60.0)]
    phases = [support_phases(force, _times(9), THRESHOLDS) for force in forces]
    assert [one.names for one in phases] == [(NO_FOOT,), (NO_FOOT,), (), ("left",)]
    require_support(phases, forces, THRESHOLDS)
    for k, words in enumerate(
        ("no support phase found.*left 30 N", "sign that of the ground", "no force that is known")
    ):
        with pytest.raises(EstimationError, match=words):
            require_support(phases[k : k + 1], forces[k : k + 1], THRESHOLDS)
    with pytest.raises(EstimationError, match="left 30 N"):
        require_support(phases[:3], forces[:3], THRESHOLDS)
