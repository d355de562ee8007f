# SPDX-License-Identifier: BSD-3-Clause
"""Rotations: the convention of URDF by hand, exactness where axes are aligned, and orthonormality."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, strategies as st
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.pose import cross, rotation_about_z, rotation_from_rpy, rotation_with_z_along, skew
from tests.base.strategies import REPEATABLE, vectors

EPS = float(np.finfo(np.float64).eps)

ROUNDING = 50 * EPS
"""Entries of rotations are at most 1 and come from a dozen products and sums."""

VISIBLE = 1e-2
"""What a negative control must exceed."""


def _elementary(roll: float, pitch: float, yaw: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Rx, Ry and Rz from their textbook entries."""
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    return (
        np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]]),
        np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]),
        np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]]),
    )


@REPEATABLE
@given(vectors(3, 7.0))
def test_rpy_is_yaw_after_pitch_after_roll(rpy: FloatArray) -> None:
    """R = Rz(yaw) Ry(pitch) Rx(roll), the rule of URDF, also beyond full turns and at pitch = pi/2."""
    for angles in (rpy, np.array([rpy[0], np.pi / 2, rpy[2]])):
        rx, ry, rz = _elementary(*angles)
        np.testing.assert_allclose(rotation_from_rpy(angles), rz @ ry @ rx, rtol=0, atol=ROUNDING)


def test_the_other_order_of_rpy_disagrees() -> None:
    """Negative control: Rx Ry Rz, rotations about moving axes in that order, is something else."""
    rx, ry, rz = _elementary(0.3, -0.5, 0.9)
    assert np.abs(rotation_from_rpy([0.3, -0.5, 0.9]) - rx @ ry @ rz).max() > VISIBLE


def test_rpy_by_hand() -> None:
    """Roll takes y to z, pitch takes z to x, yaw takes x to y; the zeros are exact."""
    quarters = rotation_from_rpy(np.pi / 2 * np.eye(3))
    assert quarters.shape == (3, 3, 3)
    expected = [
        [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
        [[0, 0, 1], [0, 1, 0], [-1, 0, 0]],
        [[0, -1, 0], [1, 0, 0], [0, 0, 1]],
    ]
    np.testing.assert_allclose(quarters, expected, rtol=0, atol=ROUNDING)
    np.testing.assert_array_equal(quarters == 0.0, np.array(expected) == 0)


def test_rpy_batch_equals_loop() -> None:
    """Leading axes of the angles are kept."""
    rpy = np.random.default_rng(1).uniform(-3, 3, size=(2, 4, 3))
    together = rotation_from_rpy(rpy)
    assert together.shape == (2, 4, 3, 3)
    compared = 0
    for index in np.ndindex(2, 4):
        np.testing.assert_array_equal(together[index], rotation_from_rpy(rpy[index]))
        compared += 1
    assert compared == 8


@REPEATABLE
@given(st.floats(-10, 10))
def test_rotation_about_z_is_a_yaw(angle: float) -> None:
    """The fast rotation of the joints is the yaw of the reader."""
    found = rotation_about_z(np.array([angle, -angle]))
    np.testing.assert_allclose(found, rotation_from_rpy([[0, 0, angle], [0, 0, -angle]]), rtol=0, atol=ROUNDING)


def _assert_rotation(matrix: FloatArray) -> None:
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), rtol=0, atol=ROUNDING)
    assert np.linalg.det(matrix) == pytest.approx(1.0, rel=0, abs=ROUNDING)


@pytest.mark.parametrize("column", [0, 1, 2])
@pytest.mark.parametrize("length", [1.0, -1.0, 2.5, -1e-3])
def test_an_axis_aligned_direction_gives_an_exact_permutation(column: int, length: float) -> None:
    """Along a coordinate axis, either way, every entry is exactly 0, 1 or -1, so no rounding enters."""
    axis = np.zeros(3)
    axis[column] = length
    matrix = rotation_with_z_along(axis)
    assert set(np.abs(matrix).ravel()) == {0.0, 1.0}
    np.testing.assert_array_equal(np.abs(matrix).sum(axis=0), np.ones(3))
    np.testing.assert_array_equal(matrix[:, 2], np.sign(axis))
    assert np.linalg.det(matrix) == 1.0


def test_a_tilted_direction_is_no_permutation() -> None:
    """Negative control: the check above notices a tilt of 1e-12."""
    assert set(np.abs(rotation_with_z_along([0.0, 1e-12, 1.0])).ravel()) != {0.0, 1.0}


@REPEATABLE
@given(vectors(3, 10.0))
def test_the_third_column_is_along_the_direction(axis: FloatArray) -> None:
    """Any direction of any length gives a proper rotation whose z axis is that direction."""
    length = np.linalg.norm(axis)
    assume(length > 1e-100)
    matrix = rotation_with_z_along(axis)
    _assert_rotation(matrix)
    np.testing.assert_allclose(matrix[:, 2], axis / length, rtol=0, atol=ROUNDING)


@REPEATABLE
@given(vectors(3, 10.0), vectors(3, 10.0))
def test_skew_is_the_cross_product(a: FloatArray, b: FloatArray) -> None:
    """skew(a) b is a x b, and skew(a) is antisymmetric; cross(a, b) is what NumPy makes of it, to the last bit."""
    np.testing.assert_array_equal(cross(a, b), np.cross(a, b))
    np.testing.assert_allclose(skew(a) @ b, np.cross(a, b), rtol=0, atol=100 * ROUNDING)
    np.testing.assert_array_equal(skew(a), -skew(a).T)


def test_skew_by_hand() -> None:
    """The matrix of (1, 2, 3), entry by entry."""
    np.testing.assert_array_equal(skew([1.0, 2.0, 3.0]), [[0, -3, 2], [3, 0, -1], [-2, 1, 0]])


def test_rpy_of_wrong_length_is_refused() -> None:
    """Angles that are not three name the argument."""
    with pytest.raises(ShapeError, match=r"rpy: expected shape \(\.\.\., 3\), got \(4,\)"):
        rotation_from_rpy(np.zeros(4))


def test_rpy_equals_scipys() -> None:
    """The library's own few lines and SciPy's agree to 1e-12; angles about moving axes would not."""
    rpy = np.random.default_rng(7).uniform(-7.0, 7.0, (1000, 3))
    ours = rotation_from_rpy(rpy)
    np.testing.assert_allclose(ours, Rotation.from_euler("xyz", rpy).as_matrix(), rtol=0, atol=1e-12)
    assert np.abs(ours - Rotation.from_euler("XYZ", rpy).as_matrix()).max() > VISIBLE
