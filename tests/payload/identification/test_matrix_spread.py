# SPDX-License-Identifier: BSD-3-Clause
"""How far a matrix may be off that is known in part: of six channels, of more, and once its rows said so."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions, rows_of
from forcetorque.payload.identification.matrix_uncertainty import MatrixSpread

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
