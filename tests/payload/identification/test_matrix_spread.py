# SPDX-License-Identifier: BSD-3-Clause
"""How far a matrix may be off that is known in part: of six channels, of more, and once its rows said so."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions, rows_of
from forcetorque.payload.identification.estimate_under_noise import noise_sizes
from forcetorque.payload.identification.matrix_uncertainty import MatrixSpread, settled
from forcetorque.payload.identification.measurement_model import load_wrench
from forcetorque.payload.identification.robust_fit import plain_fit
from tests.payload.identification.payloads import SIZES, poses, problem_of, weight

FULL_SCALE = np.array([100.0, 100.0, 200.0, 10.0, 10.0, 10.0])


def test_deviations_of_twelve_channels_add_up_in_the_wrench() -> None:
    """Each channel errs by itself, so E has the covariance of a sum of twelve independent errors, all of one size."""
    rng = np.random.default_rng(1)
    matrix = rng.normal(size=(6, 12)) * FULL_SCALE[:, None] / 3e4
    assumed = Assumptions(full_scale=np.full(12, 3e4))
    spread = MatrixSpread.of(matrix, assumed)
    channels = rows_of(matrix, assumed, in_wrench=False)
    sizes = np.array([[0.03, 0.01], [0.02, 0.05]])
    covariance = spread.covariance(sizes)
    for row in range(6):
        terms = [
            matrix[row, channel] * channels.unit[channel] * size * root[channel]
            for channel in range(12)
            for size, root in zip(sizes[row // 3], (channels.sensor_root, channels.frame_root), strict=True)
        ]
        stacked = np.hstack(terms)
        np.testing.assert_allclose(covariance[row], stacked @ stacked.T, rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("channels", [6, 8])
def test_sizes_that_explain_the_deviations_are_told(channels: int) -> None:
    """Deviations that were drawn with a size and are known exactly tell it, some 18 numbers and the expected one.

    Nothing that is known of them leaves what was expected.
    """
    rng = np.random.default_rng(2)
    assumed = Assumptions(full_scale=np.full(channels, 3e4))
    matrix = rng.normal(size=(6, channels)) * FULL_SCALE[:, None] / 3e4
    spread = MatrixSpread.of(matrix, assumed)
    sizes = spread.expected * [1.0, 1e-6]  # the frame is exact, so that the sensor makes all of it
    drawn = np.array([np.linalg.cholesky(one) @ rng.normal(size=6) for one in spread.covariance(sizes)])
    exact = np.zeros((6, 6, 6))
    for factor in (0.3, 1.0, 3.0):
        told = spread.told(sizes, factor * drawn, exact)[:, 0] / sizes[:, 0]
        # eighteen numbers tell a size to a sixth; what was expected holds it back
        expected = [np.sqrt(((factor * 18.0**0.5) ** 2 + weight) / (18.0 + weight)) for weight in (0.0, 18.0)]
        assert 0.6 * min(expected) < told.min() <= told.max() < 1.5 * max(expected)
    unknown = spread.told(sizes, np.zeros((6, 6)), spread.covariance(sizes))
    np.testing.assert_allclose(unknown, spread.expected, rtol=1e-9)


def test_sizes_settle_where_the_rows_tell_them_again() -> None:
    """One more round by the equations of the module leaves the prior of the matrix as it is."""
    rng = np.random.default_rng(4)
    gravity = poses(60, rng)
    spread = MatrixSpread.of(np.diag(FULL_SCALE) / 3e4, Assumptions(full_scale=np.full(6, 3e4)))
    off = np.array([np.linalg.cholesky(one) @ rng.normal(size=6) for one in spread.covariance(0.5 * spread.expected)])
    reading = weight(gravity) @ (np.eye(6) + off).T + SIZES * rng.normal(size=(60, 6))
    problem = settled(problem_of(reading, gravity), spread)
    assert problem.matrix_prior is not None
    kinds = np.array([spread.covariance(np.tile(kind, (2, 1))) for kind in np.eye(2)])
    sizes = np.sqrt(
        [np.linalg.lstsq(kinds[:, own].reshape(2, -1).T, problem.matrix_prior[own].ravel())[0] for own in GROUPS]
    )
    guess, residual = plain_fit(problem, drift=False)
    loads = load_wrench(problem, guess)
    about = loads - loads.mean(axis=0)
    information = np.einsum("ni,nj->ij", about, about) / noise_sizes(residual)[:, None, None] ** 2
    posterior = np.linalg.inv(np.linalg.inv(problem.matrix_prior) + information)
    told = spread.told(sizes, guess.response - np.eye(6), posterior)
    np.testing.assert_allclose(told, sizes, rtol=1e-3)
    assert np.abs(sizes / spread.expected - 1.0).max() > 0.05


GROUPS = (slice(0, 3), slice(3, 6))
"""Forces and moments."""
