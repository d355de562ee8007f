# SPDX-License-Identifier: BSD-3-Clause
"""Rebuilt normals are those of the surface below the modules, not of the modules."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SkinError
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.normals import patch_normals, rebuilt_normals
from forcetorque.skin.layout.triangular_modules import outward_of_boards
from forcetorque.skin.surface import skin_surface
from tests.scenes.patches import cylinder_patch, ellipsoid_patch

CYLINDER = cylinder_patch(across=9, along=4)
ELLIPSOID = ellipsoid_patch()


@dataclass(frozen=True)
class Limits:
    """What was measured, with a fifth of room: degrees, root mean square and largest."""

    rms: float
    worst: float


def _degrees(normals: FloatArray, truth: FloatArray | None) -> FloatArray:
    assert truth is not None
    angles: FloatArray = np.degrees(np.arccos(np.clip((normals * truth).sum(axis=1), -1.0, 1.0)))
    return angles


def _rms(angles: FloatArray) -> float:
    return float(np.sqrt((angles**2).mean()))


@pytest.mark.parametrize(
    ("patch", "limits"),
    [(CYLINDER, Limits(rms=0.01, worst=0.05)), (ELLIPSOID, Limits(rms=1.2, worst=5.4))],
    ids=["cylinder of 60 mm", "ellipsoid of 50, 70 and 150 mm"],
)
def test_normals_are_those_of_the_surface(patch: PatchDescription, limits: Limits) -> None:
    """On a cylinder to a hundredth of a degree, on an ellipsoid to a degree, at its rim to five."""
    angles = _degrees(rebuilt_normals(patch.positions, patch.modules), patch.normals)
    assert _rms(angles) < limits.rms
    assert angles.max() < limits.worst


@pytest.mark.parametrize("patch", [CYLINDER, ELLIPSOID], ids=["cylinder", "ellipsoid"])
def test_they_are_better_than_planes_and_means_of_facets(patch: PatchDescription) -> None:
    """Three times better than area-weighted means of facets, and four times better than one plane per module."""
    angles = _degrees(rebuilt_normals(patch.positions, patch.modules), patch.normals)
    facets = _degrees(skin_surface(patch.positions).vertex_normals, patch.normals)
    planes = _degrees(_module_planes(patch), patch.normals)
    assert 3.0 * _rms(angles) < _rms(facets)
    assert 4.0 * _rms(angles) < _rms(planes)


def _module_planes(patch: PatchDescription) -> FloatArray:
    assert patch.normals is not None
    normals = np.zeros_like(patch.positions)
    for module in np.unique(patch.modules):
        own = patch.modules == module
        normal = np.linalg.svd(patch.positions[own] - patch.positions[own].mean(axis=0))[2][2]
        normals[own] = normal * np.sign(normal @ patch.normals[own].sum(axis=0))
    return normals


def test_a_rigid_move_turns_them() -> None:
    """A rotation and a shift of all positions, to rounding."""
    rotation = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    rotation *= np.sign(np.linalg.det(rotation))
    moved = rebuilt_normals(CYLINDER.positions @ rotation.T + [0.3, -0.2, 0.1], CYLINDER.modules)
    assert np.abs(moved - rebuilt_normals(CYLINDER.positions, CYLINDER.modules) @ rotation.T).max() < 1e-9


def test_without_modules_facets_take_their_place() -> None:
    """Every taxel a module of its own: still within two degrees of the cylinder."""
    angles = _degrees(rebuilt_normals(CYLINDER.positions, np.arange(len(CYLINDER))), CYLINDER.normals)
    assert _rms(angles) < 1.5


def test_outer_sides_of_boards_turn_with_them_and_stay_when_they_are_shifted() -> None:
    """On a cylinder each board looks away from the axis, wherever its frame lies."""
    rotation = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    rotation *= np.sign(np.linalg.det(rotation))
    boards = outward_of_boards(CYLINDER.positions, CYLINDER.taxels, CYLINDER.modules)
    moved = outward_of_boards(CYLINDER.positions @ rotation.T + [0.3, -0.2, 0.1], CYLINDER.taxels, CYLINDER.modules)
    assert boards is not None
    assert moved is not None
    for module in np.unique(CYLINDER.modules):
        own = CYLINDER.modules == module
        across = CYLINDER.positions[own].mean(axis=0) * [1.0, 1.0, 0.0]
        # a board bridges the cylinder like a chord, and a triangle leans a little to its corner
        assert boards[own][0] @ across > 0.99 * np.linalg.norm(across)
    np.testing.assert_allclose(moved, boards @ rotation.T, atol=1e-9)


def test_a_taxel_by_itself_gets_the_normal_beside_it() -> None:
    """It has no facet; the module it belongs to is flat all the same."""
    keep = (CYLINDER.modules != 35) | np.isin(np.arange(len(CYLINDER)), [350, 351, 359])
    normals = rebuilt_normals(CYLINDER.positions[keep], CYLINDER.modules[keep])
    assert np.isfinite(normals).all()
    assert np.abs(np.linalg.norm(normals, axis=1) - 1.0).max() < 1e-12


def test_a_flat_patch_needs_to_be_told_its_outer_side() -> None:
    """It is refused without, and follows what is said."""
    flat = cylinder_patch(radius_m=1e6).positions - [1e6, 0.0, 0.0]
    positions, modules = np.round(flat, 7), cylinder_patch().modules
    with pytest.raises(SkinError, match="outer side"):
        rebuilt_normals(positions, modules)
    for sign in (1.0, -1.0):
        outward = np.tile([sign, 0.3, 0.0], (len(positions), 1))
        assert np.abs(rebuilt_normals(positions, modules, outward=outward) - [sign, 0.0, 0.0]).max() < 1e-4


def test_a_flat_patch_of_boards_tells_its_outer_side_by_them() -> None:
    """Wherever the patch lies; a rough direction that is stated wins."""
    flat = cylinder_patch(radius_m=1e6)
    patch = replace(flat, positions=np.round(flat.positions - [1e6, 0.0, 0.0], 7))
    assert np.abs(patch_normals(patch) - [1.0, 0.0, 0.0]).max() < 1e-4
    turned = replace(patch, positions=patch.positions * [-1.0, -1.0, 1.0])
    assert np.abs(patch_normals(turned) - [-1.0, 0.0, 0.0]).max() < 1e-4
    assert np.abs(patch_normals(patch, np.array([-1.0, 0.2, 0.0])) - [-1.0, 0.0, 0.0]).max() < 1e-4
    other_boards = replace(patch, modules=patch.modules + 100)
    with pytest.raises(SkinError, match="outer side"):
        patch_normals(replace(other_boards, normals=None))


def test_a_flat_patch_without_boards_looks_where_its_file_says() -> None:
    """Rough normals of the file choose the side; those along the patch say nothing, and are refused."""
    flat = cylinder_patch(radius_m=1e6)
    patch = replace(flat, positions=np.round(flat.positions - [1e6, 0.0, 0.0], 7), modules=flat.modules + 100)
    for sign in (1.0, -1.0):
        written = replace(patch, normals=np.tile([0.8 * sign, 0.6, 0.0], (len(patch), 1)))
        assert np.abs(patch_normals(written) - [sign, 0.0, 0.0]).max() < 1e-4
    with pytest.raises(SkinError, match="outer side"):
        patch_normals(replace(patch, normals=np.tile([0.0, 0.0, 1.0], (len(patch), 1))))
