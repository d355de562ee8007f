# SPDX-License-Identifier: BSD-3-Clause
"""Friction is found with an interval that holds it, and motors say nothing where nothing can be told from them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError, FitError
from forcetorque.estimation.torque.motor_torque import (
    Friction,
    _Scatter,
    drive_torque,
    fit_friction,
    friction_terms,
    motor_source,
)
from tests.scenes.simulated_motor import SimulatedMotor

RATE_HZ = 50.0
MOTOR = SimulatedMotor(
    torque_constant=0.05, gear_ratio=100.0, coulomb=1.5, viscous=0.6, inertia=0.08, offset_a=0.02, noise_a=0.02
)
TRUE = np.array([1.5, 0.6, 0.08, 0.1])
STANDSTILL = 0.02
SEEDS = range(40)


def test_lasting_errors_of_the_trusted_torque_are_not_noise_of_the_motor() -> None:
    """What they explain neither widens a sample nor makes samples repeat themselves; unexplained, it does both."""
    samples, length = 6000, 50
    used = np.arange(samples) % 7 != 0
    white = 0.5 * np.random.default_rng(3).normal(size=used.sum())
    lasting = np.sin(np.arange(samples) / 300.0)[used][:, None]
    explained = _Scatter.of(used, white + lasting[:, 0], lasting, length=length)
    assert explained.variance == pytest.approx(0.25, rel=0.1)
    assert explained.repeated < 2.0
    unexplained = _Scatter.of(used, white + lasting[:, 0], 0.0 * lasting, length=length)
    assert unexplained.variance == pytest.approx(0.75, rel=0.1)
    assert unexplained.repeated > 10.0


def _motion(rng: np.random.Generator, samples: int = 2000) -> tuple[FloatArray, FloatArray]:
    """Velocity and acceleration of a joint that moves both ways, fast and slowly."""
    time_s, phase = np.arange(samples) / RATE_HZ, rng.uniform(0.0, 6.0, 2)
    omega = np.array([0.9, 2.3])
    angle = time_s[:, None] * omega + phase
    return np.cos(angle) @ [0.4, 0.3], -np.sin(angle) @ (omega * [0.4, 0.3])


def _fitted(seed: int, motor: SimulatedMotor = MOTOR, offset: float = 0.0) -> Friction:
    rng = np.random.default_rng(seed)
    velocity, acceleration = _motion(rng)
    torque = 2.0 * np.sin(np.arange(len(velocity)) / 70.0)
    current = motor.current(torque, velocity, acceleration, rng, rate_hz=RATE_HZ)
    drive = drive_torque("knee", current, torque_constant=0.05, gear_ratio=100.0)
    trusted = torque + 0.02 * rng.standard_normal(len(torque)) + offset * rng.standard_normal()
    return fit_friction(
        "knee",
        drive,
        trusted,
        velocity,
        acceleration,
        period_s=1.0 / RATE_HZ,
        standstill=STANDSTILL,
        trusted_variance=np.full(len(torque), 4e-4),
        trusted_lasting=np.full((len(torque), 1), offset),
    )


@pytest.mark.parametrize("motor", [MOTOR, replace(MOTOR, ripple=0.1, ripple_time_s=0.2)])
def test_friction_is_found_within_its_intervals(motor: SimulatedMotor) -> None:
    """White noise, and friction that wanders: 95 % of 160 intervals, within three standard errors of a share."""
    off = []
    for seed in SEEDS:
        friction = _fitted(seed, motor, offset=0.05)
        off.append((friction.coefficients - TRUE) / np.sqrt(np.diag(friction.covariance)))
    share = np.mean(np.abs(off) < 1.96)
    assert share > 0.89
    # negative control: intervals so wide that they say nothing would hold all
    assert np.std(off) > 0.6


def test_what_friction_leaves_is_the_drives() -> None:
    """Noise of 0.1 N m of the current, without that of the trusted source; ripple repeats itself, noise not."""
    white, wandering = _fitted(1), _fitted(1, replace(MOTOR, ripple=0.1, ripple_time_s=0.2))
    assert white.variance == pytest.approx(0.01, rel=0.1)
    assert wandering.variance == pytest.approx(0.02, rel=0.2)
    assert white.noise_time_s < 0.03 < wandering.noise_time_s < 0.3


def test_the_variance_is_over_the_degrees_of_freedom() -> None:
    """Of 60 samples and four coefficients, as least squares have it."""
    rng = np.random.default_rng(3)
    velocity, acceleration = _motion(rng, 60)
    velocity[::3] *= -1.0
    drive = rng.standard_normal(60)
    friction = fit_friction("knee", drive, np.zeros(60), velocity, acceleration, period_s=0.02, standstill=1e-6)
    terms = friction_terms(velocity, acceleration)
    coefficients, squares, *_ = np.linalg.lstsq(terms, drive, rcond=None)
    np.testing.assert_allclose(friction.coefficients, coefficients, rtol=1e-9)
    assert friction.variance == pytest.approx(squares[0] / (60 - 4), rel=1e-9)
    # however small the accelerations are: only the unit of the inertia changes
    slow = fit_friction("knee", drive, np.zeros(60), velocity, 1e-5 * acceleration, period_s=0.02, standstill=1e-6)
    np.testing.assert_allclose(slow.coefficients, coefficients * [1.0, 1.0, 1e5, 1.0], rtol=1e-6)


def test_the_unit_of_torque_does_not_change_what_is_fitted() -> None:
    """In N mm coefficients are a thousand times as large and variances a million times; times stay."""
    rng = np.random.default_rng(7)
    velocity, acceleration = _motion(rng)
    count = len(velocity)
    lasting = 0.01 * np.stack([np.sin(np.arange(count) / 40.0), np.cos(np.arange(count) / 90.0)], axis=1)
    trusted = 2.0 * np.sin(np.arange(count) / 70.0)
    ripple = np.convolve(rng.standard_normal(count + 9), np.full(10, 0.03), "valid")
    drive = trusted + friction_terms(velocity, acceleration) @ TRUE + ripple + lasting @ rng.standard_normal(2)

    def fitted(unit: float) -> Friction:
        return fit_friction(
            "knee",
            unit * drive,
            unit * trusted,
            velocity,
            acceleration,
            period_s=1.0 / RATE_HZ,
            standstill=STANDSTILL,
            trusted_variance=np.full(count, 1e-4 * unit**2),
            trusted_lasting=unit * lasting,
        )

    metres, millimetres = fitted(1.0), fitted(1e3)
    np.testing.assert_allclose(millimetres.coefficients, 1e3 * metres.coefficients, rtol=1e-9)
    np.testing.assert_allclose(millimetres.covariance, 1e6 * metres.covariance, rtol=1e-9)
    assert millimetres.variance == pytest.approx(1e6 * metres.variance)
    assert millimetres.noise_time_s == pytest.approx(metres.noise_time_s)
    # a mean of ten repeats itself for nine halves of a period; forty blocks tell a variance to a quarter
    assert metres.noise_time_s == pytest.approx(4.5 / RATE_HZ, rel=0.5)


def test_a_joint_at_standstill_says_nothing() -> None:
    """Friction is anything up to Coulomb's there."""
    velocity = np.array([[0.0], [0.01], [0.5], [-0.5]])
    drive = np.array([[3.0], [3.0], [3.0], [3.0]])
    source = motor_source("current", [_fitted(1)], np.arange(4), drive, velocity, np.zeros((4, 1)))
    assert np.isnan(source.torque[:2]).all()
    np.testing.assert_allclose(source.torque[2:, 0], [3.0 - 1.5 - 0.3 - 0.1, 3.0 + 1.5 + 0.3 - 0.1], atol=0.05)


def test_the_variance_of_friction_is_carried_to_torques() -> None:
    """What lasts is the variance of the terms, as coefficients have it."""
    friction = _fitted(2, offset=0.05)
    source = motor_source("current", [friction], np.arange(1), np.ones((1, 1)), np.full((1, 1), 0.5), np.ones((1, 1)))
    terms = np.array([1.0, 0.5, 1.0, 1.0])
    assert source.covariance[0, 0, 0] == pytest.approx(friction.variance + terms @ friction.covariance @ terms)


def test_an_error_of_the_trusted_torque_comes_back_from_the_motors() -> None:
    """A torque that is 0.5 N m too high while friction is fitted is as much too high in the motors' torques."""
    rng = np.random.default_rng(8)
    velocity, acceleration = _motion(rng)
    torque = 2.0 * np.sin(np.arange(len(velocity)) / 70.0)
    drive = torque + friction_terms(velocity, acceleration) @ TRUE
    friction = fit_friction(
        "knee",
        drive,
        torque + 0.5,
        velocity,
        acceleration,
        period_s=1.0 / RATE_HZ,
        standstill=STANDSTILL,
        trusted_shared=np.full((len(torque), 1), 0.5),
    )
    moved = (drive[:, None], velocity[:, None], acceleration[:, None])
    source = motor_source("current", [friction], np.arange(len(torque)), *moved)
    known = np.isfinite(source.torque[:, 0])
    np.testing.assert_allclose(source.torque[known, 0] - torque[known], 0.5, atol=1e-6)
    np.testing.assert_allclose(source.shared[known, 0, 0], 0.5, atol=1e-9)
    # it is no error of the motors alone
    assert np.abs(source.lasting).max() < 0.01
    assert friction.covariance[3, 3] == pytest.approx(0.25, rel=1e-3)


@pytest.mark.parametrize("field", ["torque_constant", "gear_ratio"])
@pytest.mark.parametrize("value", [0.0, np.nan])
def test_a_motor_without_constant_is_refused(field: str, value: float) -> None:
    """Nothing can be told from its current."""
    with pytest.raises(EstimationError, match=f"motor of joint 'knee': {field}: expected a number other than 0"):
        drive_torque("knee", np.ones(1), **{"torque_constant": 0.05, "gear_ratio": 100.0, field: value})


def test_motions_that_do_not_tell_friction_are_refused() -> None:
    """One way only, or one speed only; and a standstill that is none."""
    rng = np.random.default_rng(1)
    n = 500
    drive, trusted = rng.standard_normal(n), np.zeros(n)
    forth = np.abs(_motion(rng, n)[0]) + 0.1
    with pytest.raises(FitError, match="joint 'knee': expected at least 20 samples .* got 500 forth and 0 back"):
        fit_friction("knee", drive, trusted, forth, np.zeros(n), period_s=0.02, standstill=0.02)
    one_speed = np.where(np.arange(n) % 100 < 50, 0.3, -0.3)
    with pytest.raises(FitError, match="expected motions that tell coulomb, viscous, inertia, offset .* apart"):
        fit_friction("knee", drive, trusted, one_speed, np.zeros(n), period_s=0.02, standstill=0.02)
    nearly_one = one_speed * (1.0 + 1e-4 * rng.standard_normal(n))
    with pytest.raises(FitError, match="expected motions that tell"):
        fit_friction("knee", drive, trusted, nearly_one, rng.standard_normal(n), period_s=0.02, standstill=0.02)
    with pytest.raises(FitError, match="standstill: expected a positive speed"):
        fit_friction("knee", drive, trusted, one_speed, np.zeros(n), period_s=0.02, standstill=0.0)


def test_errors_that_change_every_second_repeat_themselves_for_a_second() -> None:
    """All fifty samples of a second are as good as one, and the noise is as correlated as half of a second."""
    rng = np.random.default_rng(8)
    velocity, acceleration = _motion(rng, 20000)
    left = np.repeat(rng.choice([-0.3, 0.3], 400), 50)
    friction = fit_friction(
        "knee", left, np.zeros(len(left)), velocity, acceleration, period_s=1.0 / RATE_HZ, standstill=1e-9
    )
    assert friction.noise_time_s == pytest.approx(0.5 * 49.0 / RATE_HZ, rel=0.03)
    assert friction.variance == pytest.approx(0.09, rel=0.03)


def _trusted(seed: int, samples: int = 900) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Drive torque with gaps over a trusted torque of zero, velocity and acceleration."""
    rng = np.random.default_rng(seed)
    velocity, acceleration = _motion(rng, samples)
    left = friction_terms(velocity, acceleration) @ TRUE
    left += np.convolve(rng.standard_normal(samples + 9), np.full(10, 0.05), "valid")
    left[::11] = np.nan
    return left, velocity, acceleration


def test_the_covariance_of_friction_is_that_of_repeated_samples_and_lasting_errors() -> None:
    """Least squares of samples that are worth less by what repeats itself, and what lasting errors do to the fit."""
    left, velocity, acceleration = _trusted(9)
    lasting = np.stack([np.sin(np.arange(len(left)) / 50.0), np.full(len(left), 0.2)], axis=1)
    shared = np.full((len(left), 1), 0.3)
    friction = fit_friction(
        "knee",
        left,
        np.zeros(len(left)),
        velocity,
        acceleration,
        period_s=1.0 / RATE_HZ,
        standstill=STANDSTILL,
        trusted_lasting=0.01 * lasting,
        trusted_shared=shared,
    )
    used = np.isfinite(left) & (np.abs(velocity) >= STANDSTILL)
    terms = friction_terms(velocity, acceleration)[used]
    moved = np.linalg.lstsq(terms, np.hstack([0.01 * lasting, shared])[used], rcond=None)[0]
    repeated = 1.0 + 2.0 * friction.noise_time_s * RATE_HZ
    assert repeated > 1.5
    expected = friction.variance * repeated * np.linalg.inv(terms.T @ terms) + moved @ moved.T
    np.testing.assert_allclose(friction.covariance, expected, rtol=1e-8, atol=1e-12)
    np.testing.assert_allclose(friction.shared, -moved[:, 2:], atol=1e-12)


def test_noise_of_the_trusted_torque_is_not_the_drives() -> None:
    """Its mean where friction is fitted is taken off, down to a tenth of the residual variance and no further."""
    left, velocity, acceleration = _trusted(10)
    used = np.isfinite(left) & (np.abs(velocity) >= STANDSTILL)
    stated = np.where(used, np.linspace(1e-3, 5e-3, len(left)), 1e6)

    def fitted(variance: FloatArray | None) -> Friction:
        motion = (np.zeros(len(left)), velocity, acceleration)
        options = {"period_s": 1.0 / RATE_HZ, "standstill": STANDSTILL}
        return fit_friction("knee", left, *motion, **options, trusted_variance=variance)

    plain, less, least = fitted(None), fitted(stated), fitted(np.full(len(left), 1e3))
    assert plain.variance - less.variance == pytest.approx(stated[used].mean())
    assert least.variance == pytest.approx(0.1 * plain.variance)
    for one in (less, least):
        np.testing.assert_allclose(one.covariance, plain.covariance)
        assert one.noise_time_s == plain.noise_time_s


def test_lasting_errors_that_friction_takes_up_leave_nothing() -> None:
    """An offset, and one in proportion to the speed: coefficients are as much less sure, and nothing else changes."""
    left, velocity, acceleration = _trusted(11)
    motion = (np.zeros(len(left)), velocity, acceleration)
    options = {"period_s": 1.0 / RATE_HZ, "standstill": STANDSTILL}
    plain = fit_friction("knee", left, *motion, **options)
    lasting = np.stack([np.full(len(left), 0.3), 0.2 * velocity], axis=1)
    friction = fit_friction("knee", left, *motion, **options, trusted_lasting=lasting)
    assert friction.variance == pytest.approx(plain.variance)
    assert friction.noise_time_s == pytest.approx(plain.noise_time_s)
    np.testing.assert_allclose(friction.covariance - plain.covariance, np.diag([0.0, 0.04, 0.0, 0.09]), atol=1e-9)


def test_lasting_errors_explain_at_most_nine_tenths_of_a_residual() -> None:
    """What is left has a tenth of the variance over the degrees of freedom, if lasting errors are all of it."""
    residual = np.random.default_rng(5).normal(size=400)
    whole = _Scatter.of(np.ones(400, dtype=np.bool_), residual, residual[:, None], length=50)
    assert whole.variance == pytest.approx(0.1 * (residual @ residual) / (400 - 4))


def test_errors_that_change_sign_at_every_sample_do_not_repeat_themselves() -> None:
    """Their means are better than of independent ones; samples are still worth one each."""
    residual = np.resize([1.0, -1.0], 400)
    alternating = _Scatter.of(np.ones(400, dtype=np.bool_), residual, np.zeros((400, 0)), length=50)
    assert alternating.repeated == 1.0


def test_errors_of_one_drive_do_not_reach_another() -> None:
    """Of two joints each has four lasting errors of its own, and its own noise."""
    frictions = [_fitted(1), replace(_fitted(2), joint="hip")]
    velocity, acceleration = np.array([[0.5, -0.4], [-0.3, 0.6]]), np.array([[1.0, 2.0], [0.5, -1.0]])
    source = motor_source("current", frictions, np.arange(2), np.ones((2, 2)), velocity, acceleration)
    for k, friction in enumerate(frictions):
        terms = friction_terms(velocity[:, k], acceleration[:, k])
        np.testing.assert_allclose(
            source.covariance[:, k, k],
            friction.variance + np.einsum("ni,ij,nj->n", terms, friction.covariance, terms),
        )
    np.testing.assert_allclose(source.covariance[:, 0, 1], 0.0, atol=1e-15)


@pytest.mark.parametrize(("lasting", "variance"), [(0.0, 4.2), (0.5, 3.75)])
def test_samples_that_are_as_good_as_one_by_hand(lasting: float, variance: float) -> None:
    """Blocks of four, of which one has no sample and one a single one; nine samples leave five for the scatter.

    Sums over roots of their counts are 1, 4 and -2, and squares of samples add up to 21; lasting errors leave both.
    """
    used = np.repeat([False, True, False, True, True], [4, 1, 3, 4, 4])
    residual = np.repeat([1.0, 2.0, -1.0], [1, 4, 4])
    scatter = _Scatter.of(used, residual, np.full((9, 1), lasting), length=4)
    assert scatter.variance == pytest.approx(variance)
    assert scatter.repeated == pytest.approx(5.0 / 3.0)
    # what hardly repeats itself counts once, and no more than a block
    opposite = np.array([1.0, 2.0, -2.0, 2.0, -2.0, 1.0, -1.0, 1.0, -1.0])
    assert _Scatter.of(used, opposite, np.zeros((9, 0)), length=4).repeated == 1.0
