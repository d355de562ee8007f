# SPDX-License-Identifier: BSD-3-Clause
"""The posterior against Gaussian inference written out: every column in its own unit, every covariance in full."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.experiment.calibration import expected_sensor_errors
from forcetorque.experiment.calibration.expected_sensor_errors import Scale
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from tests.calibration.synthetic import LIMIT_COUNTS, OFFSET, PRIOR, anyhow, assumptions as assumed, hanging, read_by

SLOPE = np.array([[0.5], [-0.3], [1.0], [0.01], [0.02], [-0.01]])
SENSOR, FRAME, QUADRATIC, FLATTENING, DEGREE, LEVER_M = 0.06, 0.02, 0.05, 0.03, 0.005, 0.1
REFERENCE_DEGC = 30.0
PAIRS = np.triu_indices(6)


def _stretches() -> list[WindowMeans]:
    """Two sessions of a warming sensor, one of two recordings, with slow noise and a flattened reference."""
    rng = np.random.default_rng(11)
    loads = [hanging(5.0, (0.03, 0.0, -0.1), n=25), anyhow(n=30, seed=4), anyhow(n=20, seed=5)]
    stretches = []
    for k, (load, session) in enumerate(zip(loads, ("one", "one", "two"), strict=True)):
        warmer = np.cumsum(rng.normal(size=(len(load), 1)), axis=0)
        data = read_by(
            load,
            offset=OFFSET * (1.0 if session == "one" else -1.0),
            variables=warmer,
            coefficients=SLOPE,
            noise_counts=5.0,
            session=session,
            recording=f"recording {k}",
            seed=k,
        )
        slow = np.cumsum(rng.normal(size=data.raw.shape), axis=0)
        stretches.append(
            replace(
                data,
                raw=data.raw + slow,
                variables=warmer + REFERENCE_DEGC,
                flattening=0.1 * rng.normal(size=load.shape),
                count=rng.integers(50, 101, len(load)).astype(float),
                time_s=data.time_s + 100.0 * (k == 1),
            )
        )
    return stretches


def _written_out(stretches: list[WindowMeans], row: int, result: GenerativeFit) -> tuple[FloatArray, FloatArray]:
    """Mean and covariance of [E, coefficient, two offsets, two drifts] of a row, given the noise that was chosen."""
    count, time = (np.concatenate([getattr(s, name) for s in stretches]) for name in ("count", "time_s"))
    flattening = np.concatenate([s.flattening for s in stretches])
    wrench = np.concatenate([s.reference for s in stretches]) + flattening / 3.0
    warmer = np.concatenate([s.variables for s in stretches]) - REFERENCE_DEGC
    lengths = [len(s) for s in stretches]
    recording = np.repeat(np.arange(3), lengths)
    member = np.repeat([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]], lengths, axis=0)
    size = LIMIT_COUNTS * np.sqrt((PRIOR**2).mean(axis=1))
    # columns
    counts = wrench @ np.linalg.inv(PRIOR).T / LIMIT_COUNTS
    about = counts - counts.mean(axis=0)
    elapsed = time - member @ result.session_time_s
    design = np.hstack(
        [wrench, warmer, member, member * elapsed[:, None], about[:, PAIRS[0]] * about[:, PAIRS[1]], flattening]
    )
    # what is known of each before the data; nothing of offsets and drifts
    reach = size[row] / LIMIT_COUNTS
    frame = np.array([1.0] * 3 + [0.0] * 3) if row < 3 else np.array([LEVER_M] * 3 + [1.0] * 3)
    response = np.linalg.inv(PRIOR)
    precision = np.zeros((len(design.T), len(design.T)))
    precision[:6, :6] = np.linalg.inv(SENSOR**2 * reach**2 * response.T @ response + FRAME**2 * np.diag(frame**2))
    precision[6, 6] = 1.0 / (DEGREE * size[row]) ** 2
    precision[11:32, 11:32] = np.eye(21) / (QUADRATIC * size[row]) ** 2
    precision[32:, 32:] = np.diag((np.arange(6) == row) / FLATTENING**2 + 1e12 * (np.arange(6) != row))
    # noise
    noise = result.posterior.noise[row]
    slow = np.zeros((len(time), len(time)))
    if noise.ratio:
        apart = np.abs(time[:, None] - time)
        slow = noise.ratio * np.exp(-apart / noise.time_constant_s) * (recording[:, None] == recording)
    covariance = noise.white**2 * (np.diag(np.median(count) / count) + slow)
    measured = np.concatenate([s.raw for s in stretches]) @ PRIOR[row] - wrench[:, row]
    weighed = np.linalg.solve(covariance, design)
    known = np.linalg.inv(design.T @ weighed + precision)
    # a reading is linear: its offset holds what the quadratic terms and the flattening come to over the session
    told = np.eye(11, len(known))
    told[7:9, 11:] = (member * count[:, None]).T @ design[:, 11:] / (member.T @ count)[:, None]
    return told @ known @ weighed.T @ measured, told @ known @ told.T


@pytest.fixture
def _fixed_sizes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take the expected sizes of all deviations for given."""
    for name, size in (("SENSOR", SENSOR), ("FRAME", FRAME), ("QUADRATIC_ALONE", QUADRATIC)):
        monkeypatch.setattr(expected_sensor_errors, name, Scale(expected=size, weight=np.inf))


@pytest.mark.usefixtures("_fixed_sizes")
def test_the_posterior_is_that_of_gaussian_inference_written_out() -> None:
    """Mean and full covariance of coefficients, temperature, offsets and drifts of all rows, the noise being given."""
    stretches = _stretches()
    temperature = LinearVariable(name="temperature", unit="degC", reference_value=REFERENCE_DEGC)
    result = fit_generative(stretches, PRIOR, assumed(), variables=[temperature], drift=True)
    assert any(noise.ratio for noise in result.posterior.noise)
    for row in range(6):
        mean, covariance = _written_out(stretches, row, result)
        spread = np.sqrt(np.diag(covariance))
        np.testing.assert_allclose((result.posterior.mean[row] - mean) / spread, 0.0, atol=1e-6)
        np.testing.assert_allclose(
            result.posterior.covariance[row] / np.outer(spread, spread),
            covariance / np.outer(spread, spread),
            atol=1e-6,
        )
