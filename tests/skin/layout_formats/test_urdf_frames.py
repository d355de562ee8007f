# SPDX-License-Identifier: BSD-3-Clause
"""Frames of a URDF become taxels: by their own axes, or by their places and a plan."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RobotError, SkinError
from forcetorque.base.pose import rotation_from_rpy
from forcetorque.skin.layout.check import shape_findings
from forcetorque.skin.layout.finding import shape_of
from forcetorque.skin.layout.formats.icub_skin_gui import read_plan
from forcetorque.skin.layout.formats.registry import describe_patch
from forcetorque.skin.layout.triangular_modules import MODULE_TAXELS, module_poses, placed_pads
from tests.scenes.patches import cylinder_modules
from tests.scenes.robots import robot_xml

TURNED = rotation_from_rpy(np.array([0.3, -0.2, 1.0]))
"""Of the module's frame in the link."""
STATED = """schema = "forcetorque/module_frames/1"
patch = "shank_lower"
urdf = "robot.urdf"
link = "shank"
frames = "shank_skin_{module}"
columns = 252
"""
NEAR_DEG = 1.0
"""Mean angle of their normals; degrees. Measured: 0.75, at most 4.1."""
NEAR_M = 3e-4
"""Mean distance of taxels that a plan and centres place on a cylinder of 60 mm; m. Measured: 0.15 mm."""


def _urdf(poses: dict[int, tuple[FloatArray, str]]) -> str:
    """A shank with a frame for each module; rpy as text."""
    elements = ["<link name='shank'/>", "<link name='foot'/>"]
    elements.append(
        "<joint name='ankle' type='continuous'><parent link='shank'/><child link='foot'/><axis xyz='0 1 0'/></joint>"
    )
    for number, (place, rpy) in poses.items():
        name = f"shank_skin_{number}"
        xyz = " ".join(map(repr, place.tolist()))
        elements.append(f"<link name='{name}'/>")
        elements.append(
            f"<joint name='{name}_joint' type='fixed'><parent link='shank'/><child link='{name}'/>"
            f"<origin xyz='{xyz}' rpy='{rpy}'/></joint>"
        )
    return robot_xml(*elements)


def _plan(modules: list[tuple[float, float, bool]]) -> str:
    lines = [
        f"triangle_10pad {k} {1e3 * u:.3f} {1e3 * v:.3f} {180 * turned} 5 0" for k, (u, v, turned) in enumerate(modules)
    ]
    return "\n".join(["robotPart shank_lower", "[SENSORS]", *lines]) + "\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A robot with one module, and the file that says so."""
    place = np.array([0.05, 0.01, -0.2])
    (tmp_path / "robot.urdf").write_text(_urdf({3: (place, "0.3 -0.2 1.0")}), encoding="utf-8")
    (tmp_path / "patch.toml").write_text(STATED, encoding="utf-8")
    return tmp_path


def test_a_frame_with_axes_places_the_template(folder: Path) -> None:
    """X and y in the board, z out; a mirrored board has its x reversed."""
    patch = describe_patch(folder / "patch.toml")
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = TURNED, [0.05, 0.01, -0.2]
    assert (patch.name, patch.frame, patch.columns) == ("shank_lower", "shank", 252)
    assert patch.taxels.tolist() == (36 + MODULE_TAXELS).tolist()
    assert np.abs(patch.positions - placed_pads(pose)[MODULE_TAXELS]).max() < 1e-15
    assert patch.normals is not None
    assert np.abs(patch.normals - TURNED[:, 2]).max() < 1e-12
    (folder / "patch.toml").write_text(STATED + "mirrored = [3]\n", encoding="utf-8")
    mirrored = describe_patch(folder / "patch.toml")
    np.testing.assert_array_equal(placed_pads(np.eye(4), mirrored=True), placed_pads(np.eye(4)) * [-1.0, 1.0, 1.0])
    assert np.abs(mirrored.positions - placed_pads(pose, mirrored=True)[MODULE_TAXELS]).max() < 1e-15


@pytest.fixture
def bent(tmp_path: Path) -> Path:
    """A robot with the places of 28 modules on a cylinder, and their plan."""
    tiles, poses = cylinder_modules(across=7, along=4)
    (tmp_path / "robot.urdf").write_text(
        _urdf({k: (pose[:3, 3], "0 0 0") for k, pose in enumerate(poses)}), encoding="utf-8"
    )
    (tmp_path / "plan.ini").write_text(_plan(tiles), encoding="utf-8")
    stated = STATED.replace("252", "336") + 'plan = "plan.ini"\n'
    (tmp_path / "patch.toml").write_text(stated, encoding="utf-8")
    return tmp_path


def test_a_plan_is_bent_over_places(bent: Path) -> None:
    """Taxels within a millimetre of the cylinder's, and a normal that looks out, though nobody said which side is."""
    _, poses = cylinder_modules(across=7, along=4)
    truth = np.concatenate([placed_pads(pose)[MODULE_TAXELS] for pose in poses])
    patch = describe_patch(bent / "patch.toml")
    distance = np.linalg.norm(patch.positions - truth, axis=1)
    assert distance.mean() < NEAR_M
    assert patch.normals is not None
    out = truth * [1.0, 1.0, 0.0] / np.linalg.norm(truth[:, :2], axis=1, keepdims=True)
    assert np.degrees(np.arccos((patch.normals * out).sum(axis=1))).mean() < NEAR_DEG
    assert shape_findings(shape_of(patch)) == ()


def test_a_piece_that_is_drawn_from_behind_is_the_same_on_the_link(bent: Path) -> None:
    """The mirror image of a plan whose modules are all marked as mirrored leads to the same taxels."""
    centres = np.array([pose[:3, 3] for pose in cylinder_modules(across=7, along=4)[1]])
    text = (bent / "plan.ini").read_text(encoding="utf-8")
    lines = []
    for line in text.splitlines():
        words = line.split()
        if words[0] == "triangle_10pad":
            words[2], words[4], words[6] = f"{-float(words[2])}", f"{-float(words[4])}", "1"
        lines.append(" ".join(words))
    (bent / "behind.ini").write_text("\n".join(lines) + "\n", encoding="utf-8")
    front, behind = (module_poses(read_plan(bent / name), centres) for name in ("plan.ini", "behind.ini"))
    assert np.abs(front - behind).max() < 1e-9


def test_a_module_by_itself_is_refused(bent: Path) -> None:
    """Nothing says how it is turned; its number is named."""
    plan = read_plan(bent / "plan.ini")
    centres = np.array([pose[:3, 3] for pose in cylinder_modules(across=7, along=4)[1]])
    centres[5] += 1.0
    with pytest.raises(SkinError, match="module 5: expected at least two neighbours"):
        module_poses(plan, centres)


DAMAGE: dict[str, tuple[str, str, type[Exception], str]] = {
    "no number": ("_{module}", "", FormatError, "frames: expected a name with {module} in it"),
    "no such frame": ("shank_skin_", "shank_pad_", FormatError, "frames: expected links of robot.urdf called"),
    "no such link": ('link = "shank"', 'link = "shin"', RobotError, "has no link 'shin'"),
    "another link": ('link = "shank"', 'link = "foot"', FormatError, "to be fixed to 'foot', got a joint that moves"),
    "short message": ("252", "36", FormatError, "columns: expected 12 for each module up to 3, got 36"),
    "unknown key": ("columns", "colums", FormatError, "unknown key 'colums'"),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_what_does_not_fit_the_robot_is_refused(folder: Path, name: str) -> None:
    """With the file and the key."""
    old, new, kind, message = DAMAGE[name]
    (folder / "patch.toml").write_text(STATED.replace(old, new), encoding="utf-8")
    with pytest.raises(kind, match=message):
        describe_patch(folder / "patch.toml")


def test_a_plan_of_other_modules_is_refused(bent: Path) -> None:
    """Modules that are only in the plan, or only frames, are named."""
    plan = bent / "plan.ini"
    plan.write_text(
        plan.read_text(encoding="utf-8").replace("triangle_10pad 5 ", "triangle_10pad 50 "), encoding="utf-8"
    )
    with pytest.raises(FormatError, match=r"plan: expected .* got only one of \[5, 50\]"):
        describe_patch(bent / "patch.toml")
