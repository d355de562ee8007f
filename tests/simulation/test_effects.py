# SPDX-License-Identifier: BSD-3-Clause
"""Each effect by itself does what physics says, and nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError
from forcetorque.simulation.sensor_effects import Creep, Crosstalk, Noise, ScrewPattern, ThermalDrift, mounted

RATE = 100.0
EXACT = 1e-9
"""Counts: sums of some ten products of numbers up to 1e3."""


def _power(values: np.ndarray, low: float, high: float) -> float:
    """Mean power per bin between two frequencies."""
    spectrum = np.abs(np.fft.rfft(values, axis=0)) ** 2
    frequency = np.fft.rfftfreq(len(values), 1.0 / RATE)
    return float(spectrum[(frequency >= low) & (frequency < high)].mean())


def test_white_noise_is_as_strong_as_stated_and_independent() -> None:
    """Standard deviation per channel, and no correlation between channels or neighbours in time."""
    noise = Noise(white_counts=4.0).sample(40_000, 6, rate_hz=RATE, rng=np.random.default_rng(1))
    np.testing.assert_allclose(noise.std(axis=0), 4.0, rtol=0.02)
    correlation = np.corrcoef(noise.T) - np.eye(6)
    assert np.abs(correlation).max() < 0.03
    assert abs(np.mean(noise[1:] * noise[:-1])) < 0.03 * 16.0


def test_the_corner_is_where_both_parts_are_equal() -> None:
    """Power is twice the white one at the corner, and falls like 1/f below it."""
    noise = Noise(white_counts=4.0, corner_hz=5.0).sample(200_000, 3, rate_hz=RATE, rng=np.random.default_rng(2))
    white = _power(Noise(white_counts=4.0).sample(200_000, 3, rate_hz=RATE, rng=np.random.default_rng(3)), 1.0, 50.0)
    assert _power(noise, 4.8, 5.2) / white == pytest.approx(2.0, rel=0.1)
    assert _power(noise, 0.09, 0.11) / _power(noise, 0.9, 1.1) == pytest.approx(51.0 / 6.0, rel=0.15)
    assert _power(noise, 40.0, 50.0) / white == pytest.approx(1.0 + 5.0 / 45.0, rel=0.05)


def test_linear_drift_is_linear_and_zero_at_its_reference() -> None:
    """Counts per degree, for each channel."""
    slope = np.array([1.0, -2.0, 0.0, 3.0, 5.0, -7.0])
    drift = ThermalDrift(slope=slope, reference_degC=30.0).drift(np.array([30.0, 31.0, 40.0]), rate_hz=RATE)
    np.testing.assert_allclose(drift, np.outer([0.0, 1.0, 10.0], slope), atol=EXACT)


def test_a_gradient_shows_while_the_temperature_moves_and_goes_away() -> None:
    """In a steady ramp the late gauges are behind by rate times lag; at rest the difference dies out."""
    drift = ThermalDrift(slope=np.zeros(2), reference_degC=20.0, gradient_slope=np.array([10.0, -4.0]), lag_s=5.0)
    seconds = np.arange(0.0, 100.0, 1.0 / RATE)
    ramp = drift.drift(20.0 + 0.1 * seconds, rate_hz=RATE)
    np.testing.assert_allclose(ramp[-1], 0.1 * 5.0 * np.array([10.0, -4.0]), rtol=1e-2)
    still = drift.drift(np.where(seconds < 20.0, 20.0 + 0.1 * seconds, 22.0), rate_hz=RATE)
    assert np.abs(still[-1]).max() < 1e-4
    np.testing.assert_array_equal(drift.drift(np.full(10, 35.0), rate_hz=RATE), 0.0)


def test_hysteresis_separates_heating_from_cooling_by_the_play() -> None:
    """On the way down the follower is higher by twice the half width; small changes do not move it at all."""
    drift = ThermalDrift(slope=np.zeros(1), reference_degC=0.0, hysteresis_slope=np.ones(1), play_degC=2.0)
    up = np.linspace(20.0, 40.0, 201)
    path = drift.drift(np.concatenate([up, up[::-1]]), rate_hz=RATE)[:, 0]
    heating, cooling = path[100], path[-101]
    assert cooling - heating == pytest.approx(4.0)
    wiggle = drift.drift(30.0 + 1.9 * np.sin(np.arange(500) / 10.0), rate_hz=RATE)
    assert np.ptp(wiggle) < 0.1 + 1.9  # it follows at most until the play is used up once
    assert np.ptp(wiggle[100:]) < EXACT


def test_creep_follows_a_step_with_its_time_constant() -> None:
    """After one time constant 63 % of the share has come, in the end all of it; a constant load shows no creep."""
    creep = Creep(share=0.02, time_constant_s=10.0)
    step = np.concatenate([np.zeros((1, 1)), np.ones((20_000, 1))])
    response = creep.response(step, rate_hz=RATE)[:, 0]
    assert response[int(10.0 * RATE)] - 1.0 == pytest.approx(0.02 * (1.0 - np.exp(-1.0)), rel=1e-2)
    assert response[-1] == pytest.approx(1.02, abs=1e-6)
    held = creep.response(np.full((50, 2), 3.0), rate_hz=RATE)
    np.testing.assert_allclose(held, 3.0 * 1.02, atol=EXACT)


def test_crosstalk_is_quadratic() -> None:
    """Twice the wrench gives four times the counts, the opposite wrench the same; one product reads by hand."""
    quadratic = np.zeros((6, 6, 6))
    quadratic[2, 0, 1] = 50.0
    crosstalk = Crosstalk(quadratic=quadratic, full_scale=np.array([100.0, 200.0, 100.0, 10.0, 10.0, 10.0]))
    wrench = np.array([[50.0, 100.0, 7.0, 1.0, 1.0, 1.0]])
    counts = crosstalk.counts(wrench)
    np.testing.assert_allclose(counts, [[0.0, 0.0, 50.0 * 0.5 * 0.5, 0.0, 0.0, 0.0]], atol=EXACT)
    np.testing.assert_allclose(crosstalk.counts(2.0 * wrench), 4.0 * counts, atol=EXACT)
    np.testing.assert_allclose(crosstalk.counts(-wrench), counts, atol=EXACT)


SCREWS = np.deg2rad([0.0, 60.0, 120.0, 180.0, 240.0, 300.0])
ARMS = np.deg2rad([180.0, 0.0, 240.0, 60.0, 300.0, 120.0])
PLANE = np.array([False, True, True, False, False, True])


def test_even_screws_leave_the_matrix_alone() -> None:
    """Whatever the torque, as long as it is the same everywhere."""
    sensitivity = np.random.default_rng(1).normal(size=(6, 6))
    for torque in (0.5, 1.0, 2.0):
        screws = ScrewPattern(angle_rad=SCREWS, torque_Nm=np.full(6, torque))
        after = mounted(sensitivity, screws, arm_angle_rad=ARMS, in_plane=PLANE)
        np.testing.assert_allclose(after, sensitivity, atol=EXACT)


def test_uneven_screws_change_in_plane_channels_most() -> None:
    """Looser screws on one axis change the channels in the plane several times as much as the others."""
    sensitivity = np.random.default_rng(2).normal(size=(6, 6))
    loose = np.where(np.abs(np.cos(SCREWS)) > 0.9, 1.0, 2.0)
    after = mounted(sensitivity, ScrewPattern(angle_rad=SCREWS, torque_Nm=loose), arm_angle_rad=ARMS, in_plane=PLANE)
    change = np.linalg.norm(after - sensitivity, axis=1) / np.linalg.norm(sensitivity, axis=1)
    assert change[PLANE].mean() > 2.0 * change[~PLANE].mean()
    assert 0.005 < change[PLANE].max() < 0.2


def test_the_rim_smooths_what_lies_between_screws() -> None:
    """The deviation at the screws of a two-lobed pattern is met; its mean over the rim is zero."""
    torque = 1.5 + 0.4 * np.cos(2.0 * SCREWS)
    screws = ScrewPattern(angle_rad=SCREWS, torque_Nm=torque)
    np.testing.assert_allclose(screws.unevenness(SCREWS), 0.2 * np.cos(2.0 * SCREWS), atol=EXACT)
    assert abs(screws.unevenness(np.linspace(0.0, 2.0 * np.pi, 360, endpoint=False)).mean()) < EXACT


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: Noise(white_counts=-1.0),
        lambda: Creep(share=0.1, time_constant_s=0.0),
        lambda: ThermalDrift(slope=np.zeros(6), reference_degC=20.0, lag_s=0.0),
        lambda: ThermalDrift(slope=np.zeros(6), reference_degC=20.0, gradient_slope=np.zeros(5)),
        lambda: ScrewPattern(angle_rad=np.zeros(2), torque_Nm=np.ones(2)),
        lambda: ScrewPattern(angle_rad=SCREWS, torque_Nm=-np.ones(6)),
        lambda: Crosstalk(quadratic=np.zeros((6, 6)), full_scale=np.ones(6)),
    ],
)
def test_figures_that_cannot_be_are_refused(wrong: object) -> None:
    """Negative noise, no time, shapes that differ, two screws."""
    with pytest.raises(ShapeError):
        wrong()  # type: ignore[operator]
