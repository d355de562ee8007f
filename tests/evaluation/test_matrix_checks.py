# SPDX-License-Identifier: BSD-3-Clause
"""Condition, full scale and offset change against numbers that were worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.evaluation.matrix_checks import matrix_checks, matrix_condition, offset_change
from forcetorque.sensor.full_scale import RawLimits, reachable_full_scale
from tests.scenes.calibrations import MOUNTED, OFFSET

LIMIT = 32767.0
EXACT = 1e-12
"""Relative: a few roundings of well-conditioned numbers."""
SLOPE = np.array([-0.4, 0.3, -1.2, 0.02, 0.01, -0.015])


def test_condition_by_hand() -> None:
    """One channel per axis is 1; two axes that share channels as 1 : a have (1 + a) / (1 - a)."""
    assert matrix_condition(np.diag([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])) == pytest.approx(1.0, rel=EXACT)
    shared = np.eye(6)
    shared[0, 1] = shared[1, 0] = 0.5
    # rows over their sum: (2/3, 1/3) and (1/3, 2/3) have singular values 1 and 1/3, the others 1
    assert matrix_condition(shared) == pytest.approx(3.0, rel=EXACT)
    assert matrix_condition(np.hstack([np.eye(6), np.eye(6)])) == pytest.approx(1.0, rel=EXACT)


def test_units_do_not_change_the_condition() -> None:
    """Moments in N mm, or counts of another size, give the same; another mixture of channels does not."""
    plain = matrix_condition(MOUNTED)
    units = np.array([1.0, 1.0, 1.0, 1e3, 1e3, 1e3])[:, None]
    assert matrix_condition(MOUNTED * units) == pytest.approx(plain, rel=1e-9)
    assert matrix_condition(MOUNTED * 17.0) == pytest.approx(plain, rel=1e-9)
    assert np.linalg.cond(MOUNTED * units) != pytest.approx(np.linalg.cond(MOUNTED), rel=0.1)
    mixed = np.array(MOUNTED)
    mixed[0] += 0.5 * mixed[1]
    assert matrix_condition(mixed) != pytest.approx(plain, rel=1e-3)


def test_a_singular_matrix_has_no_finite_condition() -> None:
    """Two equal rows, or a row of zeros; fewer channels than components are an error."""
    equal, empty = np.array(MOUNTED), np.array(MOUNTED)
    equal[4] = 3.0 * equal[3]
    empty[2] = 0.0
    assert matrix_condition(equal) == matrix_condition(empty) == np.inf
    with pytest.raises(ShapeError, match="expected at least 6 channels, got 5"):
        matrix_condition(MOUNTED[:, :5])


def test_the_full_scale_is_the_reachable_one_of_both_directions() -> None:
    """0.1 N per count, 1000 counts and an offset of 30 N: 130 N up, 70 N down, 100 N stated."""
    checks = matrix_checks(0.1 * np.eye(6), np.array([30.0, 0, 0, 0, 0, 0]), limit_counts=1000.0)
    assert checks.full_scale is not None
    np.testing.assert_allclose(checks.full_scale.positive, [130.0, *[100.0] * 5], rtol=EXACT)
    np.testing.assert_allclose(checks.full_scale.negative, [-70.0, *[-100.0] * 5], rtol=EXACT)
    np.testing.assert_allclose(checks.stated_full_scale, np.full(6, 100.0), rtol=EXACT)
    np.testing.assert_allclose(checks.resolution_rms, np.full(6, 0.1), rtol=EXACT)
    mixed = matrix_checks(MOUNTED, OFFSET, limit_counts=LIMIT)
    limits = RawLimits(matrix=MOUNTED, offset=OFFSET, lowest=np.full(6, -LIMIT), highest=np.full(6, LIMIT))
    assert mixed.full_scale is not None
    np.testing.assert_array_equal(mixed.full_scale.positive, reachable_full_scale(limits).positive)
    assert (mixed.full_scale.positive < mixed.stated_full_scale + OFFSET).all()


def test_without_a_full_scale_the_reason_is_there() -> None:
    """More channels than six, a singular matrix, a channel that is saturated without load."""
    wide = matrix_checks(np.hstack([MOUNTED, MOUNTED]), OFFSET, limit_counts=LIMIT)
    assert (wide.full_scale, wide.no_full_scale[:16]) == (None, "with 12 channels")
    equal = np.array(MOUNTED)
    equal[4] = equal[3]
    assert "singular" in matrix_checks(equal, OFFSET, limit_counts=LIMIT).no_full_scale
    far = matrix_checks(MOUNTED, np.full(6, 1e5), limit_counts=LIMIT)
    assert "without load" in far.no_full_scale
    with pytest.raises(SensorError, match="offset"):
        matrix_checks(MOUNTED, np.full(6, np.nan), limit_counts=LIMIT)


def test_a_straight_drift_is_all_slope() -> None:
    """Offsets on a line against temperature give its slope and leave nothing; a wrong sign would not."""
    temperature = np.array([30.0, 33.5, 31.0, 40.0])
    found = offset_change(OFFSET + np.outer(temperature, SLOPE), temperature)
    assert found.per_degree is not None
    assert found.left is not None
    np.testing.assert_allclose(found.per_degree, SLOPE, rtol=1e-10)
    assert np.abs(found.left).max() < 1e-10
    np.testing.assert_allclose(found.change, 10.0 * np.abs(SLOPE), rtol=1e-10)
    assert found.force_change == pytest.approx(10.0 * np.linalg.norm(SLOPE[:3]), rel=1e-10)
    assert found.temperature_span == 10.0
    bent = offset_change(OFFSET + np.outer([0.0, 1.0, 0.0], SLOPE), np.array([30.0, 31.0, 32.0]))
    assert bent.per_degree is not None
    assert bent.left is not None
    np.testing.assert_allclose(bent.per_degree, np.zeros(6), atol=1e-12)
    np.testing.assert_allclose(bent.left, 2.0 / 3.0 * np.abs(SLOPE), rtol=1e-10)


def test_equal_temperatures_tell_no_slope() -> None:
    """Just below 1 degC there is none, from it on there is; without temperature the change remains."""
    offsets = np.array([OFFSET, OFFSET + SLOPE])
    near = offset_change(offsets, np.array([30.0, 30.999]))
    far = offset_change(offsets, np.array([30.0, 31.0]))
    unknown = offset_change(offsets)
    assert near.per_degree is None
    assert far.per_degree is not None
    assert (unknown.temperature_span, unknown.per_degree) == (None, None)
    for found in (near, far, unknown):
        np.testing.assert_allclose(found.change, np.abs(SLOPE), rtol=1e-10)


def test_offsets_that_cannot_be_compared_are_refused() -> None:
    """One recording, a missing number, a temperature too few."""
    with pytest.raises(ShapeError, match="at least 2 recordings, got 1"):
        offset_change(np.zeros((1, 6)))
    with pytest.raises(ShapeError, match="finite"):
        offset_change(np.full((2, 6), np.nan))
    with pytest.raises(ShapeError, match="temperature"):
        offset_change(np.zeros((3, 6)), np.zeros(2))
    with pytest.raises(ShapeError, match="finite number for every recording"):
        offset_change(np.zeros((2, 6)), np.array([30.0, np.nan]))
