# SPDX-License-Identifier: BSD-3-Clause
"""The uncertainty of a prior matrix, as a certificate states it: how far a fit may leave the matrix without data."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.base.units import NORMAL_95
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.joint.unknowns import UNITS, SensorPrior
from forcetorque.calibration.moments_of_samples import assumptions_of
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions, stated_prior_size
from forcetorque.experiment.campaign_intervals import CampaignRecording
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.identification.matrix_uncertainty import MatrixSpread
from tests.calibration.synthetic import LIMIT_COUNTS, MOUNTED, PRIOR, anyhow, assumptions, hanging, read_by
from tests.scenes.experiments import PARQUET, edit

FULL_SCALE = np.array([500.0, 500.0, 1000.0, 20.0, 20.0, 10.0])
PERCENT = np.array([1.0, 1.25, 0.75, 1.5, 1.25, 1.0])
DEVIATION = PERCENT / 100.0 * FULL_SCALE / NORMAL_95


def _stated(matrix: FloatArray = PRIOR, *, times: float = 1.0) -> Assumptions:
    counts = np.full(matrix.shape[1], LIMIT_COUNTS)
    size = stated_prior_size(matrix, counts, FULL_SCALE, times * DEVIATION)
    return replace(assumptions(channels=matrix.shape[1]), prior_size=size)


def _at_full_scale(covariance: FloatArray) -> FloatArray:
    """Root mean square error of rows over six loads of full scale; covariance of rows of shape (6, 6, 6)."""
    return np.sqrt(np.einsum("ijj,j->i", covariance[:, :6, :6], FULL_SCALE**2) / 6.0)


def test_before_data_readings_are_as_uncertain_as_stated() -> None:
    """Single fit, joint fit and weighing of loads take one covariance from what is stated."""
    known = _stated()
    spread = MatrixSpread.of(PRIOR, known)
    sizes = np.stack([spread.expected[:, 0], np.zeros(2)], axis=1)  # of coefficients, without gain and frame
    np.testing.assert_allclose(_at_full_scale(spread.covariance(sizes)), DEVIATION)
    prior = SensorPrior.of(PRIOR, known)
    of_coefficients = prior.basis[:, :36] * prior.scales[0].expected
    rows = (of_coefficients @ of_coefficients.T).reshape(6, 6, 6, 6)[np.arange(6), :, np.arange(6), :]
    in_si = rows * UNITS[:, None, None] ** 2 / np.outer(UNITS, UNITS)
    np.testing.assert_allclose(_at_full_scale(in_si), DEVIATION)


def _error(fit: GenerativeFit, load: FloatArray) -> float:
    counts = np.linalg.solve(MOUNTED, load.T).T
    return float(np.linalg.norm((counts @ fit.model.matrix.T - load)[:, :3], axis=1).mean())


def test_a_matrix_is_kept_as_far_as_it_is_stated_to_be_right() -> None:
    """A tight statement keeps the matrix where data say little; what data contradict is left all the same."""
    little, much = [read_by(hanging(0.05, [0.0, 0.0, 0.03]))], [read_by(anyhow())]
    tight, usual = _stated(times=0.01), assumptions()
    kept, changed = (
        np.linalg.norm(fit_generative(little, PRIOR, known).model.matrix @ np.linalg.inv(PRIOR) - np.eye(6))
        for known in (tight, usual)
    )
    assert kept < 0.5 * changed
    load = anyhow(seed=5)
    before = float(np.linalg.norm((np.linalg.solve(MOUNTED, load.T).T @ PRIOR.T - load)[:, :3], axis=1).mean())
    # the mounted sensor is 5 % off, far more than stated: 60 loads in all directions say so
    assert _error(fit_generative(much, PRIOR, tight), load) < 0.05 * before


def test_predicted_errors_are_those_that_are_stated() -> None:
    """Where nothing but one weight was seen, errors of other loads are predicted as stated, not as usual."""
    load = np.diag(FULL_SCALE)
    data = [read_by(hanging(0.05, [0.0, 0.0, 0.03]))]
    predicted = {
        name: np.sqrt(np.einsum("nii->ni", fit_generative(data, PRIOR, known).posterior.error_covariance(load)))
        for name, known in (("stated", _stated()), ("usual", assumptions()))
    }
    stated = np.sqrt((predicted["stated"] ** 2).mean(axis=0))
    # gain and frame are expected beside: by the reference a share of 2 %
    assert (stated > 0.9 * DEVIATION).all()
    assert (stated < np.sqrt((predicted["usual"] ** 2).mean(axis=0))).all()


def test_of_the_file(arm: Path) -> None:
    """It is percent of the full scale, and needs one and a prior."""
    line = "prior_uncertainty_percent = [1.0, 1.25, 0.75, 1.5, 1.25, 1.0]\n"
    file = edit(arm / PARQUET, "[[sensor]]\n", f"[[sensor]]\nfull_scale = {FULL_SCALE.tolist()}\n{line}")
    run = SensorRun(load_experiment(file), "arm_ft")
    np.testing.assert_allclose(run.sensor.prior_deviation, DEVIATION)
    assert run.sensor.prior is not None
    size = assumptions_of(CampaignRecording.of(run)).prior_size
    counts = np.full(run.sensor.prior.shape[1], run.sensor.limit_counts)
    np.testing.assert_allclose(size, stated_prior_size(run.sensor.prior, counts, FULL_SCALE, DEVIATION))
    edit(file, f"full_scale = {FULL_SCALE.tolist()}\n", "")
    with pytest.raises(ExperimentError, match="expected full_scale, of which prior_uncertainty_percent is a share"):
        load_experiment(file)
    edit(file, 'prior = "matrix_SIM001.txt"\n', "")
    with pytest.raises(FormatError, match="prior_uncertainty_percent needs prior"):
        load_experiment(file)


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("prior_uncertainty_percent", "0", "expected more than 0, got 0"),
        ("prior_uncertainty_percent", "-1.5", "expected more than 0, got -1.5"),
        ("prior_uncertainty_percent", "[1, 1, 0, 1, 1, 1]", "expected more than 0, got 0"),
        ("prior_uncertainty_percent", "[1, 1, 1, 1, 1]", "expected one number, or six .* percent of the full scale"),
        ("full_scale", "0", "expected more than 0, got 0"),
    ],
)
def test_one_number_that_is_wrong_is_named_by_its_key(arm: Path, key: str, value: str, expected: str) -> None:
    """One number stands for six, which are in no list of the file."""
    place = r"\[2\]" if "0," in value else ""
    edit(arm / PARQUET, "[[sensor]]\n", f"[[sensor]]\n{key} = {value}\n")
    with pytest.raises(FormatError, match=rf"sensor\[0\]\.{key}{place}: {expected}"):
        load_experiment(arm / PARQUET)
