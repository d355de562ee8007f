# SPDX-License-Identifier: BSD-3-Clause
"""A fresh copy of a small complete experiment, and a stand-in for the page's bundle."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.experiment.loading import load_experiment
from forcetorque.viewer.page import ASSETS
from forcetorque.viewer.scene_builder import BuiltScene, build_scene
from tests.scenes.experiments import PARQUET


@pytest.fixture(scope="session")
def built(intact: Path) -> BuiltScene:
    """Scene of the intact experiment."""
    return build_scene(load_experiment(intact / PARQUET), {}, urdf=intact / "arm.urdf")


@pytest.fixture(scope="session")
def assets(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the page's template and a bundle that does nothing."""
    folder = tmp_path_factory.mktemp("assets")
    (folder / "page.html").write_text((ASSETS / "page.html").read_text(encoding="utf-8"), encoding="utf-8")
    (folder / "viewer.js").write_text("window.ft = '</script><!-- é';", encoding="utf-8")
    (folder / "viewer.css").write_text("#viewer { color: black }", encoding="utf-8")
    (folder / "THIRD_PARTY_LICENSES.txt").write_text("some -- licence", encoding="utf-8")
    return folder
