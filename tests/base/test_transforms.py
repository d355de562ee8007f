# SPDX-License-Identifier: BSD-3-Clause
"""Wrench and twist transforms: power, inverse, composition, batches, and by hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.pose import invert_pose, make_pose, rotation_about_z, skew, split_pose
from forcetorque.base.wrench import transform_twist, transform_wrench, twist_matrix, wrench_matrix
from tests.base.strategies import FARTHEST, LARGEST, REPEATABLE, poses, six_vectors

EPS = float(np.finfo(np.float64).eps)

VECTOR_ROUNDING = 100 * EPS * LARGEST * (1 + 2 * FARTHEST) ** 2
"""Rounding of two transforms over 2 * FARTHEST of components up to LARGEST, with a margin for the sums."""

POWER_ROUNDING = 6 * LARGEST * VECTOR_ROUNDING
"""Six products of a component of LARGEST with one that carries the rounding of a vector; W."""

MATRIX_ROUNDING = 100 * EPS * (1 + 2 * FARTHEST)
"""Rounding of products of 6 x 6 matrices with entries up to the farthest distance."""

VISIBLE = 1e-3
"""What a negative control must exceed: far above every rounding here, far below the effects."""

TURNED = make_pose(rotation_about_z(np.array(0.7)), [0.4, -0.3, 0.2])
"""A pose without symmetry for negative controls."""


def _power(wrench: FloatArray, twist: FloatArray) -> float:
    return float(wrench @ twist)


@REPEATABLE
@given(poses(), six_vectors(), six_vectors())
def test_power_is_equal_in_both_frames(a_H_b: FloatArray, b_wrench: FloatArray, b_twist: FloatArray) -> None:
    """A wrench on a moving rigid body has the same power in every frame fixed to it."""
    in_a = _power(transform_wrench(a_H_b, b_wrench), transform_twist(a_H_b, b_twist))
    assert in_a == pytest.approx(_power(b_wrench, b_twist), rel=0, abs=POWER_ROUNDING)


def _without_hat(a_H_b: FloatArray, b_wrench: FloatArray) -> FloatArray:
    rotation, position = split_pose(a_H_b)
    wrong = wrench_matrix(a_H_b)
    wrong[3:, :3] = np.diag(position) @ rotation
    return wrong @ b_wrench


def _without_offset(a_H_b: FloatArray, b_wrench: FloatArray) -> FloatArray:
    return transform_wrench(make_pose(split_pose(a_H_b)[0], np.zeros(3)), b_wrench)


@pytest.mark.parametrize("wrong", [transform_twist, _without_hat, _without_offset])
def test_wrong_wrench_maps_break_the_power(wrong: Callable[[Any, Any], FloatArray]) -> None:
    """Negative control: the twist map, an offset without its hat, or none, change the power."""
    b_wrench, b_twist = np.random.default_rng(1).normal(size=(2, 6))
    in_b = _power(b_wrench, b_twist)
    twist = transform_twist(TURNED, b_twist)
    assert _power(transform_wrench(TURNED, b_wrench), twist) == pytest.approx(in_b, rel=0, abs=POWER_ROUNDING)
    assert abs(_power(wrong(TURNED, b_wrench), twist) - in_b) > VISIBLE


@REPEATABLE
@given(poses(), six_vectors())
def test_the_inverse_pose_undoes(a_H_b: FloatArray, vector: FloatArray) -> None:
    """Going to another frame and back gives the same wrench and the same twist."""
    for transform in (transform_wrench, transform_twist):
        back = transform(invert_pose(a_H_b), transform(a_H_b, vector))
        np.testing.assert_allclose(back, vector, rtol=0, atol=VECTOR_ROUNDING)


def test_the_transposed_pose_does_not_undo() -> None:
    """Negative control: turning back without moving back leaves a moment."""
    wrench = np.array([1.0, 2.0, 3.0, 0.0, 0.0, 0.0])
    halfway = make_pose(split_pose(TURNED)[0].T, np.zeros(3))
    assert np.abs(transform_wrench(halfway, transform_wrench(TURNED, wrench)) - wrench).max() > VISIBLE


@REPEATABLE
@given(poses(), poses(), six_vectors())
def test_transforms_compose_as_poses_do(a_H_b: FloatArray, b_H_c: FloatArray, vector: FloatArray) -> None:
    """Expressing in b and then in a is expressing with the product of the poses."""
    for transform in (transform_wrench, transform_twist):
        in_steps = transform(a_H_b, transform(b_H_c, vector))
        np.testing.assert_allclose(transform(a_H_b @ b_H_c, vector), in_steps, rtol=0, atol=VECTOR_ROUNDING)


def test_composition_in_the_wrong_order_disagrees() -> None:
    """Negative control: poses do not commute."""
    other = make_pose(np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]), [0.1, 0.5, 0.0])
    wrench = np.arange(1.0, 7.0)
    in_steps = transform_wrench(TURNED, transform_wrench(other, wrench))
    assert np.abs(transform_wrench(other @ TURNED, wrench) - in_steps).max() > VISIBLE


@REPEATABLE
@given(poses())
def test_wrench_matrix_is_the_inverse_transpose_of_the_twist_matrix(a_H_b: FloatArray) -> None:
    """The two maps are dual, and the inverse pose gives the inverse matrix."""
    np.testing.assert_allclose(wrench_matrix(a_H_b).T @ twist_matrix(a_H_b), np.eye(6), rtol=0, atol=MATRIX_ROUNDING)
    np.testing.assert_allclose(
        wrench_matrix(invert_pose(a_H_b)) @ wrench_matrix(a_H_b), np.eye(6), rtol=0, atol=MATRIX_ROUNDING
    )


@REPEATABLE
@given(poses())
def test_a_pose_times_its_inverse_is_the_identity(a_H_b: FloatArray) -> None:
    """The pose of b in a and that of a in b cancel."""
    np.testing.assert_allclose(a_H_b @ invert_pose(a_H_b), np.eye(4), rtol=0, atol=MATRIX_ROUNDING)


def test_batches_equal_loops() -> None:
    """Arrays of poses, wrenches and twists give what a loop over them gives; a single pose broadcasts."""
    rng = np.random.default_rng(2)
    count = 5
    angles, positions = rng.uniform(-3, 3, count), rng.normal(size=(count, 3))
    batch = make_pose(rotation_about_z(angles), positions)
    vectors = rng.normal(size=(count, 6))
    compared = 0
    for transform in (transform_wrench, transform_twist):
        together, one_pose = transform(batch, vectors), transform(batch[0], vectors)
        assert together.shape == one_pose.shape == (count, 6)
        for k in range(count):
            single = make_pose(rotation_about_z(angles[k]), positions[k])
            np.testing.assert_allclose(invert_pose(batch)[k], invert_pose(single), rtol=0, atol=MATRIX_ROUNDING)
            np.testing.assert_allclose(together[k], transform(single, vectors[k]), rtol=0, atol=VECTOR_ROUNDING)
            np.testing.assert_allclose(one_pose[k], transform(batch[0], vectors[k]), rtol=0, atol=VECTOR_ROUNDING)
            compared += 1
    assert compared == 2 * count
    assert np.abs(together[0] - together[1]).max() > VISIBLE


def test_wrench_by_hand() -> None:
    """A force of 2 N along z at x = 3 m turned by a quarter about z: moment -6 N m about y."""
    quarter = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    found = transform_wrench(make_pose(quarter, [3.0, 0.0, 0.0]), [5.0, 0.0, 2.0, 0.0, 0.0, 0.0])
    # force x of b is y of a: its moment about z is 3 * 5; force z gives (3, 0, 0) x (0, 0, 2) = (0, -6, 0)
    np.testing.assert_array_equal(found, [0.0, 5.0, 2.0, 0.0, -6.0, 15.0])


def test_twist_by_hand() -> None:
    """A body that spins at 2 rad/s about z through x = 3 m moves at -6 m/s along y in the origin."""
    found = transform_twist(make_pose(np.eye(3), [3.0, 0.0, 0.0]), [0.0, 0.0, 0.0, 0.0, 0.0, 2.0])
    np.testing.assert_array_equal(found, [0.0, -6.0, 0.0, 0.0, 0.0, 2.0])


def test_arguments_are_not_changed() -> None:
    """Read-only arrays are accepted, so nothing is written into them."""
    pose, vector = TURNED.copy(), np.arange(6.0)
    pose.setflags(write=False)
    vector.setflags(write=False)
    moved = transform_wrench(pose, vector), transform_twist(pose, vector), invert_pose(pose)
    assert all(result.flags.writeable for result in moved)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: transform_wrench(np.eye(4), np.zeros(3)), r"b_wrench: expected shape \(\.\.\., 6\), got \(3,\)"),
        (lambda: transform_wrench(np.eye(4), 1.0), r"b_wrench: expected shape \(\.\.\., 6\), got \(\)"),
        (lambda: transform_twist(np.eye(4), np.zeros((6, 1))), r"b_twist: expected shape \(\.\.\., 6\), got \(6, 1\)"),
        (lambda: transform_wrench(np.eye(3), np.zeros(6)), r"a_H_b: expected shape \(\.\.\., 4, 4\), got \(3, 3\)"),
        (lambda: invert_pose(np.zeros((4, 3))), r"a_H_b: expected shape \(\.\.\., 4, 4\), got \(4, 3\)"),
        (lambda: make_pose(np.eye(4), np.zeros(3)), r"a_R_b: expected shape \(\.\.\., 3, 3\), got \(4, 4\)"),
        (lambda: make_pose(1.0, np.zeros(3)), r"a_R_b: expected shape \(\.\.\., 3, 3\), got \(\)"),
        (lambda: make_pose(np.eye(3), 0.5), r"a_p_b: expected shape \(\.\.\., 3\), got \(\)"),
        (lambda: make_pose(np.eye(3), [0.5]), r"a_p_b: expected shape \(\.\.\., 3\), got \(1,\)"),
        (lambda: skew([1.0, 2.0]), r"vector: expected shape \(\.\.\., 3\), got \(2,\)"),
    ],
)
def test_wrong_shapes_are_refused(call: Callable[[], FloatArray], message: str) -> None:
    """A wrong shape names the argument, the expected shape and the one that came; nothing is padded."""
    with pytest.raises(ShapeError, match=message):
        call()
