# SPDX-License-Identifier: BSD-3-Clause
"""Plans, tables, TaxelArray messages: what is written is read, what is not stated is refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingFileError, UnitError
from forcetorque.skin.layout.check import shape_findings
from forcetorque.skin.layout.finding import shape_of
from forcetorque.skin.layout.formats.icub_skin_gui import read_plan
from forcetorque.skin.layout.formats.layout_table import write_layout_table
from forcetorque.skin.layout.formats.registry import describe_patch, read_layout
from forcetorque.skin.layout.triangular_modules import MODULE_PADS, MODULE_TAXELS
from tests.scenes.patches import cylinder_patch

PATCH = cylinder_patch(across=3, along=2)
PLAN = """cardid 8
robotPart shank_lower
[SENSORS]
# Number X Y degrees gain mirror
triangle_10pad\t2\t16\t9\t180\t5\t0

triangle_10pad\t0\t0\t0\t0\t5\t0
triangle_10pad\t1\t-16\t9\t180\t5\t1
"""
TABLE = """# patch: palm
# frame: r_hand
# columns: 5
column,module,kind,x_mm,y_mm,z_mm,nx,ny,nz
0,0,pressure,0,0,1,0,0,1
3,1,pressure,0,6.5,1,0,0,1
1,0,pressure,6.5,0,1,0,0,1
2,0,thermal,,,,,,
"""
MESSAGE = {
    "header": {"frame_id": "forearm"},
    "sensor_type": "force",
    "link_names": ["forearm", "forearm"],
    "centers_x": [0.0, 0.01],
    "centers_y": [0.0, 0.0],
    "centers_z": [0.02, 0.02],
    "normals_x": [0.0, 0.0],
    "normals_y": [0.0, 0.0],
    "normals_z": [1.0, 1.0],
}
ECHO = """header:
  seq: 1
  frame_id: "forearm"
sensor_type: force
link_names: ['forearm', 'forearm']
centers_x: [0.0, 0.01]
centers_y: [0.0, 0.0]
centers_z:
  - 0.02
  - 0.02
normals_x: [0.0, 0.0]
normals_y: [0.0, 0.0]
normals_z: [1.0, 1.0]
---
header:
  frame_id: "other"
centers_x: [5.0]
"""


def _written(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_plan_has_the_template_at_every_place(tmp_path: Path) -> None:
    """In mm, turned by degrees; a mirrored module has its x reversed, for it is seen from behind."""
    path = _written(tmp_path, "plan.ini", PLAN)
    patch = describe_patch(path)
    assert (patch.name, patch.frame, patch.columns) == ("shank_lower", "u-v plane", 192)
    template = MODULE_PADS[MODULE_TAXELS]
    assert np.abs(patch.positions[:10] - template).max() < 1e-15
    assert np.abs(patch.positions[10:20] - (template * [1.0, -1.0, 1.0] + [-0.016, 0.009, 0.0])).max() < 1e-15
    assert np.abs(patch.positions[20:] - (template * [-1.0, -1.0, 1.0] + [0.016, 0.009, 0.0])).max() < 1e-15
    assert patch.normals is not None
    assert patch.normals[[0, 10, 20], 2].tolist() == [1.0, -1.0, 1.0]
    assert patch.lines[[0, 12, 24]].tolist() == [7, 8, 5]
    assert [module.number for module in read_plan(path)] == [2, 0, 1]


PLANS: dict[str, tuple[str, str, str]] = {
    "another sensor": (
        "triangle_10pad\t2",
        "fingertip2L\t2",
        r"plan.ini:5: expected triangle_10pad, got 'fingertip2L'",
    ),
    "repeated": ("triangle_10pad\t1", "triangle_10pad\t0", "plan.ini:8: expected each module once, got 0 of line 7"),
    "no mirror": ("\t180\t5\t1", "\t180\t5", "plan.ini:8: expected triangle_10pad number X Y degrees gain mirror"),
    "a word": ("\t16\t9", "\tx\t9", "plan.ini:5: expected triangle_10pad number"),
    "a module that none has": ("triangle_10pad\t1", "triangle_10pad\t999999999", "plan.ini:8: expected triangle_10pad"),
    "no part": ("robotPart", "part", "expected a line `robotPart PATCH`"),
    "no section": ("[SENSORS]", "", r"expected a section \[SENSORS\]"),
}


@pytest.mark.parametrize("name", PLANS)
def test_what_is_no_plan_is_refused(tmp_path: Path, name: str) -> None:
    """With the file and the line."""
    old, new, message = PLANS[name]
    with pytest.raises(FormatError, match=message):
        describe_patch(_written(tmp_path, "plan.ini", PLAN.replace(old, new)))


def test_a_table_is_read_by_its_header(tmp_path: Path) -> None:
    """Rows in any order, in the unit that the header states; metres are a thousand millimetres."""
    patch = describe_patch(_written(tmp_path, "palm.csv", TABLE))
    assert (patch.name, patch.frame, patch.columns) == ("palm", "r_hand", 5)
    assert patch.taxels.tolist() == [0, 1, 3]
    assert patch.modules.tolist() == [0, 0, 1]
    assert patch.thermal_pads.tolist() == [2]
    assert patch.lines.tolist() == [5, 7, 8, 6, 0]
    assert np.abs(patch.positions - [[0, 0, 1e-3], [6.5e-3, 0, 1e-3], [0, 6.5e-3, 1e-3]]).max() < 1e-18
    metres = describe_patch(_written(tmp_path, "metres.csv", TABLE.replace("_mm", "_m")))
    assert np.abs(metres.positions - 1e3 * patch.positions).max() < 1e-12


TABLES: dict[str, tuple[str, str, str]] = {
    "no unit": ("x_mm,y_mm,z_mm", "x,y,z", "palm.csv:4: expected columns of positions with their unit"),
    "two units": ("x_mm,y_mm", "x_mm,y_m", "palm.csv:4: expected columns of positions with their unit"),
    "unit of force": ("x_mm,y_mm,z_mm", "x_N,y_N,z_N", "palm.csv:4: expected columns of positions with their unit"),
    "no frame": ("# frame: r_hand\n", "", "expected a line `# frame"),
    "no columns": ("# columns: 5\n", "", "expected a line `# columns"),
    "a message that none sends": ("columns: 5", "columns: 99999999999", "# columns: expected 1 to 1000000 numbers"),
    "beyond": ("3,1,", "5,1,", "palm.csv:6: expected a column of 0 to 4, got 5"),
    "twice": ("3,1,", "0,1,", "palm.csv:6: expected each column once, got 0 of line 5 again"),
    "a word": ("6.5,0,1", "6.5,zero,1", "palm.csv:7: y_mm of taxel 1: expected a finite number, got 'zero'"),
    "short": ("0,0,pressure,0,0,1,0,0,1", "0,0,pressure", "palm.csv:5: expected 9 fields, got 3"),
    "a kind": ("thermal", "warm", "palm.csv:8: kind: expected pressure or thermal, got 'warm'"),
    "no such number": ("3,1,", "three,1,", "palm.csv:6: column: expected a whole number, got 'three'"),
    "two normals": ("nx,ny,nz", "nx,ny,mz", "nx, ny and nz or none of them"),
}


@pytest.mark.parametrize("name", TABLES)
def test_what_a_table_does_not_state_is_refused(tmp_path: Path, name: str) -> None:
    """Unit, frame and order are never guessed; errors name file, line and taxel."""
    old, new, message = TABLES[name]
    assert old in TABLE
    with pytest.raises((FormatError, UnitError), match=message):
        describe_patch(_written(tmp_path, "palm.csv", TABLE.replace(old, new)))


def test_a_table_that_is_written_reads_back_bit_by_bit(tmp_path: Path) -> None:
    """Also the normals, which are of length 1 to rounding."""
    layout = PATCH.layout()
    path = tmp_path / "layout.csv"
    write_layout_table(path, layout)
    again = read_layout(path)
    for name in ("taxels", "modules", "positions", "thermal_pads", "thermal_modules"):
        assert np.array_equal(getattr(again, name), getattr(layout, name)), name
    assert np.abs(again.normals - layout.normals).max() < 1e-15
    assert (again.name, again.frame, again.columns) == ("patch", "shank", 72)
    assert shape_findings(shape_of(describe_patch(path))) == ()


@pytest.mark.parametrize(
    "text", [json.dumps(MESSAGE), json.dumps(MESSAGE, indent=2), ECHO], ids=["line", "json", "echo"]
)
def test_a_message_is_read_in_either_form(tmp_path: Path, text: str) -> None:
    """The first one; each taxel is a column."""
    patch = describe_patch(_written(tmp_path, "arm.yaml", text))
    assert (patch.name, patch.frame, patch.columns) == ("arm", "forearm", 2)
    assert patch.positions.tolist() == [[0.0, 0.0, 0.02], [0.01, 0.0, 0.02]]
    assert patch.layout().normals.tolist() == [[0.0, 0.0, 1.0]] * 2


MESSAGES: dict[str, tuple[dict[str, object], str]] = {
    "two links": ({"link_names": ["forearm", "wrist"]}, "expected the taxels of one link.*forearm, wrist"),
    "no frame": ({"header": {}}, "header.frame_id: expected the frame of the centers"),
    "short": ({"centers_y": [0.0]}, "centers: expected as many x as y and z, got 2, 1, 2"),
    "few normals": (
        {"normals_x": [0.0], "normals_y": [0.0], "normals_z": [1.0]},
        "normals: expected as many as there are centers, 2, got 1",
    ),
    "a word": ({"centers_z": [0.0, "high"]}, "centers of taxel 1: expected a finite number, got 'high'"),
    "absent": ({"centers_z": None}, "expected a list centers_z, got none"),
}


@pytest.mark.parametrize("name", MESSAGES)
def test_what_a_message_lacks_is_refused(tmp_path: Path, name: str) -> None:
    """With the field and the taxel."""
    change, message = MESSAGES[name]
    with pytest.raises(FormatError, match=message):
        describe_patch(_written(tmp_path, "arm.json", json.dumps({**MESSAGE, **change})))


def test_a_file_of_no_form_and_none_are_refused(tmp_path: Path) -> None:
    """All forms are named."""
    with pytest.raises(FormatError, match=r"expected a text with the line \[calibration\]; or .* got none of them"):
        describe_patch(_written(tmp_path, "notes.txt", "skin\n"))
    with pytest.raises(FormatError, match="got several"):
        describe_patch(_written(tmp_path, "both.txt", PLAN + "[calibration]\n"))
    with pytest.raises(MissingFileError, match="expected a file with a layout of skin, there is none"):
        describe_patch(tmp_path / "none.txt")
    (tmp_path / "bytes.txt").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(FormatError, match="in UTF-8, got bytes that are no text at byte 0"):
        describe_patch(tmp_path / "bytes.txt")


@pytest.mark.parametrize("form", ["table", "message", "normal", "plan"])
def test_taxels_beyond_all_bounds_are_refused_by_their_line(tmp_path: Path, form: str) -> None:
    """Distances of such numbers overflow; what is only in another unit is still described."""
    texts = {
        "table": (TABLE.replace("0,6.5,1,0", "0,1e308,1,0"), r":6: position, m, of taxel 3: .* got 0 1e\+305 0.001"),
        "normal": (TABLE.replace("6.5,0,1,0,0,1", "6.5,0,1,0,0,-1e200"), r":7: normal of taxel 1: .* got 0 0 -1e\+200"),
        "message": (ECHO.replace("[0.0, 0.01]", "[0.0, 1e308]", 1), r": position, m, of taxel 1: .* got 1e\+308"),
        "plan": (PLAN.replace("-16", "1e308"), r":8: position, m, of taxel "),
    }
    text, message = texts[form]
    with pytest.raises(FormatError, match=message):
        describe_patch(_written(tmp_path, "patch.txt", text))
    describe_patch(_written(tmp_path, "patch.txt", TABLE.replace("x_mm,y_mm,z_mm", "x_m,y_m,z_m")))


def test_a_plan_that_is_no_text_is_refused(tmp_path: Path) -> None:
    """With the byte where it ends to be one."""
    (tmp_path / "plan.ini").write_bytes(PLAN.encode() + b"\xff\xfe")
    for read in (read_plan, describe_patch):
        with pytest.raises(FormatError, match=f"plan.ini: .* no text at byte {len(PLAN)}; save it as UTF-8"):
            read(tmp_path / "plan.ini")
