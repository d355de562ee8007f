# SPDX-License-Identifier: BSD-3-Clause
"""Moments: what a fit needs of the samples, and nothing that depends on their order or grouping."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.experiment.calibration.moments import _BLOCK, Moments, pooled
from forcetorque.experiment.calibration.sensor_model import WrenchModel

ROUNDING = 1e-12
"""Relative: double precision over sums of some 100 terms whose means were removed first."""


def _samples(seed: int, n: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return 300.0 * rng.normal(size=(n, 6)) + 24000.0, 10.0 * rng.normal(size=(n, 6)) - 40.0


def _close(a: Moments, b: Moments) -> bool:
    fields = ("raw_mean", "reference_mean", "raw_raw", "reference_raw", "reference_reference")
    return a.count == b.count and all(
        np.allclose(getattr(a, f), getattr(b, f), rtol=ROUNDING, atol=ROUNDING * np.abs(getattr(a, f)).max())
        for f in fields
    )


@given(st.integers(2, 60), st.integers(1, 59), st.integers(0, 10**6))
def test_parts_add_up_to_the_whole(n: int, cut: int, seed: int) -> None:
    """Moments of two parts add to those of all samples, wherever they are cut."""
    raw, reference = _samples(seed, n)
    cut = min(cut, n - 1)
    parts = pooled([Moments.of(raw[:cut], reference[:cut]), Moments.of(raw[cut:], reference[cut:])])
    assert _close(parts, Moments.of(raw, reference))


def test_a_part_alone_is_not_the_whole() -> None:
    """Negative control of the comparison above."""
    raw, reference = _samples(1, 50)
    assert not _close(Moments.of(raw[:49], reference[:49]), Moments.of(raw, reference))


def test_order_of_samples_does_not_matter() -> None:
    """Permuted samples have the same moments."""
    raw, reference = _samples(2, 100)
    order = np.random.default_rng(3).permutation(100)
    assert _close(Moments.of(raw, reference), Moments.of(raw[order], reference[order]))


def test_squared_error_equals_that_of_the_samples() -> None:
    """The error from moments is the mean squared residual of the samples, per component."""
    raw, reference = _samples(4, 200)
    rng = np.random.default_rng(5)
    matrix, offset = 0.01 * rng.normal(size=(6, 6)), rng.normal(size=6)
    model = WrenchModel(matrix=matrix, offset=offset)
    direct = ((raw @ matrix.T + offset - reference) ** 2).mean(axis=0)
    np.testing.assert_allclose(Moments.of(raw, reference).squared_error(model), direct, rtol=1e-10)


def test_large_offsets_cost_no_accuracy() -> None:
    """A constant of 24 000 counts changes the centred moments by rounding only."""
    raw, reference = _samples(6, 500)
    moved = Moments.of(raw - 24000.0, reference).raw_raw
    np.testing.assert_allclose(Moments.of(raw, reference).raw_raw, moved, rtol=1e-9)


@pytest.mark.parametrize(
    ("raw", "reference", "error"),
    [
        (np.zeros((0, 6)), np.zeros((0, 6)), FitError),
        (np.full((3, 6), np.nan), np.zeros((3, 6)), FitError),
        (np.zeros((3, 6)), np.zeros((4, 6)), ShapeError),
        (np.zeros(6), np.zeros((1, 6)), ShapeError),
    ],
)
def test_bad_samples_are_refused(raw: np.ndarray, reference: np.ndarray, error: type[Exception]) -> None:
    """No samples, missing values and shapes that do not fit are errors."""
    with pytest.raises(error, match="expected"):
        Moments.of(raw, reference)


@pytest.mark.parametrize("n", [8191, 8192, 8193, 2 * 8192 + 1000])
def test_more_samples_than_a_pass_takes_are_all_counted_once(n: int) -> None:
    """Mean and covariance are NumPy's over all samples, about the edges of a pass of 8192 and beyond the second."""
    raw, reference = _samples(6, n)
    raw[8000:] += 500.0  # the rough mean of the first pass is not that of the whole
    moments = Moments.of(raw, reference)
    assert _BLOCK == 8192
    assert moments.count == n
    columns = np.hstack([raw, reference])
    np.testing.assert_allclose(moments.mean, columns.mean(axis=0), rtol=ROUNDING)
    exact = np.cov(columns.T, bias=True)
    np.testing.assert_allclose(moments.second, exact, rtol=0.0, atol=1e-11 * np.abs(exact).max())


def test_a_pass_left_out_is_noticed() -> None:
    """Negative control: without the samples of the last pass the moments are others."""
    raw, reference = _samples(6, 8192 + 500)
    whole, first = Moments.of(raw, reference), Moments.of(raw[:8192], reference[:8192])
    assert np.abs(whole.second - first.second).max() > 1e-6 * np.abs(whole.second).max()
