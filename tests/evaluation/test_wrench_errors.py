# SPDX-License-Identifier: BSD-3-Clause
"""Error statistics: pooled, per axis and by magnitude, with an honest standard error."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError
from forcetorque.base.noise.window_means import mean_error
from forcetorque.experiment.calibrations_under_test import errors_from_zero, wrench_errors
from forcetorque.experiment.evaluated_wrenches import offset_removed


def test_by_hand() -> None:
    """Two samples whose statistics can be written down."""
    measured = np.array([[3.0, 4.0, 0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0, 0.0, -1.0]])
    errors = wrench_errors(measured, np.zeros((2, 6)), [0.0, 1.0])
    assert errors.count == 2
    np.testing.assert_allclose(errors.bias, [1.5, 2.0, 0, 0, 0, 0])
    np.testing.assert_allclose(errors.rmse, [np.sqrt(4.5), np.sqrt(8.0), 0, 0, 0, 1.0])
    np.testing.assert_allclose(errors.largest, [3.0, 4.0, 0, 0, 0, 1.0])
    np.testing.assert_allclose(errors.mean_absolute, [1.5, 2.0, 0, 0, 0, 1.0])
    assert (errors.force_mean, errors.force_largest) == (2.5, 5.0)
    assert (errors.moment_mean, errors.moment_largest) == (1.0, 1.0)
    # what would be known were they independent: means of 5 and 0, standard deviation 5 / sqrt 2, over sqrt 2
    assert errors.force_mean_error > 2.5
    assert errors.force_mean_half_width > 12.7 * 2.5
    assert errors.mean_absolute_error[2] == 0.0


def test_the_error_is_that_of_the_mean_over_the_recording() -> None:
    """One rule for all means of a recording."""
    values = np.random.default_rng(4).normal(size=(500, 6))
    time = 0.1 * np.arange(500)
    errors = wrench_errors(values, np.zeros((500, 6)), time)
    known = mean_error(np.linalg.norm(values[:, 3:], axis=1)[:, None], time)
    assert errors.moment_mean_error == pytest.approx(known.standard_error[0])
    assert errors.moment_mean_half_width == pytest.approx(known.half_width[0])


def test_the_standard_error_sees_slow_changes() -> None:
    """A slow drift counts as few independent values: white noise of the same size has a far smaller error."""
    time = 0.1 * np.arange(1000)
    rng = np.random.default_rng(1)
    zero = np.zeros((1000, 6))
    slow, white = zero.copy(), zero.copy()
    slow[:, 0] = np.linspace(0.0, 4.0, 1000)
    white[:, 0] = rng.permutation(slow[:, 0])
    of_slow, of_white = wrench_errors(slow, zero, time), wrench_errors(white, zero, time)
    assert of_slow.force_mean_error > 5 * of_white.force_mean_error
    # one axis alone moves: its mean absolute value is the mean norm
    assert of_slow.mean_absolute_error[0] == pytest.approx(of_slow.force_mean_error)


def test_removing_the_offset_leaves_no_bias() -> None:
    """A re-estimated offset takes out exactly the mean error."""
    rng = np.random.default_rng(2)
    reference = rng.normal(size=(50, 6))
    measured = reference + rng.normal(size=(50, 6)) + 7.0
    moved = offset_removed(measured, reference)
    np.testing.assert_allclose((moved - reference).mean(axis=0), 0.0, atol=1e-14)
    np.testing.assert_allclose(moved - measured, np.tile((moved - measured)[0], (50, 1)), atol=1e-13)


def test_a_single_sample_has_no_standard_error() -> None:
    """One sample says nothing about its own scatter."""
    errors = wrench_errors(np.ones((1, 6)), np.zeros((1, 6)), [0.0])
    assert np.isnan(errors.force_mean_error)
    assert np.isinf(errors.force_mean_half_width)
    assert np.isnan(errors.mean_absolute_error).all()


@pytest.mark.parametrize(("a", "b"), [((0, 6), (0, 6)), ((3, 6), (2, 6)), ((3, 5), (3, 5)), ((6,), (6,))])
def test_shapes_are_checked(a: tuple[int, ...], b: tuple[int, ...]) -> None:
    """No samples, or shapes that do not fit, are refused."""
    with pytest.raises(ShapeError, match="expected"):
        wrench_errors(np.zeros(a), np.zeros(b), np.zeros(a[0]))


def test_samples_with_a_gap_are_left_out_of_wrenches_that_should_be_zero() -> None:
    """The statistics are those of the other samples; one component that is missing spoils its sample."""
    wrenches = np.random.default_rng(3).normal(size=(40, 6))
    gappy = wrenches.copy()
    gappy[[3, 17], [2, 5]] = np.nan
    time = 0.1 * np.arange(40)
    wanted = wrench_errors(np.delete(wrenches, [3, 17], axis=0), np.zeros((38, 6)), np.delete(time, [3, 17]))
    found = errors_from_zero(gappy, time)
    assert found.count == 38
    np.testing.assert_array_equal(found.mean_absolute, wanted.mean_absolute)
    assert (found.force_mean, found.moment_mean_error) == (wanted.force_mean, wanted.moment_mean_error)


@pytest.mark.parametrize("wrenches", [np.full((3, 6), np.nan), np.zeros((0, 6)), np.zeros((3, 5))])
def test_nothing_to_sum_up_is_refused(wrenches: np.ndarray) -> None:
    """Gaps alone, no samples, or another shape."""
    with pytest.raises(ShapeError, match="wrenches: expected"):
        errors_from_zero(wrenches, np.arange(float(len(wrenches))))
