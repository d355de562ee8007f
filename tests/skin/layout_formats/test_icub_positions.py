# SPDX-License-Identifier: BSD-3-Clause
"""Position files are read as they are written; what is no such row is refused with its line."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, SkinError
from forcetorque.skin.layout.check import shape_findings
from forcetorque.skin.layout.finding import shape_of
from forcetorque.skin.layout.formats.registry import describe_patch, read_layout
from tests.scenes.patches import collapsed, cylinder_patch, position_text, without_modules

PATCH = cylinder_patch()
WRITTEN_M = 5e-7
"""Half of the last digit of six."""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A sound position file."""
    path = tmp_path / "shank_lower.txt"
    path.write_text(position_text(PATCH), encoding="utf-8")
    return path


def _edit(path: Path, line: int, text: str) -> Path:
    lines = path.read_text(encoding="utf-8").split("\n")
    lines[line - 1] = text
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def test_a_file_is_read_as_it_is_written(file: Path) -> None:
    """Taxels, modules, thermal pads, entries, and the line of every column; positions and normals to its digits."""
    patch = describe_patch(file)
    assert PATCH.normals is not None
    assert patch.normals is not None
    for name in ("taxels", "modules", "thermal_pads", "thermal_modules", "representatives", "lines"):
        assert np.array_equal(getattr(patch, name), getattr(PATCH, name)), name
    assert (patch.name, patch.frame, patch.columns) == ("shank_lower", "shank", 252)
    assert np.abs(patch.positions - PATCH.positions).max() <= WRITTEN_M
    assert np.abs(patch.normals - PATCH.normals).max() <= WRITTEN_M
    assert shape_findings(shape_of(patch)) == ()


def test_its_layout_is_sound(file: Path) -> None:
    """Lengths of normals are 1 but for rounding of floats, though the file has six digits."""
    layout = read_layout(file)
    assert len(layout) == 210
    assert np.abs(np.linalg.norm(layout.normals, axis=1) - 1.0).max() < 1e-15


def test_modules_without_taxels_are_dummies(file: Path) -> None:
    """Rows of zeros of a module without taxels are neither taxels nor thermal pads."""
    file.write_text(position_text(without_modules(PATCH, 4, 20)), encoding="utf-8")
    patch = describe_patch(file)
    assert sorted({4, 20} & set(patch.modules.tolist())) == []
    assert sorted({4, 20} & set(patch.thermal_modules.tolist())) == []
    assert patch.columns == 252


def test_what_is_called_a_thermal_pad_is_none_of_the_taxels(file: Path) -> None:
    """Its counts are no pressure, even where its row has a place."""
    file = _edit(file, 4 + 1 + 6, "0.06 0 0 1 0 0")
    patch = describe_patch(file)
    assert 6 not in patch.taxels
    assert 6 in patch.thermal_pads
    (finding,) = shape_findings(shape_of(patch))
    assert list(finding.taxels) == [6]


def test_what_is_not_sound_leads_to_the_command(file: Path) -> None:
    """The error names file, patch and taxel; asked for, normals are rebuilt instead."""
    file.write_text(position_text(collapsed(PATCH, 2)), encoding="utf-8")
    with pytest.raises(
        SkinError, match=r"shank_lower.txt: patch 'shank_lower', taxel 24: positions.*`forcetorque skin"
    ):
        read_layout(file)
    file.write_text(position_text(replace(PATCH, normals=np.zeros((210, 3)))), encoding="utf-8")
    with pytest.raises(SkinError, match="taxel 0: normals: expected length 1, got 0.0"):
        read_layout(file)
    assert PATCH.normals is not None
    rebuilt = read_layout(file, rebuild_normals=True).normals
    assert np.degrees(np.arccos((rebuilt * PATCH.normals).sum(axis=1).clip(-1, 1))).max() < 0.1


DAMAGE: dict[str, tuple[int, str, str]] = {
    "five numbers": (5, "0.06 0 0 1 0", r"txt:5: expected six finite numbers x y z nx ny nz, got '0.06 0 0 1 0'"),
    "a word": (9, "0.06 0 zero 1 0 0", r"txt:9: expected six finite numbers"),
    "no number": (9, "nan 0 0 1 0 0", r"txt:9: expected six finite numbers"),
    "no frame": (1, "nome shank", "expected a line `name ...`"),
    "another sampling": (2, "spatial_sampling patch", "spatial_sampling: expected taxel, a row for each, got 'patch'"),
    "no entries": (3, "", "expected a line `taxel2Repr"),
    "odd entries": (3, "taxel2Repr ( 3 x )", "taxel2Repr: expected whole numbers"),
    "no sign": (4, "[calibracion]", "expected a text with the line"),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_what_is_no_position_file_is_refused(file: Path, name: str) -> None:
    """With the file and the line."""
    line, text, message = DAMAGE[name]
    with pytest.raises(FormatError, match=message):
        describe_patch(_edit(file, line, text))


def test_a_file_of_zeros_is_refused(file: Path) -> None:
    """No row is a taxel."""
    head = file.read_text(encoding="utf-8").partition("[calibration]")[0]
    file.write_text(head + "[calibration]\n" + "0 0 0 0 0 0\n" * 12, encoding="utf-8")
    with pytest.raises(FormatError, match="got none but zeros"):
        describe_patch(file)
