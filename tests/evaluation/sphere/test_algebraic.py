# SPDX-License-Identifier: BSD-3-Clause
"""Algebraic fits against implementations from the literature on the points themselves, and exact cases."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from forcetorque.evaluation.sphere.algebraic_fit import (
    Quadrics,
    direct_fit,
    gradient_weighted_fit,
    gradient_weighted_spheres,
    inverse_lengths,
    least_squares_spheres,
)
from forcetorque.evaluation.sphere.cloud import QuadricMoments
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid
from forcetorque.evaluation.sphere.resampling import whole
from tests.evaluation.sphere.clouds import DEFORMED, grid, on, whole_sphere

AGREEMENT = 1e-7
"""Between eigenproblems of ten monomials: rounding times the condition of clouds of this kind."""
FITS = {"direct": direct_fit, "gradient-weighted": gradient_weighted_fit}


def _fit(name: str, cloud: np.ndarray) -> Quadrics:
    moments = QuadricMoments.of(cloud)
    return FITS[name](whole(moments.sums), moments)


def _clouds() -> dict[str, np.ndarray]:
    rng = np.random.default_rng(3)
    return {
        "whole, noise 2 %": on(DEFORMED, whole_sphere(700)) + rng.normal(size=(700, 3)),
        "grid of 60 degrees, noise 0.4 %": on(DEFORMED, grid(900, 60.0)) + 0.2 * rng.normal(size=(900, 3)),
        "grid of 40 degrees, noise 2 %": on(DEFORMED, grid(900, 40.0)) + rng.normal(size=(900, 3)),
    }


CLOUDS = _clouds()


def _design(cloud: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Points moved and scaled as the fits hold them, since neither method is free of the choice of units."""
    shift = cloud.mean(axis=0)
    scale = np.sqrt(((cloud - shift) ** 2).sum(axis=1).mean())
    return (cloud - shift) / scale, shift, float(scale)


def _quadric(v: np.ndarray, shift: np.ndarray, scale: float) -> tuple[np.ndarray, np.ndarray]:
    """Centre and shape of v0 x2 + v1 y2 + v2 z2 + 2 v3 yz + 2 v4 xz + 2 v5 xy + 2 v6 x + 2 v7 y + 2 v8 z + v9."""
    a = np.array([[v[0], v[5], v[4]], [v[5], v[1], v[3]], [v[4], v[3], v[2]]])
    centre = np.linalg.solve(a, -v[6:9])
    return shift + scale * centre, a / (centre @ a @ centre - v[9]) / scale**2


TRIED = (1000.0, 100.0, 30.0, 10.0, 6.0, 4.0)
"""Values of k of the direct fit; 4 gives ellipsoids only."""


def _li_griffiths(cloud: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Li and Griffiths (2004), with the largest k that gives an ellipsoid."""
    fits = (_with_k(cloud, k) for k in TRIED)
    return next((centre, shape) for centre, shape in fits if np.linalg.eigvalsh(shape)[0] > 0.0)


def _with_k(cloud: np.ndarray, k: float) -> tuple[np.ndarray, np.ndarray]:
    """Equations 5 to 15, on the design matrix."""
    x, shift, scale = _design(cloud)
    design = np.column_stack(
        [x**2, 2 * x[:, 1] * x[:, 2], 2 * x[:, 0] * x[:, 2], 2 * x[:, 0] * x[:, 1], 2 * x, np.ones(len(x))]
    )
    scatter = design.T @ design
    c1 = np.full((3, 3), k / 2 - 1) - k / 2 * np.eye(3)
    constraint = scipy.linalg.block_diag(c1, -k * np.eye(3), np.zeros((4, 4)))
    # S v = lambda C v, turned over because C is singular and S is not
    mu, vectors = scipy.linalg.eig(constraint, scatter)
    return _quadric(vectors[:, np.argmax(mu.real)].real, shift, scale)


def _taubin(cloud: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Taubin (1991), equation 19, with gradients taken point by point."""
    x, shift, scale = _design(cloud)
    zero, one = np.zeros(len(x)), np.ones(len(x))
    a, b, c = x.T
    design = np.column_stack([a * a, b * b, c * c, 2 * b * c, 2 * a * c, 2 * a * b, 2 * a, 2 * b, 2 * c, one])
    along = (
        np.column_stack([2 * a, zero, zero, zero, 2 * c, 2 * b, 2 * one, zero, zero, zero]),
        np.column_stack([zero, 2 * b, zero, 2 * c, zero, 2 * a, zero, 2 * one, zero, zero]),
        np.column_stack([zero, zero, 2 * c, 2 * b, 2 * a, zero, zero, zero, 2 * one, zero]),
    )
    gradients = sum(part.T @ part for part in along)
    mu, vectors = scipy.linalg.eigh(gradients, design.T @ design)
    return _quadric(vectors[:, np.argmax(mu)], shift, scale)


@pytest.mark.parametrize("cloud", CLOUDS)
@pytest.mark.parametrize(("name", "oracle"), [("direct", _li_griffiths), ("gradient-weighted", _taubin)])
def test_fits_agree_with_the_literature(name: str, oracle: object, cloud: str) -> None:
    """From moments as from the design matrix of all points, with noise and on parts of the ellipsoid."""
    centre, shape = oracle(CLOUDS[cloud])  # type: ignore[operator]
    ours = _fit(name, CLOUDS[cloud])
    size = np.sqrt(np.abs(np.diag(shape)))
    np.testing.assert_allclose(ours.shape[0] / size / size[:, None], shape / size / size[:, None], atol=AGREEMENT)
    np.testing.assert_allclose(ours.centre[0], centre, atol=AGREEMENT / size.min())


@pytest.mark.parametrize(
    ("across", "size", "k"),
    [(-0.05, 7.0, 100), (-0.05, 8.0, 30), (-0.05, 9.0, 10), (-0.05, 12.0, 6), (-0.2, 12.0, 4)],
)
def test_the_largest_k_that_gives_an_ellipsoid_is_taken(across: float, size: float, k: int) -> None:
    """Of noisy saddles, which need another one each, by the literature; the next larger one gives no ellipsoid."""
    rng = np.random.default_rng(5)
    x, y = rng.uniform(-10.0, 10.0, size=(2, 500))
    cloud = np.column_stack([x, y, (x**2 + across * y**2) / size + 0.3 * rng.normal(size=500)])
    centre, shape = _li_griffiths(cloud)
    ours = _fit("direct", cloud)
    np.testing.assert_allclose(ours.centre[0], centre, atol=AGREEMENT * np.linalg.norm(centre))
    np.testing.assert_allclose(ours.shape[0], shape, atol=AGREEMENT * np.abs(shape).max())
    smallest = [np.linalg.eigvalsh(_with_k(cloud, one)[1])[0] for one in TRIED]
    assert [one for one, value in zip(TRIED, smallest, strict=True) if value > 0.0][0] == k


def test_the_two_methods_are_told_apart() -> None:
    """Negative control: on noise the oracles differ from each other by far more than the fits from them."""
    for cloud in CLOUDS.values():
        direct, weighted = _li_griffiths(cloud)[1], _taubin(cloud)[1]
        assert np.abs(direct / weighted - 1.0).max() > 1e3 * AGREEMENT


@pytest.mark.parametrize("name", FITS)
@pytest.mark.parametrize("directions", [whole_sphere(40), grid(300, 50.0), grid(300, 15.0)])
def test_exact_ellipsoids_are_found(name: str, directions: np.ndarray) -> None:
    """Without noise any part of an ellipsoid that is no plane determines it."""
    found = _fit(name, on(DEFORMED, directions))
    # the smaller the cap, the more nearly its monomials depend on each other
    assert found.closed.all()
    np.testing.assert_allclose(1.0 / found.inverse_lengths[0, :3], DEFORMED.axis_intersections, rtol=1e-5)
    np.testing.assert_allclose(found.centre[0], DEFORMED.centre, atol=1e-5 * np.abs(DEFORMED.centre).max())


@given(
    turn=st.tuples(*[st.floats(-3.0, 3.0)] * 3),
    step=st.tuples(*[st.floats(-500.0, 500.0)] * 3),
    factor=st.floats(0.01, 100.0),
    name=st.sampled_from(sorted(FITS)),
    cloud=st.sampled_from(sorted(CLOUDS)),
)
def test_fits_follow_rotation_translation_and_units(
    turn: tuple[float, ...], step: tuple[float, ...], factor: float, name: str, cloud: str
) -> None:
    """Where the axes and the zero are, and what the unit is, makes no difference."""
    turned = Rotation.from_rotvec(turn).as_matrix()
    plain = _fit(name, CLOUDS[cloud])
    moved = _fit(name, factor * (CLOUDS[cloud] @ turned.T + step))
    size = np.abs(plain.shape).max()
    back = factor**2 * turned.T @ moved.shape[0] @ turned
    # an offset of 500 N costs the cloud of 50 N a digit or two
    np.testing.assert_allclose(back / size, plain.shape[0] / size, atol=1e-6)
    np.testing.assert_allclose((moved.centre[0] / factor - step) @ turned, plain.centre[0], atol=1e-4)


def test_the_direct_fit_gives_an_ellipsoid_of_anything() -> None:
    """Of a saddle too, which the gradient-weighted fit sees for what it is."""
    rng = np.random.default_rng(5)
    x, y = rng.uniform(-10.0, 10.0, size=(2, 500))
    saddle = np.column_stack([x, y, 0.02 * (x**2 - y**2)])
    assert _fit("direct", saddle).closed.all()
    assert not _fit("gradient-weighted", saddle).closed.any()
    assert (_fit("gradient-weighted", saddle).inverse_lengths == 0.0).all()


def test_many_are_fitted_as_one_by_one() -> None:
    """A batch of clouds gives what each gives alone."""
    moments = QuadricMoments.of(CLOUDS["grid of 60 degrees, noise 0.4 %"])
    means = moments.sums / moments.sums[:, 9:, 9:]
    for fit in FITS.values():
        together = fit(means, moments)
        for k in range(len(means)):
            alone = fit(means[k : k + 1], moments)
            np.testing.assert_allclose(together.shape[k], alone.shape[0], rtol=1e-9, atol=1e-15)


def test_an_elongated_ellipsoid_is_not_rounded() -> None:
    """One five times as long as wide: with k = 4 alone it would come out rounder."""
    long = Ellipsoid(centre=np.zeros(3), shape=np.diag([1.0 / 2500.0, 1.0 / 100.0, 1.0 / 100.0]))
    rng = np.random.default_rng(6)
    cloud = on(long, whole_sphere(2000)) + 0.1 * rng.normal(size=(2000, 3))
    np.testing.assert_allclose(1.0 / _fit("direct", cloud).inverse_lengths[0, :3], [50.0, 10.0, 10.0], rtol=0.01)


def test_lengths_of_an_ellipsoid_are_those_of_the_map_of_the_unit_sphere() -> None:
    """Half-widths are norms of rows of the map, intersections of an axis those of columns of its inverse, inverted."""
    maps = np.random.default_rng(5).normal(size=(4, 3, 3)) + 2.0 * np.eye(3)
    lengths = inverse_lengths(maps @ maps.transpose(0, 2, 1))
    intersections = np.linalg.norm(np.linalg.inv(maps), axis=1)
    half_widths = np.linalg.norm(maps, axis=2)
    np.testing.assert_allclose(lengths, np.hstack([intersections, 1.0 / half_widths]), rtol=1e-10)


@pytest.mark.parametrize("fit", [*FITS.values(), least_squares_spheres, gradient_weighted_spheres])
def test_a_part_of_a_cloud_is_fitted_about_any_middle(fit: object) -> None:
    """The first half, whose middle is far from that of the whole, by moments about the whole and about its own."""
    directions = whole_sphere(700)
    ordered = directions[np.argsort(directions @ [1.0, 2.0, -1.0])]
    cloud = on(DEFORMED, ordered) + np.random.default_rng(5).normal(size=(700, 3))
    moments, own = QuadricMoments.of(cloud), QuadricMoments.of(cloud[:350])
    found = fit(whole(moments.sums[: len(moments.sums) // 2]), moments)  # type: ignore[operator]
    alone = fit(whole(own.sums), own)  # type: ignore[operator]
    np.testing.assert_allclose(found.centre, alone.centre, rtol=AGREEMENT)
    form, same = (one.shape if isinstance(one, Quadrics) else one.bend for one in (found, alone))
    np.testing.assert_allclose(form, same, rtol=0.0, atol=AGREEMENT * np.abs(same).max())
    assert np.abs(same).max() > 0.0
    # negative control: the other half has another middle
    other = fit(whole(moments.sums[len(moments.sums) // 2 :]), moments)  # type: ignore[operator]
    assert np.abs(other.centre - alone.centre).max() > 0.01
