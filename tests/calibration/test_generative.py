# SPDX-License-Identifier: BSD-3-Clause
"""The generative fit on sensors that are as it supposes: what it finds, what it leaves, and what it knows of both."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import CANDIDATES
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.generative.model import _have_rank
from forcetorque.calibration.thesis.regression import solve
from forcetorque.experiment.calibration.estimation_type import Estimation
from forcetorque.experiment.calibration.moments import Moments, WindowMeans
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.simulation.simulated_sensor import distorted_by_mounting
from tests.calibration.synthetic import (
    LIMIT_COUNTS,
    MOUNTED,
    OFFSET,
    PRIOR,
    anyhow,
    assumptions,
    hanging,
    read_by,
)
from tests.cases import some_cases
from tests.payload.identification.payloads import slow

ROUNDING = 1e-8
"""Relative: double precision times the condition of the whitened columns, some 1e6."""
TEMPERATURE = LinearVariable(name="temperature", unit="degC", reference_value=30.0)
SLOPE = np.array([[0.5], [-0.3], [1.0], [0.01], [0.02], [-0.01]])
"""What a degree does; N, N m."""
EIGHT = np.vstack(
    [np.linalg.inv(MOUNTED), [[9.0, 16.0, 20.0, 300.0, -200.0, 500.0], [-15.0, 4.0, 25.0, 0.0, 700.0, 300.0]]]
)
"""Response of eight gauges; counts per N and N m."""


def _excess(matrix: FloatArray, response: FloatArray | None = None) -> FloatArray:
    """What a matrix reads of a load beside the load itself; shape (6, 6)."""
    return matrix @ (np.linalg.inv(MOUNTED) if response is None else response) - np.eye(6)


def _kept(fit: GenerativeFit) -> FloatArray:
    """Measured response less that by the prior; zero where the prior was kept; shape (6, 6)."""
    return PRIOR @ np.linalg.inv(fit.model.matrix) - np.eye(6)


def test_a_direction_that_no_load_moves_keeps_its_prior() -> None:
    """A force that turns in the x-y plane teaches two columns of the response; the other four stay as they were."""
    wrench = hanging(5.0, (0.0, 0.0, 0.0)) * [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]
    data = read_by(wrench)
    fit = fit_generative([data], PRIOR, assumptions())
    assert np.abs(_kept(fit)[:, 2:]).max() < ROUNDING
    assert np.abs(_excess(fit.model.matrix)[:2, :2]).max() < 1e-3
    assert np.abs(_excess(PRIOR)[:2, :2]).max() > 0.02
    # negative control: noise in the counts takes these directions from the ridge of the thesis, be lambda small
    ridge = solve(Moments.of(data.raw, data.reference), Estimation(prior=PRIOR), 1e-3)
    response = ridge.matrix @ np.linalg.inv(MOUNTED)
    assert np.abs(np.diag(response)[2:]).max() < 0.1


def test_loads_that_rounding_makes_negative_have_no_rank() -> None:
    """Squares of a load that does not move are zero but for rounding, of either sign."""
    assert _have_rank(np.eye(6))
    assert not _have_rank(np.diag([1.0, 1.0, 1.0, 1.0, 1.0, -1e-17]))


@pytest.mark.parametrize(
    ("accuracy", "lasts_s", "found"),
    [(0.0, 2.0, {2.0}), (0.0, 15.0, {15.0}), (0.1, 2.0, {15.0}), (0.1, 15.0, {15.0, 50.0})],
)
def test_noise_beside_an_error_of_the_reference_lasts_15_s_or_longer(
    accuracy: float, lasts_s: float, found: set[float]
) -> None:
    """What averages out is not the reference's; noise that lasts 15 s is found where it is, in four channels of six."""
    rng, load = np.random.default_rng(4), anyhow(n=400)
    means = read_by(load)
    noisy = replace(means, raw=means.raw + 20.0 * np.column_stack([slow(400, lasts_s, rng) for _ in range(6)]))
    stated = np.repeat([accuracy, 0.1 * accuracy], 3)
    noises = fit_generative([noisy], PRIOR, assumptions(accuracy=stated)).posterior.noise
    times = [noise.time_constant_s for noise in noises]
    assert set(times) <= found
    assert times.count(min(found)) >= 4


def test_a_limb_that_stands_still_leaves_the_prior_and_finds_the_offset() -> None:
    """Then nothing is learnt of the matrix, and the offset is that of the prior."""
    wrench = np.tile(hanging(5.0, (0.02, 0.0, -0.1), n=1), (40, 1))
    data = read_by(wrench)
    fit = fit_generative([data], PRIOR, assumptions())
    np.testing.assert_allclose(fit.model.matrix, PRIOR, rtol=0.0, atol=ROUNDING * np.abs(PRIOR).max())
    of_prior = np.average(data.reference - data.raw @ PRIOR.T, axis=0, weights=data.count)
    # slow noise weighs the ends more than the middle, by less than the readings tremble
    np.testing.assert_allclose(fit.offsets[0], of_prior, rtol=0.0, atol=1e-3)
    before = fit.posterior.prior_covariance
    assert before is not None
    np.testing.assert_allclose(fit.posterior.mean_covariance, before, rtol=1e-6, atol=1e-9 * before.max())


@pytest.mark.long
@pytest.mark.parametrize("with_prior", [True, False])
def test_errors_are_as_large_as_they_are_said_to_be(with_prior: bool) -> None:
    """Error over standard error of 432 coefficients of 12 sensors has a root mean square of 1, and none is above 4.5.

    The spread of 432 squares is 7 % of their mean; a quarter leaves room for sizes that sensors share.
    """
    ratios = []
    for seed in range(12):
        prior = distorted_by_mounting(MOUNTED, relative=0.06, rng=np.random.default_rng(seed))
        loads = anyhow(seed=seed) if seed % 2 or not with_prior else hanging(5.0, (0.03, 0.0, -0.1), seed=seed)
        fit = fit_generative([read_by(loads, seed=seed)], prior if with_prior else None, assumptions())
        assert fit.posterior.space == ("wrench" if with_prior else "channel")
        ratios.append((fit.model.matrix - MOUNTED) / fit.posterior.matrix_error(fit.model.matrix))
    assert 0.75 < np.mean(np.square(ratios)) < 1.25
    assert np.abs(ratios).max() < 4.5


@pytest.mark.long
def test_sessions_share_a_matrix_and_have_offsets_of_their_own() -> None:
    """Bodies with other centres of mass, after other power-ups, tell together what neither tells alone."""
    centres, offsets = [(0.0, 0.0, -0.1), (0.1, 0.0, 0.0), (0.0, 0.1, 0.0)], [OFFSET, -OFFSET, 2.0 * OFFSET]
    data = [
        read_by(hanging(5.0, centre, seed=k), offset=offset, session=f"day {k}", seed=k)
        for k, (centre, offset) in enumerate(zip(centres, offsets, strict=True))
    ]
    fit = fit_generative(data, PRIOR, assumptions())
    alone = [np.abs(_excess(fit_generative([one], PRIOR, assumptions()).model.matrix)).max() for one in data]
    assert np.abs(_excess(fit.model.matrix)).max() < 0.01 * min(alone)
    for session, offset, true in zip(fit.posterior.sessions, fit.offsets, offsets, strict=True):
        assert (np.abs(offset - true) < 4.0 * fit.posterior.offset_error(offset, session)).all()
    np.testing.assert_array_equal(fit.model.offset, fit.offsets[-1])


@cache
def _two_sessions() -> tuple[list[WindowMeans], GenerativeFit]:
    """A body and another, each after a power-up of its own, and their fit."""
    loads = [hanging(5.0, (0.0, 0.0, -0.1)), hanging(5.0, (0.1, 0.0, 0.0), seed=1)]
    data = [read_by(load, session=name) for load, name in zip(loads, "ab", strict=True)]
    return data, fit_generative(data, PRIOR, assumptions())


@pytest.mark.long
@settings(max_examples=5)
@given(st.lists(st.floats(-1e4, 1e4), min_size=6, max_size=6))
def test_what_a_power_up_adds_moves_the_offset_of_its_session_alone(added: list[float]) -> None:
    """Counts added to a whole session change neither the matrix nor another offset; added to half of it they do."""
    data, fit = _two_sessions()
    moved = fit_generative([data[0], replace(data[1], raw=data[1].raw + added)], PRIOR, assumptions())
    np.testing.assert_allclose(moved.model.matrix, fit.model.matrix, rtol=0.0, atol=ROUNDING * np.abs(PRIOR).max())
    change = moved.offsets - fit.offsets
    np.testing.assert_allclose(change[1], -fit.model.matrix @ added, atol=1e-5)
    np.testing.assert_allclose(change[0], 0.0, atol=1e-5)


def test_a_step_within_a_session_is_no_offset() -> None:
    """Negative control of the above."""
    data = read_by(hanging(5.0, (0.0, 0.0, -0.1)))
    stepped = replace(data, raw=data.raw + 300.0 * (np.arange(len(data)) >= 20)[:, None])
    apart = fit_generative([stepped], PRIOR, assumptions()).model.matrix
    assert np.abs(apart - fit_generative([data], PRIOR, assumptions()).model.matrix).max() > 1e-3 * np.abs(PRIOR).max()


def test_what_drifts_is_no_error() -> None:
    """The residual of a fit with a drift is that of the same readings without a ramp; as constant it is far larger."""
    ramp, load = np.array([0.05, -0.02, 0.1, 0.002, 0.001, -0.003]), anyhow()
    still, drifting, constant = (
        fit_generative([read_by(load, drift=of_data)], PRIOR, assumptions(), drift=fitted, shapes=(CANDIDATES[0],))
        for of_data, fitted in ((0.0, True), (ramp, True), (ramp, False))
    )
    np.testing.assert_allclose(drifting.residual, still.residual, rtol=0.02)
    assert (constant.residual > 2.0 * drifting.residual).all()


@pytest.mark.long
def test_an_offset_may_drift() -> None:
    """A drift is found within its error; a ramp in time changes nothing else."""
    drift = np.array([0.05, -0.02, 0.1, 0.002, 0.001, -0.003])
    load = anyhow()
    still, ramp = (fit_generative([read_by(load, drift=one)], PRIOR, assumptions(), drift=True) for one in (0.0, drift))
    np.testing.assert_allclose(ramp.model.matrix, still.model.matrix, rtol=0.0, atol=1e-6 * np.abs(PRIOR).max())
    assert ramp.drifts is not None
    assert still.drifts is not None
    np.testing.assert_allclose(ramp.drifts - still.drifts, [drift], rtol=0.0, atol=1e-4)
    place = 6 + 1  # of the drift, after six coefficients and the offset
    spread = np.sqrt(ramp.posterior.to_wrench**2 @ ramp.posterior.covariance[:, place, place])
    assert (np.abs(ramp.drifts[0] - drift) < 4.0 * spread).all()
    np.testing.assert_allclose(ramp.offsets[0], OFFSET + drift * ramp.session_time_s[0], atol=0.05)
    # negative control: taken as constant the ramp is noise, which the fit sees
    constant = fit_generative([read_by(load, drift=drift)], PRIOR, assumptions())
    assert (constant.residual > 3.0 * ramp.residual).all()


def test_a_drift_of_a_session_of_two_seconds_is_refused() -> None:
    """Two means leave nothing beside offset and drift."""
    data = [read_by(anyhow(), session="long"), read_by(anyhow(n=2), session="short")]
    with pytest.raises(FitError, match="session 'short': expected at least 3 s"):
        fit_generative(data, PRIOR, assumptions(), drift=True)


@pytest.mark.long
def test_a_session_with_a_single_sample_gets_an_offset() -> None:
    """It tells nothing of the matrix, and its offset is known as well as one reading is."""
    data, single = read_by(anyhow(), session="long"), read_by(anyhow(n=1, seed=9), offset=-OFFSET, session="one")
    fit, alone = (fit_generative(stretches, PRIOR, assumptions()) for stretches in ([data, single], [data]))
    np.testing.assert_allclose(fit.model.matrix, alone.model.matrix, rtol=0.0, atol=1e-3 * np.abs(PRIOR).max())
    error = fit.posterior.offset_error(fit.offsets[1], "one")
    assert (np.abs(fit.offsets[1] + OFFSET) < 4.0 * error).all()
    assert (error > 3.0 * fit.posterior.offset_error(fit.offsets[0], "long")).all()
    only = fit_generative([single], PRIOR, assumptions())
    np.testing.assert_allclose(only.model.matrix, PRIOR, rtol=0.0, atol=ROUNDING * np.abs(PRIOR).max())
    assert np.isfinite(only.posterior.covariance).all()


@pytest.mark.long
def test_a_variable_that_hardly_moves_does_no_harm() -> None:
    """With 0.05 degC the matrix is as good as without, and with 10 degC the coefficient is found too."""
    fits = {degrees: _warmed(degrees) for degrees in (0.0, 0.05, 10.0)}
    np.testing.assert_allclose(_kept(fits[0.05]), _kept(fits[0.0]), rtol=0.0, atol=2e-3)
    errors = {}
    for degrees, fit in fits.items():
        errors[degrees] = fit.posterior.coefficient_error(fit.model.coefficients)
        assert (np.abs(fit.model.coefficients - SLOPE) < 4.0 * errors[degrees]).all()
    assert (errors[10.0] < 0.1 * errors[0.05]).all()
    assert (np.abs(fits[10.0].model.coefficients - SLOPE) < 0.1 * np.abs(SLOPE)).all()


def _warmed(degrees: float) -> GenerativeFit:
    """A sensor that is warmed, and fitted with its temperature."""
    load = anyhow()
    warmer = np.linspace(0.0, degrees, len(load))[:, None]
    data = read_by(load, variables=warmer, coefficients=SLOPE)
    return fit_generative([replace(data, variables=30.0 + warmer)], PRIOR, assumptions(), variables=[TEMPERATURE])


@some_cases("prior", [None, np.array([0.5, -0.3, 1.0, 0.01, 0.02, -0.01])])
def test_a_variable_that_never_moves_keeps_the_coefficient_it_had(prior: FloatArray | None) -> None:
    """Zero, or what was said of it, with the standard deviation that was supposed: half a per cent of full scale."""
    data = read_by(anyhow())
    data = replace(data, variables=np.full((len(data), 1), 30.0))
    variable = replace(TEMPERATURE, prior=prior)
    fit = fit_generative([data], PRIOR, assumptions(), variables=[variable])
    usual = np.zeros(6) if prior is None else prior
    # the prior speaks of wrenches by the prior matrix, the coefficient of those by the new one
    expected = np.linalg.solve(np.eye(6) + _kept(fit), usual)
    np.testing.assert_allclose(fit.model.coefficients[:, 0], expected, rtol=0.0, atol=1e-6)
    supposed = 0.005 * np.sqrt((PRIOR**2).mean(axis=1)) * LIMIT_COUNTS
    error = fit.posterior.coefficient_error(fit.model.coefficients)[:, 0]
    np.testing.assert_allclose(error, supposed, rtol=0.2)


def test_a_variable_of_which_nothing_is_known_must_move() -> None:
    """A constant voltage would get a coefficient of zero that is known exactly; temperatures are known beforehand."""
    data = read_by(anyhow())
    data = replace(data, variables=np.full((len(data), 1), 24.0))
    supply = LinearVariable(name="supply", unit="V")
    with pytest.raises(FitError, match="'supply': expected prior_deviation.*the same throughout the data"):
        fit_generative([data], PRIOR, assumptions(), variables=[supply])
    deviation = np.array([0.5, 0.5, 0.5, 0.01, 0.01, 0.01])
    fit = fit_generative([data], PRIOR, assumptions(), variables=[replace(supply, prior_deviation=deviation)])
    np.testing.assert_allclose(fit.posterior.coefficient_error(fit.model.coefficients)[:, 0], deviation, rtol=0.2)


def test_prior_deviations_of_a_variable_are_respected() -> None:
    """A coefficient that is stated to a thousandth stays, whatever the data say."""
    load, slope = anyhow(), np.full((6, 1), 0.01)
    temperature = np.linspace(0.0, 5.0, len(load))[:, None]
    data = read_by(load, variables=temperature, coefficients=slope)
    sure = LinearVariable(
        name="temperature", unit="degC", reference_value=0.0, prior=np.zeros(6), prior_deviation=np.full(6, 1e-9)
    )
    fit = fit_generative([data], PRIOR, assumptions(), variables=[sure])
    assert np.abs(fit.model.coefficients).max() < 1e-6


@some_cases("with_prior", [True, False])
def test_eight_channels_are_fitted_with_a_prior_and_without(with_prior: bool) -> None:
    """Both read loads to a thousandth; the prior is several per cent off."""
    rng = np.random.default_rng(5)
    prior = np.linalg.pinv(EIGHT) @ np.diag(1.0 + 0.05 * rng.normal(size=8))
    fit = fit_generative([read_by(anyhow(), response=EIGHT)], prior if with_prior else None, assumptions(channels=8))
    assert fit.posterior.space == "channel"
    assert fit.model.matrix.shape == (6, 8)
    size = np.array([1.0, 1.0, 1.0, 0.02, 0.02, 0.02])  # N m per N of this sensor
    after, before = (np.abs(_excess(one, EIGHT) * size / size[:, None]).max() for one in (fit.model.matrix, prior))
    assert after < 2e-3
    assert before > 0.02


def test_eight_channels_with_a_prior_keep_it_where_nothing_moves() -> None:
    """A body in one posture moves nothing: the response stays, whatever matrix best reads it."""
    wrench = np.tile(hanging(5.0, (0.02, 0.0, -0.1), n=1), (40, 1))
    data = read_by(wrench, response=EIGHT)
    fit = fit_generative([data], np.linalg.pinv(EIGHT), assumptions(channels=8))
    np.testing.assert_allclose(fit.model.matrix @ EIGHT, np.eye(6), rtol=0.0, atol=1e-6)


def test_without_a_prior_a_direction_that_is_not_loaded_is_named() -> None:
    """A torque about z that never changes; a body in one piece, whose moments follow from its forces."""
    with pytest.raises(FitError, match="move 5 of 6 directions, not tz; without a prior"):
        fit_generative([read_by(anyhow() * [1.0, 1.0, 1.0, 1.0, 1.0, 0.0])], None, assumptions())
    with pytest.raises(FitError, match="move 3 of 6 directions"):
        fit_generative([read_by(hanging(5.0, (0.0, 0.0, -0.1)))], None, assumptions())


def test_without_a_prior_a_direction_that_is_hardly_loaded_is_named() -> None:
    """A torque that moves less than the reading trembles is as good as none."""
    data = read_by(anyhow() * [1.0, 1.0, 1.0, 1.0, 1.0, 1e-4], noise_counts=20.0)
    with pytest.raises(FitError, match="loads hardly move tz, the response to it is not known by half; without"):
        fit_generative([data], None, assumptions())


def test_five_channels_are_refused() -> None:
    """Six directions of load need six channels."""
    data = read_by(anyhow(), response=np.linalg.inv(MOUNTED)[:5])
    with pytest.raises(FitError, match="at least 6 channels.*got 5"):
        fit_generative([data], None, assumptions(channels=5))


def test_masses_in_grams_are_no_sensor() -> None:
    """By loads a thousand times too large the sensor would hardly answer; mounting does not do that.

    The gain is a thousandth, not what rounding makes of noise that few means leave nothing of.
    """
    data = read_by(anyhow())
    with pytest.raises(FitError, match="with 0.00 of what its prior says; mounting does not do that"):
        fit_generative([replace(data, reference=1000.0 * data.reference)], PRIOR, assumptions())


@cache
def _one_session() -> tuple[WindowMeans, GenerativeFit]:
    """A body, and its fit."""
    data = read_by(hanging(5.0, (0.03, 0.0, -0.1)))
    return data, fit_generative([data], PRIOR, assumptions())


@pytest.mark.long
@settings(max_examples=5)
@given(st.floats(-3.0, 3.0))
def test_the_unit_of_a_count_does_not_matter(decades: float) -> None:
    """Counts ten times as large, with a tenth of the matrix, tell the same."""
    factor = 10.0**decades
    data, fit = _one_session()
    known = assumptions()
    scaled = fit_generative(
        [replace(data, raw=factor * data.raw)], PRIOR / factor, replace(known, full_scale=factor * known.full_scale)
    )
    largest = np.abs(PRIOR).max()
    np.testing.assert_allclose(factor * scaled.model.matrix, fit.model.matrix, rtol=0.0, atol=1e-6 * largest)
    np.testing.assert_allclose(scaled.offsets, fit.offsets, rtol=0.0, atol=1e-5)
    np.testing.assert_allclose(scaled.posterior.covariance, fit.posterior.covariance, rtol=1e-4, atol=1e-9)


def test_rows_of_channels_and_of_wrenches_agree_where_all_is_loaded() -> None:
    """Six channels without a prior are fitted channel by channel, with one component by component."""
    data = [read_by(anyhow(n=400))]
    wrench, channel = (fit_generative(data, prior, assumptions()) for prior in (PRIOR, None))
    spread = channel.posterior.matrix_error(channel.model.matrix)
    assert (np.abs(wrench.model.matrix - channel.model.matrix) < 0.5 * spread).all()
    np.testing.assert_allclose(wrench.posterior.matrix_error(wrench.model.matrix), spread, rtol=0.15)


def test_an_accuracy_of_the_reference_limits_what_small_loads_teach() -> None:
    """A body of 5 kg that is turned slowly teaches in spite of an error of 0.5 N, one of 0.05 kg does not."""
    centre = np.array([0.03, 0.0, -0.1])
    angle = 2.0 * np.pi * np.arange(120) / 120.0
    direction = np.stack([np.sin(angle), np.zeros_like(angle), np.cos(angle)], axis=1)
    load = np.hstack([direction, np.cross(centre, direction)])
    left = {}
    for weight_N in (50.0, 0.5):
        for accuracy_N in (0.5, 0.0):
            known = assumptions(accuracy=accuracy_N * np.array([1.0, 1.0, 1.0, 0.04, 0.04, 0.04]))
            posterior = fit_generative([read_by(weight_N * load, noise_counts=0.05)], PRIOR, known).posterior
            before = posterior.prior_error_covariance(load[0])
            assert before is not None
            left[weight_N, accuracy_N] = np.sqrt(posterior.error_covariance(load[0])[2, 2] / before[2, 2])
    assert left[50.0, 0.5] < 0.3
    assert left[0.5, 0.5] > 0.9
    # negative control: a perfect reference lets it teach
    assert left[0.5, 0.0] < 0.3


def test_repeatability_widens_and_moves_nothing() -> None:
    """Three thousandths of the response are added to every error, and the matrix is the same."""
    data = [read_by(anyhow())]
    sure, unsure = (
        fit_generative(data, PRIOR, assumptions(repeatability=share), shapes=CANDIDATES[:1]) for share in (0.0, 0.003)
    )
    np.testing.assert_array_equal(sure.model.matrix, unsure.model.matrix)
    push = np.array([50.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    narrow, wide = (np.sqrt(one.posterior.error_covariance(push)[0, 0]) for one in (sure, unsure))
    rms = np.sqrt((PRIOR**2).mean(axis=1))[0]
    added = 0.003 * rms * np.linalg.norm(np.linalg.inv(PRIOR)[:, 0]) * 50.0
    np.testing.assert_allclose(wide**2 - narrow**2, added**2, rtol=0.2)


def test_order_of_recordings_does_not_matter() -> None:
    """Nor where the clock of a recording starts."""
    data = [read_by(hanging(5.0, (0.1 * k, 0.0, -0.1), seed=k), session=f"day {k}", seed=k) for k in range(3)]
    later = [replace(one, time_s=one.time_s + 1e6) for one in reversed(data)]
    fit, other = (fit_generative(stretches, PRIOR, assumptions()) for stretches in (data, later))
    np.testing.assert_allclose(other.model.matrix, fit.model.matrix, rtol=0.0, atol=1e-6 * np.abs(PRIOR).max())
    np.testing.assert_allclose(other.offsets[::-1], fit.offsets, rtol=0.0, atol=1e-5)


def test_no_data_and_data_that_differ_are_refused() -> None:
    """A campaign without an interval, and intervals of other numbers of channels."""
    with pytest.raises(FitError, match="at least one calibration interval"):
        fit_generative([], PRIOR, assumptions())
    stretches: list[WindowMeans] = [read_by(anyhow()), read_by(anyhow(), response=EIGHT)]
    with pytest.raises(ValueError, match="expected one number of raw channels"):
        fit_generative(stretches, PRIOR, assumptions())


def _wandering(rng: np.random.Generator, n: int, forgets_in_s: float) -> FloatArray:
    """Ornstein-Uhlenbeck errors of size 1 every second; shape (n, 6)."""
    kept = np.exp(-1.0 / forgets_in_s)
    steps = rng.normal(size=(n, 6)) * np.sqrt(1.0 - kept**2)
    steps[0] = rng.normal(size=6)
    values = [steps[0]]
    for step in steps[1:]:
        values.append(kept * values[-1] + step)
    return np.array(values)


@some_cases("with_prior", [True, False])
@some_cases("forgets_in_s", [15.0, 50.0])
def test_an_accuracy_in_wrenches_is_no_error_of_each_channel_by_itself(forgets_in_s: float, with_prior: bool) -> None:
    """References that wander by 0.9 N and 0.2 N m: pushes err as predicted, in force and in moment, prior or not.

    Six channels without a prior took the moment for errors of the channels, which came back as errors of force,
    10 to 20 times too large.
    """
    accuracy = np.repeat([0.9, 0.2], 3)
    push = np.random.default_rng(0).normal(size=(50, 6)) * [50.0, 50.0, 50.0, 5.0, 5.0, 5.0]
    ratios = []
    for seed in range(4):
        loads = np.repeat(anyhow(n=24, seed=seed), 10, axis=0)
        reference = loads + accuracy * _wandering(np.random.default_rng(seed), len(loads), forgets_in_s)
        data = replace(read_by(loads, seed=seed), reference=reference)
        fit = fit_generative([data], PRIOR if with_prior else None, assumptions(accuracy=accuracy))
        predicted = np.einsum("nii->i", fit.posterior.error_covariance(push)) / len(push)
        error = ((push @ _excess(fit.model.matrix).T) ** 2).mean(axis=0)
        ratios.append([error[part].sum() / predicted[part].sum() for part in (slice(3), slice(3, 6))])
    assert (np.abs(np.log(np.sqrt(np.mean(ratios, axis=0)))) < np.log(1.6)).all()  # 36 coefficients, four times
