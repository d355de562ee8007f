# SPDX-License-Identifier: BSD-3-Clause
"""Reachable full scale: by hand, at the limit, and against the stated full scale."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.sensor.full_scale import RawLimits, axis_resolution, reachable_full_scale

RNG = np.random.default_rng(1)
UNITS = np.array([1.0, 1, 1, 0.02, 0.02, 0.02])[:, None]
"""Moments are as many N m as forces times 0.02 m."""

MIXED = RawLimits(
    matrix=0.02 * UNITS * (np.eye(6) + 0.3 * RNG.normal(size=(6, 6))),
    offset=np.array([30.0, -50, 100, 0.5, -1, 0.2]),
    lowest=np.full(6, -32768.0),
    highest=np.full(6, 32767.0),
)
PLAIN = RawLimits(matrix=0.1 * np.eye(6), offset=np.zeros(6), lowest=np.full(6, -1000.0), highest=np.full(6, 1000.0))

ROUNDING = 1e-9
"""Rounding of counts up to 32768 through a matrix with a condition number below 1e4; counts."""


def test_one_channel_per_axis_by_hand() -> None:
    """0.1 N per count and 1000 counts: 100 N each way; an offset of 30 N leaves 130 and 70 N."""
    found = reachable_full_scale(PLAIN)
    np.testing.assert_allclose(found.positive, np.full(6, 100.0), rtol=1e-12)
    np.testing.assert_allclose(found.negative, np.full(6, -100.0), rtol=1e-12)
    np.testing.assert_array_equal(found.positive_channel, np.arange(6))
    shifted = reachable_full_scale(dataclasses.replace(PLAIN, offset=np.array([30.0, 0, 0, 0, 0, 0])))
    # at rest the channel already reads -300 counts
    assert shifted.positive[0] == pytest.approx(130.0, rel=1e-12)
    assert shifted.negative[0] == pytest.approx(-70.0, rel=1e-12)


def test_at_the_largest_load_exactly_the_named_channel_is_at_its_limit() -> None:
    """The raw reading at the reachable load touches one limit, and stays within the others; a bit more exceeds it."""
    found = reachable_full_scale(MIXED)
    touched = 0
    for axis in range(6):
        for load, channel in (
            (found.positive[axis], found.positive_channel[axis]),
            (found.negative[axis], found.negative_channel[axis]),
        ):
            raw = MIXED.raw(load * np.eye(6)[axis])
            room = np.minimum(MIXED.highest - raw, raw - MIXED.lowest)
            assert room[channel] == pytest.approx(0.0, abs=ROUNDING)
            assert room.min() >= -ROUNDING
            more = MIXED.raw(1.001 * load * np.eye(6)[axis])
            assert not ((more > MIXED.lowest) & (more < MIXED.highest)).all()
            touched += 1
    assert touched == 12


def test_reachable_is_less_than_stated() -> None:
    """No load reaches the full scale that has all channels at their limits, where axes share channels."""
    centred = dataclasses.replace(MIXED, offset=np.zeros(6))
    stated = 32768 * axis_resolution(MIXED.matrix)
    found = reachable_full_scale(centred)
    assert (found.positive <= stated).all()
    assert (found.positive < 0.95 * stated).any()


def test_an_offset_makes_the_scale_asymmetric() -> None:
    """What the offset takes from one direction it gives to the other, as long as one channel limits both."""
    found = reachable_full_scale(MIXED)
    assert (np.abs(found.positive + found.negative) > 0.01 * found.positive).any()
    same = found.positive_channel == found.negative_channel
    assert same.any()
    centred = reachable_full_scale(dataclasses.replace(MIXED, offset=np.zeros(6)))
    both = (centred.positive_channel == found.positive_channel) & same
    assert both.any()
    np.testing.assert_allclose(
        (found.positive - found.negative)[both], (centred.positive - centred.negative)[both], rtol=1e-10
    )


def test_the_reversed_sensor_has_the_reversed_scale() -> None:
    """Negating matrix and offset swaps the two directions, in every axis."""
    turned = reachable_full_scale(dataclasses.replace(MIXED, matrix=-MIXED.matrix, offset=-MIXED.offset))
    found = reachable_full_scale(MIXED)
    np.testing.assert_allclose(turned.positive, -found.negative, rtol=1e-10)
    np.testing.assert_array_equal(turned.positive_channel, found.negative_channel)


def test_twice_the_gain_reaches_half_as_far() -> None:
    """A matrix with half the newtons per count reaches half the load."""
    half = dataclasses.replace(PLAIN, matrix=0.5 * PLAIN.matrix)
    np.testing.assert_allclose(reachable_full_scale(half).positive, 50.0, rtol=1e-12)


def test_a_sensor_that_is_saturated_at_rest_is_refused() -> None:
    """Without room at zero load there is no full scale; the message names the channel."""
    with pytest.raises(SensorError, match="channel 0 reads -1010 counts without load"):
        reachable_full_scale(dataclasses.replace(PLAIN, offset=np.array([101.0, 0, 0, 0, 0, 0])))


def test_bad_limits_are_refused() -> None:
    """Eight channels, a singular matrix, limits that cross."""
    with pytest.raises(ShapeError, match="matrix"):
        dataclasses.replace(PLAIN, matrix=np.ones((6, 8)))
    with pytest.raises(SensorError, match="singular"):
        dataclasses.replace(PLAIN, matrix=np.ones((6, 6)))
    with pytest.raises(SensorError, match="singular"):
        dataclasses.replace(PLAIN, matrix=np.diag([1.0, 1, 1, 1, 1, 0]))
    with pytest.raises(SensorError, match="lowest below highest"):
        dataclasses.replace(PLAIN, lowest=PLAIN.highest)


def test_units_of_moments_do_not_make_a_matrix_singular() -> None:
    """Rows in small units are still rows."""
    tiny = dataclasses.replace(PLAIN, matrix=np.diag([0.1, 0.1, 0.1, 1e-18, 1e-18, 1e-18]))
    assert reachable_full_scale(tiny).positive[5] == pytest.approx(1e-15, rel=1e-12)
