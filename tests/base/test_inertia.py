# SPDX-License-Identifier: BSD-3-Clause
"""Inertias: kinetic energy in two frames, sums of bodies, and point masses by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import invert_pose, make_pose, rotation_from_rpy, skew
from forcetorque.base.wrench import transform_twist
from tests.base.strategies import FARTHEST, REPEATABLE, poses, vectors

EPS = float(np.finfo(np.float64).eps)

HEAVIEST = 10.0
"""Bound of masses; kg."""

MOMENT_ROUNDING = 100 * EPS * HEAVIEST * (1 + 2 * FARTHEST) ** 2
"""kg m2: rounding of masses times squared distances of up to 2 * FARTHEST."""

FASTEST = 10.0
"""Bound of components of twists in the energy test; m/s, rad/s."""

ENERGY_ROUNDING = 36 * (FASTEST * (1 + 2 * FARTHEST)) ** 2 * MOMENT_ROUNDING
"""J: 36 products of two velocities at the farthest point with a moment that carries its rounding."""

VISIBLE = 1e-2
"""What a negative control must exceed."""


@st.composite
def bodies(draw: st.DrawFn) -> Inertia:
    """Bodies of a few point masses, none included; some have one more, massless, second moment."""
    inertia = Inertia.zero()
    for _ in range(draw(st.integers(0, 3))):
        inertia += _point(draw(st.floats(0, HEAVIEST / 3)), draw(vectors(3, 1.0)))
    spread = draw(st.floats(0, 1))
    return inertia + Inertia(mass=0.0, first_moment=np.zeros(3), second_moment=spread * np.diag([1.0, 2.0, 2.5]))


def _point(mass: float, position: Any) -> Inertia:
    return Inertia.about_centre_of_mass(mass=mass, centre_of_mass=position, second_moment=np.zeros((3, 3)))


def _assert_same(found: Inertia, expected: Inertia) -> None:
    assert found.mass == pytest.approx(expected.mass, rel=0, abs=MOMENT_ROUNDING)
    np.testing.assert_allclose(found.first_moment, expected.first_moment, rtol=0, atol=MOMENT_ROUNDING)
    np.testing.assert_allclose(found.second_moment, expected.second_moment, rtol=0, atol=MOMENT_ROUNDING)


def _energy(inertia: Inertia, twist: FloatArray) -> float:
    return float(0.5 * twist @ inertia.matrix() @ twist)


def test_point_mass_by_hand() -> None:
    """2 kg at (1, 2, 3): first moment (2, 4, 6), second moment m (|p|^2 1 - p p^T)."""
    inertia = _point(2.0, [1.0, 2.0, 3.0])
    assert inertia.mass == 2.0
    np.testing.assert_array_equal(inertia.first_moment, [2.0, 4.0, 6.0])
    np.testing.assert_array_equal(inertia.second_moment, [[26, -4, -6], [-4, 20, -12], [-6, -12, 10]])


def test_matrix_by_hand() -> None:
    """Momentum of that point mass: m v of the point, and its moment about the origin."""
    inertia = _point(2.0, [1.0, 2.0, 3.0])
    v, omega = np.array([0.5, -1.0, 2.0]), np.array([1.0, -2.0, 0.5])
    velocity = v + np.cross(omega, [1.0, 2.0, 3.0])
    momentum = np.concatenate([2.0 * velocity, np.cross([1.0, 2.0, 3.0], 2.0 * velocity)])
    np.testing.assert_allclose(inertia.matrix() @ np.concatenate([v, omega]), momentum, rtol=0, atol=MOMENT_ROUNDING)


@REPEATABLE
@given(bodies(), poses(), vectors(6, FASTEST))
def test_kinetic_energy_is_the_same_in_both_frames(body: Inertia, a_H_b: FloatArray, b_twist: FloatArray) -> None:
    """Moving the inertia and the twist to another frame keeps the energy."""
    in_a = _energy(body.expressed_in(a_H_b), transform_twist(a_H_b, b_twist))
    assert in_a == pytest.approx(_energy(body, b_twist), rel=0, abs=ENERGY_ROUNDING)


def test_a_parallel_axis_rule_without_the_first_moment_changes_the_energy() -> None:
    """Negative control: shifting by the offset alone holds only for frames at the centre of mass."""
    a_H_b, body = make_pose(rotation_from_rpy([0.4, -0.2, 1.0]), [0.5, -0.3, 0.8]), _point(2.0, [0.1, 0.4, -0.2])
    right, offset, rotation = body.expressed_in(a_H_b), skew(a_H_b[:3, 3]), a_H_b[:3, :3]
    wrong = Inertia(
        mass=right.mass,
        first_moment=right.first_moment,
        second_moment=rotation @ body.second_moment @ rotation.T - body.mass * offset @ offset,
    )
    b_twist = np.array([0.3, -1.0, 0.5, 1.0, 2.0, -1.5])
    a_twist = transform_twist(a_H_b, b_twist)
    assert _energy(right, a_twist) == pytest.approx(_energy(body, b_twist), rel=0, abs=ENERGY_ROUNDING)
    assert abs(_energy(wrong, a_twist) - _energy(body, b_twist)) > VISIBLE


@REPEATABLE
@given(st.floats(0, HEAVIEST), vectors(3, FARTHEST / 2), poses())
def test_moving_the_frame_moves_the_point_mass(mass: float, position: FloatArray, a_H_b: FloatArray) -> None:
    """The inertia of a point mass in a is that of the same mass at the moved point."""
    moved = a_H_b[:3, :3] @ position + a_H_b[:3, 3]
    _assert_same(_point(mass, position).expressed_in(a_H_b), _point(mass, moved))


@REPEATABLE
@given(bodies(), poses())
def test_the_inverse_pose_undoes(body: Inertia, a_H_b: FloatArray) -> None:
    """Expressed in another frame and back, the inertia is the same."""
    _assert_same(body.expressed_in(a_H_b).expressed_in(invert_pose(a_H_b)), body)


@REPEATABLE
@given(bodies(), poses())
def test_the_matrix_is_symmetric(body: Inertia, a_H_b: FloatArray) -> None:
    """The 6 x 6 matrix is symmetric in every frame: momentum derives from an energy."""
    matrix = body.expressed_in(a_H_b).matrix()
    assert matrix.shape == (6, 6)
    np.testing.assert_allclose(matrix, matrix.T, rtol=0, atol=MOMENT_ROUNDING)


def test_two_halves_are_the_whole() -> None:
    """Two uniform rods end to end are the rod of double length: m L^2 / 12 about its middle."""
    mass, length = 1.5, 0.4

    def rod(mass: float, length: float, middle: float) -> Inertia:
        across = mass * length**2 / 12
        return Inertia.about_centre_of_mass(
            mass=mass, centre_of_mass=[middle, 0.0, 0.0], second_moment=np.diag([0.0, across, across])
        )

    joined = rod(mass, length, -length / 2) + rod(mass, length, length / 2)
    _assert_same(joined, rod(2 * mass, 2 * length, 0.0))
    shifted = rod(mass, length, -length / 2) + rod(mass, length, length)
    assert np.abs(shifted.second_moment - joined.second_moment).max() > VISIBLE


@REPEATABLE
@given(bodies(), bodies(), poses())
def test_joining_and_moving_commute(first: Inertia, second: Inertia, a_H_b: FloatArray) -> None:
    """The joined body moved is the moved bodies joined; nothing added changes nothing."""
    _assert_same((first + second).expressed_in(a_H_b), first.expressed_in(a_H_b) + second.expressed_in(a_H_b))
    _assert_same(first + Inertia.zero(), first)


def test_a_massless_body_keeps_its_second_moment() -> None:
    """A link of mass zero with inertia is not nothing, and its inertia turns but does not shift."""
    body = Inertia(mass=0.0, first_moment=np.zeros(3), second_moment=np.diag([1.0, 2.0, 3.0]))
    assert not body.is_zero
    assert Inertia.zero().is_zero
    quarter_about_z = make_pose(rotation_from_rpy([0.0, 0.0, np.pi / 2]), [0.5, 0.6, 0.7])
    moved = body.expressed_in(quarter_about_z)
    assert not moved.is_zero
    np.testing.assert_allclose(moved.second_moment, np.diag([2.0, 1.0, 3.0]), rtol=0, atol=MOMENT_ROUNDING)
    assert Inertia.zero().expressed_in(quarter_about_z).is_zero


def test_arrays_are_copied_and_read_only() -> None:
    """Nobody can change an inertia, neither through its fields nor through the caller's arrays."""
    moment = np.ones(3)
    inertia = Inertia(mass=1.0, first_moment=moment, second_moment=np.eye(3))
    moment[0] = 7.0
    np.testing.assert_array_equal(inertia.first_moment, np.ones(3))
    with pytest.raises(ValueError, match="read-only"):
        inertia.second_moment[0, 0] = 2.0


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("centre_of_mass", [1.0, 2.0], r"vector: expected shape \(\.\.\., 3\), got \(2,\)"),
        ("centre_of_mass", np.zeros((2, 3)), r"expected an array of shape \(3"),
        ("second_moment", 1.0, r"second_moment: expected an array of shape \(3, 3\), got \(\)"),
        ("second_moment", np.ones(3), r"second_moment: expected an array of shape \(3, 3\), got \(3,\)"),
    ],
)
def test_wrong_shapes_are_refused(field: str, value: Any, message: str) -> None:
    """Moments of a wrong shape are named, not broadcast."""
    right = {"mass": 1.0, "centre_of_mass": np.zeros(3), "second_moment": np.eye(3)}
    with pytest.raises(ShapeError, match=message):
        Inertia.about_centre_of_mass(**{**right, field: value})
