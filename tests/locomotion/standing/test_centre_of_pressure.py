# SPDX-License-Identifier: BSD-3-Clause
"""Centres of pressure are where the ground presses, with errors as large as those of the wrench make them."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import EstimationError, ShapeError
from forcetorque.base.pose import make_pose
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import (
    PlaneTolerance,
    Sole,
    centre_of_pressure,
    coplanar,
    wrench_on_ground,
)

ANKLE_M = 0.06
"""Height of a sensor above the sole."""


def test_it_is_where_forces_act() -> None:
    """Pressures at points of a sole have their mean there, weighed by what presses, whatever friction does."""
    rng = np.random.default_rng(1)
    points, pressed = rng.uniform(-0.1, 0.1, (7, 2)), rng.uniform(1.0, 30.0, 7)
    forces = np.column_stack([rng.normal(size=(7, 2)) * 5.0, pressed])
    arms = np.column_stack([points, np.zeros(7)])
    wrench = np.r_[forces.sum(axis=0), np.cross(arms, forces).sum(axis=0)]
    pressure = centre_of_pressure(wrench[None], least_load_N=1.0)
    np.testing.assert_allclose(pressure.points[0], pressed @ points / pressed.sum(), rtol=0, atol=1e-15)
    # negative control: moment over force, component by component, as (5.21) is printed
    assert np.abs(wrench[3:5] / wrench[2] - pressure.points[0]).max() > 1e-3


def test_forces_along_the_ground_shift_a_point_that_is_read_above_it() -> None:
    """14 and 28 N at 60 mm, under the weight of 33.1 kg, are 2.6 and 5.2 mm: what neglect of the height costs."""
    weight_N = 33.1 * 9.81
    for along_N, cost_mm in ((14.0, 2.6), (28.0, 5.2)):
        below = np.array([along_N, 0.0, weight_N, 0.0, 0.0, 0.0])  # presses at the origin of the sole
        at_ankle = below.copy()
        at_ankle[3:] = np.cross([0.0, 0.0, -ANKLE_M], below[:3])
        moved = centre_of_pressure(below[None], least_load_N=50.0).points[0]
        neglected = centre_of_pressure(at_ankle[None], least_load_N=50.0).points[0]
        assert 1e3 * np.linalg.norm(neglected - moved) == pytest.approx(cost_mm, abs=0.05)


def test_intervals_hold_the_point() -> None:
    """Of 20 000 draws of a correlated wrench 94 to 96 % are within the 95 % interval on either axis."""
    rng = np.random.default_rng(2)
    wrench = np.array([5.0, -8.0, 200.0, 4.0, -12.0, 1.0])
    root = rng.normal(size=(6, 6)) * np.repeat([2.0, 0.1], 3)[:, None]
    covariance = root @ root.T
    known = centre_of_pressure(wrench[None], least_load_N=50.0, covariance=covariance[None])
    drawn = centre_of_pressure(wrench + rng.normal(size=(20_000, 6)) @ root.T, least_load_N=50.0)
    assert known.covariance is not None
    half = 1.96 * np.sqrt(np.diag(known.covariance[0]))
    share = np.mean(np.abs(drawn.points - known.points) <= half, axis=0)
    assert np.all((share > 0.94) & (share < 0.96))


def test_too_little_load_has_no_point() -> None:
    """A foot in the air, or one that is pulled, has none; the threshold itself has one."""
    wrench = np.zeros((4, 6))
    wrench[:, 2] = [49.0, 50.0, -80.0, np.nan]
    assert centre_of_pressure(wrench, least_load_N=50.0).known.tolist() == [False, True, False, False]
    with pytest.raises(EstimationError, match="least_load_N: expected a positive force in N, got 0"):
        centre_of_pressure(wrench, least_load_N=0.0)
    with pytest.raises(ShapeError, match="covariance"):
        centre_of_pressure(wrench, least_load_N=50.0, covariance=np.eye(6))


def test_a_point_beyond_the_outline_is_measured() -> None:
    """The distance to the nearest edge of the convex outline, negative inside."""
    sole = Sole(frame="sole", outline=np.array([[-0.1, -0.04], [0.1, -0.04], [0.1, 0.04], [-0.1, 0.04], [0.0, 0.0]]))
    points = np.array([[0.0, 0.0], [0.09, 0.0], [0.12, 0.0], [0.0, -0.05]])
    np.testing.assert_allclose(sole.beyond(points), [-0.04, -0.01, 0.02, 0.01], atol=1e-12)
    assert np.isnan(Sole(frame="sole").beyond(points)).all()
    with pytest.raises(EstimationError, match="expected at least 3 corners"):
        Sole(frame="sole", outline=np.array([[0.0, 0.0], [0.1, 0.0], [0.2, 0.0]]))


def test_soles_on_one_plane_have_a_common_point() -> None:
    """It lies between them by their loads; a step of 2 cm, or a sole turned up, has none while both are down."""
    apart = np.eye(4)
    apart[:3, 3] = [0.0, 0.2, 0.0]
    poses = np.stack([np.eye(4)] * 2), np.stack([apart] * 2)
    loads = np.zeros((2, 6)), np.zeros((2, 6))
    loads[0][:, 2], loads[1][:, 2] = 100.0, [300.0, 300.0]
    down = np.array([[True, True], [True, False]])
    total, spread = wrench_on_ground(poses, loads, (None, None), down)
    assert spread is None
    points = centre_of_pressure(total, least_load_N=50.0).points
    np.testing.assert_allclose(points, [[0.0, 0.15], [0.0, 0.0]], atol=1e-15)
    assert coplanar(poses, down, PlaneTolerance()).all()
    higher = apart.copy()
    higher[2, 3] = 0.02
    tilted = make_pose(np.array([[1.0, 0.0, 0.0], [0.0, 0.995, -0.0998], [0.0, 0.0998, 0.995]]), apart[:3, 3])
    for pose in (higher, tilted):
        assert coplanar((poses[0], np.stack([pose] * 2)), down, PlaneTolerance()).tolist() == [False, True]
