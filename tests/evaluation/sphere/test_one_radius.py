# SPDX-License-Identifier: BSD-3-Clause
"""Spheres against least squares on the points."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import least_squares

from forcetorque.evaluation.sphere.algebraic_fit import Spheres, gradient_weighted_spheres, least_squares_spheres
from forcetorque.evaluation.sphere.cloud import QuadricMoments
from forcetorque.evaluation.sphere.geometric_fit import refine_sphere
from forcetorque.evaluation.sphere.resampling import whole
from tests.evaluation.sphere.clouds import WEIGHT, grid, whole_sphere

CENTRE = np.array([8.0, -20.0, 35.0])
FITS = (least_squares_spheres, gradient_weighted_spheres)


def _cloud(directions: np.ndarray, noise: float, seed: int = 1) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return WEIGHT * directions + CENTRE + noise * rng.normal(size=directions.shape)


def _fit(fit: object, cloud: np.ndarray) -> Spheres:
    moments = QuadricMoments.of(cloud)
    spheres: Spheres = fit(whole(moments.sums), moments)  # type: ignore[operator]
    return spheres


@pytest.mark.parametrize("fit", FITS)
@pytest.mark.parametrize("directions", [whole_sphere(50), grid(200, 60.0), grid(200, 10.0)])
def test_exact_spheres_are_found(fit: object, directions: np.ndarray) -> None:
    """Centre, radius and the way towards the centre."""
    cloud = _cloud(directions, 0.0)
    found = _fit(fit, cloud)
    assert found.radius[0] == pytest.approx(WEIGHT, rel=1e-8)
    np.testing.assert_allclose(found.centre[0], CENTRE, atol=1e-6)
    towards = CENTRE - cloud.mean(axis=0)
    if np.linalg.norm(towards) > 1.0:
        np.testing.assert_allclose(found.bend[0] * WEIGHT, towards / np.linalg.norm(towards), atol=1e-6)


def test_least_squares_as_numpy_solves_it() -> None:
    """The linear problem in 2 c and R2 - c2."""
    cloud = _cloud(grid(400, 40.0), 0.5)
    solved = np.linalg.lstsq(np.column_stack([2.0 * cloud, np.ones(len(cloud))]), (cloud**2).sum(axis=1), rcond=None)[0]
    radius = np.sqrt(solved[3] + solved[:3] @ solved[:3])
    found = _fit(least_squares_spheres, cloud)
    assert found.radius[0] == pytest.approx(radius, rel=1e-9)
    np.testing.assert_allclose(found.centre[0], solved[:3], atol=1e-7)


@pytest.mark.parametrize(("half", "noise"), [(90.0, 1.0), (40.0, 1.0), (20.0, 0.3)])
def test_the_geometric_fit_as_scipy_finds_it(half: float, noise: float) -> None:
    """Sum of squared distances to the sphere, from the same start."""
    cloud = _cloud(grid(500, half), noise)
    start = _fit(gradient_weighted_spheres, cloud)
    peer = least_squares(
        lambda p: np.linalg.norm(cloud - p[:3], axis=1) - p[3],
        np.append(start.centre[0], start.radius[0]),
        xtol=1e-14,
        ftol=1e-14,
        gtol=1e-12,
    )
    ours = refine_sphere(cloud, start.centre[0], float(start.radius[0]))
    assert ours.converged
    np.testing.assert_allclose(ours.parameters, peer.x, rtol=1e-5, atol=1e-4)
    assert ours.rms == pytest.approx(np.sqrt(2.0 * peer.cost / len(cloud)), rel=1e-9)
    # the gradient-weighted fit comes close to it, linear least squares does not
    assert start.radius[0] == pytest.approx(ours.parameters[3], rel=0.02)


def test_least_squares_shrink_on_a_noisy_cap() -> None:
    """What makes two methods a witness: on a part of a sphere with noise one is too small, the other is not."""
    radii = np.array([[_fit(fit, _cloud(grid(500, 20.0), 0.8, seed)).radius[0] for fit in FITS] for seed in range(30)])
    shrunk, fair = np.median(radii, axis=0)
    assert shrunk < 0.8 * WEIGHT
    assert abs(fair - WEIGHT) < 0.15 * WEIGHT


def test_a_bowl_and_a_dome_bend_apart() -> None:
    """The way towards the centre changes sides with the bend, through a plane without any."""
    x, y = np.random.default_rng(2).uniform(-5.0, 5.0, size=(2, 300))
    for fit in FITS:
        sides = [_fit(fit, np.column_stack([x, y, bend * (x**2 + y**2)])).bend[0, 2] for bend in (0.02, -0.02)]
        assert sides[0] == pytest.approx(-sides[1], rel=1e-6)
        assert sides[0] > 0.0
    flat = _fit(gradient_weighted_spheres, np.column_stack([x, y, np.zeros(300)]))
    assert np.abs(flat.bend).max() < 1e-6
