# SPDX-License-Identifier: BSD-3-Clause
"""The bias of a live sensor is found while an arm moves a tool, and tracked without following contacts."""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks.live import biased_contact, tares_of_a_moving_arm
from forcetorque.base.errors import RecordingError
from forcetorque.live.bias_tracking_and_tare import BiasTracker, Tracking

STEP_NS = 20_000_000


def test_drift_is_tracked_and_a_contact_is_not() -> None:
    """A drift of 1 N per hour over some minutes, 5 N for one of them."""
    outcome = biased_contact(seconds=200.0, rate_hz=10.0, contact_s=(90.0, 150.0), seed=3)
    assert outcome.error_N < 0.1
    assert outcome.moved_in_contact_N < 0.03
    assert outcome.contact_s == pytest.approx(60.0 + Tracking().leave_after_s, abs=0.6)


def test_without_a_gate_the_contact_would_be_followed() -> None:
    """Negative control."""
    open_gate = Tracking(enter_gate=1e6, leave_gate=1e6)
    outcome = biased_contact(seconds=200.0, rate_hz=10.0, contact_s=(90.0, 150.0), seed=3, tracking=open_gate)
    assert outcome.moved_in_contact_N > 2.0


def test_a_part_of_the_bias_is_linear_in_temperature() -> None:
    """Its coefficient is found while the sensor warms up by ten degrees, and the bias follows."""
    tracker = BiasTracker(Tracking(with_temperature=True), np.zeros((1, 6)), np.full((1, 6), 0.01), np.array([25.0]))
    rng, slope = np.random.default_rng(5), np.array([0.3, -0.2, 0.1, 0.004, 0.0, -0.002])
    for k in range(4500):
        warmth = np.array([25.0 + 10.0 * k / 4500])
        noise = rng.normal(0.0, [0.1] * 3 + [0.002] * 3)
        tracker.add((slope * (warmth - 25.0) + noise)[None], k * STEP_NS, warmth)
    assert not tracker.in_contact.any()
    assert np.abs(tracker.bias[0] - 10.0 * slope).max() < 0.15
    assert np.abs(tracker.coefficient[0] - slope)[:3].max() < 0.1


def test_a_sensor_without_samples_keeps_its_bias_and_widens() -> None:
    """While the other one is tracked."""
    tracker = BiasTracker(Tracking(), np.zeros((2, 6)), np.full((2, 6), 1e-4))
    before = tracker.variance[1].copy()
    for k in range(500):
        tracker.add(np.full((2, 6), 0.02), k * STEP_NS, None, np.array([True, False]))
    assert tracker.bias[1].tolist() == [0.0] * 6
    assert (tracker.variance[1] > before).all()
    assert tracker.bias[0, 0] > 0.005


@pytest.mark.long
def test_a_tare_of_a_moving_arm_knows_its_error() -> None:
    """The bias of a tare with a tool lies in its 95 % interval in 90 to 99 of 100 runs."""
    inside = tares_of_a_moving_arm(range(100))
    assert 90 <= inside <= 99


def test_what_is_no_number_is_refused() -> None:
    """Each field by its name."""
    with pytest.raises(RecordingError, match="noise_N"):
        Tracking(noise_N=0.0)
    with pytest.raises(RecordingError, match="leave_gate"):
        Tracking(leave_gate=6.0)
    with pytest.raises(RecordingError, match="expected a temperature"):
        BiasTracker(Tracking(with_temperature=True), np.zeros((1, 6)), np.zeros((1, 6)))
