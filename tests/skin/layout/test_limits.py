# SPDX-License-Identifier: BSD-3-Clause
"""Findings of a layout on either side of their limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.layout.check import shape_findings
from forcetorque.skin.layout.finding import Defect, shape_of
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.triangular_modules import MODULE_PADS, MODULE_TAXELS, _neighbours, template_misfit
from tests.scenes.patches import cylinder_patch, moved_module

SOUND = cylinder_patch()


def _found(patch: PatchDescription) -> list[Defect]:
    return [finding.defect for finding in shape_findings(shape_of(patch))]


def _flat() -> PatchDescription:
    patch = cylinder_patch(radius_m=1e6)
    positions = np.round(patch.positions - [1e6, 0.0, 0.0], 7)
    return replace(patch, positions=positions, normals=np.tile([1.0, 0.0, 0.0], (len(patch), 1)))


@pytest.mark.parametrize(
    ("angle_deg", "defects"),
    [(29.5, []), (30.5, [Defect.OBLIQUE]), (89.5, [Defect.OBLIQUE]), (90.5, [Defect.INWARD]), (150.0, [Defect.INWARD])],
)
def test_a_normal_is_oblique_from_thirty_degrees_and_inward_from_ninety(
    angle_deg: float, defects: list[Defect]
) -> None:
    """Against the surface through the taxels; about any axis of it."""
    shape = shape_of(SOUND)
    assert shape.normals is not None
    assert SOUND.normals is not None
    for axis in ([0.0, 0.0, 1.0], np.cross(shape.normals[100], [0.0, 0.0, 1.0])):
        normals = SOUND.normals.copy()
        normals[100] = Rotation.from_rotvec(np.radians(angle_deg) * np.array(axis)).apply(shape.normals[100])
        assert _found(replace(SOUND, normals=normals)) == defects


@pytest.mark.parametrize(("length", "defects"), [(1.0019, []), (0.9981, []), (1.0021, [Defect.NOT_UNIT])])
def test_a_normal_is_a_unit_vector_to_two_thousandths(length: float, defects: list[Defect]) -> None:
    """As three digits of its components make it."""
    assert SOUND.normals is not None
    normals = SOUND.normals.copy()
    normals[17] *= length / np.linalg.norm(normals[17])
    assert _found(replace(SOUND, normals=normals)) == defects


def _moved(points: FloatArray) -> FloatArray:
    return Rotation.from_rotvec([0.3, -1.0, 0.7]).apply(points) + [0.1, -0.2, 0.05]


def test_the_misfit_of_a_module_is_the_root_of_the_mean_square_of_what_no_motion_takes_off() -> None:
    """Of a stretch along its normal axis, and of one taxel that is raised; by hand, wherever the module is."""
    pads = MODULE_PADS[MODULE_TAXELS]
    assert template_misfit(_moved(pads)) < 1e-12
    assert template_misfit(_moved(pads * [-1.0, 1.0, 1.0])) < 1e-12
    centred = pads - pads.mean(axis=0)
    assert template_misfit(_moved(1.1 * pads)) == pytest.approx(0.1 * np.sqrt((centred**2).sum(axis=1).mean()))
    # heights that are no plane stay as they are, as no small turn takes them off
    height = np.random.default_rng(3).normal(size=10) * 1e-5
    terms = np.column_stack([np.ones(10), pads[:, :2]])
    height -= terms @ np.linalg.lstsq(terms, height, rcond=None)[0]
    raised = pads + height[:, None] * [0.0, 0.0, 1.0]
    assert template_misfit(_moved(raised)) == pytest.approx(np.sqrt((height**2).mean()), rel=1e-4)


@pytest.mark.parametrize(("misfit_m", "defects"), [(0.49e-3, []), (0.51e-3, [Defect.TEMPLATE])])
def test_a_module_is_off_the_template_from_half_a_millimetre(misfit_m: float, defects: list[Defect]) -> None:
    """Drawn larger by as much."""
    own = SOUND.modules == 8
    positions = SOUND.positions.copy()
    centred = positions[own] - positions[own].mean(axis=0)
    positions[own] += misfit_m / np.sqrt((centred**2).sum(axis=1).mean()) * centred
    assert _found(replace(SOUND, positions=positions)) == defects


@pytest.mark.parametrize(("share", "overlap"), [(0.79, True), (0.81, False)])
def test_modules_overlap_where_centres_are_nearer_than_those_of_two_triangles(share: float, overlap: bool) -> None:
    """Four fifths of the distance of the centres of two triangles of 30 mm side by side, 17.3 mm."""
    flat = _flat()
    first, second = (flat.positions[(flat.modules == module) & (flat.taxels % 12 == 3)][0] for module in (0, 2))
    away = share * 0.030 / np.sqrt(3.0) * np.array([0.0, 0.0, -1.0])
    found = _found(moved_module(flat, 0, second - first + away))
    assert (Defect.OVERLAP in found) == overlap


@pytest.mark.parametrize(("faceted", "radius_m"), [(True, 0.10), (False, 0.16)])
def test_one_normal_for_each_module_is_coarse_from_two_degrees_on(faceted: bool, radius_m: float) -> None:
    """In the mean within modules, of cylinders on either side: 2 degrees are 4.7 mm at 0.135 m."""
    patch = cylinder_patch(radius_m=radius_m)
    shape = shape_of(patch)
    assert shape.normals is not None
    own = [patch.modules == module for module in np.unique(patch.modules)]
    means = [shape.normals[k].mean(axis=0) for k in own]
    means = [mean / np.linalg.norm(mean) for mean in means]
    turned = np.concatenate(
        [np.degrees(np.arccos(np.clip(shape.normals[k] @ mean, -1.0, 1.0))) for k, mean in zip(own, means, strict=True)]
    ).mean()
    assert (turned > 2.0) == faceted
    normals = np.zeros_like(patch.positions)
    for k, mean in zip(own, means, strict=True):
        normals[k] = mean
    assert _found(replace(patch, normals=normals)) == ([Defect.FACETED] if faceted else [])


@pytest.mark.parametrize(
    ("drawn_m", "real_m", "joined"),
    [
        (0.020, 1.3 * 0.020 + 0.00199, True),
        (0.020, 1.3 * 0.020 + 0.00201, False),
        (1.3 * 0.020 + 0.00199, 0.020, True),
        (1.3 * 0.020 + 0.00201, 0.020, False),
        (0.0499, 0.045, True),
        (0.0501, 0.045, False),
        (0.045, 0.0501, False),
        (0.0, 0.001, False),
    ],
)
def test_modules_are_neighbours_that_are_as_far_on_paper_as_on_the_link(
    drawn_m: float, real_m: float, joined: bool
) -> None:
    """To a factor of 1.3 and the 2 mm of a plan in whole millimetres, up to 5 cm; a module is none of itself."""
    turn = np.array([0.6, -0.8])
    found = _neighbours(drawn_m * turn[None], real_m * np.array([[0.0, 0.6, 0.8]]))
    assert found.tolist() == [joined]
