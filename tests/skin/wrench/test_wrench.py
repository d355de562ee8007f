# SPDX-License-Identifier: BSD-3-Clause
"""Operators from pressures to wrenches: exact where mathematics says what must come out, and linear."""

from __future__ import annotations

from dataclasses import replace
from math import factorial
from typing import Final

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.special import gamma, kv

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError, SkinError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.wrench import transform_wrench
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.wrench.curved_elements import POINTS, WEIGHTS
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from forcetorque.skin.wrench.pressure_to_wrench import (
    LENGTH_M,
    PredictedPressures,
    WrenchMethod,
    kriging_shares,
)
from tests.scenes.patches import cylinder_patch, ellipsoid_patch
from tests.skin.layout.skins import plane_layout
from tests.skin.outline import outline_wrench

EXACT: Final = 1e-12
"""Of wrenches of some N and N m per Pa m²: rounding, summed over thousands of points."""
AREA_M2: Final = 39e-6
CYLINDER: Final = cylinder_patch(across=7, along=4).layout()
ELLIPSOID: Final = ellipsoid_patch().layout()
ON_SURFACE: Final = (WrenchMethod.LINEAR, WrenchMethod.KRIGING)


def patch_of(layout: SkinLayout, method: WrenchMethod) -> SkinPatch:
    """The patch, with what the method needs; its drawing is the cylinder unrolled."""
    if method is WrenchMethod.SIMPLE:
        return SkinPatch.of(layout, method, taxel_area_m2=AREA_M2)
    return SkinPatch.of(layout, method, plane=_unrolled() if method is WrenchMethod.THESIS else None)


def _unrolled() -> FloatArray:
    x, y, z = CYLINDER.positions.T
    return np.stack([np.hypot(x, y).mean() * np.arctan2(y, x), z], axis=1)


@pytest.mark.parametrize("layout", [CYLINDER, ELLIPSOID], ids=["cylinder", "ellipsoid"])
@pytest.mark.parametrize("method", ON_SURFACE)
def test_uniform_pressure_gives_what_the_outline_says(layout: SkinLayout, method: WrenchMethod) -> None:
    """The force is -1/2 sum of r_i x r_j, the moment 1/2 integral of |r|^2 dr around it, whatever is between."""
    patch = patch_of(layout, method)
    wrench = patch.operator().wrench(np.ones(len(layout)))
    np.testing.assert_allclose(wrench, outline_wrench(patch), atol=EXACT)


def test_pressure_from_inside_is_noticed() -> None:
    """Negative control: with the sign of the reaction the outline says something else."""
    patch = patch_of(CYLINDER, WrenchMethod.LINEAR)
    wrench = patch.operator().wrench(np.ones(len(CYLINDER)))
    assert not np.allclose(-wrench, outline_wrench(patch), atol=1e3 * EXACT)


@pytest.mark.parametrize("method", WrenchMethod)
def test_a_rigid_move_moves_the_wrench(method: WrenchMethod) -> None:
    """The same pressures on a turned and displaced layout: the wrench is that of the moved frame."""
    base_R_link, base_p_link = rotation_from_rpy([0.4, -0.7, 2.1]), np.array([0.3, -0.2, 0.5])
    moved = replace(
        CYLINDER,
        positions=CYLINDER.positions @ base_R_link.T + base_p_link,
        normals=CYLINDER.normals @ base_R_link.T,
    )
    pressures = np.random.default_rng(1).uniform(0.0, 1e3, len(CYLINDER))
    wrench = patch_of(CYLINDER, method).operator().wrench(pressures)
    expected = transform_wrench(make_pose(base_R_link, base_p_link), wrench)
    got = patch_of(moved, method).operator().wrench(pressures)
    np.testing.assert_allclose(got, expected, atol=EXACT * np.linalg.norm(expected))
    assert not np.allclose(got, wrench, rtol=1e-3)  # negative control: it did move


@pytest.mark.parametrize("method", WrenchMethod)
def test_wrenches_are_linear_in_pressure(method: WrenchMethod) -> None:
    """Of sums and multiples, and of batches."""
    operator = patch_of(CYLINDER, method).operator()
    first, second = np.random.default_rng(2).uniform(0.0, 1e3, (2, len(CYLINDER)))
    both = operator.wrench(np.stack([first, second, 2.0 * first - 3.0 * second]))
    np.testing.assert_allclose(both[2], 2.0 * both[0] - 3.0 * both[1], rtol=1e-10)
    np.testing.assert_allclose(operator.wrench(first), both[0], rtol=1e-10)


def test_the_environment_pushes_inwards() -> None:
    """On a plane patch that looks up: down, by pressure times area; both magnitudes are one there, (3.27)."""
    layout = plane_layout()
    for method in ON_SURFACE:
        operator = SkinPatch.of(layout, method).operator()
        wrench = operator.wrench(np.full(len(layout), 100.0))
        np.testing.assert_allclose(wrench[:3], [0.0, 0.0, -100.0 * operator.areas.sum()], atol=EXACT)
        np.testing.assert_allclose(operator.normal_force(np.full(len(layout), 100.0)), -wrench[2], rtol=1e-12)


def test_on_a_bent_patch_the_two_magnitudes_differ() -> None:
    """Over a quarter of a cylinder forces on both sides cancel in (7.4), and not in (7.12)."""
    operator = patch_of(CYLINDER, WrenchMethod.LINEAR).operator()
    pressures = np.full(len(CYLINDER), 1e3)
    assert operator.normal_force(pressures) > 1.1 * np.linalg.norm(operator.wrench(pressures)[:3])


def test_the_area_is_that_of_the_cylinder() -> None:
    """Modules of 32.5 mm tile it: taxels stand for a tenth of a triangle each, but for what the strip leaves out."""
    areas = patch_of(CYLINDER, WrenchMethod.LINEAR).operator().areas
    tile = np.sqrt(3.0) / 4.0 * 0.0325**2 / 10.0
    assert 0.9 * tile < areas.mean() < 1.02 * tile
    assert (areas > 0.0).all()


@pytest.mark.parametrize("method", ON_SURFACE)
def test_without_dead_taxels_uniform_pressure_is_still_exact(method: WrenchMethod) -> None:
    """Live taxels around tell what dead ones do not; the operator of the dead mask is another, and kept."""
    patch = patch_of(CYLINDER, method)
    live = np.random.default_rng(3).uniform(size=len(CYLINDER)) > 0.2
    operator = patch.operator(live)
    pressures = np.where(live, 1.0, np.nan)
    np.testing.assert_allclose(operator.wrench(np.nan_to_num(pressures)), outline_wrench(patch), atol=EXACT)
    assert not operator.weights[:, ~live].any()
    assert patch.operator(live.copy()) is operator
    assert patch.operator() is not operator
    # negative control: the old operator with zeros where taxels are dead loses their force
    lost = patch.operator().wrench(np.where(live, 1.0, 0.0))
    assert np.linalg.norm(lost[:3]) < 0.9 * np.linalg.norm(outline_wrench(patch)[:3])


def test_kept_operators_do_not_pile_up() -> None:
    """A mask that flickers for an hour must not fill the memory."""
    patch = patch_of(CYLINDER, WrenchMethod.SIMPLE)
    rng = np.random.default_rng(4)
    for _ in range(40):
        patch.operator(rng.uniform(size=len(CYLINDER)) > 0.5)
    assert patch._operator_by_mask.cache_info().currsize == 16


def test_the_simple_sum_is_the_stated_one() -> None:
    """(7.13): area times pressures times normals."""
    pressures = np.random.default_rng(5).uniform(0.0, 1e3, len(CYLINDER))
    wrench = patch_of(CYLINDER, WrenchMethod.SIMPLE).operator().wrench(pressures)
    forces = -AREA_M2 * pressures[:, None] * CYLINDER.normals
    moments = np.cross(CYLINDER.positions, forces)
    np.testing.assert_allclose(wrench, np.concatenate([forces.sum(axis=0), moments.sum(axis=0)]), atol=EXACT)


def test_the_thesis_counts_holes_and_no_edge() -> None:
    """On a plane lattice without holes: the hull of the discs; with a hole of modules in the middle the same."""
    layout = plane_layout()
    plane = layout.positions[:, :2]
    whole = SkinPatch.of(layout, "thesis", plane=plane).operator()
    live = np.linalg.norm(plane - plane.mean(axis=0), axis=1) > 0.012
    holed = SkinPatch.of(layout, "thesis", plane=plane).operator(live)
    np.testing.assert_allclose(holed.areas.sum(), whole.areas.sum(), rtol=1e-9)
    turns = np.pi / 4.0 * np.arange(8)
    discs = plane[:, None] + 0.0022 * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    np.testing.assert_allclose(whole.areas.sum(), ConvexHull(discs.reshape(-1, 2)).volume, rtol=1e-9)
    assert whole.areas.sum() < SkinPatch.of(layout).operator().areas.sum()


def test_the_thesis_presses_each_taxel_at_its_place() -> None:
    """On a plane patch drawn as it is, away from its edge: within 3 % of the pitch, since a lattice has many meshes."""
    layout = plane_layout()
    plane = layout.positions[:, :2]
    weights = SkinPatch.of(layout, WrenchMethod.THESIS, plane=plane).operator().weights
    pressed_at = np.stack([-weights[4], weights[3]], axis=1) / weights[2, :, None]
    inner = np.linalg.norm(plane - plane.mean(axis=0), axis=1) < 0.02
    assert inner.sum() > 20
    np.testing.assert_allclose(pressed_at[inner], plane[inner], atol=0.03 * 0.0065)


@pytest.mark.parametrize("method", ON_SURFACE)
def test_a_smooth_field_is_told_to_a_thousandth(method: WrenchMethod) -> None:
    """A hill of pressure over thirty taxels of a plane lattice; its integral is known."""
    layout = plane_layout(rows=24, columns=24)
    centre, width = layout.positions.mean(axis=0), 0.012
    distance = np.linalg.norm(layout.positions - centre, axis=1)
    pressures = 1e4 * np.exp(-0.5 * (distance / width) ** 2)
    wrench = SkinPatch.of(layout, method).operator().wrench(pressures)
    force = 1e4 * 2.0 * np.pi * width**2
    np.testing.assert_allclose(wrench[2], -force, rtol=2e-3)
    np.testing.assert_allclose(wrench[3:], np.cross(centre, [0.0, 0.0, -force]), atol=2e-3 * force * 0.1)


@pytest.mark.parametrize("powers", [(0, 0, 0), (1, 0, 0), (1, 2, 0), (0, 3, 1), (4, 0, 0), (1, 1, 2), (0, 2, 2)])
def test_six_points_integrate_polynomials_of_fourth_degree(powers: tuple[int, int, int]) -> None:
    """Over a triangle the mean of products of barycentric coordinates is `2 i! j! k! / (i + j + k + 2)!`."""
    exact = 2.0 * np.prod([factorial(power) for power in powers]) / factorial(sum(powers) + 2)
    np.testing.assert_allclose(WEIGHTS @ (POINTS**powers).prod(axis=1), exact, rtol=EXACT)
    # negative control: they are not exact beyond
    assert abs(WEIGHTS @ POINTS[:, 0] ** 6 - 2.0 / 56.0) > 1e-4 / 56.0


def _correlation(distance: float) -> float:
    """Matern's correlation of smoothness 5/2 by its definition, with a modified Bessel function."""
    scaled = np.sqrt(5.0) * distance / LENGTH_M
    return float(2.0 ** (1.0 - 2.5) / gamma(2.5) * scaled**2.5 * kv(2.5, scaled))


def test_two_taxels_share_a_point_as_kriging_with_an_unknown_mean_says() -> None:
    """Half each, and what they differ in correlation with the point, over twice what they lack of one between them."""
    first, second = np.array([0.0, 0.0, 0.0]), np.array([0.006, 0.002, 0.0])
    points = np.array([[0.001, 0.001, 0.0], [0.004, -0.003, 0.001], [0.02, 0.01, 0.0]])
    apart = 1.0 - _correlation(float(np.linalg.norm(second - first)))
    assert 0.1 < apart < 0.9
    expected = []
    for point in points:
        near, far = (_correlation(float(np.linalg.norm(point - taxel))) for taxel in (first, second))
        share = 0.5 + (near - far) / (2.0 * apart)
        expected.append([share, 1.0 - share])
    shares = kriging_shares(np.array([[first, second]]), points[None])
    np.testing.assert_allclose(shares[0], expected, atol=EXACT)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"method": "simple"}, "taxel_area_m2: expected a value for the method simple, got none"),
        ({"method": "simple", "taxel_area_m2": 0.0}, "area of a taxel above 0"),
        ({"method": "thesis"}, "plane: expected a value for the method thesis, got none"),
        ({"method": "kriging", "taxel_area_m2": 1e-5}, "taxel_area_m2: expected none for the method kriging, got one"),
        ({"method": "thesis", "plane": np.zeros((len(CYLINDER), 2))}, "that lie on a line"),
    ],
)
def test_what_a_method_lacks_is_said(arguments: dict[str, object], message: str) -> None:
    """Methods are given what they need and nothing that they do not use."""
    with pytest.raises(SkinError, match=message):
        SkinPatch.of(CYLINDER, **arguments).operator()  # type: ignore[arg-type]


def test_masks_must_fit_the_patch() -> None:
    """A mask of another patch, or one without a live taxel."""
    patch = patch_of(CYLINDER, WrenchMethod.LINEAR)
    with pytest.raises(ShapeError, match="live"):
        patch.operator(np.ones(3, dtype=bool))
    with pytest.raises(SkinError, match="expected a taxel that can be trusted, got none"):
        patch.operator(np.zeros(len(CYLINDER), dtype=bool))
    with pytest.raises(ShapeError, match="pressures"):
        patch.operator().wrench(np.ones(3))


@pytest.mark.parametrize("number", [2, 6, 25, 40])
def test_a_taxel_is_predicted_from_its_nearest_live_neighbours(number: int) -> None:
    """From 24, or from all others of fewer; never from itself; of one pressure everywhere nothing is left."""
    surface = SkinPatch.of(CYLINDER).surface
    live = np.zeros(len(CYLINDER), dtype=np.bool_)
    live[np.random.default_rng(81).choice(len(live), number, replace=False)] = True
    predicted = PredictedPressures.of(surface, live)
    known, count = np.flatnonzero(live), min(24, number - 1)
    assert predicted.neighbours.shape == (len(CYLINDER), count)
    for taxel, neighbours in enumerate(predicted.neighbours):
        others = known[known != taxel]
        far = np.linalg.norm(surface.positions[others] - surface.positions[taxel], axis=1)
        assert set(neighbours) <= set(others)
        assert len(set(neighbours)) == count
        at = np.linalg.norm(surface.positions[neighbours] - surface.positions[taxel], axis=1)
        np.testing.assert_allclose(np.sort(at), np.sort(far)[:count], atol=1e-8)
    left = predicted.residual(np.full(len(CYLINDER), 3e3), np.arange(len(CYLINDER)))
    np.testing.assert_allclose(left, 0.0, atol=1e-6)
