# SPDX-License-Identifier: BSD-3-Clause
"""The lower leg of the thesis: its surface has no false holes, and its operators are exact."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.wrench import transform_wrench
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from tests.skin.contact_trials import leg_drawing, leg_layout
from tests.skin.outline import outline_wrench

pytestmark = pytest.mark.real_data
EXACT = 1e-12
"""Rounding of wrenches of some N, relative to their size."""


@pytest.fixture(scope="module", name="leg")
def right_leg_lower(data_dir: Path) -> SkinLayout:
    """Its 380 taxels, with rebuilt normals."""
    return leg_layout(data_dir)


def test_its_surface_is_one_piece_around_the_shin(leg: SkinLayout) -> None:
    """All taxels have neighbours, three to nine; areas are those of modules of 3 cm; it looks outwards."""
    surface = SkinPatch.of(leg).surface
    degrees = np.bincount(surface.edges.ravel())
    assert len(leg) == 380
    assert set(surface.triangles.ravel()) == set(range(len(leg)))
    assert degrees.min() >= 2
    assert degrees.max() <= 9
    assert ((surface.vertex_normals * leg.normals).sum(axis=1) > np.cos(np.radians(20.0))).all()
    areas = SkinPatch.of(leg).operator().areas
    assert 42e-6 < areas.mean() < 48e-6


@pytest.mark.parametrize("method", ["linear", "kriging"])
def test_uniform_pressure_gives_what_its_outline_says(leg: SkinLayout, method: str) -> None:
    """With and without dead taxels, of which there are 15 %."""
    patch = SkinPatch.of(leg, method)
    expected = outline_wrench(patch)
    for live in (np.ones(380, dtype=bool), np.random.default_rng(1).uniform(size=380) > 0.15):
        np.testing.assert_allclose(patch.operator(live).wrench(np.ones(380)), expected, atol=EXACT)


@pytest.mark.parametrize("method", ["linear", "kriging", "thesis", "simple"])
def test_a_rigid_move_moves_its_wrench(leg: SkinLayout, data_dir: Path, method: str) -> None:
    """To rounding, whatever the method."""
    base_R_link, base_p_link = rotation_from_rpy([-0.9, 0.4, 2.5]), np.array([0.1, 0.2, -0.4])
    moved = replace(leg, positions=leg.positions @ base_R_link.T + base_p_link, normals=leg.normals @ base_R_link.T)
    needs = {
        "thesis": {"plane": leg_drawing(data_dir, leg)},
        "simple": {"taxel_area_m2": 39e-6},
    }.get(method, {})
    pressures = np.random.default_rng(2).uniform(0.0, 5e4, 380)
    here, there = (
        SkinPatch.of(layout, method, **needs).operator().wrench(pressures)  # type: ignore[arg-type]
        for layout in (leg, moved)
    )
    expected = transform_wrench(make_pose(base_R_link, base_p_link), here)
    np.testing.assert_allclose(there, expected, atol=EXACT * np.linalg.norm(expected))
