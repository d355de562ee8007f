# SPDX-License-Identifier: BSD-3-Clause
"""A sensor of a joint fit in the form of every calibration: the same wrenches, and the same errors."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from forcetorque.calibration.joint.fit import fit_jointly
from forcetorque.calibration.joint.model_error_columns import error_terms
from forcetorque.calibration.joint.posterior_and_calibrations import sensor_posterior
from forcetorque.calibration.joint.unknowns import UNITS, JointFit
from forcetorque.calibration.joint.windows import part_windows
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.robot_model_error import ModelTolerance
from forcetorque.robot.mechanics.sub_model_equations import untouched_parts
from tests.calibration.joint.swaying import FEET, SENSORS, swaying

SENSOR = "l_foot_ft"
LOADS = np.array([[0.0, 0.0, 200.0, 0.0, 0.0, 0.0], [20.0, -10.0, 100.0, 3.0, 2.0, 1.0]])


@cache
def _fit() -> JointFit:
    stretch = swaying(61, duration_s=5.0, mass=0.02, joint_zero_rad=0.005).stretch
    parts = untouched_parts(stretch.tree, SENSORS, FEET)
    terms = error_terms(stretch.tree, parts, ModelTolerance())
    return fit_jointly(part_windows(stretch, parts, terms), terms)


def _posterior(repeatability: float = 0.0) -> Posterior:
    loads = LOADS[:1]
    return sensor_posterior(
        _fit(), SENSOR, ["day"], noise=np.full(6, 0.1), repeatability=repeatability, mean_loads=loads
    )


def test_the_mean_reads_what_the_fit_reads() -> None:
    """1 + E undoes 1 + D, and the offset is carried along."""
    fit, posterior = _fit(), _posterior()
    factor, offset = np.eye(6) + posterior.mean[:, :6], posterior.mean[:, 6]
    reading = factor @ LOADS[1] + offset  # by the prior matrix
    np.testing.assert_allclose(fit.wrench(SENSOR, "day", reading[None], {})[0], LOADS[1], atol=1e-9)
    np.testing.assert_allclose(posterior.to_wrench, fit.change(SENSOR))


@pytest.mark.parametrize("session", ["day", None])
def test_the_predicted_error_is_that_of_draws_of_the_fit(session: str | None) -> None:
    """Changes and offsets are drawn from the joint covariance; their readings of a load scatter as predicted."""
    fit, posterior = _fit(), _posterior()
    rng = np.random.default_rng(1)
    values, vectors = np.linalg.eigh(fit.covariance)
    draws = fit.mean + rng.normal(size=(4000, len(values))) * np.sqrt(np.maximum(values, 0.0)) @ vectors.T
    factor, offset = np.eye(6) + posterior.mean[:, :6], posterior.mean[:, 6]
    load = LOADS[1]
    reading = factor @ load + offset if session is not None else factor @ load
    errors = []
    for mean in draws:
        drawn = JointFit(places=fit.places, mean=mean, covariance=fit.covariance, prior_root=fit.prior_root)
        added = drawn.offset(SENSOR, "day") if session is not None else np.zeros(6)
        errors.append(drawn.change(SENSOR) @ reading + added - load)
    spread = np.sqrt((np.array(errors) ** 2).mean(axis=0))
    predicted = np.sqrt(np.diag(posterior.error_covariance(load, session=session)))
    # rows of a calibration are independent, those of the fit are not: fx is predicted 17 % too wide
    np.testing.assert_allclose(predicted, spread, rtol=0.2)


def test_the_error_of_a_change_of_load_is_linear_in_the_changes_of_the_sensor() -> None:
    """Forces and moments of single changes by hand: what one of them adds for a load, times their covariance."""
    fit = _fit()
    places = fit.places.changes(SENSOR)
    derivative = []
    for place in range(places.start, places.stop):
        mean = np.zeros_like(fit.mean)
        mean[place] = 1.0
        changed = JointFit(places=fit.places, mean=mean, covariance=fit.covariance, prior_root=fit.prior_root)
        derivative.append((changed.change(SENSOR) - np.eye(6)) @ LOADS.T)  # (6, loads)
    errors = fit.error_covariance(SENSOR, LOADS)
    for k in range(len(LOADS)):
        jacobian = np.array(derivative)[:, :, k].T
        np.testing.assert_allclose(errors[k], jacobian @ fit.covariance[places, places] @ jacobian.T, rtol=1e-9)
    np.testing.assert_allclose(fit.error_covariance(SENSOR, 2.0 * LOADS), 4.0 * errors, rtol=1e-12)


def test_repeatability_widens_but_teaches_nothing() -> None:
    """What a sensor does not repeat stands in its error, not in what was learnt."""
    exact, creeping = _posterior(), _posterior(0.003)
    np.testing.assert_array_equal(exact.mean_covariance, creeping.mean_covariance)
    added = creeping.error_covariance(LOADS[0]) - exact.error_covariance(LOADS[0])
    assert np.sqrt(added[2, 2]) == pytest.approx(0.003 * 200.0, rel=0.1)


def test_the_prior_is_as_wide_as_it_was() -> None:
    """By the size that the data gave the changes."""
    fit, posterior = _fit(), _posterior()
    before = posterior.prior_error_covariance(LOADS[0])
    assert before is not None
    by_row = fit.prior_covariance(SENSOR).reshape(6, 6, 6, 6)
    unit = LOADS[0] / UNITS
    expected = np.einsum("b,abcd,d->ac", unit, by_row, unit) * np.outer(UNITS, UNITS)
    np.testing.assert_allclose(np.diag(before), np.diag(expected), rtol=0.3)  # turned by 1 + D


def test_data_never_widen_what_was_known_before() -> None:
    """In no direction of all unknowns has the fit more variance than before the data, and in some nearly none."""
    fit = _fit()
    before = fit.prior_root @ fit.prior_root.T
    size = np.sqrt(np.diag(before))
    narrowed = np.linalg.eigvalsh((before - fit.covariance) / np.outer(size, size))
    assert narrowed[0] > -1e-9  # rounding
    assert (np.diag(fit.covariance) / size**2).min() < 1e-6
