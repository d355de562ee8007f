# SPDX-License-Identifier: BSD-3-Clause
"""Fresh copies of small complete experiments for every test: fixtures for a conftest to name."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.scenes.arm_folder import arm, intact
from tests.scenes.studies import write_days
from tests.scenes.warm_experiments import warm_up

__all__ = ["arm", "days", "intact", "intact_warm", "recorded", "warm"]


@pytest.fixture(scope="session")
def intact_warm(intact: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the experiment whose sensor drifts with temperature, without noise; nobody changes it."""
    return warm_up(intact, tmp_path_factory.mktemp("warm") / "arm")


@pytest.fixture
def warm(intact_warm: Path, tmp_path: Path) -> Path:
    """Folder with a copy of the drifting experiment, to damage; its file states no variable yet."""
    return Path(shutil.copytree(intact_warm, tmp_path / "warm"))


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the recordings of three days; nobody changes it."""
    folder = tmp_path_factory.mktemp("recorded")
    write_days(folder)
    return folder


@pytest.fixture
def days(recorded: Path, tmp_path: Path) -> Path:
    """Folder with a copy of them, to damage."""
    return Path(shutil.copytree(recorded, tmp_path / "days"))
