# SPDX-License-Identifier: BSD-3-Clause
"""Cosine and sine of the compiled evaluator against the C library's."""

from __future__ import annotations

import numpy as np
from numba import njit

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.compiled.recursion_and_vectors import cosine_sine

LAST_PLACES = 3.0
"""Units in the last place of numbers from 0.5 to 1: one by the polynomials, one by the reduction of the angle, and
one by the C library that they are held against."""


@njit(fastmath={"contract", "nsz"})  # type: ignore[untyped-decorator]
def _both(angles, cosine, sine):  # type: ignore[no-untyped-def]
    for k in range(len(angles)):
        cosine[k], sine[k] = cosine_sine(angles[k])


def _cosine_sine(angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    cosine, sine = np.empty_like(angles), np.empty_like(angles)
    _both(angles, cosine, sine)
    return cosine, sine


def _angles() -> FloatArray:
    rng = np.random.default_rng(1)
    quarters = np.pi / 2 * np.arange(-2000, 2001)
    ranges = [rng.uniform(-size, size, 20000) for size in (1e-8, 0.8, np.pi, 100.0, 1e4, 1e6)]
    return np.concatenate([*ranges, quarters, np.nextafter(quarters, 1e9), np.nextafter(quarters, -1e9), quarters / 2])


def test_equal_to_those_of_the_c_library() -> None:
    """Up to 1e6 rad, at multiples of a quarter turn and beside them, within three units in the last place."""
    angles = _angles()
    cosine, sine = _cosine_sine(angles)
    allowed = LAST_PLACES * np.finfo(np.float64).eps / 2
    assert len(angles) > 100_000
    assert np.abs(cosine - np.cos(angles)).max() <= allowed
    assert np.abs(sine - np.sin(angles)).max() <= allowed
    assert np.abs(cosine - np.cos(angles + 1e-9)).max() > allowed  # negative control


def test_small_sines_keep_their_digits() -> None:
    """Within two units in the last place of the sine itself, down to angles of 1e-300."""
    angles = np.concatenate([10.0 ** np.arange(-300.0, 0.0), -(10.0 ** np.arange(-300.0, 0.0))])
    _, sine = _cosine_sine(angles)
    assert (np.abs(sine - np.sin(angles)) <= 2 * np.spacing(np.abs(np.sin(angles)))).all()


def test_symmetry_and_unit_circle() -> None:
    """Cosine is even, sine odd, to the last bit; their squares add up to one."""
    angles = _angles()
    angles = angles[np.abs(angles / (np.pi / 4) % 2 - 1) > 1e-6]  # where the quarter turn is not a tie
    cosine, sine = _cosine_sine(angles)
    mirrored_cosine, mirrored_sine = _cosine_sine(-angles)
    np.testing.assert_array_equal(cosine, mirrored_cosine)
    np.testing.assert_array_equal(sine, -mirrored_sine)
    np.testing.assert_allclose(cosine**2 + sine**2, 1.0, rtol=0, atol=1e-15)


def test_a_gap_stays_a_gap() -> None:
    """NaN gives NaN."""
    for values in _cosine_sine(np.array([np.nan, 0.0])):
        np.testing.assert_array_equal(np.isnan(values), [True, False])
