# SPDX-License-Identifier: BSD-3-Clause
"""A fresh copy of a small complete experiment for every test: fixtures for a conftest to name."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.scenes.experiments import write_experiments


@pytest.fixture(scope="session")
def intact(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the experiment; nobody changes it."""
    folder = tmp_path_factory.mktemp("intact")
    write_experiments(folder)
    return folder


@pytest.fixture
def arm(intact: Path, tmp_path: Path) -> Path:
    """Folder with a copy of the experiment, to damage."""
    return Path(shutil.copytree(intact, tmp_path / "arm"))
