# SPDX-License-Identifier: BSD-3-Clause
"""Orthogonal distances against a search over the surface; geometric fits against scipy with other parameters."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import least_squares, minimize
from scipy.spatial.transform import Rotation

from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid
from forcetorque.evaluation.sphere.geometric_fit import (
    ellipsoid_distances,
    ellipsoid_equations,
    ellipsoid_of_parameters,
    ellipsoid_parameters,
    refine_ellipsoid,
    sphere_equations,
)
from tests.evaluation.sphere.clouds import DEFORMED, grid, map_of, on, whole_sphere


def _searched(point: np.ndarray, ellipsoid: Ellipsoid) -> float:
    """Distance by minimising over two angles, from the best of many starts."""
    root = map_of(ellipsoid)
    starts = whole_sphere(2000)
    best = starts[np.argmin(np.linalg.norm(point - ellipsoid.centre - starts @ root.T, axis=1))]
    turn = Rotation.align_vectors([best], [[0.0, 0.0, 1.0]])[0].as_matrix()

    def distance(angles: np.ndarray) -> float:
        a, b = angles
        direction = turn @ np.array([np.sin(a) * np.cos(b), np.sin(b), np.cos(a) * np.cos(b)])
        return float(np.linalg.norm(point - ellipsoid.centre - root @ direction))

    return float(minimize(distance, [0.0, 0.0], method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-12}).fun)


def test_distances_are_the_shortest() -> None:
    """Outside and inside, near and far, as a search over the surface finds them; inside they are negative."""
    directions = whole_sphere(14)
    checked = 0
    for stretch in (0.3, 0.95, 1.05, 4.0):
        cloud = stretch * (on(DEFORMED, directions) - DEFORMED.centre) + DEFORMED.centre
        for point, distance in zip(cloud, ellipsoid_distances(cloud, DEFORMED), strict=True):
            assert abs(distance) == pytest.approx(_searched(point, DEFORMED), rel=1e-6, abs=1e-6)
            assert np.sign(distance) == np.sign(stretch - 1.0)
            checked += 1
    assert checked == 56


def test_distances_in_symmetry_planes() -> None:
    """Points on the axes and in the centre, where feet are many: by hand."""
    ellipsoid = Ellipsoid(centre=np.zeros(3), shape=np.diag([1.0 / 25.0, 1.0 / 9.0, 1.0 / 4.0]))
    points = np.array([[7.0, 0, 0], [0, -4.0, 0], [0, 0, 1.5], [0, 0, 0], [4.9, 0, 0], [5.0, 0, 0]])
    distances = ellipsoid_distances(points, ellipsoid)
    np.testing.assert_allclose(distances, [2.0, 1.0, -0.5, -2.0, -0.1, 0.0], atol=1e-7)


def test_the_jacobian_is_that_of_finite_differences() -> None:
    """Gradient of half the sum of squares, along each of the nine parameters."""
    rng = np.random.default_rng(4)
    cloud = on(DEFORMED, whole_sphere(60)) + rng.normal(size=(60, 3))
    parameters = ellipsoid_parameters(DEFORMED) + 0.3 * rng.normal(size=9)
    equations = ellipsoid_equations(cloud, parameters)
    assert equations is not None
    step = 1e-5
    slopes = []
    for along in np.eye(9):
        ends = [ellipsoid_equations(cloud, parameters + side * step * along) for side in (1.0, -1.0)]
        assert ends[0] is not None
        assert ends[1] is not None
        slopes.append((ends[0].cost - ends[1].cost) / (4.0 * step))
    np.testing.assert_allclose(equations.gradient, slopes, rtol=1e-5, atol=1e-4)


def test_the_jacobian_of_a_sphere_is_that_of_finite_differences() -> None:
    """Gradient of half the sum of squares, along centre and radius, away from the minimum."""
    rng = np.random.default_rng(5)
    cloud = 30.0 * whole_sphere(60) + [1.0, -2.0, 3.0] + rng.normal(size=(60, 3))
    parameters = np.array([2.0, -1.0, 2.5, 27.0])
    equations = sphere_equations(cloud, parameters)
    assert equations is not None
    step = 1e-5

    def cost(at: np.ndarray) -> float:
        found = sphere_equations(cloud, at)
        assert found is not None
        return found.cost

    slopes = [(cost(parameters + step * along) - cost(parameters - step * along)) / (4.0 * step) for along in np.eye(4)]
    np.testing.assert_allclose(equations.gradient, slopes, rtol=1e-5)


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e4])
def test_a_disc_is_no_ellipsoid_in_any_unit(size: float) -> None:
    """One whose third half-axis is 1e13 times as long has no equations; one of a million times has."""
    cloud = on(DEFORMED, whole_sphere(60)) / size
    places = np.flatnonzero(np.equal(*np.tril_indices(3)))
    for third, known in ((1e-6, True), (1e-13, False)):
        parameters = np.zeros(9)
        parameters[3 + places] = size * np.array([1.0, 1.0, third])
        assert (ellipsoid_equations(cloud, parameters) is not None) is known


def test_parameters_and_back() -> None:
    """Nine numbers hold an ellipsoid."""
    back = ellipsoid_of_parameters(ellipsoid_parameters(DEFORMED))
    np.testing.assert_allclose(back.shape, DEFORMED.shape, rtol=1e-10)
    np.testing.assert_allclose(back.centre, DEFORMED.centre)


def _peer(cloud: np.ndarray, start: Ellipsoid) -> tuple[np.ndarray, float]:
    """Axis intersections and cost by scipy: centre, logarithms of three radii, three angles; numerical Jacobian."""
    values, axes = np.linalg.eigh(start.shape)
    axes = axes * np.sign(np.linalg.det(axes))

    def ellipsoid(p: np.ndarray) -> Ellipsoid:
        turned = Rotation.from_rotvec(p[6:]).as_matrix() @ axes
        return Ellipsoid(centre=p[:3], shape=turned @ np.diag(np.exp(-2.0 * p[3:6])) @ turned.T)

    begin = np.concatenate([start.centre, -0.5 * np.log(values), np.zeros(3)])
    found = least_squares(lambda p: ellipsoid_distances(cloud, ellipsoid(p)), begin, xtol=1e-14, ftol=1e-14, gtol=1e-12)
    return ellipsoid(found.x).axis_intersections, float(2.0 * found.cost)


@pytest.mark.parametrize(("directions", "noise"), [(whole_sphere(300), 1.5), (grid(400, 60.0), 0.5)])
def test_the_geometric_fit_as_scipy_finds_it(directions: np.ndarray, noise: float) -> None:
    """The same minimum, from a start that is neither the truth nor the algebraic fit."""
    rng = np.random.default_rng(8)
    cloud = on(DEFORMED, directions) + noise * rng.normal(size=directions.shape)
    start = Ellipsoid(centre=DEFORMED.centre + 2.0, shape=1.1 * DEFORMED.shape)
    ours, fit = refine_ellipsoid(cloud, start)
    peer, cost = _peer(cloud, start)
    assert fit.converged
    # a numerical Jacobian stops a little before the minimum
    np.testing.assert_allclose(ours.axis_intersections, peer, rtol=1e-4)
    assert fit.rms**2 * len(cloud) == pytest.approx(cost, rel=1e-7)


def test_more_points_than_a_first_pass_takes() -> None:
    """All of them count in the end: the fit to 50 000 points is a minimum over all, not over every third."""
    rng = np.random.default_rng(9)
    cloud = on(DEFORMED, grid(50_000, 70.0)) + rng.normal(size=(50_000, 3))
    found, fit = refine_ellipsoid(cloud, DEFORMED)
    assert fit.converged
    equations = ellipsoid_equations(cloud, ellipsoid_parameters(found))
    assert equations is not None
    # a Newton step from here is no longer than the tolerance of the fit
    assert np.abs(np.linalg.solve(equations.hessian, equations.gradient)).max() < 1e-5
    np.testing.assert_allclose(found.axis_intersections, DEFORMED.axis_intersections, rtol=0.01)


def test_what_keeps_opening_has_not_converged() -> None:
    """Points of a saddle have no nearest ellipsoid: the fit says that it found none."""
    x, y = np.random.default_rng(5).uniform(-10.0, 10.0, size=(2, 500))
    saddle = np.column_stack([x, y, 0.02 * (x**2 - y**2)])
    start = Ellipsoid(centre=np.array([0.0, 0.0, -40.0]), shape=np.eye(3) / 40.0**2)
    _, fit = refine_ellipsoid(saddle, start)
    assert not fit.converged
