# SPDX-License-Identifier: BSD-3-Clause
"""The three lengths that are called radius are told apart."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid, ellipsoid_of_map
from forcetorque.evaluation.sphere.model_free_fit import _intervals
from forcetorque.evaluation.sphere.resampling import Resampled
from tests.evaluation.sphere.clouds import DEFORMED, on, whole_sphere

ROUNDING = 1e-13
"""A few operations on numbers of order 1 to 100."""


def test_lengths_by_hand() -> None:
    """An ellipse with half axes 5 and 3 at 45 degrees: x meets it at 15 / sqrt(17) and it reaches to sqrt(17)."""
    turned = Rotation.from_euler("z", 45.0, degrees=True).as_matrix()
    shape = turned @ np.diag([1.0 / 25.0, 1.0 / 9.0, 1.0 / 4.0]) @ turned.T
    ellipsoid = Ellipsoid(centre=np.zeros(3), shape=shape)
    root = np.sqrt(17.0)
    np.testing.assert_allclose(ellipsoid.axis_intersections, [15.0 / root, 15.0 / root, 2.0], rtol=ROUNDING)
    np.testing.assert_allclose(ellipsoid.half_widths, [root, root, 2.0], rtol=ROUNDING)
    np.testing.assert_allclose(ellipsoid.principal_radii, [5.0, 3.0, 2.0], rtol=ROUNDING)
    np.testing.assert_allclose(np.abs(ellipsoid.principal_axes.T @ turned), np.eye(3), atol=ROUNDING)


def test_without_a_turn_all_three_are_one() -> None:
    """Along its own axes an ellipsoid has one radius per axis; the principal ones are sorted."""
    ellipsoid = Ellipsoid(centre=[1.0, 2.0, 3.0], shape=np.diag([0.25, 1.0, 1.0 / 9.0]))
    np.testing.assert_allclose(ellipsoid.axis_intersections, [2.0, 1.0, 3.0], rtol=ROUNDING)
    np.testing.assert_allclose(ellipsoid.half_widths, [2.0, 1.0, 3.0], rtol=ROUNDING)
    np.testing.assert_allclose(ellipsoid.principal_radii, [3.0, 2.0, 1.0], rtol=ROUNDING)


def test_intersections_lie_on_it_and_half_widths_bound_it() -> None:
    """The point at an intersection fulfils the equation; no point goes beyond a half-width, and one comes close."""
    for k, length in enumerate(DEFORMED.axis_intersections):
        away = length * np.eye(3)[k]
        assert away @ DEFORMED.shape @ away == pytest.approx(1.0, rel=ROUNDING)
    reached = (on(DEFORMED, whole_sphere(20_000)) - DEFORMED.centre).max(axis=0)
    assert (reached <= DEFORMED.half_widths * (1.0 + ROUNDING)).all()
    # 20 000 directions are some 1.4 degrees apart, which costs at most its square
    np.testing.assert_allclose(reached, DEFORMED.half_widths, rtol=1e-3)
    assert (DEFORMED.axis_intersections < DEFORMED.half_widths - 0.01).all()


def test_principal_radii_do_not_turn() -> None:
    """A rotation of the sensor changes intersections and widths, not the ellipsoid's own radii."""
    turned = Rotation.from_rotvec([0.4, -1.0, 0.7]).as_matrix()
    other = Ellipsoid(centre=DEFORMED.centre, shape=turned @ DEFORMED.shape @ turned.T)
    np.testing.assert_allclose(other.principal_radii, DEFORMED.principal_radii, rtol=1e-12)
    assert np.abs(other.axis_intersections - DEFORMED.axis_intersections).max() > 1.0


def test_a_map_makes_an_ellipsoid_of_a_sphere() -> None:
    """Images of points of the sphere lie on it; the radii are the singular values times the radius."""
    matrix = np.random.default_rng(1).normal(size=(3, 3))
    ellipsoid = ellipsoid_of_map(matrix, centre=[1.0, 2.0, 3.0], radius=7.0)
    away = 7.0 * whole_sphere(50) @ matrix.T
    np.testing.assert_allclose(np.einsum("ni,ij,nj->n", away, ellipsoid.shape, away), 1.0, rtol=1e-11)
    np.testing.assert_allclose(ellipsoid.principal_radii, 7.0 * np.linalg.svd(matrix, compute_uv=False), rtol=1e-11)


def test_open_and_flat_ones_are_refused() -> None:
    """A hyperboloid has no radii; the image under a singular map is a disc."""
    with pytest.raises(FitError, match="expected a positive definite shape"):
        Ellipsoid(centre=np.zeros(3), shape=np.diag([1.0, 1.0, -1.0]))
    with pytest.raises(FitError, match="expected a positive definite shape"):
        Ellipsoid(centre=np.zeros(3), shape=np.full((3, 3), np.nan))
    with pytest.raises(FitError, match="expected a map onto space"):
        ellipsoid_of_map(np.diag([1.0, 1.0, 0.0]), centre=np.zeros(3), radius=1.0)
    with pytest.raises(ShapeError, match=r"shape: expected an array of shape \(3, 3\)"):
        Ellipsoid(centre=np.zeros(3), shape=np.eye(2))


def _steady(*lengths: float) -> Resampled:
    """Lengths that no part of a recording changes."""
    inverse = 1.0 / np.array(lengths)
    return Resampled(whole=inverse, **dict.fromkeys(("without_one", "halves", "windows"), np.tile(inverse, (10, 1))))


@pytest.mark.parametrize(("middle", "least"), [(50.0, 0.0), (53.0, np.std([50.0, 53.0, 50.2], ddof=1))])
def test_intervals_of_lengths_and_index_span_the_methods(middle: float, least: float) -> None:
    """By hand from two methods and the geometric fit: an index may be zero where the three intersections may be equal.

    Half-widths are no intersections, however short they are.
    """
    direct = _steady(50.0, middle, 50.2, 30.0, 70.0, 60.0)
    weighted = _steady(50.5, middle + 0.3, 49.0, 30.0, 70.0, 61.0)
    geometric = 1.0 / np.array([50.2, middle, 49.5, 31.0, 69.0, 60.5])
    low, high, index_low, index_high = _intervals(direct, weighted, geometric, None)
    np.testing.assert_allclose(low, [50.0, middle, 49.0, 30.0, 69.0, 60.0], rtol=ROUNDING)
    np.testing.assert_allclose(high, [50.5, middle + 0.3, 50.2, 31.0, 70.0, 61.0], rtol=ROUNDING)
    assert index_low == pytest.approx(least)
    assert index_high == pytest.approx(np.std([50.5, middle + 0.3, 49.0], ddof=1))
    # half-widths that are longer than any intersection change nothing either
    longer = [_steady(*(1.0 / fit.whole[:3]), 90.0, 90.0, 90.0) for fit in (direct, weighted)]
    assert _intervals(*longer, geometric, None)[2] == pytest.approx(least)
