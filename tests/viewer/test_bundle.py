# SPDX-License-Identifier: BSD-3-Clause
"""The committed bundle is that of the committed sources."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ASSETS = Path("src/forcetorque/viewer/assets")


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Sources and bundle in another folder."""
    shutil.copytree(ROOT / "web", tmp_path / "web", ignore=shutil.ignore_patterns("node_modules"))
    shutil.copytree(ROOT / ASSETS, tmp_path / ASSETS)
    return tmp_path


def check(root: Path) -> subprocess.CompletedProcess[str]:
    """Run the check where there is no npm: hashes are then all there is to compare."""
    command = [sys.executable, str(root / "web" / "check_bundle.py")]
    return subprocess.run(command, env={"PATH": ""}, capture_output=True, text=True, check=False)


def test_bundle_is_up_to_date(copy: Path) -> None:
    """The hashes of sources and bundle are those of the last build, in any folder."""
    done = check(copy)
    assert done.returncode == 0, done.stderr
    assert "only hashes were compared: npm is not installed" in done.stdout


@pytest.mark.parametrize("name", ["web/src/main.ts", "web/package-lock.json", str(ASSETS / "viewer.js")])
def test_every_change_is_seen(copy: Path, name: str) -> None:
    """A changed source without its bundle, or a changed bundle, is named."""
    with (copy / name).open("a") as file:
        file.write("\n")
    done = check(copy)
    assert done.returncode == 1
    assert Path(name).name in done.stderr
    assert "run `make web`" in done.stderr


def test_new_source_is_seen(copy: Path) -> None:
    """A module that the build did not see counts as a change."""
    (copy / "web" / "src" / "more.ts").write_text("export {};\n")
    assert "web/src/more.ts" in check(copy).stderr


def test_licences_of_all_packages_are_shipped() -> None:
    """What the bundle contains is named with the text of its licence."""
    licences = (ROOT / ASSETS / "THIRD_PARTY_LICENSES.txt").read_text()
    for package in ("fflate", "three", "uplot", "mp4-muxer"):
        assert f"\n{package} " in licences
    assert licences.count("Permission is hereby granted") == 4
