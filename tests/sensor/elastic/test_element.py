# SPDX-License-Identifier: BSD-3-Clause
"""Y- and cross-shaped elements: equilibrium, symmetry, by hand, and what a wrong place of the gauges costs."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.base.pose import make_pose, rotation_about_z
from forcetorque.base.wrench import wrench_matrix
from forcetorque.sensor.elastic_element import (
    Beam,
    Bending,
    ElasticElement,
    GaugePlace,
    Material,
    RectangularSection,
)

MATERIAL = Material.from_poisson_ratio(200e9, 0.3)
SECTION = RectangularSection(width=0.004, height=0.005)
BEAM = Beam(length=0.012, section=SECTION, material=MATERIAL)
HUB = 0.006
PLACE = 0.001

ROUNDING = 1e-11
"""Relative rounding of the inverse of the stiffness, whose condition number in N and N m is about 1e4."""


def _spokes(beam: Beam, position: float, arms: int, hub_radius: float = HUB) -> ElasticElement:
    """Arms at even angles, with gauges for both directions of bending in one section of each."""
    places = tuple(
        GaugePlace(arm=arm, position=position, bending=bending) for arm in range(arms) for bending in Bending
    )
    angles = 2 * np.pi * np.arange(arms) / arms
    return ElasticElement(beam=beam, hub_radius=hub_radius, arm_angles=angles, places=places)


def _bending_strain(moment: float, section: RectangularSection) -> float:
    """Strain on the upper face of a beam that a moment bends in its x-z plane, `M z / (E I)`."""
    return moment * 0.5 * section.height / (MATERIAL.young_modulus * section.second_moment_y)


Y = _spokes(BEAM, PLACE, 3)
CROSS = _spokes(BEAM, PLACE, 4)
BOTH = pytest.mark.parametrize("element", [Y, CROSS], ids=["y", "cross"])


def _hub_X_end(angle: float) -> np.ndarray:
    return wrench_matrix(
        make_pose(rotation_about_z(np.array(angle)), HUB * np.array([np.cos(angle), np.sin(angle), 0]))
    )


@BOTH
def test_arms_together_carry_the_load(element: ElasticElement) -> None:
    """The wrenches on all arms, brought to the middle of the hub, add up to the load."""
    total = sum(_hub_X_end(a) @ w for a, w in zip(element.arm_angles, element.arm_wrenches(), strict=True))
    np.testing.assert_allclose(total, np.eye(6), rtol=0, atol=ROUNDING)


@BOTH
def test_stiffness_is_symmetric_and_resists_every_load(element: ElasticElement) -> None:
    """Work does not depend on the order of loads, and every displacement costs some."""
    stiffness = element.stiffness()
    np.testing.assert_allclose(stiffness, stiffness.T, rtol=0, atol=ROUNDING * np.abs(stiffness).max())
    assert np.linalg.eigvalsh(stiffness).min() > 0.0


@pytest.mark.parametrize(("element", "arms"), [(Y, 3), (CROSS, 4)], ids=["y", "cross"])
def test_turning_the_load_by_one_arm_moves_the_channels_by_one_arm(element: ElasticElement, arms: int) -> None:
    """The element looks the same after a turn from arm to arm, so channels trade places."""
    turn = wrench_matrix(make_pose(rotation_about_z(np.array(2 * np.pi / arms)), np.zeros(3)))
    matrix = element.strain_matrix()
    turned = np.roll(matrix @ turn, -2, axis=0)  # two channels per arm
    np.testing.assert_allclose(turned, matrix, rtol=0, atol=ROUNDING * np.abs(matrix).max())
    assert np.abs(np.roll(matrix @ turn, 2, axis=0) - matrix).max() > 0.1 * np.abs(matrix).max()  # the wrong way


def test_a_force_along_z_by_hand() -> None:
    """Each arm of three carries a third as a guided beam: moment F (l / 2 - s) at a gauge."""
    expected = _bending_strain(1.0 / 3.0 * (BEAM.length / 2 - PLACE), SECTION)
    np.testing.assert_allclose(Y.strain_matrix()[1::2, 2], expected, rtol=ROUNDING)
    np.testing.assert_allclose(Y.strain_matrix()[::2, 2], 0.0, atol=ROUNDING * expected)


def test_a_moment_about_z_by_hand() -> None:
    """A turn about z moves each arm's end by r and turns it by 1; force and couple are those of the clamped beam."""
    l, r = BEAM.length, HUB  # noqa: E741
    force = 12.0 * r / l**3 + 6.0 / l**2  # per E I and rad
    couple = 6.0 * r / l**2 + 4.0 / l
    share = (couple - PLACE * force) / (3.0 * (couple + r * force))
    on_its_side = RectangularSection(width=SECTION.height, height=SECTION.width)  # bent along y, not z
    expected = _bending_strain(share, on_its_side)
    np.testing.assert_allclose(Y.strain_matrix()[::2, 5], expected, rtol=ROUNDING)
    np.testing.assert_allclose(Y.strain_matrix()[1::2, 5], 0.0, atol=ROUNDING * expected)


def test_a_pull_along_one_arm_bends_the_others_only() -> None:
    """The arm along x is stretched, which a bending pair does not see; its neighbours bend oppositely."""
    column = Y.strain_matrix()[:, 0]
    size = np.abs(column).max()
    assert column[4] == pytest.approx(-column[2], rel=ROUNDING)
    np.testing.assert_allclose(column[[0, 1, 3, 5]], 0.0, atol=ROUNDING * size)
    assert column[4] > 0.0  # the arm at 240 degrees is pushed along its own y


@BOTH
def test_six_axes_can_be_told_apart(element: ElasticElement) -> None:
    """The strain matrix has full rank, with moments as forces at the radius of the hub."""
    scaled = element.strain_matrix() * [1, 1, 1, HUB, HUB, HUB]
    assert scaled.shape == (len(element.places), 6)
    assert np.linalg.cond(scaled) < 20.0


def test_gauges_at_half_length_do_not_see_a_guided_force() -> None:
    """Half-way along a guided arm the bending changes its sign: a force along z is lost there."""
    halfway = _spokes(BEAM, BEAM.length / 2, 3).strain_matrix()
    assert np.abs(halfway[:, 2]).max() < ROUNDING * np.abs(halfway).max()
    beyond = _spokes(BEAM, BEAM.length - PLACE, 3).strain_matrix()
    np.testing.assert_allclose(beyond[1::2, 2], -Y.strain_matrix()[1::2, 2], rtol=ROUNDING)


def test_a_stiffer_material_strains_less() -> None:
    """Strain goes with one over the moduli."""
    stiff = dataclasses.replace(BEAM, material=Material.from_poisson_ratio(600e9, 0.3))
    third = _spokes(stiff, PLACE, 3).strain_matrix()
    np.testing.assert_allclose(3.0 * third, Y.strain_matrix(), rtol=ROUNDING, atol=ROUNDING * 1e-6)


@pytest.mark.parametrize("arms", [3, 4])
def test_a_larger_element_strains_less(arms: int) -> None:
    """Twice the size: a quarter of the strain per force, an eighth per moment."""
    large = Beam(length=0.024, section=RectangularSection(width=0.008, height=0.010), material=MATERIAL)
    big = _spokes(large, 2 * PLACE, arms, 2 * HUB).strain_matrix()
    small = _spokes(BEAM, PLACE, arms).strain_matrix()
    np.testing.assert_allclose(big * [4, 4, 4, 8, 8, 8], small, rtol=0, atol=ROUNDING * np.abs(small).max())


def test_a_rigid_gauge_place_is_refused_with_what_exists() -> None:
    """Gauges must be on an arm that is there, between hub and rim; the hub has a radius, the element arms."""
    place = GaugePlace(arm=3, position=0.001, bending=Bending.IN_PLANE)
    with pytest.raises(SensorError, match=r"arms 0 to 2, 0 to 0\.012 m from the hub; got arm 3"):
        dataclasses.replace(Y, places=(place,))
    with pytest.raises(SensorError, match=r"got arm 0, 0\.02 m"):
        _spokes(BEAM, 0.02, 3)
    with pytest.raises(SensorError, match="hub_radius"):
        _spokes(BEAM, PLACE, 3, 0.0)
    with pytest.raises(SensorError, match="at least one arm"):
        dataclasses.replace(Y, arm_angles=np.zeros(0), places=())
