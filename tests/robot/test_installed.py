# SPDX-License-Identifier: BSD-3-Clause
"""Robots of installed packages stand where a URDF file may stand, and what is recorded of them."""

import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import pytest

from forcetorque.base.errors import MissingExtraError, RobotError
from forcetorque.experiment.named_files import Inputs, sha256_of
from forcetorque.robot import installed_robots as installed
from forcetorque.robot.installed_robots import (
    InstalledRobot,
    installed_robot,
    installed_robots,
    is_robot_name,
    urdf_file,
)
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.viewer.meshes import find_mesh, package_folders
from forcetorque.viewer.robot_shapes import read_visuals
from tests.scenes.robots import example_robot

_COMMIT = "0123456789abcdef0123456789abcdef01234567"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of robot_descriptions with one repository, which holds an arm, and one at another commit."""
    folder = tmp_path / "cache"
    for repository in (folder / "some_arms", folder / "older-1234" / "older"):
        (repository / ".git").mkdir(parents=True)
        (repository / ".git" / "HEAD").write_text(f"{_COMMIT}\n", encoding="utf-8")
        urdf = repository / "arm_description" / "urdf" / f"{repository.name}_robot.urdf"
        urdf.parent.mkdir(parents=True)
        urdf.write_bytes(ARM_URDF.read_bytes())
    monkeypatch.setenv("ROBOT_DESCRIPTIONS_CACHE", str(folder))
    return folder


def test_a_name_is_the_file_that_the_package_has() -> None:
    """`ur5` is ur5_robot.urdf; of ur3, the file without links is not taken; two with one name go by the description."""
    ur5 = example_robot("ur_description/urdf/ur5_robot.urdf")
    assert urdf_file("ur5") == ur5
    assert len(read_urdf(urdf_file("ur3")).links) > 6
    robots = installed_robots()
    assert {"anymal_b_simple", "anymal_c_simple", "panda", "talos_full_v2"} <= robots.keys()
    assert "anymal" not in robots
    assert {robot.version for robot in robots.values() if robot.package == "example-robot-data"} == {
        version("example-robot-data")
    }


@pytest.mark.parametrize("text", ["ur5.urdf", "robots/ur5", "./ur5", "UR5.URDF"])
def test_what_looks_like_a_file_stays_a_file(text: str, tmp_path: Path) -> None:
    """A suffix or a folder makes a path, whether or not the file exists."""
    assert not is_robot_name(text, tmp_path)
    assert urdf_file(text, tmp_path) == tmp_path / text


def test_a_file_that_exists_is_never_a_name(tmp_path: Path) -> None:
    """Without the file the same text is a name."""
    assert is_robot_name("ur5", tmp_path)
    (tmp_path / "ur5").write_bytes(ARM_URDF.read_bytes())
    assert not is_robot_name("ur5", tmp_path)
    assert urdf_file("ur5", tmp_path) == tmp_path / "ur5"


def test_an_unknown_name_lists_the_known_ones() -> None:
    """With the likeliest in front."""
    example_robot("ur_description/urdf/ur5_robot.urdf")
    pytest.importorskip("icub_models")
    with pytest.raises(RobotError, match=r"called 'ur_5'; did you mean \"ur5\"\? known: .*panda.*or name a URDF file"):
        installed_robot("ur_5")


def test_without_the_packages_the_extras_are_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Nothing is downloaded."""

    def absent(name: str) -> None:
        raise PackageNotFoundError(name)

    monkeypatch.setenv("ROBOT_DESCRIPTIONS_CACHE", str(tmp_path / "none"))
    monkeypatch.setitem(sys.modules, "icub_models", None)
    monkeypatch.setattr(installed, "distribution", absent)
    with pytest.raises(MissingExtraError, match=r"known: none; more robots: .*\[robots\].*\[icub\]"):
        installed_robot("ur5")


def test_the_cache_of_robot_descriptions_is_read(cache: Path) -> None:
    """With the commit in place of a version, and the roots of its packages."""
    found = installed_robot("some_arms")
    assert found == InstalledRobot(
        name="some_arms",
        urdf=cache / "some_arms" / "arm_description" / "urdf" / "some_arms_robot.urdf",
        package="some_arms",
        version=_COMMIT,
    )
    assert installed_robot("older").urdf.is_relative_to(cache / "older-1234" / "older")
    assert {cache, cache / "older-1234"} <= set(installed.package_roots())


def test_inputs_record_the_package_and_its_version(tmp_path: Path) -> None:
    """Beside the hash that every input has; a file is recorded by its path."""
    ur5 = example_robot("ur_description/urdf/ur5_robot.urdf")
    (tmp_path / "arm.urdf").write_bytes(ARM_URDF.read_bytes())
    inputs = Inputs(tmp_path)
    assert inputs.robot(Path("ur5")) == ur5
    assert inputs.robot(Path("arm.urdf")) == tmp_path / "arm.urdf"
    assert inputs.sha256() == {
        "arm.urdf": sha256_of(ARM_URDF),
        f"ur5 (example-robot-data {version('example-robot-data')})": sha256_of(ur5),
    }


def test_meshes_of_a_named_robot_are_found() -> None:
    """Every mesh of the arm lies in the package."""
    urdf = example_robot("ur_description/urdf/ur5_robot.urdf")
    names = [visual.file for visual in read_visuals(urdf) if visual.file is not None]
    assert names
    folders = package_folders(urdf)
    assert all(find_mesh(name, urdf, folders) is not None for name in names)
