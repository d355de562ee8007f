# SPDX-License-Identifier: BSD-3-Clause
"""The check of a layout as a result, and what it says of published layouts."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.skin.commands import check_skin
from forcetorque.skin.layout.check import SkinCheck, check_patch
from forcetorque.skin.layout.finding import Defect
from forcetorque.skin.layout.formats.icub_skin_gui import read_plan
from forcetorque.skin.layout.formats.registry import describe_patch, read_layout
from forcetorque.skin.layout.normals import module_planes, patch_normals
from forcetorque.skin.layout.triangular_modules import (
    MODULE_TAXELS,
    PlannedModule,
    module_poses,
    outward_of_boards,
    placed_pads,
)
from forcetorque.skin.surface import skin_surface
from tests.cases import some_cases
from tests.scenes.patches import collapsed, cylinder_patch


def test_a_sound_patch_has_no_finding() -> None:
    """It still says what it is; the CSV has its header."""
    answer = check_patch(cylinder_patch())
    assert answer.findings == ()
    assert [one.verdict for one in answer.answers()] == ["NO FINDINGS"]
    assert answer.details(200) == (
        "patch in shank: 210 taxels on 21 modules, 42 thermal pads, 252 numbers in a message; 0 findings\n"
    )
    assert answer.columns() == ["defect", "taxels", "lines", "modules", "message", "remedy"]


def test_a_finding_says_where_and_what_to_do() -> None:
    """In the table stretches of columns, in JSON and CSV every column and line, and what to do in a sentence."""
    answer = check_patch(collapsed(cylinder_patch(), 4))
    finding = answer.findings[0]
    assert (finding.defect, finding.modules) == ("duplicate taxels", (4,))
    assert finding.taxels == (48, 49, 50, 51, 52, 53, 55, 56, 57, 59)
    assert finding.lines == tuple(column + 5 for column in finding.taxels)
    assert "duplicate taxels       10   48-53, 55-57, 59         4" in answer.text(200)
    assert "Place their modules anew" in answer.text(200)
    assert answer.records()[0]["taxels"] == "48 49 50 51 52 53 55 56 57 59"


def test_figures_have_normals_as_written_and_rebuilt() -> None:
    """Those that there are; they are no part of the JSON."""
    answer = check_patch(cylinder_patch())
    assert list(answer.normals) == ["as written", "rebuilt"]
    assert list(check_patch(replace(cylinder_patch(), normals=None)).normals) == ["rebuilt"]
    assert "positions" not in answer.json_text()


PUBLISHED: dict[str, dict[Defect, tuple[int, ...]]] = {
    "left_arm": {Defect.REPRESENTATIVES: (0,), Defect.PLACEHOLDER: (350,), Defect.GAP: ()},
    "left_arm_mesh": {
        Defect.REPRESENTATIVES: (74, 19),
        Defect.DUPLICATE: (12,),
        Defect.TEMPLATE: (435,),
        Defect.NOT_UNIT: (295,),
        Defect.OBLIQUE: (),
        Defect.GAP: (),
    },
    "left_foot": {Defect.REPRESENTATIVES: (0,), Defect.PLACEHOLDER: (250,)},
    "left_forearm_V2": {
        Defect.DUPLICATE: (112,),
        Defect.TEMPLATE: (240,),
        Defect.OBLIQUE: (),
        Defect.GAP: (),
    },
    "left_forearm_mesh": {Defect.TEMPLATE: (276,), Defect.NOT_UNIT: (261,), Defect.OBLIQUE: (), Defect.GAP: ()},
    "left_forearm_nomesh": {
        Defect.REPRESENTATIVES: (1,),
        Defect.TEMPLATE: (275,),
        Defect.ZERO: (275,),
        Defect.GAP: (),
    },
    "left_hand_V2_1": {Defect.REPRESENTATIVES: (4, 60), Defect.TEMPLATE: (48,)},
    "left_leg_lower": {Defect.REPRESENTATIVES: (0,), Defect.PLACEHOLDER: (380,)},
    "left_leg_upper": {Defect.REPRESENTATIVES: (0,), Defect.PLACEHOLDER: (680,), Defect.GAP: ()},
    "r_lower_leg_cad_V2": {
        Defect.DUPLICATE: (230,),
        Defect.TEMPLATE: (380,),
        Defect.OVERLAP: (70,),
        Defect.OBLIQUE: (),
        Defect.GAP: (),
    },
    "right_foot": {Defect.REPRESENTATIVES: (0,), Defect.PLACEHOLDER: (250,)},
    "right_leg_lower": {Defect.REPRESENTATIVES: (0,), Defect.PLACEHOLDER: (380,)},
    "right_leg_upper": {Defect.REPRESENTATIVES: (0,), Defect.PLACEHOLDER: (680,), Defect.GAP: ()},
    "torso": {
        Defect.REPRESENTATIVES: (88,),
        Defect.DUPLICATE: (82,),
        Defect.TEMPLATE: (340,),
        Defect.PLACEHOLDER: (440,),
    },
}
"""Taxels with each defect in files of icub-main and icub-models-generator; of what triangles decide only that it is."""


def _positions(data_dir: Path) -> Path:
    return data_dir / "icub_skin_positions"


@cache
def _checked(data_dir: Path, name: str) -> SkinCheck:
    """What the check says of a published layout."""
    return check_skin(_positions(data_dir) / f"{name}.txt")


def _counts(answer: SkinCheck) -> dict[Defect, tuple[int, ...]]:
    counts: dict[Defect, tuple[int, ...]] = {}
    for finding in answer.findings:
        defect = Defect(finding.defect)
        by_triangles = defect in (Defect.OBLIQUE, Defect.GAP)
        counts[defect] = () if by_triangles else (*counts.get(defect, ()), len(finding.taxels))
    return counts


@pytest.mark.real_data
@some_cases("name", PUBLISHED, quick=4)
def test_published_layouts_have_these_findings(data_dir: Path, name: str) -> None:
    """Every one has some, none has others."""
    assert _counts(_checked(data_dir, name)) == PUBLISHED[name]


@pytest.mark.real_data
@pytest.mark.long
def test_published_plans_have_gaps_at_most(data_dir: Path) -> None:
    """Where a patch is drawn in pieces; one plan states a module twice and is refused, with both lines."""
    plans = sorted((_positions(data_dir) / "skinGui_ini").glob("*.ini"))
    pieces = []
    for plan in plans:
        if plan.stem == "right_arm_V2_7":
            with pytest.raises(FormatError, match="ini:130: expected each module once, got 61 of line 96 again"):
                check_skin(plan)
            continue
        counts = _counts(check_skin(plan))
        assert set(counts) <= {Defect.GAP}
        pieces += [plan.stem] * len(counts)
    assert len(plans) == 9
    assert pieces == ["left_arm_V2_7", "left_leg_upper", "right_leg_upper"]


@pytest.mark.real_data
def test_messages_have_the_numbers_of_the_files(data_dir: Path) -> None:
    """Entries against rows, distinct places, lengths of normals, modules on each other."""
    said = {
        name: " ".join(finding.message for finding in _checked(data_dir, name).findings)
        for name in ("right_leg_lower", "right_leg_upper", "r_lower_leg_cad_V2", "left_forearm_V2", "left_arm_mesh")
    }
    assert "960 entries for 768 rows" in said["right_leg_lower"]
    assert "all 380 normals are 1 0 0" in said["right_leg_lower"]
    assert "960 entries for 1344 rows" in said["right_leg_upper"]
    assert "188 distinct places of 380" in said["r_lower_leg_cad_V2"]
    assert "32 and 42 (6.9 mm)" in said["r_lower_leg_cad_V2"]
    assert "148 distinct places of 240" in said["left_forearm_V2"]
    assert "a length of 0.503 to 0.998" in said["left_arm_mesh"]


@pytest.mark.real_data
def test_most_taxels_of_an_old_file_sit_on_the_centre_of_their_module(data_dir: Path) -> None:
    """177 of the 342 that are no centre; four modules are 20 to 50 mm from where the file of today has them."""
    old = describe_patch(_positions(data_dir) / "r_lower_leg_cad_V2.txt")
    new = describe_patch(_positions(data_dir) / "right_leg_lower.txt")
    centre = old.taxels % 12 == 3
    at_centre = (old.positions == np.repeat(old.positions[centre], 10, axis=0)).all(axis=1)
    assert np.count_nonzero(at_centre & ~centre) == 177
    distance = _distances(old.positions[centre], new.positions[centre])
    far = distance > 0.01
    assert old.modules[centre][far].tolist() == [32, 43, 46, 47]
    assert 1e3 * distance[far] == pytest.approx([33.4, 39.2, 20.3, 49.6], abs=0.1)
    assert np.median(distance) < 1e-3


def _distances(places: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Distances after the rigid move that fits those best that it can bring near."""
    use = np.ones(len(places), dtype=bool)
    for _ in range(8):
        middle, aim = places[use].mean(axis=0), wanted[use].mean(axis=0)
        left, _, right = np.linalg.svd((places[use] - middle).T @ (wanted[use] - aim))
        turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
        distance: np.ndarray = np.linalg.norm((places - middle) @ turn - (wanted - aim), axis=1)
        use = distance < 8e-3
    return distance


CURVED = ("left_arm", "right_arm", "left_leg_lower", "right_leg_lower", "left_leg_upper", "right_leg_upper")


@pytest.mark.long
@pytest.mark.real_data
def test_every_board_of_a_curved_patch_is_numbered_the_same_way_round(data_dir: Path) -> None:
    """What flat patches rely on: seen from the side that bulges, all 282 boards are the template, not its image."""
    alike = count = 0
    for name in CURVED:
        patch = describe_patch(_positions(data_dir) / f"{name}.txt")
        boards = outward_of_boards(patch.positions, patch.taxels, patch.modules)
        assert boards is not None
        agreement = (boards * patch_normals(patch)).sum(axis=1)[patch.taxels % 12 == 3]
        alike += np.count_nonzero(agreement > 0.9)
        count += len(agreement)
    assert (alike, count) == (282, 282)


@pytest.mark.real_data
@pytest.mark.parametrize("name", ["left_forearm_mesh", "left_arm_mesh"])
def test_rebuilt_normals_agree_with_good_ones(data_dir: Path, name: str) -> None:
    """Of files with normals by a mesh of their makers: 4 and 7 degrees in the median, most at rims."""
    answer = _checked(data_dir, name)
    written = answer.normals["as written"]
    written = written / np.linalg.norm(written, axis=1, keepdims=True)
    cosine = (written * answer.normals["rebuilt"]).sum(axis=1)
    assert np.degrees(np.arccos(np.median(cosine))) < 8.0
    assert (cosine > 0.0).all()


LEFT_OUT_DEG = {
    "left_leg_lower": 1.5,
    "right_leg_lower": 1.5,
    "left_leg_upper": 2.5,
    "right_leg_upper": 2.5,
    "left_arm": 10.0,
}
"""Median angle of a module to what the others foretell; degrees. Measured: 1.0, 1.1, 2.1, 2.1, 9.2."""


@pytest.mark.real_data
@some_cases("name", LEFT_OUT_DEG, quick=2)
def test_the_others_foretell_how_a_module_lies(data_dir: Path, name: str) -> None:
    """Each left out in its turn: on legs, whose neighbours are 14 to 18 degrees apart, within two; on an arm in ten."""
    patch = describe_patch(_positions(data_dir) / f"{name}.txt")
    planes = module_planes(skin_surface(patch.positions), patch.modules)
    assert planes is not None
    angles = []
    for k, (centre, normal) in enumerate(zip(planes.centres, planes.normals, strict=True)):
        others = np.arange(len(planes.centres)) != k
        left = replace(
            planes,
            centres=planes.centres[others],
            normals=planes.normals[others],
            weights=planes.weights[others],
        )
        foretold = left.normal_at(centre, np.zeros(3))
        angles.append(np.degrees(np.arccos(np.clip(foretold @ normal, -1.0, 1.0))))
    assert len(angles) == len(np.unique(patch.modules))
    assert np.median(angles) < LEFT_OUT_DEG[name]


PLANS = {
    "left_leg_lower": "left_leg_lower",
    "right_leg_lower": "right_leg_lower",
    "left_leg_upper": "left_leg_upper",
    "right_leg_upper": "right_leg_upper",
    "right_foot": "right_foot",
}


def test_nearer_modules_show_more_how_one_lies() -> None:
    """On z = a u^3 the slope is the mean of a u^2, weighted by u^2 and a normal density of 20 mm in the distance."""
    along, across, curve = np.array([-0.036, -0.018, 0.018, 0.036]), np.array([-0.018, 0.018]), 128.6
    u, v = np.concatenate([[0.0], along, 0.0 * across]), np.concatenate([[0.0], 0.0 * along, across])
    centres = np.column_stack([u, v, curve * u**3])
    plan = [PlannedModule(number=k, u_m=u[k], v_m=v[k], angle_rad=0.0, mirrored=False) for k in range(len(u))]
    weight = np.exp(-0.5 * (np.linalg.norm(centres[1:5], axis=1) / 0.02) ** 2) * along**2
    slope = curve * (weight @ along**2) / weight.sum()
    np.testing.assert_allclose(
        module_poses(plan, centres)[0][:3, 2], np.array([-slope, 0.0, 1.0]) / np.hypot(slope, 1.0), rtol=0.0, atol=1e-12
    )


@pytest.mark.real_data
@pytest.mark.parametrize("name", PLANS)
def test_a_plan_and_centres_place_real_taxels(data_dir: Path, name: str) -> None:
    """Where a CAD file has them, by the centres of modules alone: half a millimetre in the median, 3.5 mm at most."""
    patch = describe_patch(_positions(data_dir) / f"{name}.txt")
    plan = {module.number: module for module in read_plan(_positions(data_dir) / "skinGui_ini" / f"{PLANS[name]}.ini")}
    modules = np.unique(patch.modules)
    poses = module_poses([plan[module] for module in modules], patch.positions[patch.taxels % 12 == 3])
    placed = np.concatenate([placed_pads(pose)[MODULE_TAXELS] for pose in poses])
    distance = np.linalg.norm(placed - patch.positions, axis=1)
    assert np.median(distance) < 5e-4
    assert distance.max() < 3.5e-3


@pytest.mark.real_data
def test_a_layout_of_today_can_be_used_with_rebuilt_normals(data_dir: Path) -> None:
    """The patch of the thesis, whose file has placeholders."""
    layout = read_layout(_positions(data_dir) / "right_leg_lower.txt", rebuild_normals=True)
    assert (len(layout), layout.columns, layout.frame) == (380, 768, "r_lower_leg")
    assert np.abs(layout.normals.mean(axis=0)).max() < 0.9
