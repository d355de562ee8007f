# SPDX-License-Identifier: BSD-3-Clause
"""Limits of clouds, of minimisers and of drifts, on either side of each, and what they are by hand."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import t as student

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, UnitError
from forcetorque.evaluation.sphere.algebraic_fit import smallest_generalised
from forcetorque.evaluation.sphere.cloud import (
    CELLS,
    StaticForceError,
    _cells,
    is_one_point,
    reach,
    require_cloud,
    share_of_directions,
)
from forcetorque.evaluation.sphere.ellipsoid import TOLERANCE, Ellipsoid, beyond_measured_extent
from forcetorque.evaluation.sphere.geometric_fit import NormalEquations, descend, refine_sphere
from forcetorque.evaluation.sphere.model_free_fit import fit_ellipsoid, fit_radius, is_flat
from forcetorque.evaluation.sphere.resampling import BLOCKS
from forcetorque.evaluation.sphere.sensor_sphere import _refuse_counts
from forcetorque.evaluation.trials.trials import _wider_together
from tests.evaluation.sphere.clouds import on, whole_sphere


def _cloud(extent: float, count: int = 40) -> FloatArray:
    """No whole numbers, of a given extent along x and less along the others."""
    values = np.random.default_rng(1).uniform(-0.25, 0.25, (count, 3)) * extent
    values[:2, 0] = [-0.5 * extent, 0.5 * extent]
    return values


def test_clouds_are_refused_beyond_what_forces_can_be() -> None:
    """An extent of 40 kN, of 100 N in whole numbers, and of 1e-9 of the values; fewer than ten points."""
    for extent, is_force in ((3.99e4, True), (4.01e4, False)):
        if is_force:
            require_cloud(_cloud(extent), name="force", unit="N")
        else:
            with pytest.raises(UnitError, match="got values from .*, which can only be counts"):
                require_cloud(_cloud(extent), name="force", unit="N")
    for extent, is_force in ((100.0, True), (102.0, False)):
        whole = np.round(_cloud(extent))
        if is_force:
            require_cloud(whole, name="force", unit="N")
        else:
            with pytest.raises(UnitError, match="got whole numbers from -51 to 51"):
                require_cloud(whole, name="force", unit="N")
    for share, is_point in ((0.99e-9, True), (1.01e-9, False)):
        cloud = np.full((20, 3), 100.0)
        cloud[3, 1] -= share * 100.0
        assert is_one_point(cloud) == is_point
        if is_point:
            with pytest.raises(StaticForceError, match="got 20 times one point"):
                require_cloud(cloud, name="force", unit="N")
    require_cloud(_cloud(10.0, 10), name="force", unit="N")
    with pytest.raises(FitError, match="at least 10 points, got 9"):
        require_cloud(_cloud(10.0, 9), name="force", unit="N")


def test_readings_that_move_by_more_than_a_hundred_weights_are_counts() -> None:
    """The extent over the mean weight."""
    expected = 5.0 * whole_sphere(40)
    force = _cloud(499.0)
    _refuse_counts(force, expected)
    with pytest.raises(UnitError, match="values that move by 100 times the weight"):
        _refuse_counts(force * 501.0 / 499.0, expected)


def test_the_reach_of_a_cloud_is_twice_its_largest_distance_from_the_mean() -> None:
    """By hand, wherever the cloud is."""
    assert reach(np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 3.0, 4.0]]) + 70.0) == pytest.approx(
        2.0 * np.hypot(2.0, 4.0 / 1.5)
    )


def test_parts_of_the_sphere_of_directions_are_all_alike() -> None:
    """Each has its share of even directions within a tenth; of a cap those at its edge count too."""
    directions = np.random.default_rng(2).normal(size=(200_000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    share = np.bincount(_cells().query(directions)[1], minlength=CELLS) / len(directions) * CELLS
    # 1000 in each: a deviation of 3 %
    assert 0.88 < share.min() < share.max() < 1.12
    for lowest in (0.9, 0.5, -0.4):
        cap = directions[directions[:, 2] > lowest]
        # of the parts that the edge goes through, half lie outside
        edge = 0.5 * np.sqrt((1.0 - lowest**2) * np.pi / CELLS)
        assert share_of_directions(cap, np.zeros(3)) == pytest.approx(0.5 * (1.0 - lowest) + edge, abs=0.02)


def _quadratic(matrix: FloatArray, target: FloatArray, parameters: FloatArray) -> NormalEquations:
    left = matrix @ parameters - target
    return NormalEquations(cost=float(left @ left), gradient=matrix.T @ left, hessian=matrix.T @ matrix)


def test_a_linear_problem_is_solved_as_numpy_solves_it() -> None:
    """The least squares and their root mean square over the number of points that is given."""
    rng = np.random.default_rng(3)
    matrix, target = rng.normal(size=(20, 4)), rng.normal(size=20)
    fit = descend(lambda at: _quadratic(matrix, target, at), np.zeros(4), 1.0, 5)
    best, (cost,), _, _ = np.linalg.lstsq(matrix, target, rcond=None)
    assert fit.converged
    np.testing.assert_allclose(fit.parameters, best, atol=1e-6)
    assert fit.rms == pytest.approx(np.sqrt(cost / 5.0), rel=1e-9)


@pytest.mark.parametrize(("radius", "converges"), [(0.99e3, True), (1.01e3, False)])
def test_a_surface_opens_up_to_a_thousand_times_the_cloud(radius: float, converges: bool) -> None:
    """A minimum at a radius just below it is one, just beyond it is not; a centre may be anywhere."""
    target = np.array([1e6, 0.0, 0.0, radius])
    fit = descend(lambda at: _quadratic(np.eye(4), target, at), np.array([1e6, 0.0, 0.0, 1.0]), 1.0, 10)
    assert fit.converged == converges


def test_where_no_step_goes_down_the_fit_ends_without_a_minimum() -> None:
    """Equations whose gradient has the wrong sign, and such that end at a wall; both say where they began."""
    start = np.array([0.0, 0.0, 0.0, 1.0])

    def uphill(at: FloatArray) -> NormalEquations:
        true = _quadratic(np.eye(4), np.zeros(4), at)
        return NormalEquations(cost=true.cost, gradient=-true.gradient, hessian=true.hessian)

    def wall(at: FloatArray) -> NormalEquations | None:
        return _quadratic(np.eye(4), np.zeros(4), at) if (at == start).all() else None

    for equations in (uphill, wall):
        fit = descend(equations, start, 1.0, 1)
        assert not fit.converged
        np.testing.assert_array_equal(fit.parameters, start)
        assert fit.rms == 1.0
    nothing = descend(lambda at: None, start, 1.0, 1)
    assert not nothing.converged
    assert np.isnan(nothing.rms)


def test_a_sphere_is_found_from_a_poor_start_whatever_its_size() -> None:
    """Exact points, from a centre that is off by half a radius."""
    for radius in (1e-3, 1.0, 1e4):
        cloud = radius * (whole_sphere(200) + [3.0, -2.0, 1.0])
        fit = refine_sphere(cloud, radius * np.array([3.4, -2.2, 1.1]), 0.7 * radius)
        assert fit.converged
        np.testing.assert_allclose(fit.parameters, radius * np.array([3.0, -2.0, 1.0, 1.0]), rtol=1e-7)
        assert fit.rms < 1e-7 * radius


def test_many_points_are_fitted_in_two_passes_to_the_minimum_of_all() -> None:
    """Of the first half, every third and so on are others: the centre is that of all of them."""
    rng = np.random.default_rng(4)
    cloud = 20.0 * whole_sphere(45_000)[rng.permutation(45_000)] + rng.normal(size=(45_000, 3))
    fit = refine_sphere(cloud, np.array([3.0, 0.0, 0.0]), 17.0)
    away = np.linalg.norm(cloud - fit.parameters[:3], axis=1)
    assert fit.converged
    assert fit.parameters[3] == pytest.approx(away.mean(), rel=1e-9)
    assert fit.rms == pytest.approx(away.std(), rel=1e-9)


def test_the_smallest_of_a_pair_leaves_out_what_has_no_weight() -> None:
    """As scipy finds it where the weight is definite; a direction without weight is none, however small its square."""
    import scipy.linalg

    rng = np.random.default_rng(5)
    roots = rng.normal(size=(2, 4, 6))
    second, weight = (root @ root.T for root in roots)
    values, vectors = scipy.linalg.eigh(second, weight)
    found = smallest_generalised(second[None], weight[None])[0]
    np.testing.assert_allclose(found @ weight @ found, 1.0, rtol=1e-9)
    np.testing.assert_allclose(found @ second @ found, values[0], rtol=1e-9)
    np.testing.assert_allclose(np.abs(found), np.abs(vectors[:, 0]), rtol=1e-6)
    wider = np.zeros((2, 5, 5))
    wider[0, :4, :4], wider[1, :4, :4] = second, weight
    wider[0, 4, 4] = 1e-9 * values[0]
    np.testing.assert_allclose(np.abs(smallest_generalised(wider[:1], wider[1:])[0]), [*np.abs(found), 0.0], atol=1e-9)


@pytest.mark.parametrize(("across", "flat"), [(0.9e-5, True), (1.1e-5, False)])
def test_a_cloud_is_flat_below_a_hundred_thousandth(across: float, flat: bool) -> None:
    """Its extent across a plane over that along it, which is turned."""
    rng = np.random.default_rng(6)
    points = rng.normal(size=(500, 3))
    points -= points.mean(axis=0)
    points = points @ np.linalg.inv(np.linalg.cholesky(np.cov(points.T))).T * [1.0, 0.7, across]
    turned = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    assert is_flat(points @ turned.T + 3.0) == flat


@pytest.mark.parametrize(("ratio", "believed"), [(4.9, True), (5.1, False)])
def test_an_ellipsoid_five_times_as_long_as_thick_is_the_noise_about_a_plane(ratio: float, believed: bool) -> None:
    """Although it is exact to a thousandth and all halves agree."""
    pancake = Ellipsoid(centre=np.zeros(3), shape=np.diag([1.0, 1.0, ratio**2]) / 2500.0)
    rng = np.random.default_rng(7)
    cloud = on(pancake, rng.permutation(whole_sphere(3000))) + 1e-3 * rng.normal(size=(3000, 3))
    fit = fit_ellipsoid(cloud, fit_radius(cloud, unit="N", tolerance=TOLERANCE), tolerance=TOLERANCE)
    assert fit.identifiable == believed


@pytest.mark.parametrize(("longest", "is_beyond"), [(49.0, False), (51.0, True)])
def test_nothing_is_measured_at_five_times_the_extent(longest: float, is_beyond: bool) -> None:
    """The longest radius, in any direction, over the extent."""
    turned = np.linalg.qr(np.random.default_rng(8).normal(size=(3, 3)))[0]
    ellipsoid = Ellipsoid(centre=np.zeros(3), shape=turned @ np.diag([longest**-2.0, 0.01, 0.04]) @ turned.T)
    assert (beyond_measured_extent(ellipsoid, 10.0) is not None) == is_beyond


def test_margins_of_seven_numbers_at_once_are_those_of_bonferroni() -> None:
    """A probability of 5 % in all, two tails of seven numbers, by Student's t of nine degrees; half as wide again."""
    wanted = student.ppf(1.0 - 0.05 / 14.0, BLOCKS - 1) / student.ppf(0.975, BLOCKS - 1)
    assert _wider_together() == pytest.approx(wanted, rel=1e-9)
    assert wanted == pytest.approx(1.5, abs=0.1)
