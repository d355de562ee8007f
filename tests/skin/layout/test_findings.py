# SPDX-License-Identifier: BSD-3-Clause
"""A sound layout has no finding; every kind of defect is found where it was planted, and alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.layout.check import shape_findings
from forcetorque.skin.layout.finding import Defect, LayoutFindingRow, shape_of
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.triangular_modules import MODULE_TAXELS, placed_pads
from tests.scenes.patches import HEAD_LINES, collapsed, cylinder_patch, moved_module, without_modules

SOUND = cylinder_patch()
WIDE = cylinder_patch(across=9, along=5)
"""Large enough for a hole in its middle."""


def _normals(patch: PatchDescription, change: Callable[[FloatArray], object]) -> PatchDescription:
    """The patch with other normals: the change is made in place."""
    assert patch.normals is not None
    normals = patch.normals.copy()
    change(normals)
    return replace(patch, normals=normals)


def _entries(patch: PatchDescription, column: int, entry: int) -> PatchDescription:
    """The patch with another entry of `taxel2Repr`."""
    assert patch.representatives is not None
    entries = patch.representatives.copy()
    entries[column] = entry
    return replace(patch, representatives=entries)


def _only(patch: PatchDescription, defect: Defect) -> LayoutFindingRow:
    (finding,) = shape_findings(shape_of(patch))
    assert finding.defect == defect
    return finding


def _flat(*, upside_down: bool = False) -> PatchDescription:
    """A flat patch, as of a sole."""
    patch = cylinder_patch(radius_m=1e6)
    positions = np.round(patch.positions - [1e6, 0.0, 0.0], 7)
    normals = np.tile([-1.0 if upside_down else 1.0, 0.0, 0.0], (len(patch), 1))
    return replace(patch, positions=positions, normals=normals)


def test_a_sound_layout_has_no_finding() -> None:
    """Neither curved nor flat, nor one without normals and entries."""
    assert len(SOUND) == 210
    for patch in (SOUND, WIDE, _flat(), replace(SOUND, normals=None, representatives=None)):
        assert shape_findings(shape_of(patch)) == ()


def test_a_link_frame_elsewhere_changes_nothing() -> None:
    """The patch says by its shape which side is out, not by where the origin is."""
    assert shape_findings(shape_of(replace(SOUND, positions=SOUND.positions + [1.0, -2.0, 3.0]))) == ()


def test_taxels_at_one_place_are_found() -> None:
    """Two taxels of one module; both are named, with their lines."""
    positions = SOUND.positions.copy()
    positions[11] = positions[10]
    found = {finding.defect: finding for finding in shape_findings(shape_of(replace(SOUND, positions=positions)))}
    # a module with a taxel elsewhere is off the template too
    assert set(found) == {Defect.DUPLICATE, Defect.TEMPLATE}
    assert list(found[Defect.DUPLICATE].taxels) == [12, 13]
    assert list(found[Defect.DUPLICATE].lines) == [HEAD_LINES + 13, HEAD_LINES + 14]
    assert list(found[Defect.DUPLICATE].modules) == [1]
    assert "2 taxels share 1 place: 209 distinct places of 210" in found[Defect.DUPLICATE].message


def test_taxels_at_one_place_are_found_alone_where_no_template_speaks() -> None:
    """On a skin that is no triangles, of which modules are not twelve columns each."""
    other = replace(SOUND, modules=SOUND.modules + 100, representatives=None)
    positions = other.positions.copy()
    positions[11] = positions[10]
    assert _only(replace(other, positions=positions), Defect.DUPLICATE).taxels == (12, 13)


def test_a_module_whose_taxels_are_at_its_centre_is_found() -> None:
    """As in published files: they are at one place, and no triangle."""
    defects = [finding.defect for finding in shape_findings(shape_of(collapsed(SOUND, 10)))]
    assert set(defects) >= {Defect.DUPLICATE, Defect.TEMPLATE}


NORMALS: dict[Defect, tuple[Callable[[FloatArray], object], list[int], str]] = {
    Defect.ZERO: (lambda normals: normals.__setitem__([3, 20], 0.0), [3, 24], "2 of 210"),
    Defect.NOT_UNIT: (lambda normals: normals.__setitem__(5, 0.7 * normals[5]), [5], "a length of 0.700 to 0.700"),
    Defect.INWARD: (lambda normals: normals.__setitem__(9, -normals[9]), [11], "1 of 210 normals point into the link"),
    Defect.OBLIQUE: (
        lambda normals: normals.__setitem__(0, [0.0, np.sqrt(0.75), 0.5]),
        [0],
        "1 of 210 normals are more than 30 degrees off",
    ),
}


@pytest.mark.parametrize("defect", NORMALS)
def test_wrong_normals_are_found_alone(defect: Defect) -> None:
    """On the taxels that have them, with how many there are."""
    change, taxels, message = NORMALS[defect]
    finding = _only(_normals(SOUND, change), defect)
    assert list(finding.taxels) == taxels
    assert message in finding.message


def test_placeholder_normals_are_found_alone() -> None:
    """One direction for all, which is right nowhere or somewhere; on a flat patch one that lies in it."""
    for patch in (SOUND, _flat()):
        finding = _only(
            _normals(patch, lambda normals: normals.__setitem__(slice(None), [0.0, 0.0, 1.0])), Defect.PLACEHOLDER
        )
        assert len(finding.taxels) == len(patch)
        assert "all 210 normals are 0 0 1, up to 90 degrees" in finding.message


def test_a_patch_that_is_inside_out_is_found() -> None:
    """All normals reversed on a curved patch; the remedy is to reverse all."""
    finding = _only(_normals(SOUND, lambda normals: np.negative(normals, out=normals)), Defect.INWARD)
    assert len(finding.taxels) == len(SOUND)
    assert finding.remedy.startswith("reverse them all")


def test_a_flat_patch_that_is_inside_out_is_found() -> None:
    """Its boards tell; without boards nobody but the normals does."""
    patch = _flat(upside_down=True)
    finding = _only(patch, Defect.INWARD)
    assert finding.remedy.startswith("reverse them all, unless its boards are mirror images")
    assert shape_findings(shape_of(replace(patch, modules=patch.modules + 100, representatives=None))) == ()


def test_one_normal_per_module_is_found_alone() -> None:
    """The plane of each module, on a surface that turns by 3 degrees within modules."""
    assert SOUND.normals is not None
    sums = np.array([SOUND.normals[SOUND.modules == module].sum(axis=0) for module in range(21)])
    planes = sums / np.linalg.norm(sums, axis=1, keepdims=True)
    finding = _only(replace(SOUND, normals=planes[SOUND.modules]), Defect.FACETED)
    assert "turns within modules by" in finding.message


ENTRIES = {
    "thermal pad": (_entries(SOUND, 4, -2), [4], "1 thermal pad with a place"),
    "missing": (_entries(SOUND, 4, -1), [4], "1 row with a place, where the entry says that there is no taxel"),
    "no row": (_entries(without_modules(WIDE, 0), 4, 3), [4], "1 row of zeros"),
    "misled": (_entries(SOUND, 4, 6), [4], "1 taxel with a representative that is none"),
    "beyond": (_entries(SOUND, 4, 9999), [4], "1 taxel with a representative that is none"),
}


@pytest.mark.parametrize("name", ENTRIES)
def test_rows_against_their_entries_are_found_alone(name: str) -> None:
    """Each way in which a row and its entry of `taxel2Repr` contradict each other."""
    patch, columns, message = ENTRIES[name]
    finding = _only(patch, Defect.REPRESENTATIVES)
    assert list(finding.taxels) == columns
    assert list(finding.lines) == [HEAD_LINES + 1 + column for column in columns]
    assert message in finding.message


def test_another_number_of_entries_is_found_alone() -> None:
    """More entries than rows, and fewer."""
    assert SOUND.representatives is not None
    for entries in (np.r_[SOUND.representatives, [-1] * 12], SOUND.representatives[:-12]):
        finding = _only(replace(SOUND, representatives=entries), Defect.REPRESENTATIVES)
        assert finding.message == f"{len(entries)} entries for 252 rows"
        assert len(finding.taxels) == 0


def test_a_module_off_the_template_is_found_alone() -> None:
    """One that is drawn 10 % too large; a mirrored one is none."""
    own = SOUND.modules == 8
    positions = SOUND.positions.copy()
    positions[own] += 0.1 * (positions[own] - positions[own].mean(axis=0))
    finding = _only(replace(SOUND, positions=positions), Defect.TEMPLATE)
    assert list(finding.modules) == [8]
    assert "taxels of 1 module are off the triangle, at the worst by 0.8 mm (root" in finding.message
    flat = _flat()
    mirrored = flat.positions.copy()
    mirrored[flat.modules == 0] = placed_pads(_POSE, mirrored=True)[MODULE_TAXELS] + flat.positions[3]
    assert shape_findings(shape_of(replace(flat, positions=mirrored))) == ()


_POSE = np.array([[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
"""A module whose plane is that of y and z, its y up."""


def test_a_module_of_other_taxels_is_found_alone() -> None:
    """Nine taxels, and a thermal pad among ten."""
    left = np.flatnonzero(SOUND.taxels != 13)
    assert SOUND.normals is not None
    nine = replace(
        SOUND,
        taxels=SOUND.taxels[left],
        modules=SOUND.modules[left],
        positions=SOUND.positions[left],
        normals=SOUND.normals[left],
        representatives=_entries(SOUND, 13, -1).representatives,
    )
    finding = _only(nine, Defect.TEMPLATE)
    assert finding.message == "1 module of 9 taxels, which are not the ten of the triangle"
    assert list(finding.modules) == [1]


def test_modules_on_each_other_are_found_alone() -> None:
    """A module at a corner that lies 5 mm beside another one, as where two frames were given one place."""
    flat = _flat()
    centres = [flat.positions[flat.modules == module].mean(axis=0) for module in (0, 2)]
    finding = _only(moved_module(flat, 0, centres[1] - centres[0] + [0.0, 0.005, 0.0]), Defect.OVERLAP)
    assert list(finding.modules) == [0, 2]
    assert "0 and 2 (5.0 mm)" in finding.message


def test_a_piece_apart_is_found_alone() -> None:
    """Without the middle row the patch falls in two; the smaller piece is named."""
    patch = without_modules(cylinder_patch(across=7, along=4), *range(7, 14))
    finding = _only(patch, Defect.GAP)
    assert list(finding.modules) == list(range(7))
    assert finding.message == "70 taxels in 1 piece are more than 15 mm from the other 140"


def test_a_hole_is_found_alone() -> None:
    """A module missing in the middle; the taxels around it are named."""
    finding = _only(without_modules(WIDE, 22), Defect.GAP)
    assert finding.message.startswith("1 hole, ")
    assert {13, 21, 23} & set(finding.modules)


def test_two_holes_of_one_size_are_two() -> None:
    """Each with the length of the line around it."""
    patch = without_modules(cylinder_patch(across=17, along=5), 38, 46)
    finding = _only(patch, Defect.GAP)
    first, second = finding.message.removeprefix("2 holes, ").removesuffix(" mm around").split(", ")
    assert first == second


def test_a_taxel_that_is_far_away_is_apart() -> None:
    """A digit too many in one position; the rest is judged all the same."""
    positions = SOUND.positions.copy()
    positions[40] = [9e6, 0.0, 0.0]
    found = {finding.defect: finding for finding in shape_findings(shape_of(replace(SOUND, positions=positions)))}
    assert list(found[Defect.GAP].taxels) == [48]
    assert Defect.TEMPLATE in found


def test_a_patch_in_millimetres_is_found() -> None:
    """No taxel has a neighbour then."""
    findings = shape_findings(shape_of(replace(SOUND, positions=1e3 * SOUND.positions)))
    gap = next(finding for finding in findings if finding.defect == Defect.GAP)
    assert gap.remedy.startswith("look whether positions are in m")
