# SPDX-License-Identifier: BSD-3-Clause
"""Full scale, resolution, and the noise of rounding."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.sensor.full_scale import (
    FullScale,
    all_channels_full_scale,
    axis_resolution,
    full_scale,
    quantisation_noise,
)

MATRIX = np.vstack(
    [0.02 * np.array([[1.0, -2, 0, 0, 0, 1], [0, 1, 1, 0, -1, 0], [1, 1, 1, 0, 0, 3]]), 1e-4 * np.eye(6)[:3]]
)

ROUNDING = 1e-14
"""Relative rounding of a few products."""


def test_full_scale_by_hand() -> None:
    """5 V per 100 N around 1 V: from -20 to 80 N between 0 and 5 V, 100 N in 1024 steps of 0.0977 N."""
    found = full_scale(lambda volts: 20.0 * (volts - 1.0), lowest=0.0, highest=5.0, bits=10)
    assert (found.lowest, found.highest, found.span) == (-20.0, 80.0, 100.0)
    assert found.resolution == pytest.approx(100.0 / 1024.0, rel=ROUNDING)
    assert found.dynamic_range_db == pytest.approx(60.206, rel=1e-5)


def test_the_division_is_by_two_to_the_bits() -> None:
    """Negative control: (3.13) as printed would give 10 N."""
    assert FullScale(lowest=0.0, highest=100.0, bits=10).resolution < 0.1


def test_a_falling_output_has_the_same_full_scale() -> None:
    """A sensor whose output falls with the stimulus measures from the other end."""
    found = full_scale(lambda volts: -20.0 * (volts - 1.0), lowest=0.0, highest=5.0, bits=10)
    assert (found.lowest, found.highest) == (-80.0, 20.0)


def test_more_gain_gives_less_range_and_finer_steps() -> None:
    """Twice the gain halves full scale and resolution, and keeps the dynamic range."""
    coarse, fine = (full_scale(lambda v, g=g: v / g, lowest=-2.5, highest=2.5, bits=16) for g in (10.0, 20.0))
    assert fine.span == pytest.approx(0.5 * coarse.span, rel=ROUNDING)
    assert fine.resolution == pytest.approx(0.5 * coarse.resolution, rel=ROUNDING)
    assert fine.dynamic_range_db == coarse.dynamic_range_db


def test_a_stimulus_that_does_not_matter_is_refused() -> None:
    """A sensor that tells one stimulus only has no full scale."""
    with pytest.raises(SensorError, match="lowest below highest"):
        full_scale(lambda volts: 3.0, lowest=0.0, highest=5.0, bits=10)
    with pytest.raises(SensorError, match="FullScale: highest: expected a finite number"):
        FullScale(lowest=0.0, highest=float("inf"), bits=10)


def test_axis_figures_by_hand() -> None:
    """Row 0 is 0.02 (1, -2, 0, 0, 0, 1): 0.08 N per count of all, 2621.44 N at 32768, noise 0.02 sqrt(6 / 12)."""
    assert axis_resolution(MATRIX)[0] == pytest.approx(0.08, rel=ROUNDING)
    assert all_channels_full_scale(MATRIX, limit_counts=32768)[0] == pytest.approx(2621.44, rel=ROUNDING)
    assert quantisation_noise(MATRIX)[0] == pytest.approx(0.02 * np.sqrt(0.5), rel=ROUNDING)


def test_resolution_is_full_scale_over_the_counts() -> None:
    """(3.13) on the stated full scale of both directions gives the resolution per axis."""
    both_directions = 2.0 * all_channels_full_scale(MATRIX, limit_counts=32768)
    np.testing.assert_allclose(both_directions / 2**16, axis_resolution(MATRIX), rtol=ROUNDING)


def test_quantisation_noise_is_that_of_rounded_counts() -> None:
    """Rounding many counts leaves errors with that deviation per axis."""
    rng = np.random.default_rng(1)
    count = 40_000
    raw = rng.uniform(-1000, 1000, size=(count, 6))
    spread = ((np.rint(raw) - raw) @ MATRIX.T).std(axis=0)
    # a standard deviation of n samples scatters by less than 1 / sqrt(2 n) of itself, here five times that
    np.testing.assert_allclose(spread, quantisation_noise(MATRIX), rtol=5 / np.sqrt(2 * count))


def test_rows_scale_with_their_unit() -> None:
    """Moments in N mm are a thousand times those in N m, in every figure."""
    in_mm = MATRIX * np.array([1, 1, 1, 1e3, 1e3, 1e3])[:, None]
    for figure in (axis_resolution, quantisation_noise):
        np.testing.assert_allclose(figure(in_mm)[3:], 1e3 * figure(MATRIX)[3:], rtol=ROUNDING)


def test_matrices_of_another_shape_are_refused() -> None:
    """Six rows, any number of channels, finite."""
    assert axis_resolution(np.ones((6, 8))).shape == (6,)
    with pytest.raises(ShapeError, match=r"matrix: expected an array of shape \(6, n\)"):
        axis_resolution(np.ones((8, 6)))
    with pytest.raises(SensorError, match="finite"):
        quantisation_noise(np.full((6, 6), np.nan))
