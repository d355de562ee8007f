# SPDX-License-Identifier: BSD-3-Clause
"""Motions of joints and of the root: shapes, copies, broadcasting."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from tests.scenes.robots import PENDULUM_URDF, read_text


def _joints(**changed: Any) -> JointMotion:
    arrays = {"names": ("a", "b"), "position": np.zeros((4, 2)), "velocity": np.zeros((4, 2))}
    return JointMotion(**{**arrays, "acceleration": np.zeros((4, 2)), **changed})


def _root(**changed: Any) -> RootMotion:
    arrays = {"proper_acceleration": np.ones(3), "angular_velocity": np.ones(3), "angular_acceleration": np.ones(3)}
    return RootMotion(**{**arrays, **changed})


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: _joints(position=np.zeros((4, 3))), r"position: expected an array of shape \(n, 2\), got \(4, 3\)"),
        (lambda: _joints(position=np.zeros(2)), r"position: expected an array of shape \(n, 2\), got \(2,\)"),
        (lambda: _joints(velocity=np.zeros((5, 2))), r"velocity: expected an array of shape \(4, 2\), got \(5, 2\)"),
        (lambda: _joints(acceleration=0.0), r"acceleration: expected an array of shape \(4, 2\), got \(\)"),
        (lambda: _joints(names=("a", "a")), r"joint names: expected each once, got \('a', 'a'\)"),
        (lambda: JointMotion.at_rest(["a"], [0.1, 0.2]), r"position: expected an array of shape \(n, 1\), got \(2,\)"),
        (lambda: _root(proper_acceleration=9.8), r"proper_acceleration: expected an array of shape \(n, 3\), got \(\)"),
        (lambda: _root(angular_velocity=np.zeros(2)), r"angular_velocity: expected .* \(3\), got \(2,\)"),
        (lambda: _root(angular_acceleration=np.zeros((4, 2))), r"angular_acceleration: .* \(n, 3\), got \(4, 2\)"),
    ],
)
def test_wrong_shapes_are_refused(build: Callable[[], object], message: str) -> None:
    """A wrong shape names the argument, the expected shape and the one that came."""
    with pytest.raises(ShapeError, match=message):
        build()


def test_motions_are_copied_and_read_only() -> None:
    """The caller's arrays stay the caller's, and those of the motion cannot change."""
    position = np.zeros((4, 2))
    joints = _joints(position=position)
    position[0, 0] = 1.0
    assert joints.position[0, 0] == 0.0
    assert len(joints) == 4
    with pytest.raises(ValueError, match="read-only"):
        joints.velocity[0, 0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        _root().proper_acceleration[0] = 1.0


def test_at_rest_nothing_moves() -> None:
    """Joints at rest keep their position and have neither velocity nor acceleration."""
    joints = JointMotion.at_rest(["a", "b"], [[0.1, 0.2]])
    np.testing.assert_array_equal(joints.position, [[0.1, 0.2]])
    np.testing.assert_array_equal([joints.velocity, joints.acceleration], np.zeros((2, 1, 2)))


def test_a_fixed_root_feels_gravity_upwards() -> None:
    """An accelerometer at rest reads against the direction of fall, with the magnitude given."""
    np.testing.assert_array_equal(RootMotion.fixed([0, 0, -1]).proper_acceleration, [0.0, 0.0, STANDARD_GRAVITY])
    np.testing.assert_array_equal(RootMotion.fixed([1, 0, 0], gravity=1.6).proper_acceleration, [-1.6, 0.0, 0.0])
    np.testing.assert_array_equal(RootMotion.fixed([1, 0, 0]).angular_velocity, np.zeros(3))


def test_one_root_sample_serves_all(tmp_path: Path) -> None:
    """A root given as (3,), as (1, 3) and as (n, 3) with equal rows reads the same."""
    tree = build_tree(read_text(PENDULUM_URDF, tmp_path), "base")
    swing = JointMotion.at_rest(["swing"], [[0.0], [0.5], [1.0]])
    single = np.array([0.5, 0.0, 9.0])
    readings = [
        expected_wrenches(tree, swing, _root(proper_acceleration=values))["ft"]
        for values in (single, single[None], np.tile(single, (3, 1)))
    ]
    np.testing.assert_array_equal(readings[1], readings[0])
    np.testing.assert_array_equal(readings[2], readings[0])
    assert np.abs(readings[0][1] - readings[0][0]).max() > 0.1


def test_another_number_of_root_samples_is_refused(tmp_path: Path) -> None:
    """Root samples that match neither one nor the joints' are named with both numbers."""
    tree = build_tree(read_text(PENDULUM_URDF, tmp_path), "base")
    swing = JointMotion.at_rest(["swing"], [[0.0], [0.5], [1.0]])
    with pytest.raises(ShapeError, match="root motion: expected 1 or 3 samples, got 2"):
        expected_wrenches(tree, swing, _root(angular_velocity=np.zeros((2, 3))))


def test_a_gravity_direction_that_is_not_a_unit_vector_is_refused() -> None:
    """Gravity in m/s2 given as the direction would weigh everything ten times."""
    with pytest.raises(ShapeError, match="unit vector"):
        RootMotion.fixed([0.0, 0.0, -9.80665])
